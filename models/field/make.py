"""Writes the horizons, wells and tops that `field.toml` is made of: synthetic, as other programs export them.

A block tilted to the west, eroded by an unconformity. What is true is known in closed form (`TRUE`); wells and their tops follow it. The
horizons of the older rocks come from seismic data, which the velocities have put some metres too deep or too high (`miss`), with noise, a
hole and places without data. Coordinates are in the world (UTM), depths positive or elevations, metres or feet.
Python's standard library alone: python3 make.py
"""

import math
import pathlib
import random

HERE = pathlib.Path(__file__).parent
EAST, NORTH = 512000.0, 6745000.0
FOOT = 0.3048
# Nodes of the grids, local: 100 m apart, from 200 m outside of the domain on.
LOW, STEP, COUNTS = (-200.0, -200.0), 100.0, (45, 35)
# What the grids that are written with noise have (m).
NOISE = {"lower-sand": 0.5, "marine-shale": 0.4}
# A hole of the data: its middle and its radius.
HOLE = ((1400.0, 2000.0), 350.0)


def miss(x, y):
    """How much too high the seismic horizons of the older rocks are (m): velocities are not known between wells."""
    return 3.0 + 0.0008 * (x - 2000) + 2.0 * math.sin(x / 900) * math.cos(y / 1100)


def tilted(x, y):
    """The top of the coal measures: falls to the west by 2.3°, over a low ridge."""
    return -2205 + 0.04 * (x - 2000) + 25 * math.exp(-((y - 1500) ** 2) / 1.2e6)


# Elevations (m) in the local plan, from the oldest to the youngest; each is the base of what it is called after.
TRUE = {
    "base": lambda x, y: tilted(x, y) - 100,
    "lower-sand": lambda x, y: tilted(x, y) - 62,
    "coal-measures": lambda x, y: tilted(x, y) - 30 - 4 * math.sin(y / 600),
    "upper-sand": tilted,
    "marine-shale": lambda x, y: tilted(x, y) + 34 - 0.002 * x,
    "unconformity": lambda x, y: -2162 + 7 * math.cos(x / 1300) + 4 * math.sin(y / 800),
    "top": lambda x, y: -2104 - 0.004 * (y - 1500) + 3 * math.sin(x / 1500),
}
SEISMIC = ("lower-sand", "coal-measures", "upper-sand", "marine-shale")


def seen(name):
    """What the data have of a surface, without their noise."""
    true = TRUE[name]
    return (lambda x, y: true(x, y) + miss(x, y)) if name in SEISMIC else true


def write(name, lines):
    (HERE / name).write_text("\n".join(lines) + "\n")


def rows(values, count):
    return [" ".join(values[k : k + count]) for k in range(0, len(values), count)]


def node(i, j):
    return (LOW[0] + STEP * i, LOW[1] + STEP * j)


def esri(name, height):
    """Elevations, rows from north to south."""
    head = [f"ncols {COUNTS[0]}", f"nrows {COUNTS[1]}", f"xllcenter {EAST + LOW[0]}", f"yllcenter {NORTH + LOW[1]}"]
    head += [f"cellsize {STEP}", "NODATA_value -9999"]
    body = [" ".join(f"{height(*node(i, j)):.3f}" for i in range(COUNTS[0])) for j in reversed(range(COUNTS[1]))]
    write(name, head + body)


def irap(name, height, noise, corner=LOW, turn=0.0, counts=COUNTS, hole=None):
    """Depths with noise; the grid may be turned, and have a hole."""
    draw = random.Random(name)
    cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    values = []
    for j in range(counts[1]):
        for i in range(counts[0]):
            x = corner[0] + STEP * (i * cosine - j * sine)
            y = corner[1] + STEP * (i * sine + j * cosine)
            depth = -height(x, y) + draw.gauss(0, noise)
            outside = not (-350 <= x <= 4350 and -350 <= y <= 3350)
            missing = outside or (hole is not None and math.dist((x, y), hole[0]) < hole[1])
            values.append("9999900.0000" if missing else f"{depth:.4f}")
    x, y = EAST + corner[0], NORTH + corner[1]
    head = [
        f"-996 {counts[1]} {STEP} {STEP}",
        f"{x} {x + STEP * (counts[0] - 1)} {y} {y + STEP * (counts[1] - 1)}",
        f"{counts[0]} {turn:.6f} {x} {y}",
        "0 0 0 0 0 0 0",
    ]
    write(name, head + rows(values, 6))


def columns(height):
    """Columns from west to east, each from north to south."""
    return [[height(*node(i, j)) for j in reversed(range(COUNTS[1]))] for i in range(COUNTS[0])]


def zmap(name, height):
    """Depths in feet; the nodes of the north-eastern corner are null."""
    east, north = node(COUNTS[0] - 1, COUNTS[1] - 1)
    head = ["! depth in feet", f"@{name} HEADER, GRID, 5", "15, -99999.0000, , 4, 1"]
    head += [f"{COUNTS[1]}, {COUNTS[0]}, {EAST + LOW[0]}, {EAST + east}, {NORTH + LOW[1]}, {NORTH + north}", "0.0, 0.0, 0.0", "@"]
    body = []
    for i, column in enumerate(columns(height)):
        missing = max(0, i - COUNTS[0] + 6)
        fields = [f"{-99999.0 if k < missing else -value / FOOT:15.4f}" for k, value in enumerate(column)]
        body += ["".join(fields[k : k + 5]) for k in range(0, len(fields), 5)]
    write(name, head + body)


def cps3(name, height):
    """Elevations."""
    values = [value for column in columns(height) for value in column]
    east, north = node(COUNTS[0] - 1, COUNTS[1] - 1)
    head = ['FSASCI 0 1 "Computed" 0 1.0E+30', "FSATTR 0 0"]
    head += [f"FSLIMI {EAST + LOW[0]} {EAST + east} {NORTH + LOW[1]} {NORTH + north} {min(values):.3f} {max(values):.3f}"]
    head += [f"FSNROW {COUNTS[1]} {COUNTS[0]}", f"FSXINC {STEP} {STEP}", f"->{name}"]
    write(name, head + rows([f"{value:.4f}" for value in values], 5))


def tsurf(name, height):
    """A triangulation of jittered nodes; the file itself says that its z is depth."""
    draw = random.Random(name)
    step, counts = 175.0, (26, 20)
    lines = ["GOCAD TSurf 1", "HEADER {", "name:unconformity", "}", "GOCAD_ORIGINAL_COORDINATE_SYSTEM", "NAME Default"]
    lines += ['AXIS_NAME "X" "Y" "Z"', 'AXIS_UNIT "m" "m" "m"', "ZPOSITIVE Depth", "END_ORIGINAL_COORDINATE_SYSTEM", "TFACE"]
    for j in range(counts[1]):
        for i in range(counts[0]):
            x, y = -180 + step * i + draw.uniform(-40, 40), -160 + step * j + draw.uniform(-40, 40)
            lines.append(f"VRTX {1 + i + counts[0] * j} {EAST + x:.3f} {NORTH + y:.3f} {-height(round(x, 3), round(y, 3)):.4f}")
    for j in range(counts[1] - 1):
        for i in range(counts[0] - 1):
            a = 1 + i + counts[0] * j
            lines += [f"TRGL {a} {a + 1} {a + counts[0] + 1}", f"TRGL {a} {a + counts[0] + 1} {a + counts[0]}"]
    write(name, lines + ["END"])


def csv(name, height):
    """Scattered depths in feet, some without a value."""
    draw = random.Random(name)
    lines = ["Point;Northing;Easting;TVDSS (ft)"]
    for k in range(600):
        x, y = round(draw.uniform(-200, 4200), 2), round(draw.uniform(-200, 3200), 2)
        value = "-999.25" if k % 40 == 39 else f"{-height(x, y) / FOOT:.3f}"
        lines.append(f"P{k + 1};{NORTH + y:.2f};{EAST + x:.2f};{value}")
    write(name, lines)


def tangent(inclination, azimuth):
    i, a = math.radians(inclination), math.radians(azimuth)
    return (math.sin(i) * math.sin(a), math.sin(i) * math.cos(a), math.cos(i))


def along(start, end, md):
    """From one station (md, inclination, azimuth) on the arc towards the next one as far as a measured depth: east, north, down."""
    t, t2 = tangent(*start[1:]), tangent(*end[1:])
    beta = math.acos(max(-1.0, min(1.0, sum(a * b for a, b in zip(t, t2)))))
    length = md - start[0]
    if beta < 1e-9 or length == 0:
        return tuple(length * a for a in t)
    angle = beta * length / (end[0] - start[0])
    radius = length / angle
    side = tuple((b - math.cos(beta) * a) / math.sin(beta) for a, b in zip(t, t2))
    return tuple(radius * (math.sin(angle) * a + (1 - math.cos(angle)) * b) for a, b in zip(t, side))


class Well:
    """A well by its head (local), the elevation of its datum, and its stations."""

    def __init__(self, head, datum, stations):
        self.head, self.datum, self.stations = head, datum, stations
        self.places = [(*head, datum)]
        for a, b in zip(stations, stations[1:]):
            east, north, down = along(a, b, b[0])
            x, y, z = self.places[-1]
            self.places.append((x + east, y + north, z - down))

    def at(self, md):
        """Its place, local, with an elevation."""
        k = max(k for k in range(len(self.stations) - 1) if self.stations[k][0] <= md)
        east, north, down = along(self.stations[k], self.stations[k + 1], md)
        x, y, z = self.places[k]
        return (x + east, y + north, z - down)

    def above(self, name, md):
        x, y, z = self.at(md)
        return z - TRUE[name](x, y)

    def tops(self):
        """Where it enters what lies below a surface for the first time, as far as that has not been eroded there."""
        last = self.stations[-1][0]
        for name in (*SEISMIC, "unconformity"):
            step = 5.0
            md = next((k * step for k in range(int(last / step)) if self.above(name, (k + 1) * step) < 0), None)
            if md is None:
                continue
            low, high = md, md + step
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if self.above(name, middle) > 0 else (low, middle)
            x, y, z = self.at(low)
            if name == "unconformity" or z < TRUE["unconformity"](x, y):
                yield name, low


def build(kick, rate, hold, azimuth, last):
    """Down to the kick-off, so many degrees in 30 m up to an inclination, and on to the last depth."""
    stations = [(kick * k / 10, 0.0, azimuth) for k in range(11)]
    steps = math.ceil(hold / rate * 2)
    stations += [(kick + 15.0 * k, hold * k / steps, azimuth) for k in range(1, steps + 1)]
    reached = stations[-1][0]
    count = math.ceil((last - reached) / 90)
    return stations + [(reached + (last - reached) * k / count, hold, azimuth) for k in range(1, count + 1)]


# Two explorers and three producers from one site.
SITE = (2300.0, 1350.0)
WELLS = {
    "F-1": Well((1200.0, 1100.0), 25.0, build(1500.0, 2.0, 2.0, 40.0, 2420.0)),
    "F-2": Well((3150.0, 2150.0), 25.0, build(1500.0, 2.0, 3.0, 220.0, 2350.0)),
    "P-1": Well(SITE, 32.0, build(1200.0, 2.5, 35.0, 285.0, 2650.0)),
    "P-2": Well(SITE, 32.0, build(1300.0, 2.5, 32.0, 160.0, 2560.0)),
    "P-3": Well(SITE, 32.0, build(1635.0, 3.0, 88.0, 275.0, 3115.0)),
}


def survey_csv(name, well):
    write(name, ["MD,INCL,AZIM_GN", *(f"{md:.2f},{inc:.3f},{azi:.2f}" for md, inc, azi in well.stations)])


def survey_las(name, well, label):
    """In feet."""
    head = ["~Version", "VERS. 2.0 : CWLS LOG ASCII STANDARD", "WRAP. NO : one line a depth", "~Well"]
    head += [f"STRT.FT {well.stations[0][0] / FOOT:.4f} :", f"STOP.FT {well.stations[-1][0] / FOOT:.4f} :", "STEP.FT 0 :"]
    head += ["NULL. -999.25 :", f"WELL. {label} :", "~Parameter", f"EKB.FT {well.datum / FOOT:.4f} : kelly bushing above the sea"]
    head += ["~Curve", "DEPT.FT : measured depth", "DEVI.DEG : inclination", "HAZI.DEG : azimuth from grid north", "~ASCII"]
    write(name, head + [f"{md / FOOT:12.4f} {inc:8.3f} {azi:8.2f}" for md, inc, azi in well.stations])


def survey_dev(name, well, label):
    rule = "#" + "=" * 80
    lines = ["# WELL TRACE FROM PETREL", f"# WELL NAME:              {label}"]
    lines += [f"# WELL HEAD X-COORDINATE: {EAST + well.head[0]:.8f} (m)", f"# WELL HEAD Y-COORDINATE: {NORTH + well.head[1]:.8f} (m)"]
    lines += [f"# WELL DATUM (KB, Kelly bushing, from MSL): {well.datum:.8f} (m)", "# WELL TYPE:              OIL"]
    lines += ["# MD AND TVD ARE REFERENCED (=0) AT WELL DATUM AND INCREASE DOWNWARDS", rule]
    lines += [" ".join(f"{word:>14}" for word in "MD X Y Z TVD DX DY AZIM_TN INCL AZIM_GN".split()), rule]
    for (md, inc, azi), (x, y, z) in zip(well.stations, well.places):
        row = (md, EAST + x, NORTH + y, z, well.datum - z, x - well.head[0], y - well.head[1], (azi + 1.5) % 360, inc, azi)
        lines.append(" ".join(f"{value:14.4f}" for value in row))
    write(name, lines)


def picks(name):
    lines = ["well,horizon,md"]
    for label, well in WELLS.items():
        unit = FOOT if label == "F-2" else 1.0
        lines += [f"{label},{horizon},{md / unit:.3f}" for horizon, md in well.tops()]
    write(name, lines)


def main():
    esri("base.asc", seen("base"))
    irap("lower-sand.irap", seen("lower-sand"), NOISE["lower-sand"], hole=HOLE)
    zmap("coal-measures.zmap", seen("coal-measures"))
    cps3("upper-sand.cps3", seen("upper-sand"))
    turned = {"corner": (-300.0, -1900.0), "turn": 25.0, "counts": (60, 62)}
    irap("marine-shale.irap", seen("marine-shale"), NOISE["marine-shale"], **turned)
    tsurf("unconformity.ts", seen("unconformity"))
    csv("top.csv", seen("top"))
    survey_csv("f-1.csv", WELLS["F-1"])
    survey_las("f-2.las", WELLS["F-2"], "F-2")
    for label in ("P-1", "P-2", "P-3"):
        survey_dev(f"{label.lower()}.dev", WELLS[label], label)
    picks("tops.csv")


if __name__ == "__main__":
    main()

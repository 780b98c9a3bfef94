"""Writes the files of heights that `from-files.toml` is made of: synthetic, each in another format, with what exported data have.

Coordinates are in the world (UTM), depths positive or elevations, metres or feet; one grid is turned, has a hole and noise. The
surfaces lie above one another by distances that are known, so the volumes between them are, too.
Python's standard library alone: python3 make.py
"""

import math
import pathlib
import random

HERE = pathlib.Path(__file__).parent
EAST, NORTH = 456000.0, 6782000.0
FOOT = 0.3048


def structure(x, y):
    """A dome of 40 m on a slope of half a degree; local coordinates, elevation in metres."""
    return -1600 - 0.009 * (x - 2000) + 40 * math.exp(-((x - 2000) ** 2 + (y - 1500) ** 2) / 1.2e6)


def sand(x):
    """Thickness of the sand, which wedges out eastwards."""
    return max(0.0, 12 * (1 - x / 2600))


def write(name, lines):
    (HERE / name).write_text("\n".join(lines) + "\n")


def rows(values, count):
    return [" ".join(values[k : k + count]) for k in range(0, len(values), count)]


def esri(name, height):
    step, low, counts = 200.0, (-300.0, -300.0), (24, 19)
    head = [f"ncols {counts[0]}", f"nrows {counts[1]}", f"xllcorner {EAST + low[0] - step / 2}", f"yllcorner {NORTH + low[1] - step / 2}"]
    head += [f"cellsize {step}", "NODATA_value -9999"]
    body = [
        " ".join(f"{height(low[0] + step * i, low[1] + step * j):.3f}" for i in range(counts[0]))
        for j in reversed(range(counts[1]))
    ]
    write(name, head + body)


def irap(name, height, noise):
    """Turned by 20°, with noise, and a hole of 300 m around (2600, 1800)."""
    draw = random.Random(7)
    step, turn, counts, first = 80.0, math.radians(20), (75, 65), (-300.0, -1700.0)
    values = []
    for j in range(counts[1]):
        for i in range(counts[0]):
            x = first[0] + step * (i * math.cos(turn) - j * math.sin(turn))
            y = first[1] + step * (i * math.sin(turn) + j * math.cos(turn))
            outside = not (-150 <= x <= 4150 and -150 <= y <= 3150)
            hole = math.hypot(x - 2600, y - 1800) < 300
            depth = -height(x, y) + draw.gauss(0, noise)
            values.append("9999900.0" if outside or hole else f"{depth:.2f}")
    head = [
        f"-996 {counts[1]} {step} {step}",
        f"{EAST + first[0]} {EAST + first[0] + step * (counts[0] - 1)} {NORTH + first[1]} {NORTH + first[1] + step * (counts[1] - 1)}",
        f"{counts[0]} {math.degrees(turn):.6f} {EAST + first[0]} {NORTH + first[1]}",
        "0 0 0 0 0 0 0",
    ]
    write(name, head + rows(values, 6))


def columns(height, low, step, counts):
    """Columns from west to east, each from north to south."""
    return [[height(low[0] + step * i, low[1] + step * j) for j in reversed(range(counts[1]))] for i in range(counts[0])]


def zmap(name, height):
    """Depths in feet."""
    low, step, counts = (-200.0, -200.0), 100.0, (45, 35)
    east, north = low[0] + step * (counts[0] - 1), low[1] + step * (counts[1] - 1)
    head = [f"! made by {pathlib.Path(__file__).name}: depth in feet", f"@{name} HEADER, GRID, 5", "12, 1.0E+30, , 2, 1"]
    head += [f"{counts[1]}, {counts[0]}, {EAST + low[0]}, {EAST + east}, {NORTH + low[1]}, {NORTH + north}", "0.0, 0.0, 0.0", "@"]
    body = []
    for column in columns(height, low, step, counts):
        fields = [f"{-value / FOOT:12.2f}" for value in column]
        body += ["".join(fields[k : k + 5]) for k in range(0, len(fields), 5)]
    write(name, head + body)


def cps3(name, height):
    low, step, counts = (-250.0, -250.0), 125.0, (37, 29)
    values = [value for column in columns(height, low, step, counts) for value in column]
    east, north = low[0] + step * (counts[0] - 1), low[1] + step * (counts[1] - 1)
    head = ['FSASCI 0 1 "Computed" 0 1.0E+30', "FSATTR 0 0"]
    head += [f"FSLIMI {EAST + low[0]} {EAST + east} {NORTH + low[1]} {NORTH + north} {min(values):.3f} {max(values):.3f}"]
    head += [f"FSNROW {counts[1]} {counts[0]}", f"FSXINC {step} {step}", f"->{name}"]
    write(name, head + rows([f"{value:.3f}" for value in values], 5))


def tsurf(name, height):
    """A triangulation of jittered nodes."""
    draw = random.Random(11)
    step, counts = 190.0, (24, 19)
    lines = ["GOCAD TSurf 1", "HEADER {", "name:upper", "}", "GOCAD_ORIGINAL_COORDINATE_SYSTEM", "NAME Default"]
    lines += ['AXIS_NAME "X" "Y" "Z"', 'AXIS_UNIT "m" "m" "m"', "ZPOSITIVE Depth", "END_ORIGINAL_COORDINATE_SYSTEM", "TFACE"]
    for j in range(counts[1]):
        for i in range(counts[0]):
            x = -200 + step * i + draw.uniform(-40, 40)
            y = -200 + step * j + draw.uniform(-40, 40)
            lines.append(f"VRTX {1 + i + counts[0] * j} {EAST + x:.3f} {NORTH + y:.3f} {-height(x, y):.4f}")
    for j in range(counts[1] - 1):
        for i in range(counts[0] - 1):
            a = 1 + i + counts[0] * j
            lines += [f"TRGL {a} {a + 1} {a + counts[0] + 1}", f"TRGL {a} {a + counts[0] + 1} {a + counts[0]}"]
    write(name, lines + ["END"])


def scattered(seed, count):
    draw = random.Random(seed)
    return [(draw.uniform(-200, 4200), draw.uniform(-200, 3200)) for _ in range(count)]


def xyz(name, height):
    lines = ["# easting northing elevation"]
    lines += [f"{EAST + x:.2f} {NORTH + y:.2f} {height(x, y):.3f}" for x, y in scattered(3, 900)]
    write(name, lines)


def csv(name, height):
    lines = ["Point,Northing,Easting,TVDSS (ft),Remark"]
    for k, (x, y) in enumerate(scattered(5, 700)):
        value = "-999.25" if k % 50 == 49 else f"{-height(x, y) / FOOT:.2f}"
        lines.append(f'P{k + 1},{NORTH + y:.2f},{EAST + x:.2f},{value},"seismic, second pass"')
    write(name, lines)


esri("base.asc", lambda x, y: structure(x, y) - 80)
irap("lower.irap", lambda x, y: structure(x, y) - 55, 0.4)
zmap("sand-base.zmap", lambda x, y: structure(x, y) - 35)
zmap("sand-top.zmap", lambda x, y: structure(x, y) - 35 + sand(x))
cps3("middle.cps3", lambda x, y: structure(x, y) - 12)
tsurf("upper.ts", lambda x, y: structure(x, y) + 3)
xyz("coal.xyz", lambda x, y: structure(x, y) + 18)
csv("top.csv", lambda x, y: structure(x, y) + 35)

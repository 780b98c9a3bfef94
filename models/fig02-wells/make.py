"""Writes the surveys of the wells A-3 (Petrel's well trace) and A-4 (a table): synthetic, and always the same bytes."""

from math import acos, atan2, cos, degrees, radians, sin, tan
from pathlib import Path

HERE = Path(__file__).parent
HEAD, DATUM = (456220.0, 6782080.0), 25.0


def tangent(inclination, azimuth):
    i, a = radians(inclination), radians(azimuth)
    return (sin(i) * sin(a), sin(i) * cos(a), cos(i))


def positions(stations):
    """East, north and depth below the datum by minimum curvature."""
    place, places = (0.0, 0.0, 0.0), [(0.0, 0.0, 0.0)]
    for (md, inc, azi), (md2, inc2, azi2) in zip(stations, stations[1:]):
        t, t2 = tangent(inc, azi), tangent(inc2, azi2)
        beta = acos(min(1.0, sum(a * b for a, b in zip(t, t2))))
        factor = 0.5 if beta < 1e-6 else tan(beta / 2) / beta
        place = tuple(p + (md2 - md) * factor * (a + b) for p, a, b in zip(place, t, t2))
        places.append(place)
    return places


def horizontal():
    """Down to 1744 m, up to 90° by 6° in 30 m, and on through the upper shoreface."""
    stations = [(43.6 * k, 0.0, 350.0) for k in range(41)]
    stations += [(1744.0 + 15.0 * k, 3.0 * k, 350.0) for k in range(1, 31)]
    stations += [(2194.0 + 30.0 * k, 90.0, 350.0) for k in range(1, 9)]
    return stations


def slanted():
    """Down to 1500 m, 3° in 30 m up to 30°, and straight on."""
    stations = [(0.0, 0.0, 20.0), (750.0, 0.0, 20.0), (1500.0, 0.0, 20.0)]
    stations += [(1500.0 + 30.0 * k, 3.0 * k, 20.0) for k in range(1, 11)]
    stations += [(1800.0 + 85.0 * k, 30.0, 20.0) for k in range(1, 5)]
    return stations


def dev(name, stations):
    rule = "#" + "=" * 120
    lines = [
        "# WELL TRACE FROM PETREL",
        f"# WELL NAME:              {name}",
        f"# WELL HEAD X-COORDINATE: {HEAD[0]:.8f} (m)",
        f"# WELL HEAD Y-COORDINATE: {HEAD[1]:.8f} (m)",
        f"# WELL DATUM (KB, Kelly bushing, from MSL): {DATUM:.8f} (m)",
        "# WELL TYPE:              OIL",
        "# MD AND TVD ARE REFERENCED (=0) AT WELL DATUM AND INCREASE DOWNWARDS",
        rule,
        " ".join(f"{word:>14}" for word in "MD X Y Z TVD DX DY AZIM_TN INCL DLS AZIM_GN".split()),
        rule,
    ]
    before = stations[0]
    for (md, inc, azi), (east, north, tvd) in zip(stations, positions(stations)):
        turn = sum(a * b for a, b in zip(tangent(*before[1:]), tangent(inc, azi)))
        dogleg = degrees(acos(min(1.0, turn))) / max(md - before[0], 1e-9) * 30.0
        row = (md, HEAD[0] + east, HEAD[1] + north, DATUM - tvd, tvd, east, north, (azi + 1.2) % 360, inc, dogleg, azi)
        lines.append(" ".join(f"{value:14.4f}" for value in row))
        before = (md, inc, azi)
    return "\n".join(lines) + "\n"


(HERE / "a-3.dev").write_text(dev("A-3", horizontal()))
rows = [f"{md:.1f},{inc:.2f},{azi:.2f}" for md, inc, azi in slanted()]
(HERE / "a-4.csv").write_text("\n".join(["MD,INCL,AZIM_GN", *rows]) + "\n")

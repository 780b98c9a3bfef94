"""Writes the solids that `salt.toml` is made of, in build123d: a salt dome as STEP, a cavern as BREP.

The dome is a stem of 600 m radius under a bulb that overhangs it: an ellipsoid of revolution of 1000 m by 500 m, cut where it is as
wide as the stem. Its file counts in millimetres, as files of CAD programs do. The cavern is a cylinder of 40 m radius and 200 m
height between two cones of 30 m, about its own origin; BREP has no unit, and its numbers are metres.

    pip install build123d==0.12.0
    python3 make.py
"""

import math
import pathlib

import build123d as bd

HERE = pathlib.Path(__file__).parent
# STEP has the time when it was written: always the same.
WRITTEN = "2026-01-01T00:00:00"
MM = 1000.0

STEM, BULB, HALF_HEIGHT, MIDDLE, FOOT = 600.0, 1000.0, 500.0, -1400.0, -3600.0


def dome():
    # Of a sphere of the bulb's radius the part above the stem; then half as high as wide.
    edge = -math.acos(STEM / BULB)
    sphere = bd.Solid.make_sphere(BULB * MM, angle1=math.degrees(edge), angle2=90)
    bulb = sphere.transform_geometry(bd.Matrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, HALF_HEIGHT / BULB, 0]]))
    bulb = bulb.moved(bd.Location((0, 0, MIDDLE * MM)))
    shoulder = MIDDLE + HALF_HEIGHT * math.sin(edge)
    stem = bd.Solid.make_cylinder(STEM * MM, (shoulder - FOOT) * MM, bd.Plane((0, 0, FOOT * MM)))
    return bulb.fuse(stem)


def cavern():
    points = [(0, -130), (40, -100), (40, 100), (0, 130)]
    with bd.BuildSketch(bd.Plane.XZ) as half:
        with bd.BuildLine():
            bd.Polyline(*points, close=True)
        bd.make_face()
    return bd.revolve(half.sketch, axis=bd.Axis.Z)


if __name__ == "__main__":
    bd.export_step(dome(), HERE / "salt.step", unit=bd.Unit.MM, timestamp=WRITTEN)
    bd.export_brep(cavern(), HERE / "cavern.brep")

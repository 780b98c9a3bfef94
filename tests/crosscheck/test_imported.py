"""Solids that build123d made and that a model holds: what is left of them, and of the beds that they pierce, has the volume that
build123d's own Boolean operations give.

Its integrals are asked for 1e-9, since its `volume` is off by a percent on a rational spline.
"""

import math
import sys
import tomllib

import build123d as bd
import pytest
from conftest import ROOT, Build, fine_volumes

FOLDER = ROOT / "models" / "salt"
TEXT = (FOLDER / "salt.toml").read_text()
MODEL = tomllib.loads(TEXT)
FEATURES = {feature["id"]: feature for feature in MODEL["feature"]}
DOMAIN = [MODEL["domain"][axis] for axis in "xyz"]


def exact(shape):
    """The volume of a shape's solids (m³)."""
    total = 0.0
    for solid in shape.solids():
        *_, last = fine_volumes(solid)
        total += last
    return total


def slab(low, high):
    (west, east), (south, north), _ = DOMAIN
    box = bd.Solid.make_box(east - west, north - south, high - low)
    return box.moved(bd.Location((west, south, low)))


def below_shale():
    """What of the domain lies below the base of the shale, which dips: a prism along y."""
    plane = FEATURES["shale"]["surface"]["dipping"]
    (west, east), (south, north), (base, _) = DOMAIN
    x, _, z = plane["through"]
    fall = math.tan(math.radians(plane["dip_deg"]))
    corners = [(west, base), (east, base), (east, z - (east - x) * fall), (west, z - (west - x) * fall)]
    face = bd.Face(bd.Wire.make_polygon([bd.Vector(u, south, w) for u, w in corners], close=True))
    return bd.Solid.extrude(face, bd.Vector(0, north - south, 0))


@pytest.fixture(scope="module")
def solids():
    sys.path.insert(0, str(FOLDER))
    try:
        import make  # noqa: PLC0415  # the model's own
    finally:
        sys.path.remove(str(FOLDER))
    dome = make.dome().solid().scale(1 / make.MM)
    place = {name: bd.Location(tuple(FEATURES[name]["at"])) for name in ("salt", "cavern")}
    return dome.moved(place["salt"]), make.cavern().solid().moved(place["cavern"])


@pytest.fixture(scope="module")
def built(clinothem, tmp_path_factory):
    folder = tmp_path_factory.mktemp("salt")
    clinothem("build", FOLDER / "salt.toml", "-o", folder / "out", "--formats", "step,brep")
    return Build("salt", folder / "out")


def test_what_is_left_is_what_build123d_leaves(solids, built):
    dome, cavern = solids
    levels = [FEATURES[name]["surface"]["level"] for name in ("sand", "upper-shale", "cover")]
    deep = below_shale()
    shale = slab(DOMAIN[2][0], levels[0]) - deep
    right = {
        "background": deep - dome,
        "shale": shale - dome,
        "sand": slab(levels[0], levels[1]) - dome,
        "upper-shale": slab(levels[1], levels[2]) - dome,
        "salt": (dome & slab(*DOMAIN[2])) - cavern,
        "salt/cavern": cavern,
        "cover": slab(levels[2], DOMAIN[2][1]),
    }
    assert set(built.volumes) == set(right)
    for name, shape in right.items():
        assert sum(built.volumes[name].solids) == pytest.approx(exact(shape), rel=1e-5), name


def test_files_are_written_again_as_they_are(tmp_path, solids):
    import make  # noqa: PLC0415

    bd.export_step(make.dome(), tmp_path / "salt.step", unit=bd.Unit.MM, timestamp=make.WRITTEN)
    bd.export_brep(make.cavern(), tmp_path / "cavern.brep")
    for name in ("salt.step", "cavern.brep"):
        assert (tmp_path / name).read_bytes() == (FOLDER / name).read_bytes(), name

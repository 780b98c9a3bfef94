"""Builds of every model in `models/`, made once a session, and what their reports promise.

The program is `target/release/clinothem`, built first if need be; CLINOTHEM_BIN names another one.
Run from the repository: script/crosscheck
"""

import json
import os
import pathlib
import subprocess
import tomllib
from dataclasses import dataclass
from functools import cached_property

import build123d as bd
import pytest
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from xdist.scheduler import LoadScopeScheduling

ROOT = pathlib.Path(__file__).resolve().parents[2]


def is_block(path):
    """Whether the domain is a block: the checks here know its walls. Models with a base or a top of their own are checked in
    tests/strata.rs, against columns under their horizons."""
    domain = tomllib.loads(path.read_text())["domain"]
    return not {"base", "top"} & domain.keys()


MODELS = [path for path in sorted(ROOT.glob("models/*/*.toml")) if is_block(path)]
assert MODELS, "there are no models to check"
STEMS = {path.stem for path in ROOT.glob("models/*/*.toml")}

# How well a reader's integrals must agree with our volumes and areas, of a solid and of the sum. OpenCASCADE's adaptive ones, asked for
# 1e-6, do to some 1e-8, and now and then end far away, whatever the accuracy asked for: the volume of a levee's channel by 1.5e-4, in
# millimetres. Those by Gauss and Kronrod, span by span, do to 1.4e-6, but take many minutes for some thin wedges of facies. So the
# next one is asked where one does not agree.
FINE, FINE_SUM = 1e-5, 1e-6
# Its integrals with a fixed number of points, which is what a reader's `volume` is, miss by up to 4e-2 of a solid, whatever program
# wrote the file. Where there is nothing else, two readers must agree about what these make of a solid (2e-5 apart were seen),
# and all solids fill the domain.
ROUGH, ROUGH_SUM = 1e-3, 1e-4
# Fixed rules miss hinges of folds, and walls that end at them; a dome is round. What the report promises is compared by integrals that converge.
CRUDE = {"fig10a-recumbent-fold": 5e-4, "parallel-fold": 5e-4, "salt": 5e-4}
# How many tolerances the boundary of a tiny, sharp piece may be off: 3.1 in a sliver of 25 litres of `coastal`.
SHARP = 4


def readable(name):
    """A name as build123d shows it, which has a line for some characters."""
    return name.translate(str.maketrans(" .()", "____"))


def fine_volumes(solid):
    """Of a solid of build123d or cadquery: OpenCASCADE's integrals, from the quickest to the surest."""
    for accuracy in (1e-6, 1e-9):
        props = GProp_GProps()
        BRepGProp.VolumeProperties_s(solid.wrapped, props, accuracy, False, False)
        yield props.Mass()
    props = GProp_GProps()
    only_closed, by_span, center, inertia, once = False, True, False, False, False
    BRepGProp.VolumePropertiesGK_s(solid.wrapped, props, 1e-6, only_closed, by_span, center, inertia, once)
    yield props.Mass()


@dataclass(frozen=True)
class Volume:
    """What the report says of a volume that has solids."""

    name: str
    # What readers call it.
    shown: str
    feature: str
    # What it lies in, or goes along.
    above: str | None
    color: tuple[int, int, int]
    solids: list[float]
    neighbours: dict[str, float]
    outer_area: float


@dataclass(frozen=True)
class Build:
    """A model's outputs."""

    stem: str
    dir: pathlib.Path

    def path(self, suffix):
        return self.dir / f"{self.stem}{suffix}"

    @property
    def step(self):
        return self.path(".step")

    @property
    def shared(self):
        return self.path(".shared.step")

    @property
    def brep(self):
        return self.path(".brep")

    @cached_property
    def report(self):
        return json.loads((self.dir / "report.json").read_text())

    @cached_property
    def volumes(self):
        """By name, in the report's order; volumes that younger ones removed altogether have no solids and no part."""
        return {
            v["name"]: Volume(
                v["name"],
                v["display_name"] or v["name"],
                v["feature"],
                v.get("along") or v["parent"],
                tuple(bytes.fromhex(v["color"].removeprefix("#"))),
                [s["volume_m3"] for s in v["solids"]],
                {n["name"]: n["area_m2"] for n in v["neighbours"]},
                v["outer_area_m2"],
            )
            for v in self.report["volumes"]
            if v["solids"]
        }

    @property
    def solids(self):
        """(volume's name, m³) of all solids in the order of the shared shape."""
        return [(v.name, size) for v in self.volumes.values() for size in v.solids]

    @cached_property
    def parts(self):
        """Volumes by the names of their parts: a volume that has several solids has a part for each."""
        found = {}
        for volume in self.volumes.values():
            count = len(volume.solids)
            names = [volume.shown] if count == 1 else [f"{volume.shown}#{number}" for number in range(1, count + 1)]
            found |= {readable(name): volume for name in names}
        return found

    def volume_of(self, part):
        """The volume that a part of the assembly is, or is a piece of."""
        return self.parts[readable(part)]

    def are_parts(self, names):
        """Whether these are all parts, each once."""
        return sorted(map(readable, names)) == sorted(self.parts)

    @property
    def domain(self):
        return self.report["domain"]

    @property
    def skin(self):
        """Area of the domain's six walls (m²)."""
        x, y, z = (high - low for low, high in (self.domain[axis] for axis in "xyz"))
        return 2 * (x * y + y * z + z * x)

    @property
    def faces(self):
        return self.report["assembly"]["faces"]

    @cached_property
    def rough(self):
        """(volume's name, m³) of all solids by build123d's own integrals with a fixed number of points."""
        solids = bd.import_brep(self.brep).solids()
        return [(name, solid.volume) for solid, (name, _) in zip(solids, self.solids, strict=True)]

    @property
    def crude(self):
        """How far integrals with a fixed number of points are off, relatively, of faces that bend sharply or are round: sums of volumes, and the domain's skin."""
        return CRUDE.get(self.stem, 0.0)

    @property
    def tolerance(self):
        return self.report["assembly"]["tolerance_m"]

    def fine_volume(self, solid, promised, area, unit=1.0):
        """A solid's volume by the first of OpenCASCADE's integrals that agrees with what the report promises (m³); else by the last."""
        found = 0.0
        for volume in fine_volumes(solid):
            found = volume / unit**3
            if self.same_volume(found, promised, FINE, area):
                break
        return found

    def same_volume(self, found, promised, relative, area):
        """A tiny piece is known no better than its boundary: some tolerances (where faces meet at a few degrees, curves
        move by more than one) times area, but never more than ten litres."""
        floor = min(SHARP * self.tolerance * area, 0.01)
        return abs(found - promised) <= max(relative * promised, floor)


class ByModel(LoadScopeScheduling):
    """Where several processes share the work, all tests of a model go to one of them, which builds it once."""

    def _split_scope(self, nodeid):
        module, _, parameters = nodeid.partition("[")
        stems = [stem for stem in STEMS if parameters.startswith(stem)]
        return max(stems, key=len, default=module.split("::")[0])


def pytest_xdist_make_scheduler(config, log):
    return ByModel(config, log)


@pytest.fixture(scope="session")
def program():
    """Where the program is."""
    program = os.environ.get("CLINOTHEM_BIN")
    if program is None:
        subprocess.run(["cargo", "build", "--quiet", "--release", "--bin", "clinothem"], cwd=ROOT, check=True)
        target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
        program = ROOT / target / "release" / "clinothem"
    return pathlib.Path(program).resolve()


@pytest.fixture(scope="session")
def clinothem(program):
    """Runs the program with these arguments, in this folder; it is to end with this code."""

    def run(*arguments, cwd=ROOT, code=0):
        command = [str(program), *map(str, arguments)]
        done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
        assert done.returncode == code, f"{' '.join(command)} ended with {done.returncode}\n{done.stderr}"
        return done

    return run


@pytest.fixture(scope="session", params=MODELS, ids=lambda path: path.stem)
def model(request):
    return request.param


@pytest.fixture(scope="session")
def build(model, clinothem, tmp_path_factory):
    folder = tmp_path_factory.mktemp(model.stem)
    clinothem("build", model, "-o", folder / "out", "--formats", "step,step-shared,brep")
    return Build(model.stem, folder / "out")

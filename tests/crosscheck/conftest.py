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

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def is_block(path):
    """Whether the domain is a block: the checks here know its walls. Models with a base or a top of their own are checked in
    tests/strata.rs, against columns under their horizons."""
    domain = tomllib.loads(path.read_text())["domain"]
    return not {"base", "top"} & domain.keys()


MODELS = [path for path in sorted(ROOT.glob("models/*/*.toml")) if is_block(path)]
assert MODELS, "there are no models to check"

# How the readers see volumes. Their `volume` integrates with a fixed number of points: on our solids it misses by up
# to 8e-4 of a solid and 6e-5 of the sum, whatever program wrote the file. Where a reader lets us ask for an accuracy
# (1e-6), it must agree a hundred times better.
ROUGH, ROUGH_SUM, FINE, FINE_SUM = 1e-3, 1e-4, 1e-5, 1e-6
# The same for models with ellipsoids, whose rational surfaces the fixed number of points fits worse, and with horizons that cut
# each other along winding lines: up to 2.3e-3, of BREP as well.
ROUGH_ROUND = 3e-3
# How many tolerances the boundary of a tiny, sharp piece may be off: 3.1 in a sliver of 25 litres of `coastal`.
SHARP = 4


@dataclass(frozen=True)
class Volume:
    """What the report says of a volume that has solids."""

    name: str
    feature: str
    parent: str | None
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
                v["feature"],
                v["parent"],
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
    def pieces(self):
        """Volumes by the names of their solids."""
        return {s["name"]: v["name"] for v in self.report["volumes"] for s in v["solids"]}

    def volume_of(self, part):
        """A part of the assembly is a volume, or a piece of one that has several."""
        return self.volumes[part if part in self.volumes else self.pieces[part]]

    def are_parts(self, names):
        """Whether these are all parts: each volume once, or in its stead each of its pieces once."""
        whole = [name for name in names if name in self.volumes]
        wanted = whole + [piece for piece, volume in self.pieces.items() if volume not in whole]
        return sorted(names) == sorted(wanted)

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

    @property
    def rough(self):
        """How far a reader's own integrals may be off."""
        curved = {"ellipsoid", "horizon"}
        return ROUGH_ROUND if any(v["kind"] in curved for v in self.report["volumes"]) else ROUGH

    @property
    def tolerance(self):
        return self.report["assembly"]["tolerance_m"]

    def same_volume(self, found, promised, relative, area):
        """A tiny piece is known no better than its boundary: some tolerances (where faces meet at a few degrees, curves
        move by more than one) times area, but never more than ten litres."""
        floor = min(SHARP * self.tolerance * area, 0.01)
        return abs(found - promised) <= max(relative * promised, floor)


@pytest.fixture(scope="session")
def clinothem():
    """Runs the program with these arguments, in this folder."""
    program = os.environ.get("CLINOTHEM_BIN")
    if program is None:
        subprocess.run(["cargo", "build", "--quiet", "--release", "--bin", "clinothem"], cwd=ROOT, check=True)
        target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
        program = ROOT / target / "release" / "clinothem"
    program = pathlib.Path(program).resolve()

    def run(*arguments, cwd=ROOT):
        command = [str(program), *map(str, arguments)]
        done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{' '.join(command)} ended with {done.returncode}\n{done.stderr}"

    return run


@pytest.fixture(scope="session", params=MODELS, ids=lambda path: path.stem)
def model(request):
    return request.param


@pytest.fixture(scope="session")
def build(model, clinothem, tmp_path_factory):
    folder = tmp_path_factory.mktemp(model.stem)
    clinothem("build", model, "-o", folder / "out", "--formats", "step,step-shared,brep")
    return Build(model.stem, folder / "out")

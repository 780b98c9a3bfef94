"""Times triangles of finished models: ours, OpenCASCADE's mesher on the same solids, and STEP in the same run of ours.

    .venv/bin/python tests/peers/triangles.py target/release/clinothem models/coastal/coastal.toml …

Processor time (user and system, of all threads), which a busy machine does not change. Ours is that of `build --formats glb` less that of
`--formats none`, STEP that of `--formats step` less that of none, one after the other; OpenCASCADE's mesher (that of build123d) has the BREP file of the same
model, the same chord (0.0002 of the domain's diagonal) and the same angle. Medians of RUNS runs.
"""

import json
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape
from OCP.TopTools import TopTools_IndexedMapOfShape

RUNS, ANGLE, CHORD = 5, 0.3, 2e-4


def processor_time(program, model, folder, formats):
    """Of one build (s)."""
    command = [program, "build", model, "-o", folder, "--formats", formats, "--quiet", "--force"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def own(program, model, folder):
    """Seconds for triangles and for STEP, each less the seconds without files."""
    none, glb, step = (processor_time(program, model, folder, formats) for formats in ("none", "glb", "step"))
    return glb - none, step - none


def theirs(path, chord):
    """Seconds for OpenCASCADE's triangles, and how many; of a shape that has none yet."""
    shape = TopoDS_Shape()
    BRepTools.Read_s(shape, str(path), BRep_Builder())
    started = time.process_time()
    BRepMesh_IncrementalMesh(shape, chord, False, ANGLE, True)
    seconds = time.process_time() - started
    faces = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, TopAbs_FACE, faces)
    meshes = [BRep_Tool.Triangulation_s(TopoDS.Face_s(faces(k)), TopLoc_Location()) for k in range(1, faces.Extent() + 1)]
    return seconds, sum(mesh.NbTriangles() for mesh in meshes if mesh is not None)


def triangles(path):
    """How many triangles a glb file has; faces between two volumes are there twice."""
    data = path.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20 : 20 + length])
    accessors = [part["indices"] for mesh in document["meshes"] for part in mesh["primitives"]]
    return sum(document["accessors"][one]["count"] for one in accessors) // 3


def main(program, *models):
    print("| | faces | ours | STEP | triangles over STEP | triangles | OpenCASCADE | triangles |")
    print("|--|--:|--:|--:|--:|--:|--:|--:|")
    for model in models:
        stem = pathlib.Path(model).stem
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name) / "out"
            command = [program, "build", model, "-o", folder, "--formats", "glb,brep", "--quiet"]
            subprocess.run(command, check=True)
            report = json.loads((folder / "report.json").read_text())
            size = [report["domain"][axis][1] - report["domain"][axis][0] for axis in "xyz"]
            chord = CHORD * sum(length**2 for length in size) ** 0.5
            brep, count = folder / f"{stem}.brep", triangles(folder / f"{stem}.glb")
            ours, other = [], []
            with tempfile.TemporaryDirectory() as again:
                for _ in range(RUNS):
                    ours.append(own(program, model, pathlib.Path(again)))
                    other.append(theirs(brep, chord))
            mesh, step = (statistics.median(times) for times in zip(*ours, strict=True))
            occt = statistics.median(seconds for seconds, _ in other)
            print(
                f"| {stem} | {report['assembly']['faces']} | {mesh:.2f} | {step:.3f} | {mesh / step:.0f} | {count} | "
                f"{occt:.2f} | {other[0][1]} |",
                flush=True,
            )


if __name__ == "__main__":
    main(*sys.argv[1:])

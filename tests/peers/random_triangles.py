"""Triangulates random models with the release program, and judges their PLY files as trimesh reads them.

    .venv/bin/python tests/peers/random_triangles.py target/release/clinothem target/release/examples/random_models --count 35
    … --kinds generic,folded --first 101 --count 20 --limit 60

Each model is built twice, with chords of 0.0002 and of 0.00002 of the domain's diagonal. Of the triangles of every volume are asked:

- closed: each edge is in two triangles, which run along it in opposite ways; where a body touches itself along an edge, in two such pairs
- the volume (by the divergence theorem) differs from the exact one of report.json by no more than chord × area of the triangles
- what volumes are off, all together, is less with the smaller chord

The last column has how many times less, the median over the models of those whose surfaces are not flat. Models that are refused, or take longer than
--limit, are counted and left out. Ends with 1 if any triangles are wrong.
"""

import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import numpy
import trimesh

KINDS = "generic,coincident,well-tops,sedimentary,round-sedimentary,referring,faulted,round-faulted,folded"
CHORDS = (2e-4, 2e-5)
# Exact volumes are known to this share of the domain's: what is off by less is flat.
EXACT = 1e-7
# How much less the volumes are off with a tenth of the chord, at least: in models that bend less than the larger chord the angle rules,
# and more than that is not promised.
CONVERGES = 0.75


def edges(faces):
    """How many edges of triangles are there, and how many of them in two pairs; None of triangles that are not closed."""
    ways = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    # An edge is counted along its one way and against the other.
    one, at, uses = numpy.unique(numpy.sort(ways, axis=1), axis=0, return_inverse=True, return_counts=True)
    balance = numpy.bincount(at.ravel(), weights=numpy.where(ways[:, 0] < ways[:, 1], 1, -1))
    if not numpy.isin(uses, (2, 4)).all() or balance.any():
        return None
    return len(one), int((uses == 4).sum())


def size(mesh):
    """Volume and area, counted from the middle, lest great coordinates cost digits."""
    corners = mesh.vertices[mesh.faces] - mesh.vertices.mean(axis=0)
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float((corners[:, 0] * normals).sum() / 6), float(numpy.linalg.norm(normals, axis=1).sum() / 2)


def build(program, text, chord, limit):
    """The report and the triangles of each volume by its name; a word if there are none."""
    with tempfile.TemporaryDirectory(prefix="clinothem-triangles-") as name:
        folder = pathlib.Path(name)
        (folder / "model.toml").write_text(text)
        command = [program, "build", folder / "model.toml", "-o", folder / "out", "--formats", "ply", "--quiet"]
        if chord:
            command += ["--chord", repr(chord)]
        try:
            run = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=limit)
        except subprocess.TimeoutExpired:
            return "too slow", ""
        if run.returncode in (1, 2):
            return "refused", run.stderr
        if run.returncode:
            return "crashed", run.stderr
        report = json.loads((folder / "out/report.json").read_text())
        meshes = {}
        for path in (folder / "out/ply").iterdir():
            header = path.read_bytes().split(b"end_header", 1)[0].decode()
            meshes[re.search(r"comment part (.*); facies ", header)[1]] = trimesh.load(path, process=False)
        return report, meshes


def diagonal(report):
    return sum((report["domain"][axis][1] - report["domain"][axis][0]) ** 2 for axis in "xyz") ** 0.5


def judged(report, meshes, chord):
    """What is wrong, how far volumes are off together, and counts of bodies, triangles, edges and touching edges."""
    wrong, off, counts = [], 0.0, numpy.zeros(4, int)
    worst = 0.0
    volumes = {volume["name"]: volume["volume_m3"] for volume in report["volumes"] if volume["solids"]}
    if volumes.keys() != meshes.keys():
        wrong.append(f"volumes {sorted(volumes.keys() ^ meshes.keys())} have no triangles, or no solids")
    for name in volumes.keys() & meshes.keys():
        mesh = meshes[name]
        found = edges(numpy.asarray(mesh.faces))
        if found is None:
            wrong.append(f"{name} is not closed")
            continue
        volume, area = size(mesh)
        error = abs(volume - volumes[name])
        if not error <= chord * area + 1e-9 * volumes[name]:
            wrong.append(f"{name} has {volume} m³ of {volumes[name]}")
        off += error
        worst = max(worst, error / (chord * area))
        counts += (1, len(mesh.faces), *found)
    return wrong, off, worst, counts


def series(args, kind):
    done = {"refused": 0, "too slow": 0, "crashed": 0}
    models, bad, times, worst, counts = 0, 0, [], 0.0, numpy.zeros(4, int)
    for seed in range(args.first, args.first + args.count):
        text = subprocess.run([args.models, kind, str(seed)], capture_output=True, text=True, check=True).stdout
        off, wrong, chord = [], [], None
        for share in CHORDS:
            # The first is the program's own, which it takes from the domain.
            report, meshes = build(args.program, text, chord and share / CHORDS[0] * chord, args.limit)
            if isinstance(report, str):
                break
            chord = chord or share * diagonal(report)
            found = judged(report, meshes, share / CHORDS[0] * chord)
            wrong += found[0]
            off.append(found[1])
            worst = max(worst, found[2])
            counts += found[3]
        if isinstance(report, str):
            done[report] += 1
            print(f"{kind} {seed}: {report} {meshes.strip().splitlines()[:1]}", file=sys.stderr, flush=True)
            continue
        models += 1
        flat = EXACT * report["domain"]["volume_m3"]
        if not off[1] <= CONVERGES * off[0] + flat:
            wrong.append(f"volumes are off by {off[0]} m³ and, with a tenth of the chord, {off[1]} m³")
        if off[0] > flat:
            times.append(off[0] / max(off[1], 1e-9 * flat))
        if wrong:
            bad += 1
            print(f"{kind} {seed} WRONG: " + "; ".join(wrong), file=sys.stderr, flush=True)
    less = f"{statistics.median(times):.0f} × ({len(times)})" if times else "all flat"
    print(
        f"| {kind} | {args.first} to {args.first + args.count - 1} | {models} | {done['refused']} | {done['too slow']} | {done['crashed']} | {bad} | "
        + " | ".join(str(count) for count in counts)
        + f" | {worst:.2f} | {less} |",
        flush=True,
    )
    return bad + done["crashed"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="clinothem")
    parser.add_argument("models", help="the example random_models")
    parser.add_argument("--kinds", default=KINDS)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=30, help="seeds of each kind")
    parser.add_argument("--limit", type=float, default=120, help="seconds for a build")
    args = parser.parse_args()
    print("| kind | seeds | triangulated | refused | too slow | crashed | WRONG | bodies | triangles | edges | in two pairs | worst error | converges |")
    print("|---|---|" + "--:|" * 11)
    sys.exit(1 if sum([series(args, kind) for kind in args.kinds.split(",")]) else 0)


if __name__ == "__main__":
    main()

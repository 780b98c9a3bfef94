"""Measures a result, after the race and with the same yardstick for all:

    measure.py BODIES RESULT parts|cells PROGRAM [ARGUMENT…]

Prints JSON: the solids inside the block, the sum of their volumes, the faces that two solids share, and the volume of each
body. In *parts* a result has a compound for each body. Of *cells*, PROGRAM says which volume holds points just inside of
each: examples/bench_owners.rs, which knows control nets and rules and no solid. Volumes are OpenCASCADE's integrals with a
relative error of 1e-8 per face (`BRepGProp_Vinert` with eps, what `VolumeProperties` with eps runs over), seen from the
middle of the block, for every program's solids alike.
"""

import json
import subprocess
import sys
from collections import Counter
from pathlib import Path

from OCP.Bnd import Bnd_Box
from OCP.BOPTools import BOPTools_AlgoTools3D
from OCP.BRep import BRep_Builder
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.BRepGProp import BRepGProp_Domain, BRepGProp_Face, BRepGProp_Vinert
from OCP.BRepTools import BRepTools
from OCP.gp import gp_Pnt, gp_Pnt2d, gp_Vec
from OCP.IntTools import IntTools_Context
from OCP.TopAbs import TopAbs_FACE, TopAbs_FORWARD, TopAbs_IN, TopAbs_REVERSED, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Iterator, TopoDS_Shape
from OCP.TopTools import TopTools_IndexedMapOfShape

EPS = 1e-8
# How far inside of a cell it is asked for its body (m; nearer if it is too thin), how closely, at how many of its faces.
INSIDE, CLOSE, FACES = (1e-3, 1e-5), 1e-7, 3
# A cell too thin to be asked.
UNKNOWN = "unknown"


def read(path):
    shape = TopoDS_Shape()
    if not BRepTools.Read_s(shape, str(path), BRep_Builder()):
        raise SystemExit(f"{path} cannot be read")
    return shape


def below(shape, kind):
    """All solids or faces of a shape, each once."""
    explorer, found = TopExp_Explorer(shape, kind), []
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def box(shape):
    found = Bnd_Box()
    BRepBndLib.Add_s(shape, found)
    return found


class Fluxes:
    """What each face adds to the volume of a solid; a face that two solids share is integrated once."""

    def __init__(self, middle):
        self.middle, self.faces, self.known = middle, TopTools_IndexedMapOfShape(), {}

    def index(self, face):
        """The same face has the same index, whichever way it looks."""
        return self.faces.Add(face)

    def of(self, face):
        index = self.index(face)
        if index not in self.known:
            forward = TopoDS.Face_s(face.Oriented(TopAbs_FORWARD))
            inert = BRepGProp_Vinert(BRepGProp_Face(forward), BRepGProp_Domain(forward), self.middle, EPS)
            self.known[index] = inert.Mass()
        # A face that hangs inside of a solid bounds nothing.
        signs = {TopAbs_FORWARD: 1.0, TopAbs_REVERSED: -1.0}
        return signs.get(face.Orientation(), 0.0) * self.known[index]

    def volume(self, solid):
        return sum(self.of(face) for face in below(solid, TopAbs_FACE))


def points_inside(solid, depth):
    """Points so far inside of a solid, beside a few of its faces."""
    context, classifier = IntTools_Context(), BRepClass3d_SolidClassifier(solid)
    found = 0
    for one in below(solid, TopAbs_FACE):
        face, at, uv = TopoDS.Face_s(one), gp_Pnt(), gp_Pnt2d()
        if BOPTools_AlgoTools3D.PointInFace_s(face, at, uv, context) != 0:
            continue
        outward = gp_Vec()
        BRepGProp_Face(face).Normal(uv.X(), uv.Y(), at, outward)
        if outward.Magnitude() == 0:
            continue
        point = at.Translated(outward.Normalized() * -depth)
        classifier.Perform(point, CLOSE)
        if classifier.State() == TopAbs_IN:
            yield point
            found += 1
            if found == FACES:
                return


def owners(cells, program):
    """Each cell with the name of the volume that most points inside of it belong to; cells outside of the block are left out."""
    asked = []
    for cell in cells:
        found = next((points for depth in INSIDE if (points := list(points_inside(cell, depth)))), [])
        asked.append(found)
    lines = [f"{p.X()!r} {p.Y()!r} {p.Z()!r}\n" for points in asked for p in points]
    told = subprocess.run(program, input="".join(lines), capture_output=True, text=True, check=True)
    names = iter(told.stdout.splitlines())
    for cell, points in zip(cells, asked, strict=True):
        votes = Counter(next(names) for _ in points)
        name = votes.most_common(1)[0][0] if votes else UNKNOWN
        if name:
            yield name, cell


def parts(result, names):
    """Each solid with the name of its body, from a compound per body in their order."""
    iterator = TopoDS_Iterator(result)
    for name in names:
        for solid in below(iterator.Value(), TopAbs_SOLID):
            yield name, solid
        iterator.Next()


def main():
    folder, path, kind, *program = sys.argv[1:]
    bodies = sorted(Path(folder).glob("*.brep"))
    block, result = read(bodies[0]), read(path)
    corner = [box(block).CornerMin(), box(block).CornerMax()]
    middle = gp_Pnt(*((getattr(corner[0], c)() + getattr(corner[1], c)()) / 2 for c in "XYZ"))
    if kind == "cells":
        named = owners(below(result, TopAbs_SOLID), program)
    else:
        named = parts(result, [body.stem.split("-", 1)[1] for body in bodies])
    fluxes = Fluxes(middle)
    sizes, uses, solids = Counter(), Counter(), 0
    for name, solid in named:
        solids += 1
        sizes[name] += fluxes.volume(solid)
        uses.update({fluxes.index(face) for face in below(solid, TopAbs_FACE)})
    told = {
        "solids": solids,
        "faces": len(uses),
        "shared_faces": sum(count > 1 for count in uses.values()),
        "volume_error": sum(sizes.values()) - fluxes.volume(block),
        "volumes": {name: size for name, size in sizes.items() if name != UNKNOWN},
    }
    print(json.dumps(told))


main()

"""Measures a result, after the race and with the same yardstick for all: `measure.py FOLDER RESULT parts|cells`.

Prints JSON: the solids inside the block, the sum of their volumes, the faces that two solids share, and the volume of each
body. In *parts* a result has a compound for each body; in *cells* the body of a cell is the youngest that holds points
just inside of it. Volumes are OpenCASCADE's integrals with a relative error of 1e-8 per face (`BRepGProp_Vinert` with eps, what
`VolumeProperties` with eps runs over),
seen from the middle of the block, for every program's solids alike.
"""

import json
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
        return -self.known[index] if face.Orientation() == TopAbs_REVERSED else self.known[index]

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


class Bodies:
    """Who holds a point: None outside of the block, 0 for the background, else the youngest body."""

    def __init__(self, folder):
        self.shapes = [read(path) for path in sorted(Path(folder).glob("*.brep"))]
        self.names = [path.stem.split("-", 1)[1] for path in sorted(Path(folder).glob("*.brep"))]
        self.boxes = [box(shape) for shape in self.shapes]
        self.classifiers = [BRepClass3d_SolidClassifier(shape) for shape in self.shapes]

    def holds(self, body, point):
        if self.boxes[body].IsOut(point):
            return False
        self.classifiers[body].Perform(point, CLOSE)
        return self.classifiers[body].State() == TopAbs_IN

    def at(self, point):
        if not self.holds(0, point):
            return None
        return next((body for body in range(len(self.shapes) - 1, 0, -1) if self.holds(body, point)), 0)

    def of(self, solid):
        for depth in INSIDE:
            votes = Counter(self.at(point) for point in points_inside(solid, depth))
            if votes:
                return votes.most_common(1)[0][0]
        return UNKNOWN


def labelled(result, kind, bodies):
    """Each solid with its body."""
    if kind == "cells":
        return [(bodies.of(solid), solid) for solid in below(result, TopAbs_SOLID)]
    iterator, found, body = TopoDS_Iterator(result), [], 0
    while iterator.More():
        found += [(body, solid) for solid in below(iterator.Value(), TopAbs_SOLID)]
        iterator.Next()
        body += 1
    return found


def main():
    folder, path, kind = sys.argv[1:]
    bodies = Bodies(folder)
    corner = [bodies.boxes[0].CornerMin(), bodies.boxes[0].CornerMax()]
    middle = gp_Pnt(*((getattr(corner[0], c)() + getattr(corner[1], c)()) / 2 for c in "XYZ"))
    fluxes = Fluxes(middle)
    block = fluxes.volume(bodies.shapes[0])
    sizes, uses, solids = Counter(), Counter(), 0
    for body, solid in labelled(read(path), kind, bodies):
        if body is None:
            continue
        solids += 1
        sizes[body] += fluxes.volume(solid)
        uses.update({fluxes.index(face) for face in below(solid, TopAbs_FACE)})
    told = {
        "solids": solids,
        "faces": len(uses),
        "shared_faces": sum(count > 1 for count in uses.values()),
        "volume_error": sum(sizes.values()) - block,
        "volumes": {bodies.names[body]: size for body, size in sizes.items() if body != UNKNOWN},
    }
    print(json.dumps(told))


main()

"""The tables of numbers against readers of the files that have no names: which solid, and which face between which solids."""

import csv

import gmsh
import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepTools import BRepTools
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.Interface import Interface_Static
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp
from OCP.TopoDS import TopoDS_Shape
from OCP.TopTools import TopTools_IndexedMapOfShape

SHOWN = {"quickstart", "coastal", "channel-belt", "levees", "nodules", "inside", "pieces"}


@pytest.fixture(scope="session", autouse=True)
def shown(model):
    """Before anything is built."""
    if model.stem not in SHOWN:
        pytest.skip("some models show it")


@pytest.fixture
def tables(build):
    """The rows of solids and of faces."""
    tables = []
    for name in ["solids", "faces"]:
        with build.path(f".{name}.csv").open(newline="", encoding="utf-8") as file:
            tables.append(list(csv.DictReader(file)))
    return tables


def members(shape, kind):
    found = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, kind, found)
    return [found.FindKey(number) for number in range(1, found.Extent() + 1)]


def beside(faces, holders):
    """Of each face the numbers of the solids that hold it, by what the reader has."""
    number = TopTools_IndexedMapOfShape()
    for face in faces:
        number.Add(face)
    found = [set() for _ in faces]
    for at, holder in enumerate(holders, 1):
        for face in members(holder, TopAbs_FACE):
            found[number.FindIndex(face) - 1].add(at)
    return found


def told(rows):
    return [{int(row[key]) for key in ("solid_number", "other_solid_number") if row[key]} for row in rows]


def check_rows(tables, build):
    solids, faces = tables
    assert [int(row["number"]) for row in solids] == list(range(1, len(build.solids) + 1))
    assert [row["volume"] for row in solids] == [name for name, _ in build.solids]
    assert len(faces) == build.faces
    for row in faces:
        one = solids[int(row["solid_number"]) - 1]
        assert (row["solid"], row["volume"], row["facies"], row["color"]) == (one["solid"], one["volume"], one["facies"], one["color"])


def test_solids_and_faces_of_brep_have_their_numbers(tables, build):
    check_rows(tables, build)
    shape = TopoDS_Shape()
    BRepTools.Read_s(shape, str(build.brep), BRep_Builder())
    found = members(shape, TopAbs_SOLID)
    assert len(found) == len(tables[0])
    for solid, row in zip(found, tables[0], strict=True):
        props = GProp_GProps()
        BRepGProp.VolumeProperties_s(solid, props, 1e-6, False, False)
        assert props.Mass() == pytest.approx(float(row["volume_m3"]), rel=1e-3, abs=1e-2)
    assert beside(members(shape, TopAbs_FACE), found) == told(tables[1])


def test_shells_and_faces_of_shared_step_have_their_numbers(tables, build):
    if not build.shared.exists():
        pytest.skip("a volume encloses another: there is no shared STEP")
    # Else each shell gets faces of its own.
    reader = STEPControl_Reader()
    before = Interface_Static.IVal_s("read.step.nonmanifold")
    assert Interface_Static.SetIVal_s("read.step.nonmanifold", 1)
    try:
        reader.ReadFile(str(build.shared))
        reader.TransferRoots()
    finally:
        Interface_Static.SetIVal_s("read.step.nonmanifold", before)
    shape = reader.OneShape()
    found = members(shape, TopAbs_SHELL)
    assert len(found) == len(tables[0])
    assert beside(members(shape, TopAbs_FACE), found) == told(tables[1])


def test_gmsh_tags_solids_and_faces_by_their_numbers(tables, build):
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.importShapes(str(build.brep))
        gmsh.model.occ.synchronize()
        assert [tag for _, tag in gmsh.model.getEntities(3)] == [int(row["number"]) for row in tables[0]]
        faces = [tag for _, tag in gmsh.model.getEntities(2)]
        assert faces == [int(row["number"]) for row in tables[1]]
        assert [set(gmsh.model.getAdjacencies(2, tag)[0].tolist()) for tag in faces] == told(tables[1])
    finally:
        gmsh.finalize()

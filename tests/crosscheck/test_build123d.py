"""build123d opens our files: named, coloured, valid, watertight solids.

It reads STEP into millimetres, so the model's metres come back times 1000; BREP has no unit and stays in metres.
"""

from collections import Counter

import build123d as bd
import pytest
from conftest import FINE, FINE_SUM, readable
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.Interface import Interface_Static
from OCP.TopAbs import TopAbs_FACE, TopAbs_REVERSED
from OCP.TopExp import TopExp_Explorer
from OCP.TopTools import TopTools_IndexedMapOfShape

MM = 1000.0


@pytest.fixture(scope="module")
def assembly(build):
    return bd.import_step(build.step)


@pytest.fixture(scope="module")
def parts(assembly):
    """Leaves of the tree as (path of names, part)."""
    found = []

    def visit(node, path):
        path = (*path, node.label)
        if node.children:
            for child in node.children:
                visit(child, path)
        else:
            found.append((path, node))

    visit(assembly, ())
    return found


@pytest.fixture(scope="module")
def brep(build):
    return bd.import_brep(build.brep)


@pytest.fixture(scope="module")
def shared(build, brep):
    """The shared flavour, read with OpenCASCADE's setting for shapes that share faces; without it each shell is copied."""
    if not build.shared.exists():
        # It cannot tell a void from a body, so it is not written where one volume encloses another.
        assert any(len(solid.shells()) > 1 for solid in brep.solids()), "there is no shared STEP"
        pytest.skip("a volume encloses another: BREP stands in for shared STEP")
    before = Interface_Static.IVal_s("read.step.nonmanifold")
    assert Interface_Static.SetIVal_s("read.step.nonmanifold", 1)
    try:
        return bd.import_step(build.shared)
    finally:
        Interface_Static.SetIVal_s("read.step.nonmanifold", before)


def fine_area(face):
    props = GProp_GProps()
    # 1e-6 is off by 1e-5 on some trimmed faces.
    BRepGProp.SurfaceProperties_s(face, props, 1e-8, False)
    return props.Mass()


def check_volumes(build, parts):
    """Compares the solids of each volume in the order of their size; gives the sum."""
    found = {name: [] for name in build.volumes}
    for path, part in parts:
        found[build.volume_of(path[-1]).name] += part.solids()
    total = 0.0
    for name, solids in found.items():
        solids.sort(key=lambda solid: solid.volume)
        for solid, told in zip(solids, sorted(build.volumes[name].solids), strict=True):
            area = solid.area / MM**2
            size = build.fine_volume(solid, told, area, MM)
            assert build.same_volume(size, told, FINE, area), (name, size, told)
            total += size
    return total


def uses(bodies):
    """For each distinct face: the (index, reversed) of the solids or shells that it bounds."""
    faces, told = TopTools_IndexedMapOfShape(), {}
    for index, body in enumerate(bodies):
        explorer = TopExp_Explorer(body.wrapped, TopAbs_FACE)
        while explorer.More():
            face = explorer.Current()
            told.setdefault(faces.Add(face), []).append((index, face.Orientation() == TopAbs_REVERSED))
            explorer.Next()
    return faces, told


def on_one_wall(face, domain, tolerance):
    """Whether a face is flat and lies in one of the domain's six walls."""
    face = bd.Face(face)
    if face.geom_type != bd.GeomType.PLANE:
        return False
    # Its middle, too: both corners of a face between a wall and a curve lie in that wall.
    points = [*(vertex.center() for vertex in face.vertices()), face.center(bd.CenterOf.GEOMETRY)]
    return any(
        all(abs(getattr(point, axis.upper()) - wall) <= tolerance for point in points)
        for axis in "xyz"
        for wall in domain[axis]
    )


def check_walls_and_contacts(build, bodies, scale):
    """Every face inside the domain bounds two bodies from opposite sides; the others cover the domain's skin once."""
    faces, told = uses(bodies)
    assert faces.Extent() == build.faces
    assert set(Counter(len(owners) for owners in told.values())) <= {1, 2}
    walls = {axis: [scale * x for x in build.domain[axis]] for axis in "xyz"}
    skin = 0.0
    for index, owners in told.items():
        if len(owners) == 1:
            assert on_one_wall(faces(index), walls, scale * build.tolerance), f"face {index} of {owners} is open"
            skin += bd.Face(faces(index)).area / scale**2
        else:
            (a, a_reversed), (b, b_reversed) = owners
            assert a != b and a_reversed != b_reversed, f"face {index} bounds {owners}"
    assert skin == pytest.approx(build.skin, rel=max(1e-5, build.crude))


def test_each_volume_is_a_part_with_its_name_or_a_node_with_its_pieces(build, parts):
    assert build.are_parts([path[-1] for path, _ in parts])
    for path, _ in parts:
        volume = build.volume_of(path[-1])
        assert len(volume.solids) == 1 or path[-2] == readable(volume.shown), path


def test_instances_of_a_feature_stand_together_below_the_model(build, parts):
    instances = Counter(v.feature for v in build.volumes.values())
    for path, _ in parts:
        volume = build.volume_of(path[-1])
        if volume.above is None:
            assert path[0] == readable(build.report["model"]["name"])
            # A feature with several instances is a node; a feature that is one volume is that volume. So is the background, of which
            # faults make grounds of blocks.
            alone = {readable(volume.shown), readable(f"{volume.shown} with children")}
            allowed = {volume.feature} if instances[volume.feature] > 1 else alone
            assert path[1] in (allowed | alone if volume.feature == "background" else allowed)


def test_each_volume_has_its_number_of_solids(build, parts):
    found = Counter()
    for path, part in parts:
        found[build.volume_of(path[-1]).name] += len(part.solids())
    assert found == {v.name: len(v.solids) for v in build.volumes.values()}


def test_each_volume_has_the_colour_of_its_facies(build, parts):
    seen = {path[-1]: part.color and tuple(round(255 * c) for c in tuple(part.color)[:3]) for path, part in parts}
    assert seen == {name: build.volume_of(name).color for name in seen}


def test_every_solid_is_valid_and_closed(parts):
    for path, part in parts:
        for solid in part.solids():
            assert solid.is_valid, path
            assert all(shell.wrapped.Closed() for shell in solid.shells()), path


def test_the_model_is_as_long_in_millimetres_as_its_metres_say(build, parts):
    corners = [v.center() for _, part in parts for v in part.vertices()]
    for axis in "xyz":
        places = [getattr(corner, axis.upper()) for corner in corners]
        assert [min(places), max(places)] == pytest.approx([MM * x for x in build.domain[axis]], abs=MM * build.tolerance)


def test_volumes_agree_with_the_report(build, parts):
    total = check_volumes(build, parts)
    assert total == pytest.approx(build.domain["volume_m3"], rel=FINE_SUM)


def test_the_reports_boxes_hold_the_solids(build, parts):
    boxes = {v["name"]: [s["box"] for s in v["solids"]] for v in build.report["volumes"]}
    for path, part in parts:
        for solid in part.solids():
            corners = [[getattr(v.center(), axis) / MM for axis in "XYZ"] for v in solid.vertices()]
            assert any(
                all(low[i] - build.tolerance <= c[i] <= high[i] + build.tolerance for c in corners for i in range(3))
                for low, high in boxes[build.volume_of(path[-1]).name]
            ), path


def test_parts_of_the_assembly_have_faces_of_their_own(build, assembly, parts):
    faces, told = uses([part for _, part in parts])
    assert all(len(owners) == 1 for owners in told.values())
    outer = sum(1 for i in told if on_one_wall(faces(i), {a: [MM * x for x in build.domain[a]] for a in "xyz"}, MM * build.tolerance))
    # Each face inside is there twice, each in the skin once.
    assert faces.Extent() == 2 * build.faces - outer
    assert faces.Extent() > build.faces or len(parts) == 1


def test_brep_keeps_shared_faces_and_is_watertight(build, brep):
    solids = brep.solids()
    assert len(solids) == len(build.solids)
    assert all(solid.is_valid for solid in solids)
    check_walls_and_contacts(build, solids, 1.0)


def test_brep_holds_the_solids_in_the_reports_order_with_its_volumes(build, brep):
    for solid, (name, told) in zip(brep.solids(), build.solids, strict=True):
        size = build.fine_volume(solid, told, solid.area)
        assert build.same_volume(size, told, FINE, solid.area), name


def test_the_contacts_of_the_brep_are_the_reports_neighbours(build, brep):
    solids = brep.solids()
    names = [name for name, _ in build.solids]
    faces, told = uses(solids)
    contacts, outer = Counter(), Counter()
    for index, owners in told.items():
        area = fine_area(faces(index))
        if len(owners) == 1:
            outer[names[owners[0][0]]] += area
        else:
            a, b = (names[owner] for owner, _ in owners)
            contacts[a, b] += area
            contacts[b, a] += area
    promised = {(v.name, other): area for v in build.volumes.values() for other, area in v.neighbours.items()}
    assert contacts.keys() == promised.keys()
    for pair, area in promised.items():
        assert contacts[pair] == pytest.approx(area, rel=FINE, abs=1e-3), pair
    for volume in build.volumes.values():
        assert outer[volume.name] == pytest.approx(volume.outer_area, rel=FINE, abs=1e-3), volume.name


def test_the_shared_flavour_keeps_common_faces_and_its_shells_close_into_the_solids(build, shared):
    shells = shared.shells()
    assert all(shell.wrapped.Closed() for shell in shells)
    check_walls_and_contacts(build, shells, MM)
    for shell, (name, told) in zip(shells, build.solids, strict=True):
        solid = bd.Solid(BRepBuilderAPI_MakeSolid(shell.wrapped).Solid())
        assert solid.is_valid, name
        area = solid.area / MM**2
        size = build.fine_volume(solid, told, area, MM)
        assert build.same_volume(size, told, FINE, area), name

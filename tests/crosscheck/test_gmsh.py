"""Gmsh opens our files: names and colours from STEP, shared faces from the shared flavour and BREP, and a mesh."""

from collections import Counter

import gmsh
import pytest
from conftest import ROUGH, ROUGH_SUM, Build, readable

# Gmsh's numbers of its algorithms for faces and for solids, the first of each its default.
FRONTAL, MESH_ADAPT = 6, 1
DELAUNAY, HXT = 1, 10
# What models are meshed with: size (m), algorithm for faces, what chords may cut off a solid.
MESHES = {
    # Much coarser than the channels are deep (5-6 m), and chords of one side cross those of the other. These cut the corners
    # of channels 50-70 m wide.
    "quickstart": {"size": 10},
    # Sharp toes are no obstacle at sizes up to three times the block's height.
    "parasequence": {"size": 40, "relative": 0.02},
    # Channels 15 to 100 m wide and 2 to 7 m deep: at 20 m, or with the default algorithm for faces, facets of their bases cut
    # through their tops. The narrowest lose a fifth to chords.
    "coastal": {"size": 10, "algorithm": MESH_ADAPT, "relative": 0.25},
}


@pytest.fixture
def opened():
    """Opens a file in metres, as a function of its path."""
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 2)
    gmsh.option.setNumber("Geometry.OCCImportLabels", 1)
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")

    def read(path):
        gmsh.model.occ.importShapes(str(path))
        gmsh.model.occ.synchronize()
        return [tag for _, tag in gmsh.model.getEntities(3)]

    yield read
    gmsh.finalize()


def volume_name(label, build):
    """Gmsh's labels are paths of names and layers: `Shapes/belt/channel/channel-2/channel-2 & & sand`."""
    path = "/" + readable(label.split(" & ")[0])
    ends = [name for name in build.parts if path.endswith("/" + name)]
    return build.volume_of(max(ends, key=len)).name if ends else None


def check_contacts(build, solids):
    """Each surface bounds one solid or two, and each solid's surfaces leave no edge open."""
    surfaces = gmsh.model.getEntities(2)
    assert len(surfaces) == build.faces
    owners = Counter(len(gmsh.model.getAdjacencies(2, tag)[0]) for _, tag in surfaces)
    assert set(owners) <= {1, 2}
    for solid in solids:
        skin = gmsh.model.getBoundary([(3, solid)], combined=False, oriented=True)
        # An edge that two faces of the solid run through in opposite directions cancels out; one that is a point (the
        # pole of an ellipsoid) has no other face.
        left = gmsh.model.getBoundary(skin, combined=True, oriented=True)
        open_edges = [edge for _, edge in left if gmsh.model.occ.getMass(1, abs(edge)) > build.tolerance]
        assert open_edges == [], f"solid {solid} is open"
    # Faces inside count twice.
    areas = Counter()
    for _, tag in surfaces:
        areas[len(gmsh.model.getAdjacencies(2, tag)[0])] += gmsh.model.occ.getMass(2, tag)
    assert areas[1] == pytest.approx(build.skin, rel=max(1e-5, build.crude))


def check_volumes(build, solids, promised):
    total = 0.0
    for tag, (name, told) in zip(solids, promised, strict=True):
        size = gmsh.model.occ.getMass(3, tag)
        area = sum(gmsh.model.occ.getMass(2, abs(face)) for _, face in gmsh.model.getBoundary([(3, tag)]))
        assert build.same_volume(size, told, ROUGH, area), (name, size, told)
        total += size
    assert total == pytest.approx(build.domain["volume_m3"], rel=max(ROUGH_SUM, build.crude))


def test_the_assembly_has_its_names_colours_solids_and_volumes(build, opened):
    solids = opened(build.step)
    names = [volume_name(gmsh.model.getEntityName(3, tag), build) for tag in solids]
    assert Counter(names) == {v.name: len(v.solids) for v in build.volumes.values()}
    colors = {name: gmsh.model.getColor(3, tag)[:3] for name, tag in zip(names, solids)}
    assert colors == {v.name: v.color for v in build.volumes.values()}
    by_name = sorted(zip(names, solids, strict=True), key=lambda entry: (entry[0], gmsh.model.occ.getMass(3, entry[1])))
    check_volumes(build, [tag for _, tag in by_name], sorted(build.rough))
    if len(build.volumes) > 1:
        assert len(gmsh.model.getEntities(2)) > build.faces


def test_the_domain_in_metres(build, opened):
    if build.stem != "quickstart":
        pytest.skip("one small model shows it")
    opened(build.step)
    points = [gmsh.model.getValue(0, tag, []) for _, tag in gmsh.model.getEntities(0)]
    for i, axis in enumerate("xyz"):
        places = [point[i] for point in points]
        assert [min(places), max(places)] == pytest.approx(build.domain[axis], abs=build.tolerance)


@pytest.mark.parametrize("flavour", ["shared", "brep"])
def test_common_faces_are_there_once_and_the_solids_close(build, opened, flavour):
    if flavour == "shared" and not build.shared.exists():
        pytest.skip("a volume encloses another: there is no shared STEP")
    solids = opened(getattr(build, flavour))
    check_contacts(build, solids)
    check_volumes(build, solids, build.rough)


def mesh(solids, promised, volume, size, algorithm=FRONTAL, algorithm_3d=DELAUNAY, relative=0.04):
    """Tetrahedra of this size (m) fill the block without a gap, and each solid but for what chords cut off."""
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.Algorithm", algorithm)
    gmsh.option.setNumber("Mesh.Algorithm3D", algorithm_3d)
    gmsh.model.mesh.generate(3)
    total = 0.0
    for tag, (name, told) in zip(solids, promised, strict=True):
        kinds, elements, _ = gmsh.model.mesh.getElements(3, tag)
        assert list(kinds) == [4], f"{name} is not all tetrahedra"
        sizes = gmsh.model.mesh.getElementQualities(elements[0], "volume")
        assert min(sizes) > 0, f"{name} has a tetrahedron inside out"
        assert sum(sizes) == pytest.approx(told, rel=relative), name
        total += sum(sizes)
    # What one solid loses to a chord its neighbour gains: nothing is left between them.
    assert total == pytest.approx(volume, rel=1e-9)


def test_tetrahedra_fill_the_solids_and_share_the_nodes_of_common_faces(build, opened):
    if build.stem not in MESHES:
        pytest.skip("some models show it")
    mesh(opened(build.brep), build.solids, build.domain["volume_m3"], **MESHES[build.stem])


@pytest.mark.parametrize("algorithm_3d", [DELAUNAY, HXT], ids=["delaunay", "hxt"])
@pytest.mark.parametrize("toe", [0, 0.3])
def test_clinoforms_mesh_whether_or_not_they_are_tangent_to_their_base(model, clinothem, opened, tmp_path, toe, algorithm_3d):
    if model.stem != "parasequence":
        pytest.skip("one model has nothing but clinoforms")
    toes = [word for one in ("lower", "upper") for word in ("--set", f"feature.{one}.toe={toe}")]
    clinothem("build", model, "-o", tmp_path / "out", "--formats", "brep", *toes)
    other = Build(model.stem, tmp_path / "out")
    mesh(opened(other.brep), other.solids, other.domain["volume_m3"], 40, algorithm_3d=algorithm_3d)

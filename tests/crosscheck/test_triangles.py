"""Triangles and grids that the program wrote, read by programs that are not ours.

Every body must be closed and have the report's volume, to within what the chord tolerance allows; surfaces and grids must come back
with their names, places and heights.
"""

import json

import meshio
import numpy as np
import pytest
import trimesh
import xtgeo

# Channels that cross; clinoforms with facies belts; ellipsoids with poles and seams; world coordinates of a model far from its origin.
MODELS = ["channel-belt/channel-belt", "coastal/coastal", "nodules/nodules", "far/channels"]
ENDINGS = ["stl", "ply", "obj", "glb"]


@pytest.fixture(scope="module", params=MODELS, ids=lambda name: name.split("/")[1])
def bodies(request, clinothem, tmp_path_factory):
    folder = tmp_path_factory.mktemp("bodies") / "out"
    clinothem("build", f"models/{request.param}.toml", "-o", folder, "--formats", "glb,stl,obj,ply,ts")
    report = json.loads((folder / "report.json").read_text())
    volumes = {v["name"]: sum(s["volume_m3"] for s in v["solids"]) for v in report["volumes"] if v["solids"]}
    size = np.array([report["domain"][axis] for axis in "xyz"])
    return folder, request.param.split("/")[1], volumes, 2e-4 * np.linalg.norm(size[:, 1] - size[:, 0])


def file_of(folder, ending, name):
    return folder / ending / f"{name.replace('/', '_')}.{ending}"


def assert_body(mesh, volume, chord):
    assert mesh.is_watertight and mesh.is_winding_consistent
    assert abs(mesh.volume - volume) <= chord * mesh.area, (mesh.volume, volume)


def merged(mesh):
    """Points that are one, whatever their normals: single precision keeps equal what is equal."""
    mesh = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    mesh.merge_vertices(merge_norm=True, merge_tex=True, digits_vertex=12)
    return mesh


def test_ply_is_closed_and_has_the_volume(bodies):
    folder, _, volumes, chord = bodies
    for name, volume in volumes.items():
        mesh = meshio.read(file_of(folder, "ply", name))
        assert mesh.points.dtype == np.float64
        faces = mesh.cells_dict["triangle"]
        assert_body(trimesh.Trimesh(mesh.points - mesh.points[0], faces, process=False), volume, chord)


def test_stl_closes_where_points_are_equal(bodies):
    folder, _, volumes, chord = bodies
    for name, volume in volumes.items():
        mesh = merged(trimesh.load(file_of(folder, "stl", name)))
        assert abs(mesh.volume - volume) <= chord * mesh.area, name


def test_obj_has_all_bodies_by_name(bodies):
    folder, stem, volumes, chord = bodies
    scene = trimesh.load(folder / f"{stem}.obj", split_object=True, group_material=False, process=False)
    names = [line[2:].strip() for line in (folder / f"{stem}.obj").read_text().splitlines() if line.startswith("o ")]
    assert names == list(volumes)
    meshes = scene.geometry.values() if isinstance(scene, trimesh.Scene) else [scene]
    total = sum(abs(mesh.volume) for mesh in meshes)
    skin = sum(mesh.area for mesh in meshes)
    assert abs(total - sum(volumes.values())) <= chord * skin
    assert (folder / f"{stem}.mtl").read_text().count("newmtl") >= 1


def test_glb_has_a_node_a_volume_upright(bodies):
    folder, stem, volumes, chord = bodies
    scene = trimesh.load(folder / f"{stem}.glb", process=False)
    assert len(scene.geometry) == len(volumes)
    total = sum(merged(mesh).volume for mesh in scene.geometry.values())
    skin = sum(mesh.area for mesh in scene.geometry.values())
    assert abs(total - sum(volumes.values())) <= chord * skin
    # y is up there: the scene is as high along y as the domain along z, and reaches no farther than that.
    report = json.loads((folder / "report.json").read_text())
    low, high = scene.bounds
    for axis, (a, b) in zip((0, 2, 1), (report["domain"]["x"], report["domain"]["y"], report["domain"]["z"]), strict=True):
        assert high[axis] - low[axis] == pytest.approx(b - a, rel=1e-5, abs=2 * chord)
    for mesh in scene.geometry.values():
        assert mesh.visual.material.baseColorFactor is not None


def test_tsurf_is_the_ply_in_world_coordinates(bodies):
    folder, _, volumes, _ = bodies
    report = json.loads((folder / "report.json").read_text())
    origin = np.array(report["model"]["origin"])
    for name in volumes:
        surface = xtgeo.triangulated_surface_from_file(file_of(folder, "ts", name), fformat="tsurf")
        mesh = meshio.read(file_of(folder, "ply", name))
        points = np.asarray(surface.vertices)
        np.testing.assert_allclose(points[:, :2], mesh.points[:, :2] + origin[:2], rtol=0, atol=2e-6)
        # xtgeo has depths.
        np.testing.assert_allclose(np.abs(points[:, 2]), np.abs(mesh.points[:, 2] + origin[2]), rtol=0, atol=2e-6)
        assert len(surface.triangles) == len(mesh.cells_dict["triangle"])


@pytest.fixture(scope="module")
def grids(clinothem, tmp_path_factory):
    folder = tmp_path_factory.mktemp("grids") / "out"
    clinothem(
        "surfaces", "models/from-files/from-files.toml", "-o", folder, "--formats", "irap,zmap,cps3,ts", "--whole", "--spacing", "100"
    )
    return folder


def test_grids_of_all_formats_are_one_surface(grids):
    names = sorted(path.stem for path in (grids / "irap").iterdir())
    assert names
    for name in names:
        irap = xtgeo.surface_from_file(grids / "irap" / f"{name}.irap", fformat="irap_ascii")
        zmap = xtgeo.surface_from_file(grids / "zmap" / f"{name}.zmap", fformat="zmap_ascii")
        assert (irap.ncol, irap.nrow) == (zmap.ncol, zmap.nrow)
        for one in ("xinc", "yinc", "xori", "yori"):
            assert getattr(irap, one) == pytest.approx(getattr(zmap, one), abs=1e-5)
        np.testing.assert_allclose(irap.values.filled(-1), zmap.values.filled(-1), rtol=0, atol=2e-4)
        stream = (grids / "cps3" / f"{name}.cps3").read_text().split("\n->")[1].split()[1:]
        columns = np.array(stream, dtype=float).reshape(irap.ncol, irap.nrow)[:, ::-1]
        filled = irap.values.filled(1e30)
        np.testing.assert_allclose(columns, filled, rtol=0, atol=2e-4)


def test_grids_lie_on_the_triangles_of_their_surface(grids):
    for path in sorted((grids / "irap").iterdir()):
        surface = xtgeo.surface_from_file(path, fformat="irap_ascii")
        sheet = xtgeo.triangulated_surface_from_file(grids / "ts" / f"{path.stem}.ts", fformat="tsurf")
        points = np.asarray(sheet.vertices)
        x, y = surface.get_xy_values()
        keep = ~np.ma.getmaskarray(surface.values)
        middle = surface.values.data[keep]
        assert np.abs(points[:, 2]).min() - 5 <= np.abs(middle).min()
        assert np.abs(middle).max() <= np.abs(points[:, 2]).max() + 5
        # The nearest vertex is less than a spacing away: no axis is swapped.
        for k in range(0, keep.sum(), max(1, keep.sum() // 50)):
            node = np.array([x.data[keep][k], y.data[keep][k]])
            near = np.linalg.norm(points[:, :2] - node, axis=1).argmin()
            slope = 40.0
            assert abs(abs(points[near, 2]) - abs(middle[k])) < slope


def test_a_surface_that_lies_over_itself_has_no_grid(clinothem, tmp_path):
    done = clinothem("surfaces", "models/nodules/nodules.toml", "--formats", "irap", "-o", tmp_path / "out", code=1)
    assert "is not single-valued: at x =" in done.stderr
    assert not (tmp_path / "out").exists()

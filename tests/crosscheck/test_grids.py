"""Grids as VTK, NumPy, xtgeo and a GSLIB reader of a few lines find them: where cells are, and what they hold.

What a cell should hold is asked of `clinothem locate` at the middle that the reader gives it.
"""

import json

import numpy as np
import pytest
import xtgeo
from vtk import vtkXMLImageDataReader
from vtk.util.numpy_support import vtk_to_numpy

# Neither two axes nor two directions are alike in it.
CORNERS = """
name = "Corners"
origin = [1000, 20000, -300]
[domain]
x = [0, 60]
y = [0, 40]
z = [-30, 0]
facies = "mud"
top = { dipping = { through = [0, 0, -6], dip_deg = 2, azimuth_deg = 30 } }
[facies.mud]
porosity = 0.05
permeability = 0.1
net = false
[facies.sand]
porosity = 0.25
permeability = [100, 50, 10]
net = true
[facies.nodule]
porosity = 0.01
permeability = 0.001
net = 0.25
[[feature]]
id = "upper"
kind = "horizon"
facies = "sand"
surface = { dipping = { through = [30, 20, -14], dip_deg = 8, azimuth_deg = 250 } }
[[feature]]
id = "egg"
kind = "ellipsoid"
facies = "nodule"
center = [44, 26, -12]
semi_axes = [12, 9, 6]
"""
COUNTS = (12, 8, 15)
VOLUMES = ["background", "upper", "egg"]
FACIES = {"background": 1, "upper": 2, "egg": 3}
POROSITY = {"background": 0.05, "upper": 0.25, "egg": 0.01}
PERMEABILITY_Y = {"background": 0.1, "upper": 50, "egg": 0.001}
ORIGIN = np.array([1000.0, 20000.0, -300.0])


@pytest.fixture(scope="module")
def grid(clinothem, tmp_path_factory):
    """A folder with a model's grids in all formats."""
    folder = tmp_path_factory.mktemp("grids")
    (folder / "corners.toml").write_text(CORNERS)
    cells = "x".join(map(str, COUNTS))
    clinothem("grid", "corners.toml", "--cells", cells, "--formats", "vti,npy,gslib,sgems,grdecl", "-o", "out", cwd=folder)
    clinothem("grid", "corners.toml", "--cells", "12x8", "--layers", "4", "--formats", "grdecl,npy", "-o", "layers", cwd=folder)
    return folder


def volume_at(x, y, z):
    """The number of the volume at places of the model, -1 above its top: planes and an ellipsoid whose first axis points north."""

    def plane(through, dip, azimuth):
        slope, azimuth = np.tan(np.radians(dip)), np.radians(azimuth)
        return through[2] - slope * ((x - through[0]) * np.sin(azimuth) + (y - through[1]) * np.cos(azimuth))

    volume = np.where(z > plane((30, 20, -14), 8, 250), 1, 0)
    volume[((y - 26) / 12) ** 2 + ((x - 44) / 9) ** 2 + ((z + 12) / 6) ** 2 < 1] = 2
    volume[z > plane((0, 0, -6), 2, 30)] = -1
    return volume


def box_volumes(z_high):
    """What a grid of boxes up to an elevation should hold, with the middles of its cells."""
    nx, ny, nz = COUNTS
    axes = [(np.arange(n) + 0.5) / n for n in COUNTS]
    x, y, z = np.meshgrid(axes[0] * 60, axes[1] * 40, -30 + axes[2] * (z_high + 30), indexing="ij")
    return volume_at(x, y, z), np.stack([x, y, z], axis=-1) + ORIGIN


@pytest.fixture(scope="module")
def boxes(grid):
    return box_volumes(0.0)


def test_the_model_has_every_volume_and_cells_outside(boxes):
    assert {-1, 0, 1, 2} == set(np.unique(boxes[0]))


def test_vtk_reads_arrays_names_and_places(grid, boxes):
    volumes, middles = boxes
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(grid / "out" / "corners.vti"))
    reader.Update()
    image = reader.GetOutput()
    assert image.GetDimensions() == tuple(n + 1 for n in COUNTS)
    arrays = image.GetCellData()
    found = {arrays.GetArrayName(n): vtk_to_numpy(arrays.GetArray(n)) for n in range(arrays.GetNumberOfArrays())}
    # VTK's cells: x fastest, then y, then z.
    assert np.array_equal(found["volume"], volumes.flatten(order="F"))
    # VTK makes no cells of hidden ones.
    for number in np.random.default_rng(1).choice(np.flatnonzero(found["volume"] >= 0), 50):
        bounds = image.GetCell(int(number)).GetBounds()
        middle = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
        assert np.allclose(middle, middles[np.unravel_index(number, COUNTS, order="F")])
    names = image.GetFieldData().GetAbstractArray("volume_names")
    assert [names.GetValue(n) for n in range(names.GetNumberOfValues())] == VOLUMES
    facies = image.GetFieldData().GetAbstractArray("facies_names")
    assert [facies.GetValue(n) for n in range(facies.GetNumberOfValues())] == ["", "mud", "sand", "nodule"]
    hidden = found["vtkGhostType"]
    assert np.array_equal(hidden == 32, found["volume"] == -1)
    assert np.array_equal(np.isnan(found["porosity"]), found["volume"] == -1)
    for number, name in enumerate(VOLUMES):
        own = found["volume"] == number
        assert set(found["facies"][own]) == {FACIES[name]}
        assert np.allclose(found["porosity"][own], POROSITY[name])
        assert np.allclose(found["permeability_y"][own], PERMEABILITY_Y[name])


def test_numpy_reads_arrays_by_place(grid, boxes):
    volumes = np.load(grid / "out" / "corners.volume.npy")
    assert volumes.shape == COUNTS and volumes.dtype == np.int32
    assert np.array_equal(volumes, boxes[0])
    porosity = np.load(grid / "out" / "corners.porosity.npy")
    assert porosity.dtype == np.float32
    assert np.allclose(porosity[volumes == 1], 0.25)
    assert np.isnan(porosity[volumes == -1]).all()


@pytest.mark.parametrize("ending, null", [("gslib", -999), ("sgems", -9966699)])
def test_a_reader_of_geo_eas_finds_the_same_cells(grid, boxes, ending, null):
    with (grid / "out" / f"corners.{ending}").open() as file:
        title = next(file)
        names = [next(file).strip() for _ in range(int(next(file)))]
        rows = np.loadtxt(file)
    assert names[:2] == ["volume", "facies"]
    assert rows.shape == (boxes[0].size, len(names))
    column = {name: rows[:, at].reshape(COUNTS, order="F") for at, name in enumerate(names)}
    volumes = np.where(boxes[0] == -1, null, boxes[0])
    assert np.array_equal(column["volume"], volumes)
    assert np.allclose(column["porosity"][boxes[0] == 1], 0.25)
    if ending == "sgems":
        assert title.strip() == "Corners (12x8x15)"
    else:
        first = [float(word) for word in title.split("first cell=")[1].split(" size=")[0].split()]
        assert np.allclose(first, boxes[1][0, 0, 0])


def read_corners(path):
    grid = xtgeo.grid_from_file(path, fformat="grdecl")
    names = ["VOLUME", "FACIES", "PORO", "PERMX", "PERMY", "PERMZ", "NTG"]
    arrays = {name: xtgeo.gridproperty_from_file(path, fformat="grdecl", name=name, grid=grid).values for name in names}
    return grid, arrays


def middles_of(grid):
    """Middles of all cells, z up."""
    x, y, z = (one.values.filled(np.nan) for one in grid.get_xyz(asmasked=False))
    return np.stack([x, y, -z], axis=-1)


def test_xtgeo_reads_boxes_right_handed_with_j_southward_and_k_downward(grid, boxes):
    found, arrays = read_corners(grid / "out" / "corners.grdecl")
    assert found.dimensions == COUNTS
    # With z down, I east, J south and K down are right-handed; xtgeo names it by what is seen with z down.
    assert found.ijk_handedness == "right"
    middles = middles_of(found)
    volumes, places = boxes
    # Ours has j northward and k upward.
    assert np.allclose(middles, places[:, ::-1, ::-1])
    volumes = volumes[:, ::-1, ::-1]
    active = found.get_actnum().values.filled(0) == 1
    assert np.array_equal(active, volumes >= 0)
    assert np.array_equal(arrays["VOLUME"].filled(-1)[active], volumes[active])
    bulk = found.get_bulk_volume(asmasked=False).values
    assert np.allclose(bulk, 5 * 5 * 2)
    for number, name in enumerate(VOLUMES):
        own = volumes == number
        assert np.allclose(arrays["PORO"].filled(-1)[own], POROSITY[name])
        assert np.allclose(arrays["PERMY"].filled(-1)[own], PERMEABILITY_Y[name])
        assert (arrays["FACIES"].filled(-1)[own] == FACIES[name]).all()


def test_xtgeo_reads_layers_that_fill_the_domain_and_follow_the_horizon(grid):
    found, arrays = read_corners(grid / "layers" / "corners.grdecl")
    assert found.dimensions == (12, 8, 8)
    assert found.ijk_handedness == "right"
    bulk = found.get_bulk_volume(asmasked=False).values.filled(0)
    # Under the dipping top: the mean height of a plane is that at its middle.
    slope = np.tan(np.radians(2))
    top = -6 - slope * (30 * np.sin(np.radians(30)) + 20 * np.cos(np.radians(30)))
    assert np.isclose(bulk.sum(), 60 * 40 * (top + 30), rtol=1e-5)
    # The upper four layers are all the unit above the horizon's, the lower ones below it, but for the nodule.
    middles = middles_of(found) - ORIGIN
    expected = volume_at(middles[..., 0], middles[..., 1], middles[..., 2])
    assert np.array_equal(arrays["VOLUME"].filled(-1), expected)
    assert set(np.unique(expected[:, :, :4])) == {1, 2}
    assert set(np.unique(expected[:, :, 4:])) == {0, 2}
    layers = json.loads((grid / "layers" / "corners.grid.json").read_text())["layers"]
    assert layers == [{"unit": "background", "layers": 4}, {"unit": "upper", "layers": 4}]
    # The same cells in NumPy's order.
    volumes = np.load(grid / "layers" / "corners.volume.npy")
    assert np.array_equal(volumes[:, ::-1, ::-1], expected)


def test_cells_of_committed_models_hold_what_locate_says(clinothem, model, tmp_path):
    clinothem("grid", model, "--cells", "9x7x11", "--formats", "npy", "--local", "-o", tmp_path / "out")
    key = json.loads((tmp_path / "out" / f"{model.stem}.grid.json").read_text())
    volumes = np.load(tmp_path / "out" / f"{model.stem}.volume.npy")
    counted = np.bincount(volumes[volumes >= 0], minlength=len(key["volumes"]))
    assert [one["cells"] for one in key["volumes"]] == counted.tolist()
    assert key["cells_outside"] == (volumes < 0).sum() == 0
    assert np.isclose(sum(one["fraction"] for one in key["volumes"]), 1)
    # Not at round numbers, where surfaces like to lie.
    for cell in [(0, 0, 0), (8, 2, 9), (3, 5, 2)]:
        middle = np.array(key["corner"]) + (np.array(cell) + 0.5) * np.array(key["size"])
        told = json.loads(clinothem("locate", model, "--json", "--", *middle).stdout)
        assert key["volumes"][volumes[cell]]["volume"] == told["volume"]

"""Heights that xtgeo wrote come back node for node: an asymmetric grid with one null, in which no order and no sign can be swapped.

ESRI and CPS-3 grids, which xtgeo does not write, are written here by numpy as their formats say. The reader under test is the
example `heights`, built first if need be.
"""

import os
import pathlib
import subprocess

import numpy as np
import pytest
import xtgeo

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS, ROWS, NULL = 4, 3, (2, 1)
VALUES = np.array([[-(100.0 * i + j) for j in range(ROWS)] for i in range(COLUMNS)])


@pytest.fixture(scope="session")
def program():
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    command = ["cargo", "build", "--locked", "--release", "--example", "heights"]
    if not os.environ.get("CLINOTHEM_HEIGHTS"):
        subprocess.run(command, cwd=ROOT, check=True)
    return os.environ.get("CLINOTHEM_HEIGHTS", target / "release/examples/heights")


def surface(rotation=0.0):
    values = np.ma.array(VALUES, mask=np.zeros_like(VALUES, dtype=bool))
    values[NULL] = np.ma.masked
    return xtgeo.RegularSurface(
        ncol=COLUMNS, nrow=ROWS, xinc=10.0, yinc=5.0, xori=456000.0, yori=6782000.0, rotation=rotation, values=values
    )


def read(program, path, *arguments):
    lines = subprocess.run([program, path, *arguments], check=True, capture_output=True, text=True).stdout.splitlines()
    assert lines[-1].startswith("nulls ")
    heights = np.array([[float(word) for word in line.split()] for line in lines[:-1]])
    return heights, int(lines[-1].split()[1])


def nodes(surface):
    """Places and heights of all nodes that have one, column by column, as xtgeo places them."""
    x, y = surface.get_xy_values()
    keep = ~np.ma.getmaskarray(surface.values)
    return np.column_stack([x.data[keep], y.data[keep], surface.values.data[keep]])


@pytest.mark.parametrize("rotation", [0.0, 30.0, 200.0, 359.0])
def test_irap_classic(program, tmp_path, rotation):
    own = surface(rotation)
    own.to_file(tmp_path / "any.name", fformat="irap_ascii")
    heights, nulls = read(program, tmp_path / "any.name")
    assert nulls == 1
    np.testing.assert_allclose(heights, nodes(own), rtol=0, atol=1e-6)


def test_zmap(program, tmp_path):
    own = surface()
    own.to_file(tmp_path / "any.name", fformat="zmap_ascii")
    heights, nulls = read(program, tmp_path / "any.name")
    assert nulls == 1
    np.testing.assert_allclose(heights, nodes(own), rtol=0, atol=1e-6)


def test_points(program, tmp_path):
    points = nodes(surface())
    xtgeo.Points(values=points.tolist()).to_file(tmp_path / "any.name", fformat="xyz")
    heights, nulls = read(program, tmp_path / "any.name")
    assert nulls == 0
    np.testing.assert_allclose(heights, points, rtol=0, atol=1e-3)


def test_tsurf(program, tmp_path):
    points = nodes(surface(30.0))
    triangles = np.array([[k, k + 1, k + 2] for k in range(len(points) - 2)])
    xtgeo.TriangulatedSurface(vertices=points, triangles=triangles).to_file(tmp_path / "any.name", fformat="tsurf")
    heights, _ = read(program, tmp_path / "any.name")
    # xtgeo says on which side of 0 depths are by turning signs; what it wrote is what it reads itself.
    back = xtgeo.triangulated_surface_from_file(tmp_path / "any.name", fformat="tsurf")
    np.testing.assert_allclose(heights[:, :2], points[:, :2], rtol=0, atol=1e-3)
    np.testing.assert_allclose(np.abs(heights[:, 2]), np.abs(np.asarray(back.vertices)[:, 2]), rtol=0, atol=1e-3)


def test_csv(program, tmp_path):
    points = nodes(surface())
    rows = "\n".join(f"{x},{z},{y}" for x, y, z in points)
    (tmp_path / "any.name").write_text(f"Easting,TVDSS,Northing\n{rows}\n")
    heights, _ = read(program, tmp_path / "any.name")
    np.testing.assert_allclose(heights, points, rtol=0, atol=0)


def test_esri(program, tmp_path):
    own = surface()
    filled = own.values.filled(-9999.0)
    head = "ncols 4\nnrows 3\nxllcenter 456000\nyllcenter 6782000\ndx 10\ndy 5\nnodata_value -9999\n"
    with (tmp_path / "any.name").open("w") as file:
        file.write(head)
        np.savetxt(file, filled.T[::-1])
    heights, nulls = read(program, tmp_path / "any.name")
    assert nulls == 1
    np.testing.assert_allclose(heights, nodes(own), rtol=0, atol=0)


def test_cps3(program, tmp_path):
    own = surface()
    stream = own.values.filled(1e30)[:, ::-1].ravel()
    lines = "\n".join(" ".join(f"{v:.7E}" for v in stream[k : k + 5]) for k in range(0, len(stream), 5))
    head = 'FSASCI 0 1 "Computed" 0 1.0E+30\nFSATTR 0 0\nFSLIMI 456000 456030 6782000 6782010 -302 0\nFSNROW 3 4\nFSXINC 10 5\n->any\n'
    (tmp_path / "any.name").write_text(head + lines + "\n")
    heights, nulls = read(program, tmp_path / "any.name")
    assert nulls == 1
    np.testing.assert_allclose(heights, nodes(own), rtol=1e-7, atol=0)

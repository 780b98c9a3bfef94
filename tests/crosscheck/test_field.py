"""The model whose horizons, wells and tops all come from files (models/field): its surfaces, written again, against those files.

xtgeo reads both sides where it knows the format; what the data should be at any place is known from the script that made them.
"""

import csv
import importlib.util
import pathlib

import numpy as np
import pytest
import xtgeo

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "models" / "field"
FOOT = 0.3048
# Honoured tops change a horizon within this distance of each (m), by no more than they were missed.
REACH = 900.0


def script():
    spec = importlib.util.spec_from_file_location("make_field", FOLDER / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


MAKE = script()
ORIGIN = np.array([MAKE.EAST, MAKE.NORTH])


@pytest.fixture(scope="module")
def written(clinothem, tmp_path_factory):
    """All surfaces as grids, whole and trimmed, with a node on each of the data's grids that lies in the domain."""
    folder = tmp_path_factory.mktemp("field")
    for name, more in (("whole", ["--whole"]), ("trimmed", [])):
        arguments = ["-o", folder / name, "--formats", "irap,zmap,cps3", "--spacing", "100"]
        clinothem("surfaces", FOLDER / "field.toml", *arguments, *more)
    return folder


def output(folder, name, kind="whole"):
    paths = list((folder / kind / "irap").glob(f"{name}*.irap"))
    assert len(paths) == 1, [path.name for path in (folder / kind / "irap").iterdir()]
    return xtgeo.surface_from_file(paths[0], fformat="irap_ascii")


def at_nodes(surface):
    """Local places and heights of the nodes of a grid that have one."""
    x, y = surface.get_xy_values()
    keep = ~np.ma.getmaskarray(surface.values)
    return np.column_stack([x.data[keep] - ORIGIN[0], y.data[keep] - ORIGIN[1], surface.values.data[keep]])


def esri(path):
    lines = path.read_text().splitlines()
    head = dict(line.split() for line in lines[:6])
    rows = np.array([[float(word) for word in line.split()] for line in lines[6:]])
    columns = rows[::-1].T
    step, x, y = (float(head[key]) for key in ("cellsize", "xllcenter", "yllcenter"))
    return [(x + step * i, y + step * j, columns[i, j]) for i in range(columns.shape[0]) for j in range(columns.shape[1])]


def cps3(path):
    head, body = path.read_text().split("\n->")
    words = {line.split()[0]: line.split()[1:] for line in head.splitlines()}
    x, _, y = (float(word) for word in words["FSLIMI"][:3])
    rows, count = (int(word) for word in words["FSNROW"])
    step = float(words["FSXINC"][0])
    columns = np.array(body.split()[1:], dtype=float).reshape(count, rows)[:, ::-1]
    return [(x + step * i, y + step * j, columns[i, j]) for i in range(count) for j in range(rows)]


def given(name):
    """What a file has of a surface: local places, and elevations in metres."""
    if name == "base":
        found = esri(FOLDER / "base.asc")
    elif name == "upper-sand":
        found = cps3(FOLDER / "upper-sand.cps3")
    elif name == "coal-measures":
        # xtgeo knows no feet and no depths.
        surface = xtgeo.surface_from_file(FOLDER / "coal-measures.zmap", fformat="zmap_ascii")
        nodes = at_nodes(surface)
        return np.column_stack([nodes[:, :2], -FOOT * nodes[:, 2]])
    elif name in {"lower-sand", "marine-shale"}:
        nodes = at_nodes(xtgeo.surface_from_file(FOLDER / f"{name}.irap", fformat="irap_ascii"))
        return np.column_stack([nodes[:, :2], -nodes[:, 2]])
    elif name == "unconformity":
        lines = (FOLDER / "unconformity.ts").read_text().splitlines()
        vertices = [line.split()[2:] for line in lines if line.startswith("VRTX")]
        found = [(float(x), float(y), -float(depth)) for x, y, depth in vertices]
    else:
        with (FOLDER / "top.csv").open(newline="") as file:
            rows = [row for row in csv.DictReader(file, delimiter=";") if row["TVDSS (ft)"] != "-999.25"]
        found = [(float(row["Easting"]), float(row["Northing"]), -FOOT * float(row["TVDSS (ft)"])) for row in rows]
    found = np.array(found)
    found[:, :2] -= ORIGIN
    return found


def inside(points):
    x, y = points[:, 0], points[:, 1]
    return points[(x >= -1e-6) & (x <= 4000 + 1e-6) & (y >= -1e-6) & (y <= 3000 + 1e-6)]


def from_tops(name, places):
    """How far places are from the horizon's nearest top, and by how much it was missed there at most."""
    tops = [well.at(md) for well in MAKE.WELLS.values() for horizon, md in well.tops() if horizon == name]
    if not tops:
        return np.full(len(places), np.inf), 0.0
    tops = np.array(tops)
    distances = np.linalg.norm(places[:, None, :2] - tops[None, :, :2], axis=2).min(axis=1)
    return distances, max(abs(MAKE.miss(x, y)) for x, y, _ in tops)


def pairs(folder, name):
    """Given and written heights at the same nodes, and how far these are from tops; at least most nodes of the domain."""
    own = {(round(x, 3), round(y, 3)): z for x, y, z in at_nodes(output(folder, name))}
    data = inside(given(name))
    found = np.array([own[round(x, 3), round(y, 3)] for x, y, _ in data])
    return data, found


@pytest.mark.parametrize("name", ["coal-measures", "upper-sand"])
def test_a_horizon_that_was_fitted_to_a_tolerance_is_the_file_node_for_node(written, name):
    data, found = pairs(written, name)
    assert len(data) > 1200
    distances, missed = from_tops(name, data)
    off = found - data[:, 2]
    away = distances > REACH
    assert away.sum() > 300
    assert np.abs(off[away]).max() <= 0.1 + 2e-4
    # Beside a top it comes down to that, and nowhere by more than a little more than was missed.
    assert np.abs(off).max() <= 1.1 * missed + 0.2
    near = distances < 50
    assert near.sum() >= 2
    assert np.abs(off[near]).min() > 1.0


def test_a_horizon_with_noise_averages_that_node_for_node(written):
    name = "lower-sand"
    data, found = pairs(written, name)
    distances, _ = from_tops(name, data)
    away = distances > REACH
    off = (found - data[:, 2])[away]
    assert away.sum() > 300
    noise = MAKE.NOISE[name]
    assert 0.9 * noise < off.std() < 1.1 * noise
    assert np.abs(off).max() < 5 * noise
    true = np.array([MAKE.seen(name)(x, y) for x, y, _ in data[away]])
    assert np.sqrt(np.mean((found[away] - true) ** 2)) < noise / 3


def test_the_hole_of_the_data_is_filled_as_the_surface_goes_on(written):
    nodes = at_nodes(output(written, "lower-sand"))
    (x, y), radius = MAKE.HOLE
    hole = nodes[np.hypot(nodes[:, 0] - x, nodes[:, 1] - y) < radius]
    distances, missed = from_tops("lower-sand", hole)
    assert len(hole) > 30
    seen = np.array([MAKE.seen("lower-sand")(*node[:2]) for node in hole])
    allowed = np.where(distances > REACH, 2.0, 2.0 + missed)
    assert (np.abs(hole[:, 2] - seen) < allowed).all()


def test_a_turned_grid_with_noise_is_met_at_its_own_nodes(written):
    surface = output(written, "marine-shale")
    data = inside(given("marine-shale"))
    distances, _ = from_tops("marine-shale", data)
    data = data[distances > REACH]
    assert len(data) > 300
    found = np.array([surface.get_value_from_xy((x + ORIGIN[0], y + ORIGIN[1])) for x, y, _ in data], dtype=float)
    off = (found - data[:, 2])[np.isfinite(found)]
    noise = MAKE.NOISE["marine-shale"]
    assert len(off) > 0.9 * len(data)
    assert 0.85 * noise < off.std() < 1.15 * noise
    assert abs(off.mean()) < 0.1


def test_scattered_points_and_triangles_are_met_where_they_are(written):
    surface = output(written, "unconformity")
    data = inside(given("unconformity"))
    found = np.array([surface.get_value_from_xy((x + ORIGIN[0], y + ORIGIN[1])) for x, y, _ in data], dtype=float)
    off = (found - data[:, 2])[np.isfinite(found)]
    assert len(off) > 300
    # Between nodes 100 m apart xtgeo is bilinear: 100² / 8 of a curvature of 1e-5 is a centimetre.
    assert np.abs(off).max() < 0.1 + 0.03


def test_tops_are_on_their_horizons(written, clinothem, tmp_path):
    for name in MAKE.SEISMIC:
        surface = output(written, name)
        tops = [well.at(md) for well in MAKE.WELLS.values() for horizon, md in well.tops() if horizon == name]
        assert tops
        for x, y, z in tops:
            found = surface.get_value_from_xy((x + ORIGIN[0], y + ORIGIN[1]))
            # Bilinear between nodes, about a top that pulls it by up to 5 m within 900 m.
            assert abs(found - z) < 0.3, (name, x, y, found, z)


def test_horizons_are_nearer_the_truth_about_wells_than_the_data(written):
    for name in MAKE.SEISMIC:
        nodes = at_nodes(output(written, name))
        distances, _ = from_tops(name, nodes)
        near = nodes[distances < 250]
        true = np.array([MAKE.TRUE[name](*node[:2]) for node in near])
        seen = np.array([MAKE.seen(name)(*node[:2]) for node in near])
        now, before = (np.sqrt(np.mean(off**2)) for off in (near[:, 2] - true, seen - true))
        assert now < before / 3, (name, now, before)


def test_what_the_unconformity_has_eroded_has_no_height_in_trimmed_grids(written):
    for name in MAKE.SEISMIC:
        nodes = at_nodes(output(written, name, "trimmed"))
        whole = at_nodes(output(written, name))
        assert 100 < len(nodes) < len(whole)
        above = np.array([MAKE.TRUE["unconformity"](x, y) for x, y, _ in nodes])
        assert (nodes[:, 2] < above + 0.15).all()
        # What is left is what lies below it.
        unconformity = np.array([MAKE.TRUE["unconformity"](x, y) for x, y, _ in whole])
        left = (whole[:, 2] < unconformity).sum()
        assert abs(len(nodes) - left) <= 0.01 * len(whole)


def test_wells_enter_what_their_tops_say(clinothem, tmp_path):
    clinothem("log", FOLDER / "field.toml", "-o", tmp_path / "wells.csv")
    with (tmp_path / "wells.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    for label, well in MAKE.WELLS.items():
        for horizon, md in well.tops():
            # The unconformity does not honour its tops: it is as near as its data.
            slack = 1e-3 if horizon in MAKE.SEISMIC else 2.0
            left = [row for row in rows if row["well"] == label and abs(float(row["md_to_m"]) - md) < slack]
            assert len(left) == 1, (label, horizon, md)

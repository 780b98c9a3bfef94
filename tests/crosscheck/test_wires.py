"""Wells as curves in STEP, read by OpenCASCADE through build123d, and as GOCAD lines; places and lengths against welleng and the log."""

import csv
import json

import build123d as bd
import numpy as np
import pytest
import welleng
from conftest import readable

MODEL = "models/fig02-wells/fig02-wells.toml"
# The model's A-2: its path is by minimum curvature, so welleng has the same.
STATIONS = ([0, 1500, 1600, 1700, 2110], [0, 0, 10, 20, 20], [300] * 5)
HEAD, DATUM, SEA = (220.0, 80.0), 25.0, 2000.0
ORIGIN = np.array([456000.0, 6782000.0, -2000.0])


@pytest.fixture(scope="module")
def files(clinothem, tmp_path_factory):
    folder = tmp_path_factory.mktemp("wires")
    clinothem("build", MODEL, "-o", folder / "out", "--formats", "none,step-wells,xlsx,csv")
    clinothem("log", MODEL, "-o", folder / "wells.pl")
    return folder


@pytest.fixture(scope="module")
def wells(files):
    report = json.loads((files / "out" / "report.json").read_text())
    return report["wells"]


def metres(vector):
    """build123d counts in millimetres."""
    return np.array([vector.X, vector.Y, vector.Z]) / 1000


def named(well):
    return [f"{well['name']} {k}: {one['volume'] or 'outside'}" for k, one in enumerate(well["intervals"], 1)]


def leaves(shape):
    return [leaf for child in shape.children for leaf in leaves(child)] if shape.children else [shape]


def test_wires_have_the_names_lengths_and_ends_of_the_intervals(files, wells):
    read = bd.import_step(files / "out" / "fig02-wells.wells.step")
    assert [child.label for child in read.children] == [well["name"] for well in wells]
    parts = leaves(read)
    intervals = [one for well in wells for one in well["intervals"]]
    assert len(parts) == len(intervals)
    names = [name for well in wells for name in named(well)]
    for part, name, one in zip(parts, names, intervals, strict=True):
        assert part.label == readable(name)
        edges = part.edges()
        assert len(edges) == 1, name
        # A spline's length is its measured depth to what the survey allows.
        assert edges[0].length / 1000 == pytest.approx(one["length_m"], rel=2e-3, abs=1e-4), name
        assert not part.solids() and not part.faces()


def test_pieces_follow_each_other_without_a_gap(files, wells):
    read = bd.import_step(files / "out" / "fig02-wells.wells.step")
    parts = iter(leaves(read))
    for well in wells:
        edges = [next(parts).edges()[0] for _ in well["intervals"]]
        for above, below in zip(edges, edges[1:]):
            assert (above.position_at(1) - below.position_at(0)).length < 1e-6
        ends = [edges[0].position_at(0), edges[-1].position_at(1)]
        for found, expected in zip(ends, well["ends"], strict=True):
            np.testing.assert_allclose(metres(found), expected, rtol=0, atol=1e-7)


def test_arcs_of_minimum_curvature_are_where_welleng_has_them(files, wells):
    read = bd.import_step(files / "out" / "fig02-wells.wells.step")
    (well,) = (child for child in read.children if child.label == "A-2")
    md, inc, azi = STATIONS
    survey = welleng.survey.Survey(md=md, inc=inc, azi=azi, start_nev=[0, 0, 0], deg=True)
    intervals = next(one for one in wells if one["name"] == "A-2")["intervals"]
    for part, one in zip(leaves(well), intervals, strict=True):
        edge = part.edges()[0]
        for at, depth in zip((0, 1), one["md_m"], strict=True):
            north, east, down = survey.interpolate_md(depth).pos_nev
            place = [HEAD[0] + east, HEAD[1] + north, SEA + DATUM - down]
            np.testing.assert_allclose(metres(edge.position_at(at)), place, rtol=0, atol=1e-5)


def plines(path):
    """Objects of a file of GOCAD lines: name, and lines of vertices (x, y, z, md, volume)."""
    objects = []
    for line in path.read_text().splitlines():
        words = line.split()
        if line.startswith("GOCAD PLine"):
            objects.append([None, []])
        elif line.startswith("name:"):
            objects[-1][0] = line[5:]
        elif words[0] == "ILINE":
            objects[-1][1].append(([], []))
        elif words[0] == "PVRTX":
            objects[-1][1][-1][0].append([float(word) for word in words[1:]])
        elif words[0] == "SEG":
            objects[-1][1][-1][1].append([int(word) for word in words[1:]])
    return objects


def test_gocad_lines_run_through_the_volumes_of_the_log(files, wells):
    objects = plines(files / "wells.pl")
    assert [name for name, _ in objects] == [well["name"] for well in wells]
    volumes = [row["volume"] for row in csv.DictReader((files / "out" / "volumes.csv").open(newline=""))]
    for (_, lines), well in zip(objects, wells, strict=True):
        assert len(lines) == len(well["intervals"])
        numbers = [vertex[0] for vertices, _ in lines for vertex in vertices]
        assert numbers == list(range(1, len(numbers) + 1))
        for (vertices, segments), one in zip(lines, well["intervals"], strict=True):
            vertices = np.array(vertices)
            assert segments == [[int(a), int(a) + 1] for a in vertices[:-1, 0]]
            depths, volume = vertices[:, 4], set(vertices[:, 5])
            np.testing.assert_allclose([depths[0], depths[-1]], one["md_m"], rtol=0, atol=1e-6)
            assert (np.diff(depths) > 0).all() and np.diff(depths).max() <= 2 + 1e-9
            (number,) = volume
            assert (volumes[int(number)] if number >= 0 else None) == one["volume"]
            places = vertices[:, 1:4] - ORIGIN
            along = np.linalg.norm(np.diff(places, axis=0), axis=1).sum()
            assert along == pytest.approx(one["length_m"], rel=2e-3, abs=1e-4)
            # Elevations, in the world: below the sea.
            np.testing.assert_allclose(-vertices[[0, -1], 3], one["tvdss_m"], rtol=0, atol=1e-5)


def test_the_workbook_has_a_sheet_of_wells(files):
    import openpyxl

    book = openpyxl.load_workbook(files / "out" / "fig02-wells.xlsx")
    assert "wells" in book.sheetnames and "tops" not in book.sheetnames
    with (files / "out" / "wells.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    found = list(book["wells"].iter_rows(values_only=True))
    assert list(found[0]) == rows[0] and len(found) == len(rows)
    for ours, theirs in zip(rows[1:], found[1:], strict=True):
        assert [cell or None for cell in ours[:3]] == list(theirs[:3])
        np.testing.assert_allclose([float(cell) for cell in ours[3:]], theirs[3:], rtol=0, atol=1e-9)

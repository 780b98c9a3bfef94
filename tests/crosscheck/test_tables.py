"""Tables as openpyxl and pandas find them: the same numbers as in CSV and in the report, and measures that are worked out again."""

import csv
import math
import zipfile

import openpyxl
import pandas as pd
import pytest

SHEETS = ["volumes", "facies", "units", "sand-bodies", "measures", "neighbours", "drawn"]


@pytest.fixture(scope="session", autouse=True)
def shown(model):
    """Before anything is built."""
    if model.stem not in {"coastal", "channel-belt", "rock", "quickstart", "levees"}:
        pytest.skip("some models show it")


@pytest.fixture(scope="module")
def tables(model, clinothem, tmp_path_factory):
    """The folder of a build with tables, and its workbook."""
    folder = tmp_path_factory.mktemp("tables") / "out"
    clinothem("build", model, "-o", folder, "--formats", "none,xlsx,csv")
    return folder, openpyxl.load_workbook(folder / f"{model.stem}.xlsx")


def cell(text):
    """A cell of CSV as a spreadsheet has it."""
    if text == "":
        return None
    try:
        return float(text)
    except ValueError:
        return text


def test_the_workbook_has_the_cells_of_the_csv_files(tables):
    folder, book = tables
    assert book.sheetnames == SHEETS
    for name in SHEETS:
        with (folder / f"{name}.csv").open(newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        found = [list(row) for row in book[name].iter_rows(values_only=True)]
        assert found[0] == rows[0]
        assert len(found) == len(rows)
        for ours, theirs in zip(rows[1:], found[1:], strict=True):
            # Numbers are numbers, not words that look like them.
            assert [cell(one) for one in ours] == [float(one) if isinstance(one, int) else one for one in theirs]


def test_the_workbook_holds_no_clock(tables, build):
    folder, book = tables
    assert book.properties.created.year == 1980
    with zipfile.ZipFile(folder / f"{build.stem}.xlsx") as archive:
        assert {entry.date_time[0] for entry in archive.infolist()} == {1980}


def test_pandas_sums_volumes_to_the_domain_and_to_the_facies(tables, build):
    folder, _ = tables
    path = folder / f"{build.stem}.xlsx"
    volumes = pd.read_excel(path, sheet_name="volumes")
    assert math.isclose(volumes["volume_m3"].sum(), build.domain["volume_m3"], rel_tol=1e-9)
    assert math.isclose(volumes["fraction"].sum(), 1, abs_tol=1e-6)
    facies = pd.read_excel(path, sheet_name="facies").set_index("facies")["volume_m3"]
    for name, size in volumes.groupby("facies")["volume_m3"].sum().items():
        assert math.isclose(facies[name], size, rel_tol=1e-9, abs_tol=1e-4)
    assert list(volumes["number"]) == list(range(len(volumes)))
    for entry, row in zip(build.report["volumes"], volumes.itertuples(), strict=True):
        value = entry["properties"].get("permeability")
        if value is None:
            continue
        if not isinstance(value, list):
            value = [value] * 3
        diagonal = [value[n][n] if isinstance(value[n], list) else value[n] for n in range(3)]
        assert [row.permeability_x_md, row.permeability_y_md, row.permeability_z_md] == pytest.approx(diagonal, rel=1e-15)


def test_connectivity_follows_from_the_neighbours(tables, build):
    """Groups of net volumes by a search of our own; volumes in several pieces are left out, since the table has volumes."""
    folder, _ = tables
    volumes = pd.read_csv(folder / "volumes.csv").set_index("volume")
    if "net" not in volumes or volumes["net"].isna().any() or volumes[volumes["net"] > 0]["solids"].max() > 1:
        pytest.skip("volumes are not all whole, or do not say whether they are net")
    net = {name for name, one in volumes.iterrows() if one["net"] > 0 and one["volume_m3"] > 0}
    edges = pd.read_csv(folder / "neighbours.csv")
    near = {name: set() for name in net}
    for edge in edges.itertuples():
        if edge.area_m2 >= 1 and {edge.volume, edge.neighbour} <= net:
            near[edge.volume].add(edge.neighbour)
            near[edge.neighbour].add(edge.volume)
    sizes, left = [], set(net)
    while left:
        group, new = set(), {left.pop()}
        while new:
            group |= new
            new = set().union(*(near[one] for one in new)) - group
        left -= group
        sizes.append(sum(volumes.loc[one, "net_volume_m3"] for one in group))
    found = build.report["connectivity"]
    assert sorted(sizes) == pytest.approx(sorted(group["net_volume_m3"] for group in found["groups"]), rel=1e-9)
    assert found["gamma"] == pytest.approx(sum(size**2 for size in sizes) / sum(sizes) ** 2, rel=1e-9)
    measures = pd.read_csv(folder / "measures.csv").set_index("measure")["value"]
    assert measures["gamma"] == pytest.approx(found["gamma"], abs=1e-8)
    assert measures["net_to_gross"] == pytest.approx(build.report["net_to_gross"], abs=1e-8)

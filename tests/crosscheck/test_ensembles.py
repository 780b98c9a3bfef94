"""An ensemble's table of realisations as pyarrow finds it in Parquet: the same as in CSV."""

import csv
import math

import pyarrow as pa
import pyarrow.parquet as pq
import pytest


@pytest.fixture(scope="session", autouse=True)
def shown(model):
    """Before anything is built."""
    if model.stem != "quickstart":
        pytest.skip("one model shows it")


def test_parquet_has_the_cells_of_the_csv_file(model, clinothem, tmp_path):
    design = tmp_path / "design.csv"
    # The largest seed that there is; a text; a channel that one scenario has not.
    design.write_text("seed,feature.young-channel.facies\n1,sand\n2,mud\n18446744073709551615,sand\n")
    scenarios = ["--scenario", "all:", "--scenario", "old: --without young-channel"]
    clinothem("ensemble", model, "--design", design, "--quiet", "-o", tmp_path / "out", *scenarios)
    table = pq.read_table(tmp_path / "out" / "realisations.parquet")
    with (tmp_path / "out" / "realisations.csv").open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert table.column_names == head
    assert table.num_rows == len(rows) == 6
    assert table["seed"].to_pylist()[2] == 18446744073709551615
    assert table.schema.field("seed").type == pa.uint64()
    empty = 0
    for at, name in enumerate(head):
        for ours, theirs in zip((row[at] for row in rows), table[name].to_pylist(), strict=True):
            if theirs is None:
                assert ours == ""
                empty += 1
            elif isinstance(theirs, float):
                assert float(ours) == theirs and math.isfinite(theirs)
            else:
                assert ours == str(theirs)
    assert empty > 0

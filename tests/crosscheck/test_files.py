"""What can be seen without opening the model: bytes and text of the files."""

import csv
import filecmp
import re

import pytest

OUTPUTS = ["{}.step", "{}.shared.step", "{}.brep", "volumes.csv", "report.json"]


def differing(build, other, outputs=OUTPUTS):
    names = [name.format(build.stem) for name in outputs]
    # There is no shared STEP where one volume encloses another; then the other build must not have it either.
    names = [name for name in names if not name.endswith(".shared.step") or (build.dir / name).exists() or (other / name).exists()]
    assert all((folder / name).stat().st_size > 0 for name in names for folder in (build.dir, other))
    return [name for name in names if not filecmp.cmp(build.dir / name, other / name, shallow=False)]


def test_another_build_elsewhere_with_the_formats_in_another_order_gives_the_same_bytes(build, model, clinothem, tmp_path):
    clinothem("build", model, "-o", "again", "--formats", "brep,step-shared,step", cwd=tmp_path)
    assert differing(build, tmp_path / "again") == []


def test_one_thread_gives_the_same_bytes_as_all_of_them(build, model, clinothem, tmp_path):
    clinothem("build", model, "-o", tmp_path / "one", "--threads", 1, "--formats", "step,step-shared,brep")
    assert differing(build, tmp_path / "one") == []


@pytest.mark.parametrize("written", [("step", "{}.step"), ("step-shared", "{}.shared.step"), ("brep", "{}.brep")], ids=lambda w: w[0])
def test_a_file_is_the_same_whether_or_not_others_are_written_with_it(build, model, clinothem, tmp_path, written):
    if model.stem != "quickstart":
        pytest.skip("one small model shows it")
    clinothem("build", model, "-o", tmp_path / "alone", "--formats", written[0])
    assert differing(build, tmp_path / "alone", [written[1], "report.json"]) == []


def test_another_seed_gives_other_bytes(build, model, clinothem, tmp_path):
    if model.stem != "quickstart":
        pytest.skip("one small model shows it")
    clinothem("build", model, "-o", tmp_path / "other", "--seed", build.report["model"]["seed"] + 1)
    assert differing(build, tmp_path / "other", ["{}.step", "report.json", "volumes.csv"]) != []


@pytest.mark.parametrize("flavour", ["step", "shared"])
def test_the_file_declares_metres_and_nothing_else_and_holds_no_clock(build, flavour):
    if flavour == "shared" and not build.shared.exists():
        pytest.skip("a volume encloses another: there is no shared STEP")
    text = getattr(build, flavour).read_text(encoding="ascii")
    units = set(re.findall(r"LENGTH_UNIT\s*\(\s*\)\s*NAMED_UNIT\s*\(\s*\*\s*\)\s*SI_UNIT\s*\(([^)]*)\)", text))
    assert units == {"$,.METRE."}
    assert len(re.findall(r"\bLENGTH_UNIT\b", text)) == len(re.findall(r"SI_UNIT\s*\(\s*\$\s*,\s*\.METRE\.\s*\)", text))
    assert re.findall(r"FILE_NAME\s*\('(?:[^']|'')*',\s*'([^']*)'", text) == ["1970-01-01T00:00:00"]


def test_every_volume_with_a_solid_is_a_product_by_its_name(build):
    products = re.findall(r"PRODUCT\s*\(\s*'([^']*)'\s*,\s*'([^']*)'", build.step.read_text(encoding="ascii"))
    names = [name for _, name in products]
    assert [names.count(volume.shown) for volume in build.volumes.values()] == [1] * len(build.volumes)
    assert len({number for number, _ in products}) == len(products), "two products with one identifier"


def test_the_report_and_the_table_tell_the_same_volumes_that_sum_to_the_domain(build):
    with (build.dir / "volumes.csv").open(newline="") as file:
        rows = {row["volume"]: float(row["volume_m3"]) for row in csv.DictReader(file)}
    told = {v["name"]: v["volume_m3"] for v in build.report["volumes"]}
    assert rows.keys() == told.keys()
    for name, size in told.items():
        assert abs(rows[name] - size) <= 1e-6 * max(size, 1)
        assert abs(sum(build.volumes[name].solids if name in build.volumes else []) - size) <= 1e-9 * max(size, 1)
    x, y, z = (high - low for low, high in (build.domain[axis] for axis in "xyz"))
    assert abs(x * y * z - build.domain["volume_m3"]) <= 1e-9 * x * y * z
    assert abs(sum(told.values()) - x * y * z) <= 1e-6 * x * y * z

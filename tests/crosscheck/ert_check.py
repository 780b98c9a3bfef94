"""Runs the configurations of integrations/ert in ERT and compares each realisation with a build of the same values.

script/crosscheck-ert calls it in a folder with a copy of them, of the models, and of the plugin. What a realisation should be is read
from where ERT has it from (the design matrix), or from its own file of parameters, and goes to the program as `--set`.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import openpyxl
from ert.storage import open_storage

WORK = Path(sys.argv[1])
CONFIGURATIONS = WORK / "integrations" / "ert"
REALISATIONS = range(8)

# What design/names.toml says, written down once more.
KEYS = {
    "CH_WIDTH": ["feature.old-channel.width", "feature.young-channel.width"],
    "CH_DEPTH": ["feature.young-channel.depth"],
    "CH_FILL": ["feature.young-channel.facies"],
    "SAND_PORO": ["facies.sand.porosity"],
    "OWC": [],
}

# The queue: LOCAL, or another one that integrations/ert/README.md has lines for.
QUEUE = os.environ.get("ERT_QUEUE", "LOCAL")

wrong: list[str] = []


def expect(is_so: bool, what: str) -> None:
    if not is_so:
        wrong.append(what)
        print(f"  WRONG: {what}")


def ert(configuration: Path, environment: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
    command = ["ert", "ensemble_experiment", "--disable-monitoring", configuration.name]
    return subprocess.run(
        command,
        cwd=configuration.parent,
        env=os.environ | (environment or {}),
        capture_output=True,
        text=True,
        check=False,
        timeout=3600,
    )


def queue_lines() -> str:
    """What the README says that takes the place of the local queue."""
    readme = (CONFIGURATIONS / "README.md").read_text(encoding="utf-8").splitlines()
    first = next(at for at, line in enumerate(readme) if line.startswith("QUEUE_SYSTEM"))
    last = readme.index("```", first)
    columns = list(zip(*(re.split(" {2,}", line) for line in readme[first:last]), strict=True))
    return "\n".join(next(column for column in columns if column[0] == f"QUEUE_SYSTEM {QUEUE}"))


def to_the_queue(configuration: Path) -> None:
    """Has a configuration run in the queue that is asked for."""
    if QUEUE == "LOCAL":
        return
    text = configuration.read_text(encoding="utf-8")
    local = re.compile("^QUEUE_SYSTEM LOCAL\n(QUEUE_OPTION LOCAL .*\n)*", re.MULTILINE)
    text, count = local.subn(queue_lines() + "\n", text)
    assert count == 1, f"{configuration} has no local queue"
    configuration.write_text(text, encoding="utf-8")


def build(model: Path, settings: list[tuple[str, object]], seed: int, folder: Path) -> dict:
    """The report of a build, in whose folder volumes.csv is."""
    command = ["clinothem", "build", str(model), "--formats", "none", "--quiet", "--seed", str(seed), "-o", str(folder)]
    command += [f"--set={key}={value}" for key, value in settings]
    subprocess.run(command, check=True)
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


def responses(folder: Path, realisations: list[int]) -> dict[tuple[str, int], float]:
    """What ERT has stored, by response and realisation."""
    with open_storage(folder / "out" / "storage") as storage:
        ensemble = next(iter(storage.ensembles))
        made = ensemble.get_realization_list_with_responses()
        expect(made == realisations, f"ERT has responses of {made}, not of {realisations}")
        frame = ensemble.load_responses("gen_data", tuple(made))
    return {(row["response_key"], row["realization"]): row["values"] for row in frame.to_dicts()}


def compare(
    folder: Path,
    model: str,
    settings: dict[int, list[tuple[str, object]]],
    measures: dict[str, Callable[[dict], float]],
) -> None:
    """Each realisation that was made has the bytes of a build, and ERT has the numbers of its report."""
    made = sorted(settings)
    stored = responses(folder, made)
    distinct = set()
    for realisation in made:
        runpath = folder / "out" / f"realization-{realisation}" / "iter-0"
        fresh = WORK / "fresh" / folder.name / str(realisation)
        report = build(WORK / "models" / model, settings[realisation], realisation, fresh)
        found = (runpath / "clinothem" / "volumes.csv").read_bytes()
        distinct.add(found)
        expect(found == (fresh / "volumes.csv").read_bytes(), f"realisation {realisation}: volumes.csv differs")
        for name, measure in measures.items():
            # ERT keeps responses in single precision.
            expected, has = np.float32(measure(report)), np.float32(stored.get((name, realisation), np.nan))
            expect(expected == has, f"realisation {realisation}: {name} is {expected}, in ERT {has}")
    expect(len(distinct) == len(made), f"only {len(distinct)} of {len(made)} realisations differ from each other")
    print(f"  compared {len(made)} realisations with builds, and their responses in ERT with reports")


def pore_volume(report: dict) -> float:
    return report["totals"]["pore_volume_m3"]


def channel_sand(report: dict) -> float:
    return next(one["fraction"] for one in report["facies"] if one["name"] == "channel-sand")


def coastal() -> None:
    print("coastal: priors, a step from a file")
    folder = CONFIGURATIONS / "coastal"
    ran = ert(folder / "coastal.ert")
    expect(ran.returncode == 0, f"ert ended with {ran.returncode}: {ran.stderr[-2000:]}")
    settings = {}
    for realisation in REALISATIONS:
        file = folder / "out" / f"realization-{realisation}" / "iter-0" / "parameters.json"
        parameters = json.loads(file.read_text(encoding="utf-8"))
        expect(len(parameters) == 12, f"{file} has {len(parameters)} parameters")
        values = {key: one["value"] for key, one in parameters.items()}
        values["feature.channel.count"] = round(values["feature.channel.count"])
        settings[realisation] = list(values.items())
    compare(folder, "coastal/coastal.toml", settings, {"PORE_VOLUME": pore_volume, "CHANNEL_SAND": channel_sand})


def design_rows() -> dict[int, dict[str, object]]:
    sheet = openpyxl.load_workbook(CONFIGURATIONS / "design" / "design.xlsx")["DesignSheet"]
    head, *rows = sheet.iter_rows(values_only=True)
    return {row[0]: dict(zip(head[1:], row[1:], strict=True)) for row in rows}


def design(folder: Path, environment: dict[str, str] | None = None) -> None:
    ran = ert(folder / "design.ert", environment)
    expect(ran.returncode == 0, f"ert ended with {ran.returncode}: {ran.stderr[-2000:]}")
    settings = {}
    for realisation, row in design_rows().items():
        runpath = folder / "out" / f"realization-{realisation}" / "iter-0"
        if row["SAND_PORO"] > 1.0:
            told = (runpath / "CLINOTHEM.stderr.0").read_text(encoding="utf-8")
            expect("parameters.json" in told and "1.26" in told, f"realisation {realisation} does not say why: {told}")
            expect((runpath / "ERROR").exists(), f"realisation {realisation} did not fail")
            expect(not (runpath / "clinothem").exists(), f"realisation {realisation} left results")
            expect(not (runpath / "grid").exists(), f"realisation {realisation} went on")
            print(f"  realisation {realisation} failed, as it must")
            continue
        expect(any((runpath / "grid").glob("*.GRDECL")) or any((runpath / "grid").glob("*.grdecl")), f"realisation {realisation} has no grid")
        settings[realisation] = [(key, value) for name, value in row.items() for key in KEYS[name]]
    expect(sorted(set(REALISATIONS) - set(settings)) == [5], "one realisation was to fail")
    measures = {"PORE_VOLUME": pore_volume, "NET_TO_GROSS": lambda report: report["net_to_gross"]}
    compare(folder, "quickstart/quickstart.toml", settings, measures)


def with_plugin() -> None:
    print("design: a matrix, steps from the plugin")
    folder = CONFIGURATIONS / "design-with-plugin"
    shutil.copytree(CONFIGURATIONS / "design", folder, ignore=shutil.ignore_patterns("out", "logs"))
    configuration = folder / "design.ert"
    lines = configuration.read_text(encoding="utf-8").splitlines(keepends=True)
    configuration.write_text("".join(line for line in lines if not line.startswith("INSTALL_JOB")), encoding="utf-8")
    environment = {"PYTHONPATH": str(WORK / "plugin")}
    design(folder, environment)

    print("a model with a defect, steps from the plugin")
    broken = folder / "broken.toml"
    model = (WORK / "models" / "quickstart" / "quickstart.toml").read_text(encoding="utf-8")
    broken.write_text(model.replace("width = 70", "widht = 70"), encoding="utf-8")
    text = configuration.read_text(encoding="utf-8")
    shutil.rmtree(folder / "out")
    configuration.write_text(text.replace("../../../models/quickstart/quickstart.toml", "broken.toml"), encoding="utf-8")
    ran = ert(configuration, environment)
    told = ran.stdout + ran.stderr
    expect(ran.returncode != 0 and "widht" in told, f"ert ended with {ran.returncode}: {told[-2000:]}")
    expect(not (folder / "out" / "realization-0").exists(), "an experiment began")
    print("  refused before the experiment")


def limit_of_time() -> None:
    print("a realisation that takes too long")
    folder = CONFIGURATIONS / "slow"
    folder.mkdir()
    book = openpyxl.Workbook()
    book.active.title = "DesignSheet"
    # Thousands of channels that cross each other take minutes.
    for row in [("REAL", "feature.channel.count"), (0, 2), (1, 2000)]:
        book.active.append(row)
    book.save(folder / "design.xlsx")
    text = (CONFIGURATIONS / "design" / "design.ert").read_text(encoding="utf-8")
    text = text.replace("NUM_REALIZATIONS 8", "NUM_REALIZATIONS 2").replace("MAX_RUNTIME 600", "MAX_RUNTIME 20")
    text = text.replace("quickstart", "channel-belt").replace(", <NAMES>=<CONFIG_PATH>/names.toml", "")
    lines = [line for line in text.splitlines() if "CLINOTHEM_GRID" not in line]
    (folder / "slow.ert").write_text("\n".join(lines) + "\n", encoding="utf-8")
    ran = ert(folder / "slow.ert")
    expect(ran.returncode == 0, f"ert ended with {ran.returncode}: {ran.stderr[-2000:]}")
    expect(not (folder / "out" / "realization-1" / "iter-0" / "clinothem").exists(), "the slow one left results")
    compare(folder, "channel-belt/channel-belt.toml", {0: [("feature.channel.count", 2)]}, {})


for name in ["coastal/coastal.ert", "design/design.ert"]:
    to_the_queue(CONFIGURATIONS / name)
print(f"ERT's queue: {QUEUE}")
coastal()
limit_of_time()
print("design: a matrix, steps from files")
design(CONFIGURATIONS / "design")
with_plugin()
if wrong:
    sys.exit(f"{len(wrong)} wrong")

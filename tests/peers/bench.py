"""The same bodies through our two engines and through other programs: script/bench-peers makes what this needs.

    script/bench-peers                              all programs, all models at all sizes: up to three hours
    script/bench-peers --models channel-belt --counts 5,20 --runs 3     small belts alone, in minutes
    script/bench-peers --models parasequence,coastal --only gmsh,partition
    script/bench-peers --write docs/benchmarks.md

Every run is a process of its own, one after another. A program that exceeds the limit is not given the model at a larger size.
"""

import argparse
import json
import os
import resource
import shlex
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import report

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
# The last is the parasequence again, small, with other seeds.
MODELS = ["channel-belt", "parasequence", "coastal", "parasequence-seeds"]
# Distance between clinoforms of the parasequence (m), which a size of it divides.
SPACING = (105, 390)
# What it is divided by with other seeds.
SPARSE = 0.75
# Script, and what its result is: a compound per body, or cells that tell nothing of their body.
PEERS = {
    "gmsh": ("gmsh_fragment.py", "cells"),
    "cadquery-imprint": ("cadquery_imprint.py", "cells"),
    "cadquery-cut": ("cadquery_cut.py", "parts"),
    "build123d-split": ("build123d_split.py", "cells"),
    "build123d-cut": ("build123d_cut.py", "parts"),
}
PROGRAMS = ["partition", "occt", *PEERS]
# Those that take open sheets; the others want closed bodies.
WITH_SHEETS = ["partition", "gmsh", "cadquery-imprint", "build123d-split"]
# A program that has run this long at a size is not run there again (s).
ENOUGH = 60.0


class Others:
    """How many processors other programs keep busy, from the system's counts less our own processes'."""

    def __init__(self):
        self.started = self.now()

    @staticmethod
    def now():
        ticks = [int(n) for n in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
        busy = (sum(ticks) - ticks[3] - ticks[4]) / 100
        own = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        return time.monotonic(), busy - sum(one.ru_utime + one.ru_stime for one in own)

    def processors(self):
        (t0, busy0), (t1, busy1) = self.started, self.now()
        return max(0.0, (busy1 - busy0) / max(t1 - t0, 1e-9))


def call(command, limit):
    """The last line of JSON, or why there is none."""
    others = Others()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return {"over": limit}
    if done.returncode == -signal.SIGALRM:
        return {"over": limit}
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode != 0 or not lines:
        words = (done.stderr.strip().splitlines() or [f"ended with {done.returncode}"])[-1]
        return {"failed": words[:200]}
    return json.loads(lines[-1]) | {"others": others.processors()}


def sizes(model, args):
    """What a model is made with, by its size: the number of channels, or what the distance of clinoforms is divided by; or
    by its seed."""
    if model == "channel-belt":
        return {count: [f"feature.channel.count={count}"] for count in sorted(args.counts)}
    if model == "coastal":
        return {1: []}
    low, high = SPACING
    spacing = lambda by: [f"feature.{one}.spacing={{ uniform = [{low / by}, {high / by}] }}" for one in ("lower", "upper")]
    if model == "parasequence-seeds":
        return {seed: [f"seed={seed}", *spacing(SPARSE)] for seed in sorted(args.seeds)}
    return {by: spacing(by) for by in sorted(args.denser)}


class Bench:
    """A model at one size."""

    def __init__(self, args, folder, examples, model, settings):
        self.args, self.folder, self.examples, self.settings = args, folder, examples, settings
        name = model.removesuffix("-seeds")
        self.model = ROOT / f"models/{name}/{name}.toml"
        self.bodies = folder / "bodies"
        told = subprocess.run(
            [examples / "bench_bodies", self.model, self.bodies, *settings], check=True, capture_output=True, text=True
        )
        self.given = json.loads(told.stdout)

    def run(self, program, result):
        if program not in PEERS:
            command = [self.examples / "bench_engine", self.model, program, result, *self.settings]
            return call(command, self.args.limit)
        command = [sys.executable, HERE / PEERS[program][0], self.bodies, result, str(self.args.limit)]
        # The clock's own limit ends it earlier; reading and writing are outside of the clock.
        told = call(command, 2 * self.args.limit + 60)
        return {"over": self.args.limit} if "over" in told else told

    def measure(self, program, result):
        kind = PEERS[program][1] if program in PEERS else "cells"
        owners = [self.examples / "bench_owners", self.model, *self.settings]
        return call([sys.executable, HERE / "measure.py", self.bodies, result, kind, *owners], self.args.measure_limit)

    def entry(self, program):
        """All that is known of a program at this size."""
        result = self.folder / f"{program}.brep"
        runs = []
        while len(runs) < self.args.runs and sum(run["seconds"] for run in runs) < ENOUGH:
            told = self.run(program, result)
            if "seconds" not in told:
                return told
            runs.append(told)
        entry = runs[0] | {
            "seconds": statistics.median(run["seconds"] for run in runs),
            "peak_mib": statistics.median(run["peak_mib"] for run in runs),
            "others": statistics.mean(run["others"] for run in runs),
            "runs": len(runs),
        }
        if "stages" in entry:
            stage = lambda name: statistics.median(run["stages"][name] for run in runs)
            entry["stages"] = {name: stage(name) for name in entry["stages"]}
        entry["measured"] = self.measure(program, result)
        result.unlink()
        return entry


def kept(path):
    """Results of an earlier, interrupted or smaller bench."""
    if path is None or not path.exists():
        return {}
    return {tuple(key): entry for *key, entry in json.loads(path.read_text())}


def command(arguments):
    """The command as others would repeat it: what is kept, and a note, are ours alone."""
    shown, rest = ["script/bench-peers"], iter(arguments)
    for argument in rest:
        if argument in ("--keep", "--note"):
            next(rest, None)
        else:
            shown.append(argument)
    return shlex.join(shown)


def race(model, args, examples, entries):
    """All programs with a model at all sizes, from small to large."""
    # From which size a program takes too long.
    over = {program: size for (one, size, program), entry in entries.items() if one == model and "over" in entry}
    for size, settings in sizes(model, args).items():
        with tempfile.TemporaryDirectory(prefix="clinothem-peers-") as folder:
            bench = Bench(args, Path(folder), examples, model, settings)
            able = WITH_SHEETS if bench.given["sheets"] else PROGRAMS
            for program in (one for one in able if one in args.only and (model, size, one) not in entries):
                hopeless = size > over.get(program, size) and model != "parasequence-seeds"
                entry = {"skipped": True} if hopeless else bench.entry(program)
                if "over" in entry:
                    over[program] = size
                entries[model, size, program] = entry | {"given": bench.given}
                if args.keep:
                    args.keep.write_text(json.dumps([[*key, entry] for key, entry in entries.items()]))
                brief = {key: entry[key] for key in entry if key not in ("volumes", "measured", "stages")}
                print(f"{model} {size:g} {program}: {brief}", file=sys.stderr, flush=True)


def main():
    parser = argparse.ArgumentParser(
        prog="script/bench-peers", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    words = lambda text: text.split(",")
    numbers = lambda kind: lambda text: [kind(one) for one in text.split(",")]
    parser.add_argument("--models", type=words, default=MODELS, help=", ".join(MODELS))
    parser.add_argument("--counts", type=numbers(int), default=[5, 20, 60, 200], help="channels of the belts")
    parser.add_argument(
        "--denser", type=numbers(float), default=[0.4, 1, 3, 10], help="how many times as many clinoforms parasequences have"
    )
    parser.add_argument("--seeds", type=numbers(int), default=list(range(1, 21)), help="of the small parasequences (default 1 to 20)")
    parser.add_argument("--runs", type=int, default=5, help="runs of each, fewer where they are slow (default 5); 0: none, tables of what is kept")
    parser.add_argument("--only", type=words, default=PROGRAMS, help=", ".join(PROGRAMS))
    parser.add_argument("--limit", type=float, default=600, help="seconds that a run may take (default 600)")
    parser.add_argument("--measure-limit", type=float, default=900, help="the same for measuring a result (default 900)")
    parser.add_argument("--keep", metavar="FILE", type=Path, help="keep all results in FILE, and do not repeat those in it")
    parser.add_argument("--write", metavar="FILE", help="write the tables as Markdown")
    parser.add_argument("--note", metavar="TEXT", help="a sentence for that file")
    args = parser.parse_args()
    for kind, asked, known in [("program", args.only, PROGRAMS), ("model", args.models, MODELS)]:
        unknown = [one for one in asked if one not in known]
        if unknown:
            parser.error(f"no {kind} {', '.join(unknown)}; there are {', '.join(known)}")
    examples = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release/examples"
    entries = kept(args.keep)
    for model in args.models if args.runs else []:
        race(model, args, examples, entries)
    text = report.text(entries, args, command(sys.argv[1:]))
    print(text)
    if args.write:
        Path(args.write).write_text(text)


main()

"""The same bodies through our two engines and through other programs: script/bench-peers makes what this needs.

    script/bench-peers                              all programs with 5, 20, 60 and 200 channels: up to two hours
    script/bench-peers --counts 5,20 --runs 3       small belts alone, in minutes
    script/bench-peers --only gmsh,partition
    script/bench-peers --write docs/benchmarks.md

Every run is a process of its own, one after another. A program that exceeds the limit is not given a larger belt.
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
MODEL = ROOT / "models/channel-belt/channel-belt.toml"
# Script, and what its result is: a compound per body, or cells that tell nothing of their body.
PEERS = {
    "gmsh": ("gmsh_fragment.py", "cells"),
    "cadquery-imprint": ("cadquery_imprint.py", "cells"),
    "cadquery-cut": ("cadquery_cut.py", "parts"),
    "build123d-split": ("build123d_split.py", "cells"),
    "build123d-cut": ("build123d_cut.py", "parts"),
}
PROGRAMS = ["partition", "occt", *PEERS]
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


class Bench:
    def __init__(self, args, folder, examples):
        self.args, self.folder, self.examples = args, folder, examples

    def run(self, program, count, bodies, result):
        if program not in PEERS:
            command = [self.examples / "bench_engine", MODEL, str(count), program, "1", result]
            return call(command, self.args.limit)
        command = [sys.executable, HERE / PEERS[program][0], bodies, result, str(self.args.limit)]
        # The clock's own limit ends it earlier; reading and writing are outside of the clock.
        told = call(command, 2 * self.args.limit + 60)
        return {"over": self.args.limit} if "over" in told else told

    def measure(self, program, bodies, result):
        kind = PEERS[program][1] if program in PEERS else "cells"
        return call([sys.executable, HERE / "measure.py", bodies, result, kind], self.args.measure_limit)

    def entry(self, program, count, bodies):
        """All that is known of a program at a size."""
        result = self.folder / f"{program}-{count}.brep"
        runs = []
        while len(runs) < self.args.runs and sum(run["seconds"] for run in runs) < ENOUGH:
            told = self.run(program, count, bodies, result)
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
        entry["measured"] = self.measure(program, bodies, result)
        result.unlink()
        return entry


def kept(path):
    """Results of an earlier, interrupted or smaller bench."""
    if path is None or not path.exists():
        return {}
    return {(program, count): entry for program, count, entry in json.loads(path.read_text())}


def command(arguments):
    """The command as others would repeat it: what is kept, and a note, are ours alone."""
    shown, rest = ["script/bench-peers"], iter(arguments)
    for argument in rest:
        if argument in ("--keep", "--note"):
            next(rest, None)
        else:
            shown.append(argument)
    return shlex.join(shown)


def main():
    parser = argparse.ArgumentParser(
        prog="script/bench-peers", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    numbers = lambda text: [int(one) for one in text.split(",")]
    parser.add_argument("--counts", type=numbers, default=[5, 20, 60, 200], help="channels of the belts")
    parser.add_argument("--runs", type=int, default=5, help="runs of each, fewer where they are slow (default 5); 0: none, tables of what is kept")
    parser.add_argument("--only", type=lambda text: text.split(","), default=PROGRAMS, help=", ".join(PROGRAMS))
    parser.add_argument("--limit", type=float, default=600, help="seconds that a run may take (default 600)")
    parser.add_argument("--measure-limit", type=float, default=900, help="the same for measuring a result (default 900)")
    parser.add_argument("--keep", metavar="FILE", type=Path, help="keep all results in FILE, and do not repeat those in it")
    parser.add_argument("--write", metavar="FILE", help="write the tables as Markdown")
    parser.add_argument("--note", metavar="TEXT", help="a sentence for that file")
    args = parser.parse_args()
    unknown = [one for one in args.only if one not in PROGRAMS]
    if unknown:
        parser.error(f"no program {', '.join(unknown)}; there are {', '.join(PROGRAMS)}")
    examples = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release/examples"
    entries = kept(args.keep)
    # From which number of channels a program takes too long.
    over = {program: count for (program, count), entry in entries.items() if "over" in entry}
    with tempfile.TemporaryDirectory(prefix="clinothem-peers-") as folder:
        bench = Bench(args, Path(folder), examples)
        for count in sorted(args.counts) if args.runs else []:
            programs = [one for one in PROGRAMS if one in args.only and (one, count) not in entries]
            bodies = Path(folder) / f"bodies-{count}"
            subprocess.run([examples / "bench_bodies", MODEL, str(count), bodies], check=True)
            for program in programs:
                hopeless = count > over.get(program, count)
                entry = {"skipped": True} if hopeless else bench.entry(program, count, bodies)
                if "over" in entry:
                    over[program] = count
                entries[program, count] = entry
                if args.keep:
                    args.keep.write_text(json.dumps([[*key, entry] for key, entry in entries.items()]))
                brief = {key: entry[key] for key in entry if key not in ("volumes", "measured", "stages")}
                print(f"{count} {program}: {brief}", file=sys.stderr, flush=True)
    text = report.text(entries, args, command(sys.argv[1:]))
    print(text)
    if args.write:
        Path(args.write).write_text(text)


main()

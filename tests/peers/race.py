"""What the programs of this folder have in common: bodies in, a clock, solids out.

Each is called as `PROGRAM FOLDER RESULT LIMIT`: it reads the bodies of FOLDER (see examples/bench_bodies.rs), starts the
clock, makes solids, stops the clock, prints one line of JSON and writes RESULT as BREP. A run that takes longer than LIMIT
seconds is ended by SIGALRM, which needs no help from the interpreter.
"""

import json
import os
import signal
import sys
import time
from pathlib import Path


def memory(key):
    """A figure of this process from the system, in MiB."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(key + ":"):
            return int(line.split()[1]) / 1024
    return None


def run(read, work, write, version, after=None):
    """Times `work(block, bodies)`, bodies from oldest to youngest; `after` belongs to neither time nor memory."""
    folder, result, limit = Path(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3])
    # File names sort from the block and the oldest body to the youngest.
    block, *bodies = [read(str(path)) for path in sorted(folder.glob("*.brep"))]
    before = memory("VmRSS")
    signal.setitimer(signal.ITIMER_REAL, limit)
    started = time.perf_counter()
    made = work(block, bodies)
    seconds = time.perf_counter() - started
    signal.setitimer(signal.ITIMER_REAL, 0)
    told = {"seconds": seconds, "peak_mib": memory("VmHWM"), "before_mib": before, "version": version}
    write(made, str(result))
    print(json.dumps(told), flush=True)
    # Not all bindings can be unloaded without harm.
    os._exit(0)


def apart(a, b):
    """Whether two boxes ((low), (high)) have nothing in common."""
    return any(a[1][i] < b[0][i] or b[1][i] < a[0][i] for i in range(3))

"""The tables of docs/benchmarks.md."""

import math
import os
import platform
from pathlib import Path

NAMES = {
    "partition": "**clinothem, partition**",
    "occt": "clinothem, `--engine occt`",
    "gmsh": "Gmsh `occ.fragment`",
    "cadquery-imprint": "cadquery `imprint`",
    "cadquery-cut": "cadquery `cut`",
    "build123d-split": "build123d `split`",
    "build123d-cut": "build123d `-`",
}
# A volume of which a program has less than half is missing; one that is off by more than this share and this much (m³,
# what the integrals of a small volume far from the middle of the block may miss) is wrong.
HALF, WRONG, LITRE = 0.5, 1e-6, 1e-3
ABOUT = {
    "channel-belt": """The bodies are those of [models/channel-belt](../models/channel-belt), with more or fewer channels: a block of
1000 × 1000 × 60 m and crossing channels, of which the younger removes the older.""",
    "parasequence": """The surfaces are those of [models/parasequence](../models/parasequence), with clinoforms nearer to each other or
farther apart: a block of 366 × 671 × 21 m, a flooding surface in it, and below and above that a set of clinoforms, tangent to
their base, with facies boundaries between them. Every surface is an open sheet, untrimmed, as the partition gets it too: it
reaches out of the block, or beyond what it ends at.""",
    "coastal": """The bodies and surfaces are those of [models/coastal](../models/coastal): a block of 366 × 671 × 52 m, crossing channels
in its lower part, and above them the two sets of clinoforms of the parasequence. Channels are closed bodies, the rest is open
sheets.""",
    "parasequence-seeds": """The parasequence with other seeds, and clinoforms somewhat farther apart. By program: seconds, and, where not all
volumes are right, how many are missing or wrong. At the end, in how many of the models a program got all volumes right.
A wedge at a tangent toe that goes to the volume below its base is valid, and the sum of all solids does not miss it.""",
}


def machine():
    """The kind of machine, without its name."""
    model = "processor unknown"
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    try:
        system = platform.freedesktop_os_release()["PRETTY_NAME"]
    except OSError:
        system = platform.system()
    return f"{model}, {os.cpu_count()} processors, {memory:.0f} GiB, {system}"


def seconds(value):
    return f"{value:.3f}" if value < 1 else f"{value:.2f}" if value < 100 else f"{value:.0f}"


def table(head, rows):
    lines = ["| " + " | ".join(row) + " |" for row in [head, *rows]]
    lines.insert(1, "|---" + "|--:" * (len(head) - 1) + "|")
    return "\n".join(lines)


def losses(measured, reference):
    """Volumes that are missing, and those that are wrong, against our report's."""
    missing, wrong = [], []
    for name, volume in reference.items():
        found = measured["volumes"].get(name, 0.0)
        if found < HALF * volume:
            missing.append(name)
        elif abs(found - volume) > max(WRONG * volume, LITRE):
            wrong.append(name)
    # What has no place at all.
    wrong += [name for name, found in measured["volumes"].items() if name not in reference and found > LITRE]
    return missing, wrong


def off(measured, reference):
    """Which volumes are missing or wrong, and by how much, in one line if there are any."""
    missing, wrong = losses(measured, reference)
    miss = lambda name: measured["volumes"].get(name, 0.0) - reference.get(name, 0.0)
    words = [f"{name} ({miss(name):+.3g} m³)" for name in missing + wrong]
    return [", ".join(words[:12]) + (f" and {len(words) - 12} more" if len(words) > 12 else "")] if words else []


def row(program, entry, ours, reference):
    cells = [NAMES[program]]
    if "skipped" in entry:
        return cells + ["not run", *[""] * 8]
    if "over" in entry:
        ratio = f"> {entry['over'] / ours:.0f}" if ours else ""
        return cells + [f"> {entry['over']:g}", ratio, *[""] * 7]
    if "failed" in entry:
        return cells + ["failed", *[""] * 8]
    ratio = f"{entry['seconds'] / ours:.1f}" if ours else ""
    before = f" ({entry['before_mib']:.0f})" if "before_mib" in entry else ""
    cells += [seconds(entry["seconds"]), ratio, str(entry["runs"]), f"{entry['peak_mib']:.0f}{before}"]
    measured = entry["measured"]
    if "solids" not in measured:
        solids = [str(entry.get("solids", "")), f"{entry['volume_error']:.0e} *" if "volume_error" in entry else ""]
        return cells + [*solids, "not measured", "", ""]
    cells += [str(measured["solids"]), f"{measured['volume_error']:.0e}", str(measured["shared_faces"])]
    if not reference:
        return [*cells, "", ""]
    missing, wrong = losses(measured, reference)
    return [*cells, str(len(missing)), str(len(wrong))]


HEAD = ["", "seconds", "÷ partition", "runs", "peak MiB", "solids", "volume error m³", "shared faces", "missing", "wrong"]


def given(entries, model, size):
    """What programs get, in words."""
    told = next(entry["given"] for (*key, _), entry in entries.items() if key == [model, size])
    count = lambda number, noun: f"{number} {noun}{'s' if number != 1 else ''}" if number else ""
    return " and ".join(filter(None, [count(told["solids"], "channel"), count(told["sheets"], "sheet")]))


def of_size(entries, model, size):
    ours = entries.get((model, size, "partition"), {})
    reference = ours.get("volumes")
    rows, details = [], []
    for program in NAMES:
        entry = entries.get((model, size, program))
        if entry is None:
            continue
        rows.append(row(program, entry, ours.get("seconds"), reference))
        if "failed" in entry:
            details.append(f"{NAMES[program]} failed: `{entry['failed']}`")
        measured = entry.get("measured", {})
        if "failed" in measured:
            details.append(f"{NAMES[program]} was not measured: `{measured['failed']}`")
        if reference and "volumes" in measured:
            details += [f"{NAMES[program]}, missing or wrong: {one}" for one in off(measured, reference)]
    lines = [f"### {given(entries, model, size)}", "", table(HEAD, rows), ""]
    if "edges" in ours:
        lines += [
            f"{ours['crossing_pairs']} pairs of bodies cross; the partition made {ours['solids']} solids, {ours['faces']} faces "
            f"and {ours['edges']} edges, with {ours['failed_attempts']} failed attempts, and "
            f"{'proved' if ours['proven'] else 'did not prove'} them; its own integrals miss the block by "
            f"{abs(ours['volume_error']):.0e} m³.",
            "",
        ]
    lines += [f"- {detail}" for detail in details] + ([""] if details else [])
    return lines


def verdict(entry, reference):
    """Seconds, and what went wrong, in a few words; and whether nothing did."""
    if entry is None:
        return "", False
    if "over" in entry:
        return f"> {entry['over']:g}", False
    if "failed" in entry or "volumes" not in entry.get("measured", {}):
        return "failed", False
    missing, wrong = losses(entry["measured"], reference or {})
    counts = [f"**{len(names)} {word}**" for names, word in ((missing, "missing"), (wrong, "wrong")) if names]
    return ", ".join([seconds(entry["seconds"]), *counts]), not counts


def of_seeds(entries, seeds):
    """A line per seed, all programs side by side."""
    model = "parasequence-seeds"
    programs = [one for one in NAMES if any((model, seed, one) in entries for seed in seeds)]
    right, rows, details = dict.fromkeys(programs, 0), [], []
    for seed in seeds:
        ours = entries.get((model, seed, "partition"), {})
        reference = ours.get("volumes")
        cells = [str(seed), given(entries, model, seed).split()[0], str(ours.get("solids", ""))]
        for program in programs:
            entry = entries.get((model, seed, program))
            words, well = verdict(entry, reference)
            cells.append(words)
            right[program] += well
            if reference and entry and "volumes" in entry.get("measured", {}):
                details += [f"seed {seed}, {NAMES[program]}: {one}" for one in off(entry["measured"], reference)]
        rows.append(cells)
    rows.append(["all right", "", "", *(f"{right[one]} of {len(seeds)}" for one in programs)])
    head = ["seed", "sheets", "our solids", *(NAMES[one] for one in programs)]
    return [table(head, rows), "", *(f"- {detail}" for detail in details), ""]


def exponent(points):
    """The slope of log seconds over log channels."""
    if len(points) < 2:
        return None
    x, y = [math.log(n) for n, _ in points], [math.log(t) for _, t in points]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def growth(entries, model, sizes):
    """How time grows with the number of bodies and sheets."""
    number = {size: sum(next(e["given"] for (*k, _), e in entries.items() if k == [model, size]).values()) for size in sizes}
    noun = "channels" if model == "channel-belt" else "sheets"
    rows = []
    for program in NAMES:
        timed = [size for size in sizes if "seconds" in entries.get((model, size, program), {})]
        points = [(number[size], entries[model, size, program]["seconds"]) for size in timed]
        slope = exponent(points)
        if slope is not None:
            last = exponent(points[-2:])
            rows.append([NAMES[program], f"{points[0][0]} to {points[-1][0]}", f"{slope:.2f}", f"{last:.2f}"])
    if not rows:
        return []
    head = ["", noun, "exponent", "between the last two sizes"]
    lines = ["### Growth", "", f"Time grows with the number of {noun} to the power of", "", table(head, rows), ""]
    per_edge = []
    for size in sizes:
        entry = entries.get((model, size, "partition"), {})
        if "edges" in entry:
            micros = lambda seconds: f"{1e6 * seconds / entry['edges']:.0f}"
            shares = [micros(seconds) for seconds in (entry["seconds"], *(entry["stages"][s] for s in ("assembly", "proof")))]
            per_edge.append([str(number[size]), str(entry["crossing_pairs"]), str(entry["edges"]), *shares])
    head = [noun, "crossing pairs", "edges made", "µs per edge", "of them assembly", "of them proof"]
    return lines + (["The partition's time per edge that it makes:", "", table(head, per_edge), ""] if per_edge else [])


def busy(entries):
    others = [entry["others"] for entry in entries.values() if "others" in entry]
    if not others:
        return ""
    mean = sum(others) / len(others)
    return (
        f"During the runs other programs kept {mean:.1f} of {os.cpu_count()} processors busy on average "
        f"({min(others):.1f} to {max(others):.1f})."
    )


def text(entries, args, command):
    models = [model for model in ABOUT if any(key[0] == model for key in entries)]
    versions = sorted({entry["version"] for entry in entries.values() if "version" in entry})
    lines = [
        "# The same bodies in other programs",
        "",
        f"Made by `{command}` on",
        f"{machine()}, with",
        f"{', '.join(versions)}.",
        busy(entries),
        *([args.note] if args.note else []),
        "",
        "Every program makes of the same block, closed bodies and open sheets solids that fill the block.",
        "",
        "- *seconds*: wall clock, medians. Ours runs from control nets to **proven** solids in memory (the plan, the point",
        "  evaluator, the assembly, the fast proof); theirs from solids in memory (read from BREP before) to solids in memory,",
        "  unproven. Fragments and cells are not yet merged or assigned to bodies.",
        f"- A run may take {args.limit:g} s, if the table does not say otherwise. A program that exceeds its limit is not run",
        "  with the model at a larger size.",
        "- *peak MiB*: of the process; in brackets what it had when the clock started, libraries and bodies included. Our",
        "  general fuse runs in the same process here, in a child process otherwise.",
        "- *solids*: inside of the block. Those of `fragment`, `imprint` and `split` are cells, of which a body has many.",
        "- *volume error*: the sum of all solids less the block, measured for all alike by OpenCASCADE's integrals (eps 1e-8 per",
        "  face) on the solids written as BREP, and so no better than these integrals. `*`: our own integrals.",
        "- *shared faces*: one face in two solids, which a mesh needs in order to fit. A cut shares only what it",
        "  did not split.",
        f"- *missing*: volumes of which less than half is there; *wrong*: volumes off by more than {WRONG:.0e} of their size and by",
        "  more than a litre. Both against the volumes of our report. A cell belongs to the volume that our point evaluator, which",
        "  knows no solids, says of points just inside of it; however many cells a volume is cut into, their sum counts.",
        "",
        "What runs in parallel: the partition and the proof (our own threads); in both of our engines, `fragment` (with",
        "`Geometry.OCCParallel`) and `imprint`, the parts of OpenCASCADE's general fuse that it makes in parallel; within a",
        "single `cut`, the same. One cut after another is serial, and `split` of build123d is serial throughout. `imprint` is",
        "called with `glue=None`: its default is for shapes that only touch. build123d has no general fuse that keeps cells,",
        "so its block is split by one shell or side after another.",
        "",
        "Where there are open sheets, only what takes them is compared. Cuts want closed bodies; our own general fuse, which closes them itself, is left out.",
        "",
    ]
    for model in models:
        sizes = sorted({key[1] for key in entries if key[0] == model})
        lines += [f"## {model}", "", ABOUT[model], ""]
        if model == "parasequence-seeds":
            lines += of_seeds(entries, sizes)
            continue
        for size in sizes:
            lines += of_size(entries, model, size)
        lines += growth(entries, model, sizes)
    return "\n".join(lines).rstrip() + "\n"

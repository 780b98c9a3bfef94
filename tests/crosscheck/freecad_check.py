"""FreeCAD opens the assembly: names, tree, number of solids, validity, volumes in millimetres; with the GUI, colours and a picture.

Run by FreeCAD itself through script/crosscheck-freecad. CLINOTHEM_BUILDS holds the folders of builds, separated by colons;
CLINOTHEM_PICTURES the folder for pictures. Exit code 0 if everything agrees, 1 if something differs, 2 if the check itself failed.
"""

import json
import os
import pathlib
import sys
import time
import traceback

import FreeCAD

MM = 1000.0
# FreeCAD integrates volumes with a fixed number of points: up to 8e-4 off for a solid of ours, 6e-5 for their sum.
ROUGH, ROUGH_SUM = 1e-3, 1e-4
# For models with ellipsoids, whose rational surfaces these points fit worse, with horizons, and with a curved base or top: there the kernel's
# integrals to a given error agree with the report to 1e-8.
ROUGH_ROUND, ROUGH_SUM_ROUND = 3e-3, 3e-4


class Findings:
    """Sentences that turned out to be false."""

    def __init__(self):
        self.checks = 0
        self.wrong = []

    def expect(self, holds, sentence):
        self.checks += 1
        if not holds:
            self.wrong.append(sentence)


def parts_of(document):
    """The imported shapes by label; App::Part objects are the tree above them."""
    return {o.Label: o for o in document.Objects if o.TypeId == "Part::Feature"}


def path_of(part):
    """Labels of the groups above a part, the nearest last."""
    above = [o for o in part.InList if o.TypeId == "App::Part"]
    return [*path_of(above[0]), above[0].Label] if above else []


def check_names(volumes, parts, found):
    """A part is a volume, or a piece of one that has several: the parts by volume."""
    pieces = {s["name"]: name for name, v in volumes.items() for s in v["solids"]}
    by_volume = {name: [] for name in volumes}
    for label, part in parts.items():
        name = label if label in volumes else pieces.get(label)
        found.expect(name is not None, f"there is a part named {label}")
        if name is not None:
            by_volume[name].append(part)
    for name, own in by_volume.items():
        labels = sorted(part.Label for part in own)
        wanted = sorted(s["name"] for s in volumes[name]["solids"])
        found.expect(labels in ([name], wanted), f"the parts of {name} are {labels}, not {wanted}")
    return by_volume


def check_tree(report, volumes, by_volume, found):
    features = [v["feature"] for v in volumes.values()]
    for name, own in by_volume.items():
        volume = volumes[name]
        if volume["parent"] is None:
            alone = features.count(volume["feature"]) == 1
            wanted = [name, f"{name} with children"] if alone else [volume["feature"]]
            for part in own:
                path = [*path_of(part), part.Label]
                holds = path[0] == report["model"]["name"] and path[1] in wanted
                found.expect(holds, f"{part.Label} is {path}, not below {wanted} of the model")


def is_block(domain):
    """Whether the domain has no base or top of its own, which lie somewhere within the block."""
    sides = [domain[axis][1] - domain[axis][0] for axis in "xyz"]
    return abs(domain["volume_m3"] / (sides[0] * sides[1] * sides[2]) - 1) < 1e-9


def check_shapes(report, volumes, by_volume, found):
    domain = report["domain"]
    curved = any(v["kind"] in ("ellipsoid", "horizon") for v in volumes.values()) or not is_block(domain)
    rough = ROUGH_ROUND if curved else ROUGH
    total, count, worst = 0.0, 0, 0.0
    corners = []
    for name, own in by_volume.items():
        promised = volumes[name]["solids"]
        for part in own:
            found.expect(part.Shape.isValid(), f"{part.Label} is not valid")
            found.expect(all(s.isClosed() for s in part.Shape.Shells), f"{part.Label} has an open shell")
            corners.extend(v.Point for v in part.Shape.Vertexes)
        sizes = sorted(s.Volume / MM**3 for part in own for s in part.Shape.Solids)
        found.expect(len(sizes) == len(promised), f"{name} has {len(sizes)} solids, not {len(promised)}")
        for size, told in zip(sizes, sorted(s["volume_m3"] for s in promised)):
            # A tiny piece is known no better than its boundary: ten litres.
            found.expect(abs(size - told) <= max(rough * told, 0.01), f"a solid of {name} has {size} m³, not {told}")
            worst = max(worst, abs(size / told - 1))
        total += sum(sizes)
        count += len(sizes)
    rough_sum = ROUGH_SUM if is_block(domain) else ROUGH_SUM_ROUND
    found.expect(abs(total / domain["volume_m3"] - 1) <= rough_sum, f"all solids have {total} m³, not {domain['volume_m3']}")
    for i, axis in enumerate("xyz"):
        span = [min(c[i] for c in corners), max(c[i] for c in corners)]
        wanted = [MM * x for x in domain[axis]]
        slack = MM * report["assembly"]["tolerance_m"]
        if axis == "z" and not is_block(domain):
            fits = wanted[0] - slack <= span[0] and span[1] <= wanted[1] + slack
        else:
            fits = all(abs(a - b) <= slack for a, b in zip(span, wanted))
        found.expect(fits, f"{axis} runs over {span} mm, not {wanted}")
    return count, worst, abs(total / domain["volume_m3"] - 1)


def check_colors(volumes, by_volume, found):
    for name, own in by_volume.items():
        wanted = tuple(bytes.fromhex(volumes[name]["color"].lstrip("#")))
        for part in own:
            # One colour, or one for each face.
            seen = {tuple(round(255 * c) for c in color[:3]) for color in part.ViewObject.DiffuseColor}
            found.expect(seen == {wanted}, f"{part.Label} is coloured {sorted(seen)}, not {wanted}")


def save_picture(stem, folder, background):
    """An isometric view, the background as glass, because the bodies are inside it."""
    import FreeCADGui

    for part in background:
        part.ViewObject.Transparency = 85
    view = FreeCADGui.activeDocument().activeView()
    view.setCameraType("Orthographic")
    view.viewIsometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    path = pathlib.Path(folder) / f"{stem}.png"
    view.saveImage(str(path), 1024, 768, "White")
    if not path.is_file() or path.stat().st_size == 0:
        raise OSError(f"FreeCAD saved no picture to {path}")
    print(f"  picture: {path}")


def check_build(folder, found):
    report = json.loads((folder / "report.json").read_text())
    volumes = {v["name"]: v for v in report["volumes"] if v["solids"]}
    (step,) = (path for path in folder.glob("*.step") if not path.name.endswith(".shared.step"))
    started = time.time()
    document = FreeCAD.newDocument(step.stem.replace("-", "_"))
    # With its default arguments FreeCAD 0.20 crashes on files of several parts.
    if FreeCAD.GuiUp:
        import ImportGui

        ImportGui.insert(str(step), document.Name, useLinkGroup=False)
    else:
        import Import

        Import.insert(str(step), document.Name, useLinkGroup=False)
    seconds = time.time() - started
    parts = parts_of(document)
    by_volume = check_names(volumes, parts, found)
    check_tree(report, volumes, by_volume, found)
    count, worst, worst_sum = check_shapes(report, volumes, by_volume, found)
    print(
        f"{step.name}: read in {seconds:.1f} s; {len(parts)} parts, {count} solids; "
        f"volumes off by at most {worst:.1e}, their sum by {worst_sum:.1e}"
    )
    if FreeCAD.GuiUp:
        check_colors(volumes, by_volume, found)
        background = [part for name, own in by_volume.items() if volumes[name]["kind"] == "background" for part in own]
        save_picture(step.stem, os.environ["CLINOTHEM_PICTURES"], background)


def main():
    found = Findings()
    builds = [pathlib.Path(folder) for folder in os.environ["CLINOTHEM_BUILDS"].split(":")]
    for folder in builds:
        before = len(found.wrong)
        check_build(folder, found)
        for sentence in found.wrong[before:]:
            print(f"  WRONG: {sentence}")
    version = ".".join(FreeCAD.Version()[:3])
    print(f"FreeCAD {version}: {found.checks - len(found.wrong)} of {found.checks} checks hold in {len(builds)} models")
    return 1 if found.wrong else 0


try:
    code = main()
except BaseException:  # noqa: BLE001 - whatever it is, FreeCAD would swallow it
    traceback.print_exc(file=sys.stdout)
    code = 2
sys.stdout.flush()
# FreeCAD would stay and wait for commands.
os._exit(code)

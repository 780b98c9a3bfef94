"""build123d: the block is split by one body after another (`split`, `Keep.ALL`): by its shell, or by the sheets
of a side. It has no general fuse that keeps cells: `fuse` keeps the outside only. Splits run one after another and serially,
as build123d calls them. Cells with boxes apart from the body are not split."""

from importlib.metadata import version

import race
from build123d import Compound, Keep, export_brep, import_brep

VERSION = f"build123d {version('build123d')} on OpenCASCADE {version('cadquery-ocp')}"


def box(shape):
    found = shape.bounding_box(optimal=False)
    return tuple(found.min), tuple(found.max)


def work(block, bodies):
    cells = [(block, box(block))]
    for body in bodies:
        limits, tool, left = box(body), body.shell() if body.solids() else body, []
        for cell, around in cells:
            if race.apart(around, limits):
                left.append((cell, around))
            else:
                left += [(one, box(one)) for one in cell.split(tool, Keep.ALL)]
        cells = left
    return [cell for cell, _ in cells]


def write(cells, path):
    export_brep(Compound(cells), path)


race.run(import_brep, work, write, VERSION)

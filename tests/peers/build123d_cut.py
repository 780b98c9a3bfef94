"""build123d: each body, cut to the block, is cut from all older ones and the block. Cuts run one after another; inside of
one, OpenCASCADE's parallel mode is on, and the result is cleaned (build123d's defaults). Solids with boxes apart are not cut
from each other."""

from importlib.metadata import version

import race
from build123d import Compound, export_brep, import_brep

VERSION = f"build123d {version('build123d')} on OpenCASCADE {version('cadquery-ocp')}"


def boxed(shape):
    """What an operation gives (a solid, several, or none), each with its box."""
    solids = shape.solids() if shape is not None else []
    boxes = [solid.bounding_box(optimal=False) for solid in solids]
    return [(solid, (tuple(box.min), tuple(box.max))) for solid, box in zip(solids, boxes)]


def without(part, body, limits):
    """A part's solids less a body. A remainder keeps the box of what it was cut from."""
    left = []
    for solid, box in part:
        if race.apart(box, limits):
            left.append((solid, box))
        else:
            left += [(one, box) for one in (solid - body).solids()]
    return left


def work(block, bodies):
    parts = [boxed(block)]
    for body in bodies:
        inside = boxed(body & block)
        for piece, limits in inside:
            parts = [without(part, piece, limits) for part in parts]
        parts.append(inside)
    return parts


def write(parts, path):
    # A compound per volume, in order: who has lost everything has an empty one.
    export_brep(Compound([Compound([solid for solid, _ in part]) for part in parts]), path)


race.run(import_brep, work, write, VERSION)

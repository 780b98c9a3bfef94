"""cadquery: each body, cut to the block, is cut from all older ones and the block. Cuts run one after another; inside of
one, OpenCASCADE's parallel mode is on (cadquery's default). Bodies with boxes apart are not cut from each other."""

from importlib.metadata import version

import race
from cadquery import Compound, Shape

VERSION = f"cadquery {version('cadquery')} on OpenCASCADE {version('cadquery-ocp')}"


def box(shape):
    found = shape.BoundingBox()
    return (found.xmin, found.ymin, found.zmin), (found.xmax, found.ymax, found.zmax)


def work(block, bodies):
    parts, boxes = [block], [box(block)]
    for body in bodies:
        body = body.intersect(block)
        limits = box(body)
        for i, part in enumerate(parts):
            # A part that is gone holds nothing more.
            if part.Solids() and not race.apart(boxes[i], limits):
                parts[i] = part.cut(body)
        parts.append(body)
        boxes.append(limits)
    return parts


def write(parts, path):
    # A compound per volume, in order: who has lost everything has an empty one.
    Compound.makeCompound([Compound.makeCompound(part.Solids()) for part in parts]).exportBrep(path)


race.run(Shape.importBrep, work, write, VERSION)

"""cadquery: one general fuse of the block, all bodies and the sheets of all sides (`imprint`), parallel inside
of OpenCASCADE. Its default, full glue, is for shapes that only touch and leaves crossing ones as they are: it is turned off."""

from importlib.metadata import version

import race
from cadquery import Shape
from cadquery.occ_impl.shapes import imprint

VERSION = f"cadquery {version('cadquery')} on OpenCASCADE {version('cadquery-ocp')}"


def work(block, bodies):
    # What lies outside of the block is still among the cells; those who count them leave it out.
    return imprint(block, *[shape for body in bodies for shape in body.Solids() or body.Faces()], glue=None)


race.run(
    Shape.importBrep,
    work,
    lambda cells, path: cells.exportBrep(path),
    VERSION,
)

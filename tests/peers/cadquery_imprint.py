"""cadquery: one general fuse of the block and all bodies (`imprint`), parallel inside of OpenCASCADE. Its default, full
glue, is for shapes that only touch and leaves crossing ones as they are: it is turned off."""

import importlib.metadata

import race
from cadquery import Shape
from cadquery.occ_impl.shapes import imprint


def work(block, bodies):
    # What lies outside of the block is still among the cells; those who count them leave it out.
    return imprint(block, *bodies, glue=None)


race.run(
    Shape.importBrep,
    work,
    lambda cells, path: cells.exportBrep(path),
    f"cadquery {importlib.metadata.version('cadquery')}",
)

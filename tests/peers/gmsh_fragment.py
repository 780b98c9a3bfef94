"""Gmsh: one general fuse of the block, all bodies and the sheets of all sides. Parallel where OpenCASCADE's fuse is
(Geometry.OCCParallel)."""

import re

import gmsh
import race

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("Geometry.OCCParallel", 1)

KERNEL = re.search(r"OCC version: ([\d.]+)", gmsh.option.getString("General.BuildInfo"))
VERSION = f"Gmsh {gmsh.__version__} on OpenCASCADE {KERNEL[1] if KERNEL else '?'}"


def read(path):
    # A solid, or the faces of a side.
    return gmsh.model.occ.importShapes(path)


def work(block, bodies):
    _, images = gmsh.model.occ.fragment(block, [shape for body in bodies for shape in body])
    # What lies outside of the block is in no image of it. Faces stay: those inside belong to the cells beside them.
    inside = set(images[0])
    outside = {cell for image in images[1:] for cell in image if cell[0] == 3} - inside
    gmsh.model.occ.remove(sorted(outside))


def write(_, path):
    gmsh.model.occ.synchronize()
    gmsh.write(path)


race.run(read, work, write, VERSION)

"""Gmsh: one general fuse of the block and all bodies. Parallel where OpenCASCADE's fuse is (Geometry.OCCParallel)."""

import re

import gmsh
import race

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("Geometry.OCCParallel", 1)

KERNEL = re.search(r"OCC version: ([\d.]+)", gmsh.option.getString("General.BuildInfo"))
VERSION = f"Gmsh {gmsh.__version__} on OpenCASCADE {KERNEL[1] if KERNEL else '?'}"


def read(path):
    (solid,) = gmsh.model.occ.importShapes(path)
    return solid


def work(block, bodies):
    _, images = gmsh.model.occ.fragment([block], bodies)
    # What lies outside of the block is in no image of it.
    inside = set(images[0])
    outside = {cell for image in images[1:] for cell in image} - inside
    gmsh.model.occ.remove(sorted(outside))


def write(_, path):
    gmsh.model.occ.synchronize()
    gmsh.write(path)


race.run(read, work, write, VERSION)

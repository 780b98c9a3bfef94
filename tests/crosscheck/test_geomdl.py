"""Random rational curves and surfaces against geomdl, an independent NURBS library in Python.

Points agree to 1e-12 of the control net's size (the diagonal of its box), derivatives to 1e-9 of the larger of that
size and their own. Run from the repository: pytest tests/crosscheck/test_geomdl.py
"""

import json
import pathlib
import subprocess

import numpy as np
import pytest
from geomdl import NURBS

ROOT = pathlib.Path(__file__).resolve().parents[2]
COUNT = 100


@pytest.fixture(scope="module")
def samples():
    command = ["cargo", "run", "--quiet", "--no-default-features", "--example", "nurbs_samples", "--", str(COUNT)]
    return json.loads(subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout)


def weighted(net):
    return [[x * w, y * w, z * w, w] for (x, y, z), w in zip(net["points"], net["weights"])]


def size(net):
    points = np.array(net["points"])
    return np.linalg.norm(points.max(axis=0) - points.min(axis=0))


def agree(ours, theirs, tolerance):
    assert np.abs(np.array(ours) - np.array(theirs)).max() <= tolerance, (ours, theirs)


def agree_derivatives(ours, theirs, scale):
    agree(ours, theirs, 1e-9 * max(scale, np.linalg.norm(theirs)))


def test_points_and_derivatives_of_rational_curves(samples):
    assert len(samples["curves"]) == COUNT
    for net in samples["curves"]:
        curve = NURBS.Curve(normalize_kv=False)
        curve.degree = net["degree"]
        curve.ctrlptsw = weighted(net)
        curve.knotvector = net["knots"]
        for sample in net["samples"]:
            agree(sample["point"], curve.evaluate_single(sample["u"]), 1e-12 * size(net))
            for ours, theirs in zip(sample["derivatives"], curve.derivatives(sample["u"], 3), strict=True):
                agree_derivatives(ours, theirs, size(net))


def test_points_and_derivatives_of_rational_surfaces(samples):
    assert len(samples["surfaces"]) == COUNT
    for net in samples["surfaces"]:
        surface = NURBS.Surface(normalize_kv=False)
        surface.degree_u, surface.degree_v = net["degrees"]
        counts = [len(knots) - degree - 1 for knots, degree in zip(net["knots"], net["degrees"])]
        surface.set_ctrlpts(weighted(net), *counts)
        surface.knotvector_u, surface.knotvector_v = net["knots"]
        for sample in net["samples"]:
            u, v = sample["u"], sample["v"]
            agree(sample["point"], surface.evaluate_single((u, v)), 1e-12 * size(net))
            theirs = surface.derivatives(u, v, 2)
            for k, row in enumerate(sample["derivatives"]):
                assert len(row) == 3 - k
                for l, ours in enumerate(row):
                    agree_derivatives(ours, theirs[k][l], size(net))

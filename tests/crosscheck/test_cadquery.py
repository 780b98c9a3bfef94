"""cadquery opens the assembly: names, colours, valid solids, volumes, in metres or millimetres as asked."""

from collections import Counter

import cadquery as cq
import pytest
from conftest import FINE, FINE_SUM
from OCP.Interface import Interface_Static


@pytest.fixture(scope="module")
def parts(build):
    """Objects of the tree by name, in metres."""
    assembly = cq.Assembly.importStep(str(build.step), "M")
    # It sets the unit for everything that reads STEP in this process.
    assert Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
    return [(node.name, node) for _, node in assembly.traverse() if node.obj is not None]


def solids(node):
    return [solid for shape in node.shapes for solid in shape.Solids()]


def test_each_volume_has_its_name_and_number_of_solids(build, parts):
    assert build.are_parts([name for name, _ in parts])
    found = Counter()
    for name, node in parts:
        found[build.volume_of(name).name] += len(solids(node))
    assert found == {v.name: len(v.solids) for v in build.volumes.values()}


def test_each_volume_has_the_colour_of_its_facies(build, parts):
    seen = {name: node.color and tuple(round(255 * c) for c in node.color.toTuple()[:3]) for name, node in parts}
    assert seen == {name: build.volume_of(name).color for name in seen}


def test_every_solid_is_valid(parts):
    for name, node in parts:
        assert all(solid.isValid() for solid in solids(node)), name


def test_volumes_agree_with_the_report(build, parts):
    found = {name: [] for name in build.volumes}
    for name, node in parts:
        found[build.volume_of(name).name] += solids(node)
    total = 0.0
    for name, own in found.items():
        own.sort(key=lambda solid: solid.Volume())
        for solid, told in zip(own, sorted(build.volumes[name].solids), strict=True):
            size = build.fine_volume(solid, told, solid.Area())
            assert build.same_volume(size, told, FINE, solid.Area()), (name, size, told)
            total += size
    assert total == pytest.approx(build.domain["volume_m3"], rel=FINE_SUM)


def test_asked_for_millimetres_the_model_is_a_thousand_times_as_long(build):
    if build.stem != "quickstart":
        pytest.skip("one small model shows it")
    shape = cq.importers.importStep(str(build.step)).val()
    for axis in "xyz":
        places = [getattr(v.Center(), axis) for v in shape.Vertices()]
        assert [min(places), max(places)] == pytest.approx([1000 * x for x in build.domain[axis]], abs=1000 * build.tolerance)

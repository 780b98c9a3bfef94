"""Wells: places along random surveys against welleng's minimum curvature, and logs read by lasio.

Many level horizons give places at depths that are no stations: where the path crosses each of them.
"""

import json
import random
import subprocess

import lasio
import numpy as np
import pytest
import welleng

HEAD, DATUM = (500.0, 400.0), 25.0


def stations(seed):
    """A vertical part, then random turns of up to 4° in 30 m."""
    source = random.Random(seed)
    depths, inclinations, azimuths = [0.0, 300.0], [0.0, 0.0], [0.0, source.uniform(0, 360)]
    azimuths[0] = azimuths[1]
    for _ in range(25):
        depths.append(depths[-1] + source.uniform(20, 40))
        inclinations.append(min(120.0, max(0.0, inclinations[-1] + source.uniform(-1, 4))))
        azimuths.append((azimuths[-1] + source.uniform(-3, 3)) % 360)
    return depths, inclinations, azimuths


def model(survey, levels):
    rows = ", ".join(f"{{ md = {md!r}, inc_deg = {inc!r}, azi_deg = {azi!r} }}" for md, inc, azi in zip(*survey))
    layers = "\n".join(
        f'[[feature]]\nid = "h{k}"\nkind = "horizon"\nfacies = "f{k % 2}"\nsurface = {{ level = {level} }}'
        for k, level in enumerate(levels)
    )
    return f"""
name = "Cross-check"
[domain]
x = [-2000, 3000]
y = [-2000, 3000]
z = [-1500, 0]
facies = "f0"
[facies.f0]
porosity = 0.1
[facies.f1]
porosity = 0.25
permeability = [500, 400, 30]
{layers}
[[well]]
id = "A-1"
head = [{HEAD[0]}, {HEAD[1]}]
datum = {DATUM}
path = "minimum-curvature"
survey = [{rows}]
completions = [[310, 330]]
"""


def run(program, folder, text, *arguments):
    (folder / "model.toml").write_text(text)
    command = [program, "log", folder / "model.toml", *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


@pytest.mark.parametrize("seed", range(20))
def test_places_are_those_of_welleng(program, tmp_path, seed):
    own = stations(seed)
    levels = [-700.0 + 25.0 * k for k in range(28)]
    answer = json.loads(run(program, tmp_path, model(own, levels), "--json"))[0]
    survey = welleng.survey.Survey(md=own[0], inc=own[1], azi=own[2], start_nev=[0, 0, 0], deg=True)
    end = answer["ends"][1]
    expected = [HEAD[0] + survey.e[-1], HEAD[1] + survey.n[-1], DATUM - survey.tvd[-1]]
    np.testing.assert_allclose(end, expected, rtol=0, atol=1e-8)
    crossings = [one for one in answer["crossings"] if one["from"] and one["to"]]
    assert len(crossings) > 5
    for one in crossings:
        node = survey.interpolate_md(one["md_m"])
        place = [HEAD[0] + node.pos_nev[1], HEAD[1] + node.pos_nev[0], DATUM - node.pos_nev[2]]
        np.testing.assert_allclose(one["at"], place, rtol=0, atol=1e-6)
        # It lies on a horizon.
        assert min(abs(one["at"][2] - level) for level in levels) < 1e-8


def test_logs_are_read_by_lasio(program, tmp_path):
    own = stations(1)
    levels = [-600.0, -400.0, -350.0, -310.0]
    text = model(own, levels)
    run(program, tmp_path, text, "-o", tmp_path / "a.las", "--step", "0.5")
    answer = json.loads(run(program, tmp_path, text, "--json"))[0]
    las = lasio.read(tmp_path / "a.las")
    assert [curve.mnemonic for curve in las.curves][:5] == ["DEPT", "TVDSS", "VOLUME", "FACIES", "PERF"]
    assert {"PHI", "KX", "KY", "KZ"} <= set(las.keys())
    assert las.well["WELL"].value == "A-1" and las.well["STEP"].value == 0.5
    depth = las["DEPT"]
    assert depth[0] == las.well["STRT"].value and depth[-1] == las.well["STOP"].value
    np.testing.assert_allclose(np.diff(depth), 0.5, atol=1e-6)
    survey = welleng.survey.Survey(md=own[0], inc=own[1], azi=own[2], start_nev=[0, 0, 0], deg=True)
    names = {f"V{k}": parameter.value for k in range(9) for parameter in las.params if parameter.mnemonic == f"V{k}"}
    for row in range(0, len(depth), 37):
        tvd = survey.interpolate_md(float(depth[row])).pos_nev[2]
        assert abs(las["TVDSS"][row] - (tvd - DATUM)) < 1e-3
        held = [one for one in answer["intervals"] if one["md_m"][0] <= depth[row] < one["md_m"][1]]
        if held and held[0]["volume"]:
            assert names[f"V{int(las['VOLUME'][row])}"] == held[0]["volume"]
            assert las["PHI"][row] == (0.25 if held[0]["facies"] == "f1" else 0.1)
            assert las["PERF"][row] == float(310 <= depth[row] <= 330)
        elif held:
            # Above the domain there is nothing.
            assert np.isnan(las["VOLUME"][row]) and np.isnan(las["PHI"][row])


def test_surveys_written_by_lasio_come_back(program, tmp_path):
    own = stations(2)
    las = lasio.LASFile()
    for mnemonic, unit, values in zip(("DEPT", "DEVI", "HAZI"), ("M", "DEG", "DEG"), own):
        las.append_curve(mnemonic, np.array(values), unit=unit)
    las.write(str(tmp_path / "own.las"), version=2.0, fmt="%.9f")
    text = model(own, [-400.0])
    inline = json.loads(run(program, tmp_path, text, "--json"))[0]
    start = text.index("survey = [")
    end = text.index("\n", start)
    beside = text[:start] + 'survey = { file = "own.las" }' + text[end:]
    from_file = json.loads(run(program, tmp_path, beside, "--json"))[0]
    assert from_file["source"]["format"] == "LAS"
    np.testing.assert_allclose(from_file["ends"], inline["ends"], rtol=0, atol=1e-5)

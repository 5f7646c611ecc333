"""Reflected light together with what else a model or a run may have, on design days of a box."""

import itertools
import math
import re

import pytest
import radiance
from output_files import values_of
from reflecting_scenes import (
    BY_GROUND,
    BY_SHADES,
    INCIDENT,
    PARTS,
    WINDOW,
    awning,
    bare,
    louvres,
    reflected_of,
    run_days,
    shade,
    street,
    suns_of,
    with_days,
)
from shading_runs import energyplus

NAMES = (BY_GROUND, BY_SHADES, INCIDENT.format(""))


def light(run):
    return {name: values_of(run, name) for name in NAMES}


def test_multipliers_change_nothing_per_area(patched, weather, tmp_path, box):
    text = with_days(bare(box) + street(0.5), (3,), 700, 150)
    many = re.sub(r"Zone,Box;", "Zone,Box,0,0,0,0,1,3;", text)
    many = many.replace("South Window,Window,Window,South,,,,,4,", "South Window,Window,Window,South,,,,2,4,")
    assert many.count("Box,0,0,0,0,1,3;") == many.count("South,,,,2,4,") == 1
    one, three = (light(run_days(patched, weather, tmp_path, each)[1]) for each in (text, many))
    for name in NAMES:
        assert three[name].keys() == one[name].keys()
        for surface, values in one[name].items():
            assert three[name][surface] == pytest.approx(values, rel=1e-9, abs=1e-9), (name, surface)


@pytest.mark.parametrize("option", [
    "--gpu-shading-lean=off", "--gpu-shading-update=timestep", "--gpu-shading-update=sampled:coarse"])
def test_options_of_shading_leave_reflected_light_as_it_is(patched, weather, tmp_path, box, option):
    """Lean input leaves out 121 blades."""
    text = with_days(bare(box) + street(0.5) + many_blades(0.6), (3,), 700, 150)
    (_, usual), (_, other) = (run_days(patched, weather, tmp_path, text, *each) for each in ((), (option,)))
    if "lean" in option:
        assert any("shading surfaces hidden from EnergyPlus" in line for line in usual.our_lines)
    for name in NAMES[:2]:
        ours, theirs = values_of(usual, name), values_of(other, name)
        assert max(ours[WINDOW]) > 1
        for surface, values in ours.items():
            assert theirs[surface] == pytest.approx(values, rel=1e-6, abs=1e-6), (name, surface)


def many_blades(reflectance):
    return "".join(
        shade(f"Blade {i} {j}", [(x, -0.06, z), (x, -0.16, z), (x + 0.4, -0.16, z), (x + 0.4, -0.06, z)], reflectance)
        for i, z in enumerate(0.8 + 0.2 * i for i in range(11)) for j, x in enumerate(1 + 0.4 * j for j in range(11)))


def test_mirrored_copies_reflect_nothing_more(patched, weather, tmp_path, box):
    """EnergyPlus copies each shading surface for the sun on its back, and asks for the copies that an output names."""
    text = with_days(bare(box) + street(0.5), (3,), 700, 150)
    asked = text + "Output:Variable,Mir-Opposite,Surface Outside Face Sunlit Fraction,Timestep;\n"
    (_, usual), (_, other) = (run_days(patched, weather, tmp_path, each) for each in (text, asked))
    assert light(usual) == light(other)
    assert max(values_of(other, "Surface Outside Face Sunlit Fraction")["Mir-OPPOSITE"]) > 0.5


def test_a_cache_answers_the_same(patched, weather, tmp_path, box):
    text = with_days(bare(box) + street(0.5) + louvres(0.6), (3,), 700, 150)
    cache = f"--gpu-shading-cache={tmp_path / 'cache'}"
    without, cold, warm = (light(run_days(patched, weather, tmp_path, text, *options)[1])
                           for options in ((), (cache,), (cache,)))
    assert without == cold == warm


def test_trees_dim_by_season(patched, weather, tmp_path, box):
    """Without beam, as the same tree with all leaves in summer, and without in winter."""
    def model(cycle, schedule=""):
        tree = f"GPUShading:Tree,Lime,3,-4,0,8,7,0.5,Ellipsoid,0,{cycle},{schedule},0.9,0.1;\n"
        return with_days(bare(box), (1, 7), 0, 300) + tree + "Schedule:Constant,Bare,,0;\n"

    january, july = {}, {}
    for name, text in {"by season": model("Deciduous"), "in leaf": model("Evergreen"),
                       "bare": model("Evergreen", "Bare")}.items():
        values = reflected_of(run_days(patched, weather, tmp_path, text)[1])
        january[name], july[name] = values[12], values[24 + 12]
    print(january, july)
    assert january["by season"] == pytest.approx(january["bare"], rel=1e-6)
    assert july["by season"] == pytest.approx(july["in leaf"], rel=1e-6)
    assert january["by season"] > 1.5 * july["by season"]


PANELS = """
Generator:Photovoltaic,Cells,{surface},PhotovoltaicPerformance:Simple,Performance,Decoupled;
PhotovoltaicPerformance:Simple,Performance,0.5,Fixed,0.2;
ElectricLoadCenter:Generators,Panels,Cells,Generator:Photovoltaic,1000;
ElectricLoadCenter:Distribution,Center,Panels,Baseload,,,,DirectCurrentWithInverter,Inverter;
ElectricLoadCenter:Inverter:Simple,Inverter,,,0,1;
Output:Variable,Cells,Generator Produced DC Electricity Rate,Timestep;
"""


def test_panels_get_all_of_the_light(patched, weather, tmp_path, box):
    text = with_days(bare(box) + street(0.5), (3,), 700, 150) + PANELS.format(surface="South")
    _, run = run_days(patched, weather, tmp_path, text)
    parts = [values_of(run, INCIDENT.format(part))["SOUTH"] for part in PARTS]
    area = 12  # of the wall without its window, m2
    power = values_of(run, "Generator Produced DC Electricity Rate")["CELLS"]
    assert max(parts[2]) > 20
    for step, found in enumerate(power):
        assert found == pytest.approx(0.5 * 0.2 * area * sum(part[step] for part in parts), rel=1e-6, abs=1e-6)


QUARTERS = [(f"QUARTER {i}{j}", 1.5 + 1.5 * i, 0.8 + j) for i in (0, 1) for j in (0, 1)]
SLOPE = (0.0, -0.1 / math.hypot(1.5, 0.1), 1.5 / math.hypot(1.5, 0.1))  # the awning's normal


def share_of_awning(x0, z0):
    """View factor of the awning from a rectangle of 1.5 x 1 m in the facade, as a sum over pieces."""
    total = 0.0
    for i, j, k, m in itertools.product(range(6), range(6), range(48), range(12)):
        y = -1.5 * (m + 0.5) / 12
        to = (6 * (k + 0.5) / 48 - x0 - 1.5 * (i + 0.5) / 6, y, 0.7 + y / 15 - z0 - (j + 0.5) / 6)
        square = radiance.dot(to, to)
        total += max(0.0, -to[1]) * max(0.0, -radiance.dot(to, SLOPE)) / (math.pi * square * square)
    return total / 36 * 6 * math.hypot(1.5, 0.1) / (48 * 12)


def test_one_reflection_is_energyplus_s_within_its_scatter(official, patched, weather, tmp_path, box):
    """Of a black door in four parts: where all but an awning is black, light is reflected once."""
    doors = "".join(
        f"FenestrationSurface:Detailed,{name},Door,Outer Wall,South,,,,,4,{x},0,{z + 1},{x},0,{z},{x + 1.5},0,{z},"
        f"{x + 1.5},0,{z + 1};\n" for name, x, z in QUARTERS)
    text = re.sub(r"\nFenestrationSurface:Detailed,.*?;\n", "\n" + doors, bare(box), flags=re.S)
    text = text.replace("Material,Block,Rough,0.1,0.5,1400,1000;", "Material,Block,Rough,0.1,0.5,1400,1000,0.9,1,1;")
    text = text.replace("Material,Insulation,Rough,0.1,0.04,30,1400;",
                        "Material,Insulation,Rough,0.1,0.04,30,1400,0.9,1,1;")
    black = "Site:GroundReflectance," + ",".join(["0"] * 12) + ";\n"
    output = "Surface Outside Face Incident Beam To Diffuse Surface Reflected Solar Radiation Rate per Area"
    text = with_days(text + awning(0.8) + black, (6,), 1000, 0) + f"Output:Variable,*,{output},Timestep;\n"
    _, run = run_days(patched, weather, tmp_path, text)
    ours = {name: values_of(run, BY_SHADES)[name] for name, _, _ in QUARTERS}
    assert max(max(values_of(run, BY_GROUND)[name]) for name in ours) < 1e-6
    (tmp_path / "stock.idf").write_text(re.sub(r"(FullInteriorAndExterior),", r"\1WithReflections,", text))
    stock = energyplus.run(official, tmp_path / "stock.idf", weather, tmp_path / "stock", ["-D"])
    assert stock.completed, stock.why()
    theirs = values_of(stock, output)
    noon = max(range(24), key=lambda step: suns_of(run)[step][1])
    lit = 1000 * radiance.dot(SLOPE, radiance.towards(suns_of(run)[noon]))
    for name, x, z in QUARTERS:
        exact = 0.8 * lit * share_of_awning(x, z)
        print(name, ours[name][noon], exact, theirs[name][noon], sum(ours[name]) / sum(theirs[name]))
        assert ours[name][noon] == pytest.approx(exact, rel=0.05)
        # EnergyPlus sends few rays from each.
        assert theirs[name][noon] == pytest.approx(exact, rel=0.3)
    assert sum(map(sum, ours.values())) == pytest.approx(sum(sum(theirs[name]) for name in ours), rel=0.06)

"""EnergyPlus's own solar reflections: as in stock, unless this module computes them (--gpu-shading-reflections)."""

import re

import pytest
import test_models
from output_files import values_of
from shading_runs import energyplus

RATE = "Surface Outside Face Incident {} Reflected Solar Radiation Rate per Area"
SKY_BY_SURFACES = RATE.format("Sky Diffuse Surface")
PARTS = [SKY_BY_SURFACES, *map(RATE.format, (
    "Beam To Beam Surface", "Beam To Diffuse Surface", "Beam To Diffuse Ground", "Sky Diffuse Ground"))]
OUTPUTS = "".join(f"Output:Variable,*,{part},Hourly;\n" for part in PARTS) + "Output:SQLite,Simple;\n"


def run_both(official, patched, weather, path, text, *options):
    """The runs of stock EnergyPlus and of ours, with reflections."""
    path.write_text(re.sub(r"(?i)(Full(?:InteriorAnd)?Exterior)(?:WithReflections)?\s*([,;])", r"\1WithReflections\2",
                           text) + OUTPUTS)
    runs = [energyplus.run(program, path, weather, path.parent / folder, ["-D", *flags])
            for folder, program, flags in (("stock", official, []), ("ours", patched, ["--gpu-shading", *options]))]
    for done in runs:
        assert done.completed, done.why()
    return runs


def assert_same(stock, ours):
    compared = 0
    for part in PARTS:
        # The sky's share depends on sunlit fractions, by clipping here and by rendering there, of which a scheduled
        # shade's are within 1e-3.
        relative = 1.6e-2 if part == SKY_BY_SURFACES else 1e-6
        mine, theirs = values_of(ours, part), values_of(stock, part)
        largest = max(map(max, theirs.values()))
        for surface, values in theirs.items():
            compared += any(values)
            assert mine[surface] == pytest.approx(values, rel=relative, abs=relative * largest), (part, surface)
    assert compared > 10


@pytest.mark.parametrize("name", ["ReflectiveAdjacentBuilding", "SolarShadingTest", "DaylightingDeviceShelf"])
def test_models_of_others_reflect_as_in_stock(name, official, patched, tmp_path):
    source = test_models.MODELS / f"{name}.idf"
    if not source.is_file():
        pytest.skip(f"{source} is missing")
    weather = sorted(test_models.MODELS.glob("weather/*Colorado*.epw"))[0]
    assert_same(*run_both(official, patched, weather, tmp_path / source.name, source.read_text(errors="replace")))


# Two, since stock's clipping is not exact for louvres that shade each other in many layers.
@pytest.mark.parametrize("lean", ["on", "off"])
def test_lean_input_leaves_energyplus_s_reflections_their_surfaces(lean, official, patched, weather, louvres, tmp_path):
    stock, ours = run_both(official, patched, weather, tmp_path / "model.idf", louvres(2),
                           f"--gpu-shading-lean={lean}", "--gpu-shading-reflections=energyplus")
    assert_same(stock, ours)
    reason = "lean input is off: Building: Solar Distribution asks for reflections"
    assert any(reason in line for line in ours.our_lines) == (lean == "on")

"""Diffuse light from the sky behind a screen that moves, against EnergyPlus's own polygon clipping.

A screen without holes in reach that is deployed to a share s passes 1 - s: what EnergyPlus has for an opaque surface
with the Transmittance Schedule 1 - s. With DetailedSkyDiffuseModeling, both change through the day.
"""

import re

import pytest
from output_files import values_of
from shading_runs import energyplus

SKY = "Surface Outside Face Incident Sky Diffuse Solar Radiation Rate per Area"
SHADE = ("Shading:Building:Detailed,Awning,{schedule},4,"
         "0.5,-1.2,3.4,0.5,-1.2,0.6,5.5,-1.2,0.6,5.5,-1.2,3.4;\n")
DAY = "Schedule:Compact,{name},,Through: 12/31,For: AllDays,Until: 11:00,{a},Until: 14:00,{b},Until: 24:00,{c};\n"
SCREEN = "GPUShading:PerforatedScreen,Closed,Awning,Square,,Straight,0.001,,50,,0,,,,,,,,20,20,,Deployed,Effective;\n"


def rewritten(box, calculation):
    text = re.sub(r"ShadowCalculation,[^;]*;[^\n]*", calculation, box)
    # Without the model's louvre.
    text = re.sub(r"Shading:Building:Detailed,[^;]*;[^\n]*\n", "", text)
    return text + f"Output:SQLite,Simple;\nOutput:Variable,*,{SKY},Timestep;\n"


def series(run):
    assert run.completed, run.why()
    return values_of(run, SKY)


@pytest.mark.parametrize("update", ["Timestep", "Periodic"])
def test_sky_follows_a_deployment_schedule(patched, weather, box, tmp_path, update):
    text = rewritten(box, f"ShadowCalculation,PolygonClipping,{update},20,15000,,512,DetailedSkyDiffuseModeling;")
    clipped = text + SHADE.format(schedule="Open") + DAY.format(name="Open", a=1.0, b=0.1, c=0.6)
    screened = text + SHADE.format(schedule="") + DAY.format(name="Deployed", a=0.0, b=0.9, c=0.4) + SCREEN
    found = []
    for name, model, options in (("clipped", clipped, []), ("screened", screened, ["--gpu-shading"])):
        path = tmp_path / f"{name}.idf"
        path.write_text(model)
        found.append(series(energyplus.run(patched, path, weather, tmp_path / name, [*options, "-D"])))
    exact, ours = found
    walls = [key for key in exact if max(exact[key]) > 0.0 and key in ours and "AWNING" not in key]
    assert len(walls) >= 5
    for key in walls:
        assert len(exact[key]) == len(ours[key])
        most = max(exact[key])
        assert max(abs(a - b) for a, b in zip(exact[key], ours[key], strict=True)) < 2e-3 * most, key
    # The window sees more of the sky while the screen is up than while it is down.
    window = next(key for key in walls if "WINDOW" in key)
    noon, late = len(exact[window]) * 12 // 24, len(exact[window]) * 15 // 24
    assert exact[window][noon] < 0.9 * exact[window][late]


def test_sky_needs_no_placeholder_without_detailed_modelling(patched, weather, box, tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(rewritten(box, "ShadowCalculation,PolygonClipping,Timestep;") + SHADE.format(schedule="")
                    + DAY.format(name="Deployed", a=0.0, b=0.9, c=0.4) + SCREEN)
    assert not any("PLACEHOLDER" in key for key in
                   series(energyplus.run(patched, path, weather, tmp_path / "out", ["--gpu-shading", "-D"])))

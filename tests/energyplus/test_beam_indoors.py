"""The beam on surfaces indoors, with schedules and DetailedSkyDiffuseModeling.

With a shade that changes, EnergyPlus asks at every timestep for the sun and then for the patches of the sky, and keeps
what it hears of surfaces indoors in the same places. With SimpleSkyDiffuseModeling it asks for the sun alone, so that
the beam indoors of that run is what it must be.
"""

import pytest
import window_with_shades
from output_files import values_of
from shading_runs import energyplus

INSIDE = "Surface Inside Face Exterior Windows Incident Beam Solar Radiation Rate"
THROUGH = "Surface Window Transmitted Beam Solar Radiation Rate"
REVEAL = "Surface Window Outside Reveal Reflected Beam Solar Radiation Rate"
DAY = "Schedule:Compact,Day,,Through: 12/31,For: AllDays,Until: 11:00,0.4,Until: 14:00,0.9,Until: 24:00,0.2;\n"
SCREEN = "GPUShading:PerforatedScreen,Screen,Panel,Square,,Straight,0.001,,50,,0,,,,,,,,20,20,,Day,Effective;\n"
MOVING = "GPUShading:MovingShade,Shade,Panel,Slide,,1,0,0,,,,0,1,0.1,,Schedule,Day;\n"
# Transmittance schedule, object, method.
CASES = {"deployment schedule": ("", SCREEN, "patched"), "moving shade": ("", MOVING, "patched"),
         "transmittance schedule": ("Day", "", "patched"), "through OpenGL": ("Day", "", "opengl")}


def model(sky, update, schedule, shade, set_back):
    """A window behind a panel in January, set back by some metres or with no reveal."""
    text = window_with_shades.model("south", False, False)
    for old, new in (("FullExterior", "FullInteriorAndExterior"), ("8,21,Summer", "1,21,Summer"),
                     ("PolygonClipping,Timestep;", f"PolygonClipping,{update},,,,,{sky};"),
                     ("Window,Front,,,,,4", "Window,Front,,,Frame,,4" if set_back else "Window,Front,,,,,4"),
                     ("  -1.500000000,0.000000000,", f"  -1.5,{set_back},"),
                     ("  1.500000000,0.000000000,", f"  1.5,{set_back},")):
        assert old in text
        text = text.replace(old, new)
    panel = f"Shading:Building:Detailed,Panel,{schedule},4,-2,-0.5,3,-2,-0.5,1,1,-0.5,1,1,-0.5,3;\n"
    frame = "WindowProperty:FrameAndDivider,Frame" + 20 * "," + "0.5,0.1,0.5,0.1,0.5;\n"
    outputs = "".join(f"Output:Variable,*,{name},Timestep;\n" for name in (INSIDE, THROUGH, REVEAL))
    return text + outputs + DAY + panel + frame + shade


@pytest.mark.parametrize("update", ["Timestep", "Periodic"])
@pytest.mark.parametrize("case", CASES)
def test_beam_indoors_is_what_windows_transmit(patched, weather, tmp_path, case, update):
    schedule, shade, method = CASES[case]
    set_back = 0.2 if method == "patched" else 0.0
    done = {}
    for sky in ("SimpleSkyDiffuseModeling", "DetailedSkyDiffuseModeling"):
        path = tmp_path / f"{sky}.idf"
        path.write_text(model(sky, update, schedule, shade, set_back))
        done[sky] = energyplus.run(patched, path, weather, tmp_path / sky,
                                   ["--gpu-shading", "--gpu-shading-method", method, "-D"])
        assert done[sky].completed, done[sky].why()
    simple, detailed = done.values()
    through = values_of(detailed, THROUGH)["WINDOW"]
    inside, expected = values_of(detailed, INSIDE), values_of(simple, INSIDE)
    assert max(through) > 500.0
    for time, transmitted in enumerate(through):
        received = sum(values[time] for values in inside.values())
        assert received <= transmitted * (1 + 1e-5) + 1e-6, (time, received, transmitted)
    assert sum(max(values) > 10.0 for values in expected.values()) >= 3
    for surface, values in expected.items():
        assert inside[surface] == pytest.approx(values, rel=1e-6, abs=1e-3), surface
    if set_back:
        reveal, its_expected = (values_of(run, REVEAL)["WINDOW"] for run in (detailed, simple))
        assert max(its_expected) > 50.0
        assert reveal == pytest.approx(its_expected, rel=1e-6, abs=1e-3)

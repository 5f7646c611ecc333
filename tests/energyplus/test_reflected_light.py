"""All of the light that ground, shades and neighbours reflect (--gpu-shading-reflections), in whole runs."""

import re

import pytest
import radiance
import radiance_reflections
from output_files import values_of
from shading_runs import energyplus

BY_GROUND = "GPU Shading Solar Radiation Reflected by Ground Rate per Area"
BY_SHADES = "GPU Shading Solar Radiation Reflected by Shades Rate per Area"
INCIDENT = "Surface Outside Face Incident {}Solar Radiation Rate per Area"
PARTS = ("Beam ", "Sky Diffuse ", "Ground Diffuse ")
OUTPUTS = "".join(f"Output:Variable,*,{name},Timestep;\n" for name in (
    BY_GROUND, BY_SHADES, INCIDENT.format(""), *(INCIDENT.format(part) for part in PARTS),
    "Site Solar Azimuth Angle", "Site Solar Altitude Angle")) + "Output:SQLite,Simple;\n"
# A day whose beam and diffuse irradiance are given, W/m2.
DAY = """
Schedule:Day:Hourly,Beam of {name},,{beam};
Schedule:Day:Hourly,Sky of {name},,{sky};
SizingPeriod:DesignDay,{name},{month},21,SummerDesignDay,20,0,DefaultMultipliers,,WetBulb,
  10,,,,,98000,2,180,No,No,No,Schedule,Beam of {name},Sky of {name},,,;
"""


def with_days(model, months, beam, sky):
    """A model's text with days of constant irradiance instead of its own, and the outputs above."""
    model = re.sub(r"SizingPeriod:DesignDay,.*?;[^\n]*\n|Output:Variable,[^;]*;[^\n]*\n", "", model, flags=re.S)
    model = re.sub(r"Timestep,\d+;", "Timestep,1;", model)
    return model + OUTPUTS + "".join(
        DAY.format(name=f"Day {month}", month=month, beam=",".join([str(beam)] * 24), sky=",".join([str(sky)] * 24))
        for month in months)


def shade(name, corners, reflectance):
    points = ",".join(f"\n  {x:.9g},{y:.9g},{z:.9g}" for x, y, z in corners)
    return (f"Shading:Building:Detailed,{name},,{len(corners)}," + points + ";\n"
            f"ShadingProperty:Reflectance,{name},{reflectance},{reflectance},0;\n")


def louvres(reflectance):
    """21 blades before the box's window, a little tilted."""
    text = ""
    for i in range(21):
        z = 0.8 + 0.1 * i
        text += shade(f"Blade {i}", [(1.2, -0.06, z), (1.2, -0.16, z - 0.04), (4.8, -0.16, z - 0.04), (4.8, -0.06, z)],
                      reflectance)
    return text


def egg_crate(reflectance):
    text = ""
    for i in range(11):
        z = 0.8 + 0.2 * i
        text += shade(f"Shelf {i}", [(1.5, -0.01, z), (1.5, -0.21, z), (4.5, -0.21, z), (4.5, -0.01, z)], reflectance)
    for i in range(16):
        x = 1.5 + 0.2 * i
        text += shade(f"Fin {i}", [(x, -0.01, 2.8), (x, -0.01, 0.8), (x, -0.21, 0.8), (x, -0.21, 2.8)], reflectance)
    return text


def street(reflectance):
    """A house across the street, and one beside it."""
    return (shade("Opposite", [(20, -8, 9), (20, -8, 0), (-14, -8, 0), (-14, -8, 9)], reflectance)
            + shade("Beside", [(-4, 0, 6), (-4, -5, 6), (-4, -5, 0), (-4, 0, 0)], reflectance))


def awning(reflectance):
    """Below the window, so that it reflects the sun to it."""
    return shade("Awning", [(0, 0, 0.7), (0, -1.5, 0.6), (6, -1.5, 0.6), (6, 0, 0.7)], reflectance)


SCENES = {"louvres": louvres, "egg crate": egg_crate, "street": street, "awning": awning}
WINDOW = "SOUTH WINDOW"
WALLS = 0.3  # of the box: EnergyPlus's default absorptance is 0.7


def bare(box):
    """The box without its louvre."""
    return re.sub(r"Shading:Building:Detailed,[^;]*;[^\n]*\n", "", box)


def run_days(patched, weather, tmp_path, text, *options):
    model = tmp_path / "model.idf"
    model.write_text(text)
    run = energyplus.run(patched, model, weather, tmp_path / "out",
                         ["-D", "--gpu-shading", "--gpu-shading-reflections=all", *options])
    assert run.completed, run.why()
    return model, run


def suns_of(run):
    """[(azimuth, altitude)] of each timestep."""
    azimuths, altitudes = (next(iter(values_of(run, f"Site Solar {angle} Angle").values()))
                           for angle in ("Azimuth", "Altitude"))
    return list(zip(azimuths, altitudes, strict=True))


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("reflectance", [0.2, 0.5, 0.8])
def test_reflected_light_is_radiance_s(patched, weather, tmp_path, box, scene, reflectance):
    if radiance.is_missing():
        pytest.skip(f"{radiance.FOLDER} is missing: scripts/setup could not fetch pyradiance")
    text = bare(box) + SCENES[scene](reflectance)
    model, run = run_days(patched, weather, tmp_path, with_days(text, (6, 9, 12), 1000, 0))
    ground, shades = (values_of(run, name)[WINDOW] for name in (BY_GROUND, BY_SHADES))
    ours = {sun: (by_ground + by_shades) / 1000.0
            for sun, by_ground, by_shades in zip(suns_of(run), ground, shades, strict=True)}
    surfaces = radiance.surfaces(patched.parent / "gpu_shading", model)

    def reflectance_of(name):
        return reflectance if name.upper().startswith(("BLADE", "SHELF", "FIN", "OPPOSITE", "BESIDE", "AWNING")) else (
            0.0 if name.upper() == WINDOW else WALLS)

    all_ours = all_theirs = squares = 0.0
    for sun in radiance.spread([sun for sun in ours if sun[1] > 5], 7):
        theirs = radiance_reflections.reflected(surfaces, WINDOW, radiance_reflections.Lights.sun(radiance.towards(sun)),
                                                tmp_path, reflectance_of)
        # The light that an open window would get of such a sun, by beam and ground.
        print(f"{scene} {reflectance} {sun[0]:6.1f} {sun[1]:5.1f}: {ours[sun]:.4f} {theirs:.4f}")
        all_ours, all_theirs = all_ours + ours[sun], all_theirs + theirs
        squares += (ours[sun] - theirs) ** 2
    print(f"{scene} {reflectance}: {all_ours / all_theirs:.4f}, rms {(squares / 7) ** 0.5 / (all_theirs / 7):.4f}")
    assert all_ours == pytest.approx(all_theirs, rel=0.02)

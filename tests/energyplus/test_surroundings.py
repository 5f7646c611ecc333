"""View factors for long-wave exchange: against closed forms, and what EnergyPlus makes of them."""

import csv
import json
import os
import subprocess
import sys

import large_packages
import numpy as np
import pytest
import radiance
import screened_room
from eso_file import EsoFile
from shading_runs import energyplus

STREET = "Shading:Site:Detailed,Street,,4, 5000,-9.3,14, 5000,-9.3,0, -5000,-9.3,0, -5000,-9.3,14;\n"
SCREEN = ("Shading:Building:Detailed,Screen,,4, -5000,-9.3,5000, -5000,-9.3,-5000, 5000,-9.3,-5000, 5000,-9.3,5000;\n"
          "GPUShading:PerforatedScreen,Sheet,Screen,Square,,Straight,0.01,,0.02,,1e-6;\n")
PANE = SCREEN.split("GPUShading")[0] + "GPUShading:TransparentShade,Pane,Screen,Construction,Glass;\n"
WARM = "Schedule:Constant,Warm,Any,35;\n"
TO = "Surface Outside Face Thermal Radiation to {} Heat Transfer Coefficient"
FACE, AIR = "Surface Outside Face Temperature", "Surface Outside Face Outdoor Air Drybulb Temperature"
SOLAR = "Surface Outside Face Incident Solar Radiation Rate per Area"
OUTPUTS = "".join(f"Output:Variable,*,{name},Timestep;\n" for name in (TO.format("Ground"), FACE, AIR, SOLAR))
PERIODIC = "PixelCounting,Periodic,20"
FLAG = "--gpu-shading-surroundings"


def call(*arguments):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    command = [energyplus.patched_prefix() / "gpu_shading", "export", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment)


def factors(folder, objects, kind="idf", shadow=PERIODIC):
    """({surface: {group: view factor}}, the file of objects)"""
    (folder / "room.idf").write_text(screened_room.model(objects=objects, shadow=shadow))
    done = call(folder / "room.idf", "--surroundings", folder / f"views.{kind}")
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{folder}/views.{kind}\n"
    with open(folder / "views.csv", newline="", encoding="utf-8") as file:
        rows = {row.pop("surface"): {key: float(value) for key, value in row.items()} for row in csv.DictReader(file)}
    for row in rows.values():
        assert sum(value for key, value in row.items() if key != "standard error") == pytest.approx(1, abs=1e-9)
    return rows, folder / f"views.{kind}"


@pytest.fixture(scope="module")
def street(tmp_path_factory):
    return factors(tmp_path_factory.mktemp("street"), STREET)


def test_street_is_that_of_the_closed_form(street):
    window = street[0]["WINDOW"]
    _, bottom, _, top = screened_room.generate.WINDOW
    z = np.linspace(bottom, top, 2001)
    # An infinite strip between two profile angles takes half the difference of their sines.
    sky = np.mean(1 - np.sin(np.arctan((14 - z) / 9.3))) / 2
    ground = np.mean(1 - np.sin(np.arctan(z / 9.3))) / 2
    found = {"SKY": sky, "GROUND": ground, "NEIGHBOURS": 1 - sky - ground}
    print({name: window[name] - value for name, value in found.items()}, window["standard error"])
    assert window["standard error"] < 0.0015
    for name, value in found.items():
        assert window[name] == pytest.approx(value, abs=3 * window["standard error"])


def test_factors_of_receivers_are_reciprocal(tmp_path):
    facing = ("BuildingSurface:Detailed,Facing,Wall,Outer Wall,Room,,Outdoors,,SunExposed,WindExposed,,4,"
              "5,-3,4, 5,-3,-1, -2,-3,-1, -2,-3,4;\nGPUShading:SurroundingGroup,Facing Group,Facing;\n")
    rows = factors(tmp_path, facing)[0]
    x1, z1, x2, z2 = screened_room.generate.WINDOW
    window = (x2 - x1) * (z2 - z1)
    areas = {"FRONT": 6 * 3 - window, "WINDOW": window}
    there = sum(area * rows[name]["FACING GROUP"] for name, area in areas.items())
    back = 7 * 5 * rows["FACING"]["BUILDING"]
    noise = np.hypot(7 * 5 * rows["FACING"]["standard error"],
                     np.hypot(*(area * rows[name]["standard error"] for name, area in areas.items())))
    print(f"{there:.4f} and {back:.4f} m2, standard error {noise:.4f}")
    assert there > 5
    assert there == pytest.approx(back, abs=3 * noise)


def test_sheet_of_holes_hides_its_solid_share(tmp_path):
    window = factors(tmp_path, SCREEN)[0]["WINDOW"]
    # Square holes of half the pitch.
    assert window["SHADES"] == pytest.approx(0.75, abs=0.004)
    assert window["SKY"] == pytest.approx(0.125, abs=0.004)
    assert window["GROUND"] == pytest.approx(0.125, abs=0.004)


@pytest.mark.skipif(radiance.is_missing(), reason="Radiance is missing: run scripts/setup")
@pytest.mark.parametrize("thickness", [1e-6, 0.003, 0.01])
def test_thick_sheet_is_that_of_radiance(tmp_path, thickness):
    pitch, diameter = 0.01, 0.007
    sheet = (screened_room.rectangle("Screen", -0.4, -20.0, -12.0, 26.0, 15.0)
             + f"GPUShading:PerforatedScreen,Sheet,Screen,Round,,Staggered60,{diameter},,{pitch},,{thickness};\n")
    (tmp_path / "room.idf").write_text(screened_room.model(objects=sheet))
    done = call(tmp_path / "room.idf", "--rays", 1_000_000, "--surroundings", tmp_path / "views.idf")
    assert done.returncode == 0, done.stderr
    with open(tmp_path / "views.csv", newline="", encoding="utf-8") as file:
        window = next(row for row in csv.DictReader(file) if row["surface"] == "WINDOW")
    found, error = float(window["SKY"]), float(window["standard error"])
    everything = radiance.surfaces(energyplus.patched_prefix() / "gpu_shading", tmp_path / "room.idf")
    building = radiance.Building(everything, (pitch, diameter, thickness), tmp_path, 400)
    [points] = [points for name, points in building.points.items() if name.upper() == "WINDOW"]
    (tmp_path / "dome.rad").write_text(
        (tmp_path / "casters.rad").read_text()
        + "void glow white\n0\n0\n4 1 1 1 0\nwhite source dome\n0\n0\n4 0 0 1 180\n")
    rays = "".join(" ".join(map(repr, (*point, *normal))) + "\n" for point, normal in points)
    lines = radiance.trace(tmp_path, "dome.rad", rays, "-I", "-ab", "1", "-ad", "4096", "-as", "0", "-aa", "0",
                           "-lw", "1e-7", "-lr", "20", "-st", "0")
    shares = np.array([float(line.split()[0]) for line in lines.splitlines()]) / np.pi
    expected, noise = shares.mean(), shares.std() / np.sqrt(len(shares))
    print(f"{thickness} m: {found:.5f}, Radiance {expected:.5f}, standard errors {error:.5f} and {noise:.5f}")
    assert found == pytest.approx(expected, abs=3 * np.hypot(error, noise))


def test_opaque_scene_is_that_of_pyviewfactor(tmp_path):
    large_packages.need("pyviewfactor")
    import pyviewfactor
    import pyvista

    # Upright and sloping surfaces before the window, which hide no part of each other from it.
    scene = {"Street": [(3, -7, 7), (3, -7, 0), (-4, -6, 0), (-4, -6, 7)],
             "Wing": [(8, -1, 5), (8, -1, 0), (8, -5, 0), (8, -5, 5)],
             "Bank": [(9, -8, 2), (9, -7, 0), (4, -9, 0), (4, -10, 2)]}
    objects = "".join(f"Shading:Site:Detailed,{name},,4," + ",".join(str(value) for value in np.ravel(corners))
                      + f";\nGPUShading:SurroundingGroup,{name} Group,{name};\n" for name, corners in scene.items())
    window = factors(tmp_path, objects)[0]["WINDOW"]
    x1, z1, x2, z2 = screened_room.generate.WINDOW
    receiver = pyvista.PolyData([(x1, 0, z1), (x2, 0, z1), (x2, 0, z2), (x1, 0, z2)], [4, 0, 1, 2, 3])
    for name, corners in scene.items():
        found = pyviewfactor.compute_viewfactor(pyvista.PolyData(np.array(corners, float), [4, 0, 1, 2, 3]), receiver)
        print(name, window[f"{name} Group".upper()] - found, window["standard error"])
        assert found > 0.01
        assert window[f"{name} Group".upper()] == pytest.approx(found, abs=3 * window["standard error"])


def run(patched, weather, folder, text, options=(), name="model.idf"):
    folder.mkdir()
    (folder / name).write_text(text)
    done = energyplus.run(patched, folder / name, weather, folder / "out", ["-D", "--gpu-shading", *options])
    assert done.completed, done.why()
    assert "Illegal surrounding" not in done.text("eplusout.err")
    return done


def in_force(values, surface):
    """The mean view factor by which EnergyPlus exchanges long-wave radiation with what is at air temperature."""
    found = []
    for time, coefficient in values[TO.format("Ground"), surface].items():
        face, air = (values[each, surface][time] + 273.15 for each in (FACE, AIR))
        if abs(face - air) > 2:
            # Linearised exchange; the wall's emissivity is EnergyPlus's default.
            found.append(coefficient / (5.6697e-8 * 0.9 * (face**2 + air**2) * (face + air)))
    assert len(found) > 5
    return float(np.mean(found))


def series(done):
    return EsoFile(done.folder / "eplusout.eso", "TimeStep").values


# The coefficients lag behind the face's temperature by an iteration.
LAG = 0.012
# By the first schedule, EnergyPlus notices that shades vary.
VARIES, GROWS = (
    f"Schedule:Compact,Half Days,Any,Through: 12/31,For: AllDays,Until: 12:00,{first},Until: 24:00,{1 - first};\n"
    "Shading:Site:Detailed,Far,Half Days,4, 5000,4000,1, 5000,4000,0, -5000,4000,0, -5000,4000,1;\n"
    for first in (1, 0))
DETAILED = "PixelCounting,Periodic,20,,,,DetailedSkyDiffuseModeling"


@pytest.mark.parametrize("objects, shadow", [
    (STREET, PERIODIC), (SCREEN, PERIODIC), (PANE, PERIODIC), (STREET + VARIES, DETAILED), (STREET + GROWS, DETAILED),
], ids=["street", "screen", "glass", "varying", "growing"])
def test_factors_are_in_force_in_energyplus(patched, weather, tmp_path, objects, shadow):
    views, file = factors(tmp_path, objects, shadow=shadow)
    text = screened_room.model(objects=objects, shadow=shadow) + OUTPUTS
    applied = series(run(patched, weather, tmp_path / "applied", text, [FLAG]))
    assert applied == series(run(patched, weather, tmp_path / "typed", text + file.read_text()))
    print(in_force(applied, "FRONT"), 1 - views["FRONT"]["SKY"])
    assert in_force(applied, "FRONT") == pytest.approx(1 - views["FRONT"]["SKY"], abs=LAG)


def test_only_long_wave_exchange_changes(patched, weather, tmp_path):
    text = screened_room.model(objects=PANE) + OUTPUTS
    plain, applied = (series(run(patched, weather, tmp_path / str(len(options)), text, options))
                      for options in ([], [FLAG]))
    assert max(plain[SOLAR, "FRONT"].values()) > 50
    assert plain[SOLAR, "FRONT"] == applied[SOLAR, "FRONT"]
    # Without it, the pane passes a part of the sky's long-wave radiation.
    print(in_force(plain, "FRONT"), in_force(applied, "FRONT"))
    assert in_force(plain, "FRONT") < in_force(applied, "FRONT") - 0.1


def test_scheduled_groups_warm_the_wall(patched, weather, tmp_path):
    warm = {"air": "", "facade": "GPUShading:SurroundingGroup,Facades,Str*,Warm;\n",
            "ground": "GPUShading:SurroundingGroup,Paving,Ground,Warm;\n"}
    window = factors(tmp_path, STREET + WARM + warm["facade"] + warm["ground"])[0]["WINDOW"]
    assert set(window) == {"SKY", "PAVING", "FACADES", "standard error"}
    assert window["FACADES"] > 0.4 and window["PAVING"] > 0.4
    assert "SurfaceProperty:SurroundingSurfaces" in (tmp_path / "views.idf").read_text()
    faces = {}
    for name, group in warm.items():
        text = screened_room.model(objects=STREET + WARM + group) + OUTPUTS
        values = series(run(patched, weather, tmp_path / name, text, [FLAG]))
        faces[name] = np.array(list(values[FACE, "FRONT"].values()))
    print({name: (face - faces["air"]).mean() for name, face in faces.items()})
    facade, ground = ((faces[name] - faces["air"]).mean() for name in ("facade", "ground"))
    assert facade > 0.5
    # What has no schedule stays at air temperature.
    assert ground / facade == pytest.approx(window["PAVING"] / window["FACADES"], rel=0.1)


def test_own_objects_stay(patched, weather, street, tmp_path):
    done = run(patched, weather, tmp_path / "own", screened_room.model(objects=STREET) + street[1].read_text(), [FLAG])
    lines = " ".join(done.text("eplusout.err").split()).replace("** ~~~ ** ", "")
    assert ("SurfaceProperty:LocalEnvironment of the model stays, so that these surfaces get no view factors: FRONT"
            in lines)


def test_less_sky_than_seen_is_said(patched, weather, tmp_path):
    """A level roof beside a tall facade with a temperature: EnergyPlus takes no sum over 1."""
    tall = ("Shading:Site:Detailed,Tower,,4, 50,-9,60, 50,-9,0, -50,-9,0, -50,-9,60;\n" + WARM
            + "GPUShading:SurroundingGroup,Facades,Tower,Warm;\n")
    text = screened_room.model(objects=tall).replace("Roof,Roof,Outer Wall,Room,,Adiabatic,,NoSun,NoWind",
                                                         "Roof,Roof,Outer Wall,Room,,Outdoors,,SunExposed,WindExposed")
    done = run(patched, weather, tmp_path / "roof", text + OUTPUTS, [FLAG])
    lines = " ".join(done.text("eplusout.err").replace("** ~~~ **", "").split())
    assert "so that these surfaces exchange less with the sky than they see of it: ROOF" in lines
    assert "long-wave exchange by view factors of" in lines


def test_shades_that_move_are_taken_at_rest_and_that_is_said(patched, weather, tmp_path):
    resting = "Shading:Building:Detailed,Panel,,4, 50,-0.3,4, 50,-0.3,0, -50,-0.3,0, -50,-0.3,4;\n"
    moving = ("GPUShading:MovingShade,Slider,Panel,Slide,,0,0,1,,,,0,20,1,5,Schedule,Open;\n"
              "Schedule:Constant,Open,Any,20;\n")
    views = {}
    for name, objects in (("still", resting), ("moves", resting + moving),
                          ("there", resting.replace("0.3,4", "0.3,9").replace("0.3,0", "0.3,5"))):
        (tmp_path / name).mkdir()
        views[name] = factors(tmp_path / name, objects)[0]["WINDOW"]["SKY"]
    assert views["moves"] == pytest.approx(views["there"], abs=0.01)
    assert abs(views["moves"] - views["still"]) > 0.1
    done = run(patched, weather, tmp_path / "run", screened_room.model(objects=resting + moving) + OUTPUTS, [FLAG])
    lines = " ".join(done.text("eplusout.err").replace("** ~~~ **", "").split())
    assert ("GPUShading:MovingShade Slider: view factors for long-wave exchange are those of the position at rest"
            in lines)


def test_groups_alone_do_nothing(patched, weather, tmp_path):
    text = screened_room.model(objects=STREET + WARM + "GPUShading:SurroundingGroup,Facades,Str*,Warm;\n")
    done = run(patched, weather, tmp_path / "alone", text)
    assert "applies with --gpu-shading-surroundings only" in " ".join(done.text("eplusout.err").split())


def test_epjson_has_the_same_objects(street, tmp_path):
    _, file = factors(tmp_path, STREET, "epJSON")
    objects = json.loads(file.read_text())
    [ground] = objects["SurfaceProperty:GroundSurfaces"]["GPU SHADING VIEWS OF WINDOW"]["ground_surfaces"]
    assert f"{ground['ground_surface_view_factor']}" in street[1].read_text()


def test_epjson_gets_them_in_memory(patched, weather, official, street, tmp_path):
    (tmp_path / "room.idf").write_text(screened_room.model(objects=STREET) + OUTPUTS)
    converted = energyplus.run(official, tmp_path / "room.idf", weather, tmp_path / "converted", ["-D", "-c"])
    text = (converted.folder / "room.epJSON").read_text()
    found = in_force(series(run(patched, weather, tmp_path / "run", text, [FLAG], "model.epJSON")), "FRONT")
    assert found == pytest.approx(1 - street[0]["FRONT"]["SKY"], abs=LAG)


@pytest.mark.parametrize("objects, arguments, why", [
    ("GPUShading:SurroundingGroup,Facades,Strt,;\n", ["--surroundings", "views.idf"],
     'Surface Name is "Strt": no surface of the model matches'),
    ("", ["--surroundings", "views.txt"], "expected an .idf or .epJSON file"),
    ("", [], "Exactly 1 option from [--scheduled,--surroundings] is required"),
])
def test_errors_say_what_was_expected(tmp_path, objects, arguments, why):
    (tmp_path / "room.idf").write_text(screened_room.model(objects=STREET + objects))
    done = call(tmp_path / "room.idf", *(tmp_path / each if "." in each else each for each in arguments))
    assert done.returncode == 1
    assert why in done.stderr
    assert not (tmp_path / "views.idf").exists()


def test_hosts_are_told_to_export(patched):
    host = (f"import ctypes; library = ctypes.CDLL(r'{patched.parent}/libgpu_shading_energyplus.so')\n"
            "flags = (ctypes.c_char_p * 1)(b'--gpu-shading-surroundings')\n"
            "assert library.gpu_shading_install(b'', 1, flags) < 0\n"
            "library.gpu_shading_message.restype = ctypes.c_char_p\n"
            "print(library.gpu_shading_message().decode())")
    done = subprocess.run([sys.executable, "-c", host], capture_output=True, text=True, check=True)
    assert "gpu_shading export --surroundings" in done.stdout

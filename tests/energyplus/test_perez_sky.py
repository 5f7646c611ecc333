"""Diffuse radiation by patches of the sky against Radiance's gendaymtx behind the same shades, and EnergyPlus's own."""

import re
import subprocess

import numpy as np
import pytest
import radiance
import screened_room
from output_files import values_of
from shading_runs import energyplus
from test_sample_sky import call, tables

FLAG = "--gpu-shading-sky=perez-patches"
SKY = "Surface Outside Face Incident Sky Diffuse Solar Radiation Rate per Area"
BEAM, DIFFUSE = (f"Site {kind} Solar Radiation Rate per Area" for kind in ("Direct", "Diffuse"))
ALTITUDE = "Site Solar Altitude Angle"
CANOPY = screened_room.ledge("Canopy", -2.0, 0.0, 2.7)
WEA = "place Golden\nlatitude 39.74\nlongitude 105.18\ntime_zone 105\nsite_elevation 1829\nweather_data_file_units 1\n"
HOURS = 8760


@pytest.fixture(scope="module")
def model(box):
    """The box under a canopy, without its louvre."""
    text = re.sub(r"Shading:Building:Detailed,[^;]*;", "", box).replace("Timestep,4;", "Timestep,1;")
    return text.replace("PolygonClipping,", "PixelCounting,") + CANOPY + "Output:SQLite,Simple;\n" + "".join(
        f"Output:Variable,*,{name},Timestep;\n" for name in (SKY, BEAM, DIFFUSE, ALTITUDE))


def run(program, weather, folder, text, *options, environment=None):
    path = folder.with_suffix(".idf")
    path.write_text(text)
    return energyplus.run(program, path, weather, folder, ["--gpu-shading", *options], environment)


def series(done, name):
    assert done.completed, done.why()
    return {key: np.array(values) for key, values in values_of(done, name).items()}


@pytest.fixture(scope="module")
def year(patched, weather, model, tmp_path_factory):
    return run(patched, weather, tmp_path_factory.mktemp("perez") / "year", model, FLAG)


@pytest.fixture(scope="module")
def site(year):
    """Direct normal and diffuse horizontal irradiance, and whether the sun is up, by hour."""
    beam, diffuse, altitude = (next(iter(series(year, name).values())) for name in (BEAM, DIFFUSE, ALTITUDE))
    assert len(beam) == HOURS
    return beam, diffuse, (altitude > 5) & (diffuse > 10)


def test_an_unexpected_layout_of_energyplus_s_memory_stops_the_run(patched, weather, model, tmp_path):
    library = energyplus.build_folder() / "tests" / "faults" / "libno_size.so"
    if not library.is_file():
        pytest.skip(f"{library} is missing: run scripts/build")
    done = run(patched, weather, tmp_path / "run", model, FLAG, "-D", environment={"LD_PRELOAD": str(library)})
    assert not done.completed
    assert "sky multipliers have an unexpected layout in memory; expected energyplus" in done.text("eplusout.err")


def test_level_roof_receives_the_horizontal_irradiance(year, site):
    _, diffuse, up = site
    assert series(year, SKY)["ROOF"][up] == pytest.approx(diffuse[up], rel=1e-9)


@pytest.mark.skipif(radiance.is_missing(), reason="Radiance is missing: run scripts/setup")
def test_sky_is_that_of_gendaymtx(patched, weather, model, year, site, tmp_path):
    beam, diffuse, up = site
    months = np.repeat(range(1, 13), [24 * days for days in (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)])
    days = np.concatenate([np.repeat(range(1, 1 + np.sum(months == month) // 24), 24) for month in range(1, 13)])
    (tmp_path / "sky.wea").write_text(WEA + "".join(
        f"{months[h]} {days[h]} {h % 24 + 0.5} {beam[h]:.3f} {diffuse[h]:.3f}\n" for h in range(HOURS) if up[h]))
    words = [radiance.FOLDER / "bin" / "gendaymtx", "-h", "-s", "-O1", "-m", "1", "-c", "1", "1", "1",
             "-g", "0", "0", "0", tmp_path / "sky.wea"]
    table = subprocess.run(words, capture_output=True, check=True, text=True).stdout
    steps = np.count_nonzero(up)
    radiances = np.array([float(row.split()[0]) for row in table.splitlines() if row.strip()]).reshape(-1, steps)[1:]
    (tmp_path / "model.idf").write_text(model)
    done = call(tmp_path / "model.idf", "-o", tmp_path / "patches")
    assert done.returncode == 0, done.stderr
    rows = [row for row in next(tables(tmp_path / "patches")) if row["sky"] == "Tregenza 145"]
    ours = series(year, SKY)
    theirs = series(run(patched, weather, tmp_path / "energyplus", model), SKY)
    for name in ("ROOF", "SOUTH", "EAST", "NORTH", "WEST", "SOUTH WINDOW"):
        expected = sum(float(row["solid_angle"]) * float(row["cosine"]) * float(row["sunlit_fraction"])
                       * radiances[int(row["patch"]) - 1] for row in rows if row["receiver"] == name)
        mean = expected.mean()
        (bias, rms), (their_bias, their_rms) = (
            (difference.mean() / mean, np.sqrt(np.mean(difference**2)) / mean)
            for difference in (ours[name][up] - expected, theirs[name][up] - expected))
        print(f"{name}: {mean:.1f} W/m2, ours {bias:+.4f} (rms {rms:.4f}), "
              f"EnergyPlus's {their_bias:+.4f} (rms {their_rms:.4f})")
        # Radiance's patches are others, and each has the radiance of its middle.
        assert abs(bias) < 0.015 and rms < 0.06
        if name != "ROOF":
            assert their_rms > 3 * rms


def days(text, more):
    """Two days of spring, with a canopy and shades that change at noon."""
    found = re.sub(r"RunPeriod,[^;]*;", "RunPeriod,Days,4,2,,4,3;", text.replace(CANOPY, ""))
    assert found.count("RunPeriod,Days") == 1
    return found + more


NOON = "Schedule:Compact,Changes,,Through: 12/31,For: AllDays,Until: 12:00,{},Until: 24:00,{};\n"
OAK = "GPUShading:Tree,Oak,3,-3,0,7,5,1,Ellipsoid,0,Evergreen,{},{},0;\n"
SHALLOW = screened_room.ledge("Canopy", -0.5, 0.0, 2.7)
SAIL = CANOPY + "GPUShading:TransparentShade,Sail,Canopy,Constant,{};\n"
# What changes, and what it is before and after noon.
CHANGES = {
    "position": (CANOPY + NOON.format(0.25, 1)
                 + "GPUShading:MovingShade,Awning,Canopy,Extend,,0,-1,0,,,,,,,,,Changes;\n", SHALLOW, CANOPY),
    "transmittance": (CANOPY.replace("Canopy,,", "Canopy,Changes,") + NOON.format(0.6, 0.1),
                      SAIL.format(0.6), SAIL.format(0.1)),
    "leaves": (OAK.format("Changes", 0.8) + NOON.format(0.25, 1), OAK.format("", 0.2), OAK.format("", 0.8)),
    "leaves and position": (
        SHALLOW.replace("Canopy", "Awning") + OAK.format("Changes", 0.8) + NOON.format(0.25, 1)
        + "GPUShading:MovingShade,Awning,Awning,Extend,,0,-1,0,,,,,,,,,Changes;\n",
        OAK.format("", 0.2) + screened_room.ledge("Awning", -0.125, 0.0, 2.7),
        OAK.format("", 0.8) + SHALLOW.replace("Canopy", "Awning")),
}


@pytest.mark.parametrize("name", CHANGES)
def test_shades_count_as_they_are_at_the_time(patched, weather, model, tmp_path, name):
    runs = [run(patched, weather, tmp_path / str(i), days(model, text), FLAG) for i, text in enumerate(CHANGES[name])]
    assert "position at rest" not in runs[0].text("eplusout.err")
    changing, before, after = (series(done, SKY) for done in runs)
    morning = np.arange(48) % 24 < 12
    for wall in ("SOUTH", "SOUTH WINDOW", "WEST"):
        expected = np.where(morning, before[wall], after[wall])
        difference = np.abs(changing[wall] - expected).max()
        print(f"{wall}: largest difference {difference:.1e} of {expected.max():.1f} W/m2, "
              f"{np.abs(before[wall] - after[wall]).max():.1f} between the two")
        assert difference < 1e-5
    assert np.abs(before["SOUTH WINDOW"] - after["SOUTH WINDOW"]).max() > 5


def test_settings_of_the_model_choose_the_sky(patched, weather, model, tmp_path):
    text = days(model, CANOPY)
    flag, settings, plain = (
        series(run(patched, weather, tmp_path / str(i), text + more, *options), SKY)["SOUTH"].tolist()
        for i, (more, *options) in enumerate([("", FLAG), ("GPUShading:Settings,,,,,perez-patches;\n",), ("",)]))
    assert flag == settings != plain


def test_other_methods_are_refused(patched, weather, model, tmp_path):
    done = run(patched, weather, tmp_path / "run", model, FLAG, "--gpu-shading-method=scheduled")
    assert not done.completed
    assert "--gpu-shading-sky: perez-patches needs --gpu-shading-method patched" in done.errors

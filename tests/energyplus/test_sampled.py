"""Sampled sun positions: whole runs against rendering every timestep, and our sun against EnergyPlus's."""

import datetime
import math
import os
import sqlite3
import subprocess

import pytest
from shading_runs import energyplus, input_file, results

LATITUDES = (0.0, 42.0, 66.5, 80.0, -35.0)
LONGITUDE, ZONE = -105.18, -7.0  # of the weather file
DAYS = ((3, 25), (6, 18), (11, 30))
NORTH_AXIS = (1, "north_axis")


@pytest.fixture
def weather_at(weather, tmp_path):
    """The weather file moved to another latitude; EnergyPlus takes the sun's positions from there."""

    def call(latitude):
        first, rest = weather.read_text(encoding="latin-1").split("\n", 1)
        fields = first.split(",")
        fields[6] = f"{latitude:.2f}"
        path = tmp_path / f"at{latitude}.epw"
        path.write_text(",".join(fields) + "\n" + rest, encoding="latin-1")
        return path

    return call


def of_days(text, days):
    """The model with one run period for each (month, day)."""
    model = input_file.Idf(text)
    model.remove(lambda name: name == "runperiod")
    for month, day in days:
        model.add("RunPeriod", [f"Day {month} {day}", month, day, "", month, day, "", "Sunday"])
    return model


@pytest.fixture
def shade(patched, tmp_path):
    """Runs a model with an update; its results at every timestep."""

    def call(model, weather, update):
        model = model.copy()
        results.instrument(model, "Timestep")
        model.write(tmp_path / "model.idf")
        flags = ["--gpu-shading", "--gpu-shading-resolution=128", f"--gpu-shading-update={update}"]
        run = energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "run", flags)
        assert run.completed, run.why()
        return run, results.Results(tmp_path / "run", "Zone Timestep")

    return call


def mean_of(found):
    assert found
    return sum(each.mean * len(each.values) for each in found) / sum(len(each.values) for each in found)


@pytest.mark.parametrize("latitude", LATITUDES)
def test_sampled_run_is_near_the_exact_one(shade, weather_at, box, latitude):
    model = of_days(box, DAYS)
    weather = weather_at(latitude)
    _, exact = shade(model, weather, "timestep")
    run, sampled = shade(model, weather, "sampled:medium")
    assert "answered from samples at 320, --gpu-shading-update sampled:medium" in "\n".join(run.our_lines)
    assert mean_of(results.differences(exact, sampled)) < 5e-3
    assert sampled.total(results.BEAM) == pytest.approx(exact.total(results.BEAM), rel=5e-3)


def test_turned_building_and_the_papers_grid(shade, weather_at, courtyard):
    """The sun's directions are true north's, whatever the building's axis."""
    model = of_days(courtyard.read_text(), [(5, 10)])
    model.set_field("Building", NORTH_AXIS, "35")
    weather = weather_at(42.0)
    _, exact = shade(model, weather, "timestep")
    ours, paper = (mean_of(results.differences(exact, shade(model, weather, f"sampled:{name}")[1]))
                   for name in ("medium", "paper-medium"))
    assert ours < 5e-3
    assert ours < paper / 3


def vector(azimuth, altitude):
    azimuth, altitude = math.radians(azimuth), math.radians(altitude)
    return (math.cos(altitude) * math.sin(azimuth), math.cos(altitude) * math.cos(azimuth), math.sin(altitude))


def our_suns(latitude, steps):
    folder = energyplus.REPOSITORY / os.environ.get("GPU_SHADING_BUILD", "build") / "tests" / "unit" / "solar"
    program = folder / "print_sun_positions"
    if not program.is_file():
        pytest.skip(f"{program} is missing: run scripts/build")
    printed = subprocess.run([program, *map(str, (latitude, LONGITUDE, ZONE, steps))], check=True,
                             capture_output=True, text=True).stdout
    rows = (line.split() for line in printed.splitlines())
    return {(int(day), int(step)): vector(float(azimuth), float(altitude)) for day, step, azimuth, altitude in rows}


def energyplus_suns(path, steps):
    query = ("SELECT Month, Day, Hour, Minute, Name, Value FROM ReportData JOIN Time USING (TimeIndex) "
             "JOIN ReportDataDictionary USING (ReportDataDictionaryIndex) WHERE Name LIKE 'Site Solar A%' "
             "AND EnvironmentPeriodIndex = (SELECT MAX(EnvironmentPeriodIndex) FROM EnvironmentPeriods)")
    angles = {}
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as data:
        for month, day, hour, minute, name, value in data.execute(query):
            place = (datetime.date(2023, month, day).timetuple().tm_yday, (60 * hour + minute) * steps // 1440)
            angles.setdefault(place, {})[name] = value
    data.close()
    return {place: vector(both["Site Solar Azimuth Angle"], both["Site Solar Altitude Angle"])
            for place, both in angles.items() if both["Site Solar Altitude Angle"] > 0.01}


@pytest.mark.parametrize("latitude", LATITUDES)
def test_sun_stands_where_energyplus_has_it(official, weather_at, box, tmp_path, latitude):
    """At every timestep of a year, daylight saving in force: clocks turn, the sun does not."""
    steps = 48
    model = input_file.Idf(box)
    model.set_field("Timestep", (0, "number_of_timesteps_per_hour"), str(steps // 24))
    model.remove(lambda name: name.startswith("shading:"))
    model.add("RunPeriodControl:DaylightSavingTime", ["April 9", "October 8"])
    model.add_unique("Output:SQLite", ["Simple"], ["option_type"])
    model.add_output_variable("Site Solar Azimuth Angle", "Timestep")
    model.add_output_variable("Site Solar Altitude Angle", "Timestep")
    model.write(tmp_path / "sun.idf")
    run = energyplus.run(official, tmp_path / "sun.idf", weather_at(latitude), tmp_path / "run")
    assert run.completed, run.why()
    ours, theirs = our_suns(latitude, steps), energyplus_suns(tmp_path / "run" / "eplusout.sql", steps)
    assert len(theirs) > 365 * steps / 2 * 0.95
    largest = 0.0
    for (day, step), (east, north, up) in theirs.items():
        if step == steps:
            # In polar day EnergyPlus reports the sun of midnight, 0:00, on the same side as that of the hour before,
            # though the sun's own midnight may have been earlier.
            east = math.copysign(east, ours[day, step][0])
        largest = max(largest, math.dist((east, north, up), ours.get((day, step), (0.0, 0.0, 0.0))))
    assert math.degrees(largest) < 0.02

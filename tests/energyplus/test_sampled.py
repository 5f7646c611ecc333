"""Sampled sun positions: whole runs against rendering every timestep, and our sun against EnergyPlus's."""

import csv
import datetime
import math
import os
import re
import shutil
import sqlite3
import subprocess

import pytest
from eso_file import EsoFile
from shading_runs import energyplus, input_file, results

LATITUDES = (0.0, 42.0, 66.5, 80.0, -35.0)
LONGITUDE, ZONE = -105.18, -7.0  # of the weather file
DAYS = ((3, 25), (6, 18), (11, 30))
NORTH_AXIS = (1, "north_axis")


@pytest.fixture
def weather_at(weather, tmp_path):
    """The weather file moved to another latitude."""
    return lambda latitude: energyplus.move_weather(weather, latitude, tmp_path)


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

    def call(model, weather, update, *options):
        model = model.copy()
        results.instrument(model, "Timestep")
        model.write(tmp_path / "model.idf")
        flags = ["--gpu-shading", "--gpu-shading-resolution=128", f"--gpu-shading-update={update}", *options]
        shutil.rmtree(tmp_path / "run", ignore_errors=True)
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
    found = re.search(r"answered from samples at (\d+), --gpu-shading-update sampled:medium", "\n".join(run.our_lines))
    assert 320 <= int(found[1]) <= 640
    assert mean_of(results.differences(exact, sampled)) < 5e-3
    assert sampled.total(results.BEAM) == pytest.approx(exact.total(results.BEAM), rel=5e-3)


def test_turned_building_and_the_papers_grid(shade, weather_at, courtyard):
    """The sun's directions are true north's, whatever the building's axis."""
    model = of_days(courtyard.read_text(), [(5, 10)])
    model.set_field("Building", NORTH_AXIS, "35")
    weather = weather_at(42.0)
    _, exact = shade(model, weather, "timestep")
    ours, paper = (mean_of(results.differences(exact, shade(model, weather, "sampled:medium", *options)[1]))
                   for options in ([], ["--gpu-shading-paper-grid"]))
    assert ours < 5e-3
    assert ours < paper / 3


def test_compare_sampling_says_what_its_runs_reported(patched, weather, box, tmp_path):
    """Its table against the reports that it does not read."""
    of_days(box, [(6, 18)]).write(tmp_path / "box.idf")
    subprocess.run([energyplus.REPOSITORY / "scripts" / "compare_sampling", tmp_path / "box.idf", "-w", weather,
                    "--latitudes", "30", "--updates", "coarse", "-o", tmp_path / "out",
                    "--", "--gpu-shading-resolution=128"], check=True, capture_output=True, text=True)
    exact, sampled = (EsoFile(tmp_path / "out" / "box_at_30" / folder / "eplusout.eso", "TimeStep").values
                      for folder in ("exact", "coarse"))
    errors, suns = {}, set()
    for (variable, name), fractions in exact.items():
        if variable == results.SUNLIT:
            facing = [when for when, cosine in exact[results.COSINE, name].items() if cosine > results.FACING]
            # Outputs with the key * want the louvre's own fractions too.
            if "LOUVRE" in name:
                suns.update(facing)
            elif any(fractions[when] < 0.999 for when in facing):
                suns.update(facing)
                errors[name] = [abs(sampled[variable, name][when] - fractions[when]) for when in facing]
    assert errors
    all_errors = sum(errors.values(), [])
    ((_, window),) = [place for place in exact if place[0] == results.BEAM]
    beam = [sum(values[results.BEAM, window].values()) for values in (exact, sampled)]
    beam_error = 100 * (beam[1] / beam[0] - 1)

    row = [each.strip() for each in (tmp_path / "out" / "compare_sampling.md").read_text().splitlines()[-1].split("|")]
    assert row[1:4] == ["box at 30", "coarse", str(len(errors))]
    assert float(row[4]) == pytest.approx(sum(all_errors) / len(all_errors), rel=0.05)
    assert float(row[5]) == pytest.approx(max(sum(each) / len(each) for each in errors.values()), rel=0.05)
    assert float(row[6]) == pytest.approx(max(all_errors), abs=0.006)
    assert float(row[7]) == float(row[8]) == pytest.approx(beam_error, abs=0.006)
    assert 238 <= int(row[9]) <= 309
    assert float(row[10]) == pytest.approx(100 * int(row[9]) / len(suns), rel=1e-3)
    with open(tmp_path / "out" / "receivers.csv", newline="", encoding="utf-8") as file:
        of_receivers = {row["receiver"]: row for row in csv.DictReader(file)}
    assert set(of_receivers) == set(errors)
    assert float(of_receivers[window]["beam %"]) == pytest.approx(beam_error, abs=1e-3)
    for name, each in errors.items():
        assert float(of_receivers[name]["mean"]) == pytest.approx(sum(each) / len(each), abs=2e-6)
        assert float(of_receivers[name]["max"]) == pytest.approx(max(each), abs=2e-6)


def vector(azimuth, altitude):
    azimuth, altitude = math.radians(azimuth), math.radians(altitude)
    return (math.cos(altitude) * math.sin(azimuth), math.cos(altitude) * math.cos(azimuth), math.sin(altitude))


def our_suns(latitude, steps):
    folder = energyplus.REPOSITORY / os.environ.get("GPU_SHADING_BUILD", "build") / "tests" / "gpu_shading" / "sun"
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

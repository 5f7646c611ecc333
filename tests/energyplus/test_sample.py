"""gpu_shading sample: samples without a run against EnergyPlus's own, and in shards against one go."""

import json
import os
import signal
import subprocess
import sys
import time
from datetime import datetime, timedelta
from pathlib import Path

import pytest
from output_files import rows_of
from shading_runs import energyplus, input_file, results

TABLES = ("samples.csv", "year.csv", "samples.json")
MODEL_YEAR = 2017
DAYS = ((3, 25), (6, 17), (11, 30))  # Saturdays, and a Thursday
RESOLUTION = "--gpu-shading-resolution=128"


def of_days(path, days=DAYS):
    """The model with one run period for each (month, day), whose schedules tell days of the week apart."""
    model = input_file.read(path)
    model.remove(lambda name: name == "runperiod")
    for month, day in days:
        model.add("RunPeriod", [f"Day {month} {day}", month, day, MODEL_YEAR, month, day, MODEL_YEAR])
    return model


@pytest.fixture(scope="session")
def courtyard_model(courtyard, tmp_path_factory):
    """The courtyard behind a hedge, which lets more pass in the afternoon and on weekdays."""
    model = of_days(courtyard)
    model.add("Schedule:Compact", ["Leaves", "", "Through: 12/31", "For: Weekdays", "Until: 12:00", "0.2",
                                   "Until: 24:00", "0.7", "For: AllOtherDays", "Until: 24:00", "0.1"])
    model.add("Shading:Building:Detailed", ["Hedge", "Leaves", 4, -2, -3, 2, -2, -3, 0, 14, -3, 0, 14, -3, 2])
    results.instrument(model, "Timestep")
    path = tmp_path_factory.mktemp("input") / "courtyard.idf"
    model.write(path)
    return path


def program(arguments):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    command = [energyplus.patched_prefix() / "gpu_shading", "sample", *arguments]
    return subprocess.run(command, capture_output=True, text=True, env=environment)


@pytest.fixture(scope="session")
def courtyard_samples(patched, courtyard_model, weather, tmp_path_factory):
    folder = tmp_path_factory.mktemp("courtyard") / "samples"
    done = program([courtyard_model, "-w", weather, "-o", folder, RESOLUTION])
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [str(folder / name) for name in TABLES]
    return folder


@pytest.fixture(scope="session")
def courtyard_run(patched, courtyard_model, weather, tmp_path_factory):
    """The model's days, by way of an update."""

    def call(update, *flags):
        folder = tmp_path_factory.mktemp("run") / "out"
        run = energyplus.run(patched, courtyard_model, weather, folder,
                             ["--gpu-shading", RESOLUTION, f"--gpu-shading-update={update}", *flags])
        assert run.completed, run.why()
        return folder

    return call


@pytest.fixture(scope="session")
def sampled_run(courtyard_run, tmp_path_factory):
    report = tmp_path_factory.mktemp("report")
    return courtyard_run("sampled:medium", f"--gpu-shading-report={report}"), report


def place_of(*angles):
    """In ten-thousandths of a degree, as far as a report tells them."""
    return tuple(round(float(angle) * 1e4) for angle in angles)


def test_samples_are_those_that_energyplus_has_rendered(courtyard_samples, sampled_run):
    """At the same directions; in a report what passes schedules has the values of the last timestep, midnight."""
    _, report = sampled_run
    theirs, ours = {}, {}
    for row in rows_of(report / "sunlit.csv"):
        sun = place_of(row["sun azimuth [deg]"], row["sun altitude [deg]"])
        theirs.setdefault(row["receiver"], {})[sun] = float(row["sunlit fraction"])
    for row in rows_of(courtyard_samples / "samples.csv"):
        factor = {"": 1.0, "LEAVES": 0.7}[row["scheduled"]]  # the last day is a Thursday
        sums = ours.setdefault(row["receiver"], {})
        sun = place_of(row["azimuth"], row["altitude"])
        sums[sun] = sums.get(sun, 0.0) + factor * float(row["sunlit_fraction"])
    assert 320 <= len(set().union(*ours.values())) <= 640
    assert sum(row["scheduled"] != "" for row in rows_of(courtyard_samples / "samples.csv")) > 200
    compared = 0
    for receiver, samples in ours.items():
        for (azimuth, altitude), fraction in samples.items():
            if receiver not in theirs:
                # Nothing shades it: EnergyPlus does not ask.
                assert fraction == 1.0
                continue
            # The fourth decimal may be rounded either way.
            near = [theirs[receiver][azimuth + a, altitude + b] for a in (0, 1, -1) for b in (0, 1, -1)
                    if (azimuth + a, altitude + b) in theirs[receiver]]
            assert near, (receiver, azimuth, altitude)
            assert fraction == pytest.approx(near[0], abs=2e-6), (receiver, azimuth, altitude)
            compared += 0.01 < fraction < 0.99
    assert set(theirs) <= set(ours)
    assert compared > 500


def fractions_of_year(folder):
    return {datetime.fromisoformat(row["time"]): row for row in rows_of(folder / "year.csv")}


def pairs(folder, run):
    """[(of year.csv, of the run)] wherever the sun stands before a receiver."""
    year, found = fractions_of_year(folder), results.Results(run, "Zone Timestep")
    compared = []
    for receiver, values in found.values[results.SUNLIT].items():
        for place in found.sun_up(receiver):
            _, month, day, hour, minute = found.times[place]
            row = year[datetime(MODEL_YEAR, month, day) + timedelta(hours=hour, minutes=minute)]
            compared.append((float(row[receiver]), values[place]))
    return compared


def test_year_is_what_a_sampled_run_answers(courtyard_samples, sampled_run):
    """Schedules' values of the calendar in it."""
    compared = pairs(courtyard_samples, sampled_run[0])
    assert sum(0.05 < theirs < 0.95 for _, theirs in compared) > 300
    # On some days EnergyPlus reports the sun up to 0.001 degrees from where it shades by.
    errors = [abs(ours - theirs) for ours, theirs in compared]
    assert max(errors) < 3e-4
    assert sum(errors) / len(errors) < 1e-5


def test_year_is_near_the_exact_one(courtyard_samples, courtyard_run):
    compared = pairs(courtyard_samples, courtyard_run("timestep"))
    assert sum(abs(ours - theirs) for ours, theirs in compared) / len(compared) < 5e-3


def test_tables_have_the_stated_schema(courtyard_samples, courtyard_model):
    about = json.loads((courtyard_samples / "samples.json").read_text())
    names = [receiver["name"] for receiver in about["receivers"]]
    assert about["directions"] == sum(about["directions_by_round"])
    assert 320 <= about["directions"] <= 640
    assert all(0 <= receiver["expected_error"] < 0.02 for receiver in about["receivers"])
    assert about["schedules"] == ["LEAVES"]
    assert about["inputs"]["model"]["name"] == courtyard_model.name
    year = rows_of(courtyard_samples / "year.csv")
    assert list(year[0]) == ["time", "azimuth", "altitude", *names]
    assert len(year) == about["year"]["rows"] == 365 * 96
    assert (year[0]["time"], year[-1]["time"]) == ("2017-01-01 00:15", "2018-01-01 00:00")
    for row in year:
        values = [float(row[name]) for name in names]
        assert min(values) >= 0.0 and max(values) <= 1.0
        if float(row["altitude"]) < 0.0:
            assert not any(values)
    samples = rows_of(courtyard_samples / "samples.csv")
    assert list(samples[0]) == ["receiver", "azimuth", "altitude", "scheduled", "sunlit_fraction"]
    assert {row["receiver"] for row in samples} <= set(names)


@pytest.fixture
def box_model(box, tmp_path):
    path = tmp_path / "box.idf"
    path.write_text(box)
    return path


PLAN = """
task = "sample"
models = {models}
weather = "{weather}"
mode = "{mode}"
shards = {shards}
options = {{ resolution = 128 }}
"""


class Driver:
    """A study that samples, running in a process group of its own."""

    def __init__(self, folder, models, weather, mode, shards):
        plan = folder / "plan.toml"
        plan.write_text(PLAN.format(models=[str(model) for model in models], weather=weather, mode=mode, shards=shards))
        environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
        environment["PATH"] = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
        self.output = folder / "many"
        self.process = subprocess.Popen([energyplus.patched_prefix() / "gpu_shading", "study", plan, "-o", self.output,
                                         "--workers", "2"], text=True, env=environment, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, start_new_session=True)

    def rows(self):
        return {row["model"]: row for row in rows_of(self.output / "runs.csv")}

    def kill(self):
        """The driver, its workers and what they run, at once."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.communicate()

    def others(self):
        """Its processes other than itself: those of its group, and what runs for its folder."""
        found = []
        for stat in Path("/proc").glob("[0-9]*/stat"):
            try:
                state, _, group = stat.read_text().rpartition(")")[2].split()[:3]
                words = (stat.parent / "cmdline").read_bytes().decode(errors="replace")
            except (FileNotFoundError, ProcessLookupError):
                continue
            ours = int(group) == self.process.pid or str(self.output.parent) in words
            if ours and state != "Z" and stat.parent.name != str(self.process.pid):
                found.append(int(stat.parent.name))
        return found

    def finish(self):
        output, errors = self.process.communicate()
        return self.process.returncode, output, errors


def test_shards_killed_and_resumed_are_as_one_go(patched, box_model, weather, tmp_path):
    pytest.importorskip("distributed", reason="Dask is missing: run scripts/setup")
    flags = [RESOLUTION, "--mode", "coarse"]
    assert program([box_model, "-w", weather, "-o", tmp_path / "one", *flags]).returncode == 0

    driver = Driver(tmp_path, [box_model], weather, "coarse", 4)
    limit = time.monotonic() + 60.0
    while len(list(driver.output.glob("runs/*/parts/round*.json"))) < 6:
        assert driver.process.poll() is None and time.monotonic() < limit, driver.finish()
        time.sleep(0.02)
    driver.kill()
    (folder,) = driver.output.glob("runs/*")
    kept = {path: path.stat().st_mtime_ns for path in folder.glob("parts/round*.json")}
    rounds = len(json.loads((tmp_path / "one" / "samples.json").read_text())["directions_by_round"])
    assert 6 <= len(kept) < 4 * rounds
    assert not (folder / "samples.csv").exists()

    driver = Driver(tmp_path, [box_model], weather, "coarse", 4)
    status, _, errors = driver.finish()
    assert status == 0, errors
    # Of what was there nothing was rendered again.
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    assert len(list(folder.glob("parts/round*.json"))) == 4 * rounds
    about = json.loads((tmp_path / "one" / "samples.json").read_text())
    assert driver.rows()["box"]["directions rendered"] == str(about["directions"])
    for name in TABLES:
        assert (folder / name).read_bytes() == (tmp_path / "one" / name).read_bytes(), name


def test_workers_end_with_a_killed_driver(patched, box_model, weather, tmp_path):
    pytest.importorskip("distributed", reason="Dask is missing: run scripts/setup")
    driver = Driver(tmp_path, [box_model], weather, "fine", 4)
    limit = time.monotonic() + 60.0
    while len(driver.others()) < 6:  # two workers, their programs and EnergyPlus
        assert driver.process.poll() is None and time.monotonic() < limit, driver.finish()
        time.sleep(0.02)
    driver.process.kill()
    limit = time.monotonic() + 15.0
    while left := driver.others():
        assert time.monotonic() < limit, left
        time.sleep(0.1)
    driver.process.communicate()


def test_driver_goes_on_with_other_models(patched, box_model, weather, tmp_path):
    pytest.importorskip("distributed", reason="Dask is missing: run scripts/setup")
    (tmp_path / "bad.idf").write_text("Version,24.1;\n")
    driver = Driver(tmp_path, [tmp_path / "bad.idf", box_model], weather, "coarse", 1)
    status, _, errors = driver.finish()
    assert status == 1
    rows = driver.rows()
    assert (rows["bad"]["status"], rows["box"]["status"]) == ("failed", "done")
    assert rows["bad"]["message"] and errors.count(rows["bad"]["message"]) == 1


def last_line(done):
    assert done.returncode == 1
    lines = [line for line in done.stderr.splitlines() if "error: " in line]
    assert len(lines) == 1, done.stderr
    return lines[0]


def test_parts_of_another_model_are_not_taken(patched, box_model, louvres, weather, tmp_path):
    arguments = [box_model, "-w", weather, "-o", tmp_path / "out", "--mode", "coarse", RESOLUTION]
    assert program(arguments).returncode == 0
    before = (tmp_path / "out" / "year.csv").read_bytes()
    again = program(arguments)
    assert "0 directions rendered" in again.stderr
    box_model.write_text(louvres(20))
    refusal = last_line(program([*arguments, "--merge", "1"]))
    assert "parts/round1-shard1of1.json: belongs to coarse samples" in refusal
    assert (tmp_path / "out" / "year.csv").read_bytes() == before
    assert program(arguments).returncode == 0
    assert (tmp_path / "out" / "year.csv").read_bytes() != before
    part = tmp_path / "out" / "parts" / "round1-shard1of1.json"
    part.write_text(part.read_text()[:1000])
    assert "round1-shard1of1.json: is not a part of samples (" in last_line(program(arguments))


MOVING = """
Schedule:Compact,Moving,,Through: 12/31,For: AllDays,Until: 12:00,0,Until: 24:00,1;
GPUShading:PerforatedScreen,Mesh,*,Round,,Staggered60,0.005,,0.008,,0.003,,,,,,,,,,,Moving;
"""


@pytest.mark.parametrize("arguments, words", [
    ((), "-w: a weather file is required"),
    (("-w", "WEATHER", "--shard", "9/8"), "--shard 9/8: expected I/N"),
    (("-w", "WEATHER", "--merge", "8"), "parts/round1-shard1of8.json: is missing"),
    (("-w", "model.idf"), "box.idf: is not a weather file (.epw), which begins with LOCATION"),
    (("-w", "WEATHER", "--gpu-shading-device=nothing"), "--gpu-shading-device is \"nothing\""),
])
def test_errors_are_one_line(patched, box_model, weather, tmp_path, arguments, words):
    named = {"WEATHER": weather, "model.idf": box_model}
    done = program([box_model, "-o", tmp_path / "out", *(named.get(word, word) for word in arguments)])
    assert words in last_line(done)
    assert not list(tmp_path.glob("out/*.*"))


def test_screens_that_move_are_refused(patched, box_model, weather, tmp_path):
    box_model.write_text(box_model.read_text() + MOVING)
    done = program([box_model, "-w", weather, "-o", tmp_path / "out"])
    assert "Deployment Schedule Name MOVING: has values from 0 to 1" in last_line(done)

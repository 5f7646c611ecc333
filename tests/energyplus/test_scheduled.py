"""Sunlit fractions as schedules, for an EnergyPlus that cannot be patched, against the patched one."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from shading_runs import energyplus, input_file, results

# Twice the default error: where an edge is nearly parallel to a row of samples, the last digits of the sun's direction,
# which differ, decide on which side of it the row is. And what the five decimals of EnergyPlus's drawing move.
MOST = 2e-3

SCRIPT = energyplus.REPOSITORY / "scripts" / "patch_energyplus"
PLAIN_HOST = Path(__file__).resolve().parent / "hosts" / "plain_host.py"
RUN_PERIOD = ["name", "begin_month", "begin_day_of_month", "begin_year", "end_month", "end_day_of_month"]
YEAR = 2017
STEP = "Zone Timestep"


@pytest.fixture(scope="session")
def without_opengl():
    """Another build of EnergyPlus: a library alone, which has nothing to patch."""
    prefix = energyplus.REPOSITORY / ".venv" / "EnergyPlus-lbnl"
    if not (prefix / "libenergyplusapi.so").is_file():
        pytest.skip(f"{prefix} is missing: scripts/setup could not fetch pyenergyplus-lbnl")
    return prefix


@pytest.fixture(scope="session")
def unpatchable(without_opengl, tmp_path_factory):
    """The program that patch_energyplus makes of it."""
    dest = tmp_path_factory.mktemp("lbnl") / "EnergyPlus"
    build = energyplus.patched_prefix().parent
    done = subprocess.run([SCRIPT, without_opengl, dest, "--build", build], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "cannot be patched" in done.stdout
    assert "pip" not in {path.name for path in dest.iterdir()}
    return dest / "energyplus"


def of_days(path, first, last):
    """The model at path with one run period of a few days, and outputs at every timestep."""
    model = input_file.read(path)
    model.add_unique("RunPeriod", ["Days", *first, YEAR, *last], RUN_PERIOD)
    if "simulationcontrol" in model.classes():
        model.set_field("SimulationControl", (3, "run_simulation_for_sizing_periods"), "No")
        model.set_field("SimulationControl", (4, "run_simulation_for_weather_file_run_periods"), "Yes")
    results.instrument(model, "Timestep")
    return model


@pytest.fixture(scope="session")
def write_model(courtyard, louvres, tmp_path_factory):
    def write(name):
        folder = tmp_path_factory.mktemp(name)
        if name == "courtyard":
            path, days = courtyard, ((3, 20), (3, 21))
        elif name == "louvres":
            path, days = folder / "louvres.idf", ((6, 1), (6, 1))
            path.write_text(louvres(20))
        else:
            path, days = energyplus.models_folder() / name, ((9, 21), (9, 21))
            if not path.is_file():
                pytest.skip(f"{path} is missing: name the collection with GPU_SHADING_MODELS")
        return input_file.place_copy(of_days(path, *days), path, folder / "input")

    return write


MODELS = ["courtyard", "louvres", "SolarShadingTest.epJSON"]


@pytest.fixture(scope="session")
def by_patch(patched, write_model, weather, tmp_path_factory):
    """The model and what the patched road makes of it, once each."""
    known = {}

    def find(name):
        if name not in known:
            model = write_model(name)
            run = energyplus.run(patched, model, weather, tmp_path_factory.mktemp("patched") / "out",
                                 ["--gpu-shading", "--gpu-shading-update=timestep"])
            assert run.completed, run.why()
            known[name] = model, results.Results(run.folder, STEP)
        return known[name]

    return find


def expect_equal_fractions(reference, folder):
    found = results.differences(reference, results.Results(folder, STEP))
    # The sun moves shadows over at least some of them.
    assert any(0.05 < value < 0.95 for difference in found for value in difference.reference)
    worst = max(found, key=lambda difference: difference.largest)
    assert worst.largest < MOST, worst.receiver.name


def expect_scheduled(run):
    assert run.completed, run.why()
    assert run.method == "Scheduled"
    assert "** Severe" not in run.text("eplusout.err")
    for text in (run.errors, run.text("eplusout.err")):
        assert text.count("scheduled sunlit fractions apply") == 1


@pytest.mark.parametrize("name", MODELS)
def test_scheduled_is_as_patched(name, by_patch, patched, weather, tmp_path):
    model, reference = by_patch(name)
    run = energyplus.run(patched, model, weather, tmp_path / "out", ["--gpu-shading-method=scheduled"])
    expect_scheduled(run)
    expect_equal_fractions(reference, run.folder)


def test_from_samples(by_patch, patched, weather, tmp_path):
    model, reference = by_patch("courtyard")
    run = energyplus.run(patched, model, weather, tmp_path / "out",
                         ["--gpu-shading-method=scheduled", "--gpu-shading-update=sampled:medium"])
    expect_scheduled(run)
    assert 320 <= int(re.search(r"answered from samples at (\d+)", run.errors)[1]) <= 640
    found = results.differences(reference, results.Results(run.folder, STEP))
    assert sum(each.mean for each in found) / len(found) < 5e-3


@pytest.mark.parametrize("name", MODELS)
def test_chosen_by_itself_where_the_library_cannot_be_patched(name, by_patch, unpatchable, weather, tmp_path):
    model, reference = by_patch(name)
    run = energyplus.run(unpatchable, model, weather, tmp_path / "out", ["--gpu-shading"])
    expect_scheduled(run)
    assert "are passed as schedules" in run.errors
    expect_equal_fractions(reference, run.folder)


def test_without_the_flag_the_library_runs_as_it_is(unpatchable, write_model, weather, tmp_path):
    run = energyplus.run(unpatchable, write_model("louvres"), weather, tmp_path / "out", [])
    assert run.completed, run.why()
    assert run.method == "PolygonClipping"


def test_patching_can_be_insisted_on(unpatchable, write_model, weather, tmp_path):
    run = energyplus.run(unpatchable, write_model("louvres"), weather, tmp_path / "out",
                         ["--gpu-shading-method=patched"])
    assert run.status == 1
    assert "cannot be redirected" in run.errors
    assert "cannot be redirected" in (tmp_path / "out" / "eplusout.err").read_text()


def test_an_exported_model_runs_in_any_program(unpatchable, without_opengl, by_patch, weather, tmp_path):
    model, reference = by_patch("courtyard")
    done = subprocess.run([unpatchable.parent / "gpu_shading", "export", model, "-w", weather, "--scheduled",
                           tmp_path / "model"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    exported = Path(done.stdout.strip())
    # The folder may be taken anywhere.
    elsewhere = exported.parent.rename(tmp_path / "elsewhere") / exported.name
    command = [sys.executable, PLAIN_HOST, without_opengl, "-w", weather, "-d", tmp_path / "out", elsewhere]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    expect_equal_fractions(reference, tmp_path / "out")


# Louvres that a schedule opens by the clock, while daylight saving is in force; a surface with a local
# environment of its own.
SUMMER_TIME = """
RunPeriodControl:DaylightSavingTime,4/1,10/1;
Schedule:Compact,Opening,,Through: 12/31,For: Saturday,Until: 24:00,0.9,
  For: AllOtherDays,Until: 10:00,0.2,Until: 14:15,0.7,Until: 24:00,0;
SurfaceProperty:LocalEnvironment,Mine,South Window,,,,;
"""


def test_schedules_and_summer_time(louvres, patched, weather, tmp_path):
    text = louvres(3)
    model = tmp_path / "model.idf"
    model.write_text(text + SUMMER_TIME)
    edited = of_days(model, (6, 1), (6, 1))
    for number, (kind, _, _, _) in enumerate(edited.objects):
        if kind.startswith("shading:") and kind.endswith(":detailed"):
            start, stop = edited.objects[number][1][1 if "zone" not in kind else 2]
            edited._replace([(start, stop, "Opening")])
    edited.write(model)
    reference = energyplus.run(patched, model, weather, tmp_path / "patched",
                               ["--gpu-shading", "--gpu-shading-update=timestep"])
    run = energyplus.run(patched, model, weather, tmp_path / "scheduled", ["--gpu-shading-method=scheduled"])
    assert reference.completed, reference.why()
    expect_scheduled(run)
    expect_equal_fractions(results.Results(reference.folder, STEP), run.folder)


def test_nothing_is_rendered_without_a_run_period(patched, courtyard, weather, tmp_path):
    run = energyplus.run(patched, courtyard, weather, tmp_path / "out", ["--gpu-shading-method=scheduled", "-D"])
    assert run.completed, run.why()
    assert "all shading is computed by polygon clipping" in run.text("eplusout.err")
    assert "shading rendered" not in run.errors


@pytest.mark.parametrize("arguments, words", [
    (["--scheduled", "out"], "-w: a weather file is required"),
    (["-w", "weather"], "Exactly 1 option from [--scheduled,--surroundings] is required"),
    (["-w", "weather", "--scheduled", "."], "choose another folder"),
    (["-w", "weather", "--imported", "sunlit.csv"], "--imported: no such flag"),
])
def test_export_says_what_is_wrong(arguments, words, patched, courtyard, weather, tmp_path):
    (tmp_path / "mine").write_text("")
    arguments = [str(weather) if word == "weather" else word for word in arguments]
    done = subprocess.run([patched.parent / "gpu_shading", "export", courtyard, *arguments], cwd=tmp_path,
                          capture_output=True, text=True)
    assert done.returncode != 0
    assert words in done.stderr + done.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]

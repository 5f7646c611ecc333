"""The cache across runs: what it answers, what it must not answer, and what a user is told of it."""

import re
import shutil
import subprocess

import pytest
from output_files import masked
from shading_runs import energyplus, input_file, results

SCHEDULED = (
    "ScheduleTypeLimits,Fraction,0,1,Continuous;"
    "Schedule:Compact,Leaves,Fraction,Through: 12/31,For: AllDays,Until: 12:00,{morning},Until: 24:00,0.8;"
)


@pytest.fixture
def cache(tmp_path):
    return tmp_path / "cache"


@pytest.fixture
def shade(patched, weather, tmp_path, cache):
    """Runs a model, given as text, with the cache; all runs go to one folder, since its name is in outputs."""

    def call(text, *options, environment=None, folder=cache):
        model = input_file.Idf(text)
        results.instrument(model)
        model.write(tmp_path / "model.idf")
        flags = ["--gpu-shading", *options, "-D", "-r"]
        if folder:
            flags.append(f"--gpu-shading-cache={folder}")
        shutil.rmtree(tmp_path / "run", ignore_errors=True)
        return energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "run", flags, environment)

    return call


def counts(run):
    """(directions rendered, directions from the cache)."""
    assert run.completed, run.why()
    found = re.search(r"(\d+) directions rendered, (\d+) from the cache", run.rendering)
    assert found, run.rendering
    return int(found[1]), int(found[2])


def outputs(run):
    """What the run has computed, byte for byte."""
    files = {path.name: masked(path.read_bytes()) for path in run.folder.iterdir()
             if path.suffix in (".eso", ".mtr", ".csv")}
    assert "eplusout.eso" in files and any(name.endswith(".csv") for name in files)
    return files


def stored(folder):
    return sorted(folder.glob("*.sunlit"))


def all_from_cache(run, directions):
    rendered, from_cache = counts(run)
    # The first direction is rendered again and again, as its receivers become known.
    assert rendered == 0 and 0.9 * directions < from_cache <= directions
    assert ", 0 views drawn, 0 clear," in run.rendering


def test_second_run_renders_nothing_and_answers_the_same(shade, courtyard, cache):
    text = courtyard.read_text()
    plain = outputs(shade(text, folder=None))
    first = shade(text)
    assert outputs(first) == plain
    directions, from_cache = counts(first)
    assert directions > 0 and from_cache == 0
    assert len(stored(cache)) == 1
    again = shade(text)
    all_from_cache(again, directions)
    assert outputs(again) == plain


def test_interiors_are_kept_too(shade, box):
    """The box computes how the beam falls on its inside (FullInteriorAndExterior)."""
    assert "FullInteriorAndExterior" in box
    first = outputs(shade(box))
    again = shade(box)
    all_from_cache(again, counts(again)[1])
    assert outputs(again) == first


@pytest.mark.parametrize(
    "old, new",
    [
        ("Glazing,1.4,0.6;", "Glazing,2.8,0.3;"),
        ("Heating Setpoint,Temperature,20;", "Heating Setpoint,Temperature,15;"),
        ("Insulation,Rough,0.1,0.04", "Insulation,Rough,0.2,0.04"),
        ("Louvre 1", "Blade 1"),
    ],
    ids=["glass", "HVAC", "wall", "name"],
)
def test_what_is_no_matter_of_shading_renders_nothing_again(shade, box, old, new):
    assert old in box
    first = shade(box)
    directions, _ = counts(first)
    before = outputs(first)
    changed = shade(box.replace(old, new))
    all_from_cache(changed, directions)
    if old != "Louvre 1":
        assert outputs(changed) != before


def test_values_of_a_transmittance_schedule_render_nothing_again(shade, box, cache):
    leafy = box.replace("Louvre 1,,4,", "Louvre 1,Leaves,4,")
    assert leafy != box
    directions, _ = counts(shade(leafy + SCHEDULED.format(morning=0.2)))
    changed = shade(leafy + SCHEDULED.format(morning=0.4))
    all_from_cache(changed, directions)
    answers = outputs(changed)
    assert answers == outputs(shade(leafy + SCHEDULED.format(morning=0.4), folder=None))
    assert counts(shade(leafy + SCHEDULED.format(morning=0.8)))[0] == directions  # one value: no factor
    assert len(stored(cache)) == 2


@pytest.mark.parametrize("change", ["louvre", "resolution", "rule"])
def test_what_is_a_matter_of_shading_renders_again(shade, box, cache, change):
    directions, _ = counts(shade(box))
    text, options = box, []
    if change == "louvre":
        place = box.index("Louvre 1")
        text = box[:place] + box[place:].replace("-0.05", "-0.06")
        assert text != box
    elif change == "resolution":
        options = ["--gpu-shading-resolution=256"]
    else:
        text = box.replace("FullInteriorAndExterior", "MinimalShadowing")
    changed = shade(text, *options)
    without = shade(text, *options, folder=None)
    # With MinimalShadowing, EnergyPlus asks for no shading surface, and so for fewer directions.
    asked = directions if change != "rule" else int(re.search(r"(\d+) directions", without.rendering)[1])
    assert counts(changed) == (asked, 0)
    assert outputs(changed) == outputs(without)
    assert len(stored(cache)) == 2


def test_only_what_is_missing_is_rendered(shade, box):
    directions, _ = counts(shade(box))
    day = "Clear Autumn Day,        !- Name\n  10,                      !- Month\n  21, "
    assert day in box
    other_day = shade(box.replace(day, day.replace("10, ", "5, ").replace("21, ", "3, ")))
    rendered, from_cache = counts(other_day)
    assert rendered > directions / 4 and 0 < from_cache < directions
    all_from_cache(shade(box), directions)


def test_damaged_file_is_ignored_with_a_remark_and_replaced(shade, box, cache):
    first = shade(box)
    directions, _ = counts(first)
    answers = outputs(first)
    (file,) = stored(cache)
    good = file.read_bytes()
    for bad in (good[:-1], good[:1000] + bytes([good[1000] ^ 4]) + good[1001:], b""):
        file.write_bytes(bad)
        run = shade(box)
        assert counts(run) == (directions, 0)
        assert outputs(run) == answers
        (remark,) = [line for line in run.our_lines if str(file) in line]
        assert "is damaged: it is ignored" in remark
        assert "warning" not in remark
        all_from_cache(shade(box), directions)


def test_environment_names_it_and_off_overrides(shade, box, tmp_path):
    named = {"GPU_SHADING_CACHE": str(tmp_path / "made" / "here")}
    assert counts(shade(box, folder=None, environment=named))[0] > 0
    assert counts(shade(box, folder=None, environment=named))[0] == 0
    assert "cache" not in shade(box, folder="off", environment=named).rendering


def test_folder_that_cannot_be_written_to_is_refused(shade, box, tmp_path):
    (tmp_path / "file").write_text("")
    run = shade(box, folder=tmp_path / "file")
    assert run.status == 1
    (ours,) = [line for line in run.errors.splitlines() if line.startswith("gpu_shading: ")]
    assert "--gpu-shading-cache" in ours and str(tmp_path / "file") in ours
    assert "--gpu-shading-cache" in (run.folder / "eplusout.err").read_text()


def test_runs_at_the_same_time_share_a_folder(patched, box, weather, tmp_path, cache):
    model = tmp_path / "model.idf"
    model.write_text(box)
    variables = {key: value for key, value in energyplus.os.environ.items()
                 if key != "DISPLAY" and not key.startswith("GPU_SHADING")}
    running = []
    for number in range(4):
        folder = tmp_path / f"run{number}"
        folder.mkdir()
        running.append(subprocess.Popen(
            [patched, f"--gpu-shading-cache={cache}", "-D", "-w", weather, "-d", folder, model],
            cwd=folder, env=variables, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True))
    for process in running:
        _, errors = process.communicate(timeout=120)
        assert process.returncode == 0, errors
        assert "damaged" not in errors and "warning: --gpu-shading-cache" not in errors
    assert len(stored(cache)) == 1
    kept = [path.name for path in stored(cache)]
    assert sorted(path.name for path in cache.iterdir()) == sorted([*kept, "gpu_shading.lock"])
    run = energyplus.run(patched, model, weather, tmp_path / "run", [f"--gpu-shading-cache={cache}", "-D"])
    assert counts(run)[0] == 0

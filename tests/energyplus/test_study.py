"""Studies: tables against runs of their own, shared shading, and what is left after kills."""

import csv
import importlib.util
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from shading_runs import energyplus

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
DAY = "RunPeriod,Day,6,17,,6,17,,Sunday;\n"
PLAN = """
models = "buildings"
weather = "{weather}"
keep = "nothing"
options = {{ error = 0.01, update = "timestep" }}

[[variant]]
name = "plain"

[[variant]]
name = "cool"
set = {{ "Schedule:Constant/cooling*/Hourly Value" = 22 }}

[[variant]]
name = "bare"
remove = ["Shading:Building:Detailed"]
"""
REFLECTING = """
models = "model.idf"
weather = "{weather}"
options = {{ error = 0.01, update = "timestep", reflections = "all" }}

[[variant]]
name = "dark"

[[variant]]
name = "bright"
set = {{ "ShadingProperty:Reflectance/*/Diffuse Solar Reflectance of Unglazed Part of Shading Surface" = 0.9 }}
"""
SOLAR = "Enclosure Windows Total Transmitted Solar Radiation Energy"


@pytest.fixture(scope="module")
def gs(patched):
    if not importlib.util.find_spec("distributed"):
        pytest.skip("Dask is missing: run scripts/setup")
    import gpu_shading

    return gpu_shading


@pytest.fixture(scope="module")
def place(gs, louvres, weather, tmp_path_factory):
    """A plan for two models of one name, each with a day."""
    folder = tmp_path_factory.mktemp("study")
    for name, count in (("b1", 3), ("b2", 5)):
        text = louvres(count)
        begin = text.index("RunPeriod,")
        text = text[:begin] + DAY + text[text.index(";", begin) + 1:]
        (folder / "buildings" / name).mkdir(parents=True)
        (folder / "buildings" / name / "in.idf").write_text(text)
    (folder / "plan.toml").write_text(PLAN.format(weather=weather))
    return folder


class Command:
    """gpu_shading study, in a process group of its own."""

    def __init__(self, place, output, *flags, plan="plan.toml", **variables):
        environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
        environment |= {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"} | variables
        self.output = place / output
        program = energyplus.patched_prefix() / "gpu_shading"
        self.process = subprocess.Popen([program, "study", plan, "-o", output, *flags], cwd=place,
                                        env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        start_new_session=True)

    def finish(self, status=0):
        output, errors = self.process.communicate(timeout=300)
        assert self.process.returncode == status, errors
        return output, errors

    def wait_for(self, is_so):
        limit = time.monotonic() + 60
        while not is_so():
            assert self.process.poll() is None and time.monotonic() < limit, self.process.communicate()
            time.sleep(0.02)

    def records(self):
        return {path: path.stat().st_mtime_ns for path in self.output.glob("runs/*/record.json")}


def tables(folder):
    return [path.read_bytes() for path in sorted(folder.glob("runs.*"))]


def rows(folder):
    with open(folder / "runs.csv", newline="", encoding="utf-8") as lines:
        return {row["run"].rpartition("/")[0]: row for row in csv.DictReader(lines)}


@pytest.fixture(scope="module")
def reference(place):
    """With two workers."""
    output, errors = Command(place, "reference", "--workers", "2").finish()
    assert output == "reference/runs.csv\n"
    assert "6 of 6 runs, 0 failed" in errors and "dashboard" in errors
    return place / "reference"


def test_numbers_are_those_of_runs(gs, place, reference, weather, tmp_path):
    """Read from the SQLite file there, and from eplusout.eso here."""
    found = rows(reference)
    assert list(found) == [f"b{number}/in/{variant}" for number in (1, 2) for variant in ("plain", "cool", "bare")]
    cooling = "Zone Ideal Loads Supply Air Total Cooling Energy"
    text = (place / "buildings" / "b2" / "in.idf").read_text()
    (tmp_path / "model.idf").write_text(
        text.replace("Cooling Setpoint,Temperature,26", "Cooling Setpoint,Temperature,22") +
        "".join(f"Output:Variable,*,{name},RunPeriod;\n" for name in (SOLAR, cooling)))
    run = gs.run(tmp_path / "model.idf", weather, tmp_path / "out", error=0.01, update="timestep")
    row = found["b2/in/cool"]
    assert float(row["largest error"]) == run.summary().shading.largest
    assert float(row["Transmitted Solar [kWh]"]) == pytest.approx(run.values(SOLAR)["BOX"][-1] / 3.6e6, rel=1e-6)
    (energy,) = run.values(cooling).values()
    assert energy[-1] > 1e6
    # Tables have two decimals.
    assert float(row["Cooling District Cooling [kWh]"]) == pytest.approx(energy[-1] / 3.6e6, abs=0.0051)


def test_runs_of_one_scene_share_its_shading(reference):
    found = rows(reference)
    for building in ("b1", "b2"):
        plain, cool, bare = (found[f"{building}/in/{variant}"] for variant in ("plain", "cool", "bare"))
        assert plain["scene"] == cool["scene"] != bare["scene"]
        assert int(plain["directions rendered"]) > 20
        assert (cool["directions rendered"], cool["directions from the cache"]) == ("0", plain["directions rendered"])
        assert cool["largest error"] == plain["largest error"] != ""
        assert cool["Transmitted Solar [kWh]"] == plain["Transmitted Solar [kWh]"]
        assert float(bare["Transmitted Solar [kWh]"]) > float(plain["Transmitted Solar [kWh]"])
    assert len({row["scene"] for row in found.values()}) == 3  # without louvres, both are one box


def test_reflected_light_of_variants_is_that_of_runs(gs, place, weather, tmp_path):
    """Louvres of two reflectances are one scene, whose beam is rendered once."""
    text = (place / "buildings" / "b2" / "in.idf").read_text()
    white = "ShadingProperty:Reflectance,Louvre 1,{},0.2,0;\n"
    assert "Louvre 1" in text
    (tmp_path / "model.idf").write_text(text + white.format(0.2))
    (tmp_path / "plan.toml").write_text(REFLECTING.format(weather=weather))
    Command(tmp_path, "out", "--workers", "1").finish()
    dark, bright = found = [rows(tmp_path / "out")[f"model/{name}"] for name in ("dark", "bright")]
    assert dark["scene"] == bright["scene"] and bright["directions rendered"] == "0"
    for row, reflectance in zip(found, (0.2, 0.9), strict=True):
        model = tmp_path / f"{reflectance}.idf"
        model.write_text(text + white.format(reflectance) + f"Output:Variable,*,{SOLAR},RunPeriod;\n")
        run = gs.run(model, weather, tmp_path / str(reflectance), error=0.01, update="timestep", reflections="all")
        assert float(row["Transmitted Solar [kWh]"]) == pytest.approx(run.values(SOLAR)["BOX"][-1] / 3.6e6, rel=1e-6)
    assert float(bright["Transmitted Solar [kWh]"]) > 1.001 * float(dark["Transmitted Solar [kWh]"])


def test_all_scenes_are_checked_before_runs(reference):
    checked = [path.stat().st_mtime_ns for path in (reference / "scenes").iterdir()]
    done = [path.stat().st_mtime_ns for path in reference.glob("runs/*/record.json")]
    assert len(checked) == len(done) == 6 and max(checked) < min(done)


def test_the_table_is_the_same_with_one_worker_after_kills(place, reference):
    """The command is killed with all its processes, and then, of what resumes, each worker once."""
    command = Command(place, "killed", "--workers", "1", "--tries", "3")
    command.wait_for(lambda: len(command.records()) >= 2)
    os.killpg(command.process.pid, signal.SIGKILL)
    command.process.communicate()
    kept = command.records()
    assert 2 <= len(kept) < 6
    command = Command(place, "killed", "--workers", "1", "--tries", "3")
    command.wait_for(lambda: parents_of(command, "in.idf"))
    for worker in parents_of(command, "in.idf"):
        os.kill(worker, signal.SIGKILL)
    command.finish()
    assert {path: time_ for path, time_ in command.records().items() if path in kept} == kept
    assert tables(place / "killed") == tables(reference)
    assert not list(command.output.glob(".gpu_shading-*"))
    # All is there.
    began = command.records()
    Command(place, "killed").finish()
    assert command.records() == began and tables(place / "killed") == tables(reference)


def parents_of(command, word):
    """The processes of the command that started EnergyPlus."""
    found = set()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            line = (folder / "cmdline").read_bytes().decode(errors="replace")
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            if word in line and str(command.output) in line and "energyplus" in line:
                found.add(parent)
        except OSError:
            continue
    return found


def test_the_command_s_death_ends_its_workers(place):
    command = Command(place, "orphans", "--workers", "2")
    command.wait_for(lambda: parents_of(command, "in.idf"))
    workers = parents_of(command, "in.idf")
    command.process.kill()
    limit = time.monotonic() + 15
    while left := [worker for worker in workers if Path(f"/proc/{worker}").exists()]:
        assert time.monotonic() < limit, left
        time.sleep(0.1)
    command.process.communicate()


STAND_IN = """#!/bin/bash
model=${{@: -1}}
if grep -q HANGS "$model"; then sleep 1000; fi
if grep -q KILLS "$model"; then kill -9 $PPID; sleep 10; fi
exec {program} "$@"
"""


@pytest.fixture
def stand_in(patched, tmp_path):
    """An EnergyPlus that hangs or kills who started it, where a model says so."""
    folder = tmp_path / "prefix"
    folder.mkdir()
    for entry in patched.parent.iterdir():
        if entry.name != "energyplus":
            (folder / entry.name).symlink_to(entry)
    (folder / "energyplus").write_text(STAND_IN.format(program=patched))
    (folder / "energyplus").chmod(0o755)
    return folder


def test_others_go_on_where_runs_hang_kill_or_fail(place, reference, weather, stand_in):
    variants = {"fine": "", "hangs": 'objects = "! HANGS\\nOutput:Diagnostics;"', "kills": 'objects = "! KILLS\\n;"',
                "refused": 'set = {"FenestrationSurface:Detailed/*/Construction Name" = "Nothing"}'}
    variants["kills"] = variants["hangs"].replace("HANGS", "KILLS")
    (place / "bad.toml").write_text(f'models = "buildings/b1/in.idf"\nweather = "{weather}"\nlimit = 4\n' + "".join(
        f'[[variant]]\nname = "{name}"\n{more}\n' for name, more in variants.items()))
    _, errors = Command(place, "bad", "--workers", "2", plan="bad.toml", GPU_SHADING_PREFIX=str(stand_in)).finish(1)
    assert "4 of 4 runs, 3 failed" in errors
    found = rows(place / "bad")
    assert {name: row["status"] for name, row in found.items()} == {
        "in/fine": "done", "in/hangs": "failed", "in/kills": "failed", "in/refused": "failed"}
    assert found["in/hangs"]["message"].startswith("stopped after the limit of 4 s")
    assert found["in/kills"]["message"] == "its worker died 2 times"
    assert "NOTHING" in found["in/refused"]["message"].upper()
    with open(place / "bad" / "times.csv", newline="") as lines:
        attempts = {row["run"].split("/")[1]: row["attempts"] for row in csv.DictReader(lines)}
    assert attempts == {"fine": "1", "hangs": "2", "kills": "2", "refused": "2"}


def test_a_dry_run_counts(place, reference):
    output, _ = Command(place, "dry", "--dry-run", "--workers", "2").finish()
    lines = output.splitlines()
    assert lines[0] == "6 runs, 0 of them done, with 3 distinct scenes"
    assert "on 2 workers, by one run of b1/in/plain" in lines[1]
    assert not (place / "dry" / "runs").exists()
    output, _ = Command(place, "reference", "--dry-run", "--workers", "1").finish()
    assert output == "6 runs, 6 of them done, with 3 distinct scenes\n"


def test_a_generator_and_csv_are_plans(gs, place, weather):
    model = place / "buildings" / "b1" / "in.idf"
    made = gs.Study((gs.Case(model, weather, f"tilt {tilt}", fields={"Building/*/North Axis": tilt})
                     for tilt in range(3)), place / "made")
    (place / "plan.csv").write_text("model,weather,variant,set:Building/*/North Axis\n" + "".join(
        f"buildings/b1/in.idf,{weather},tilt {tilt},{tilt}\n" for tilt in range(3)))
    read = gs.Study(place / "plan.csv", place / "made")
    assert [job.name for job in made.jobs] == [f"in/tilt {tilt}/{Path(weather).stem}" for tilt in range(3)]
    assert made.jobs == read.jobs


@pytest.mark.parametrize("old, new, words", [
    ('models = "buildings"', 'models = "towers"', "models: 'towers', expected files or folders with models"),
    ("weather =", "climate =", "weather: missing, expected weather files"),
    ('keep = "nothing"', 'keep = "some"', "keep: 'some', expected one of tables, sql, all, nothing"),
    ('keep = "nothing"', "limit = 0", "limit: 0, expected a number of at least 1"),
    ("error = 0.01", "errors = 0.01", "options.errors: 0.01, expected one of the options error, resolution"),
    ('"cool"', '"plain"', "two runs have this model, variant and weather"),
    ('name = "cool"', "", "variant 2.name: missing, expected a name"),
    ("set =", "sets =", "variant 2.sets: {'Schedule:Constant/cooling*/Hourly Value': 22}, expected no such key, but"),
    ("Hourly Value", "Hourly Values", "Schedule:Constant has no field 'Hourly Values'"),
    ("cooling*", "freezing*", "'Schedule:Constant/freezing*': "),
    ("Schedule:Constant", "Schedule:Constants", "EnergyPlus has no class 'Schedule:Constants'"),
    ("[[variant]]", "[[variant", "is not TOML: "),
])
def test_errors_of_plans_are_one_line(gs, place, old, new, words):
    text = (place / "plan.toml").read_text()
    assert old in text
    (place / "wrong.toml").write_text(text.replace(old, new, 1))
    with pytest.raises(gs.InvalidInput) as refusal:
        gs.Study(place / "wrong.toml", place / "wrong")
    assert str(refusal.value).startswith(f"{place / 'wrong.toml'}: ") and words in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_fields_of_lists_and_epjson_are_replaced(gs):
    from gpu_shading.study import models

    field = models.find_field("Shading:Building:Detailed/louvre 1/vertex 2 y-coordinate")
    assert (field.index, field.item) == (3 + 3 + 1, 1)
    idf = models.Idf("Shading:Building:Detailed, Louvre 1,,4, 0,0,0, ! corner\n 1,1,1;")
    idf.set(field, "9")
    assert idf.text == "Shading:Building:Detailed, Louvre 1,,4, 0,0,0, ! corner\n 1,9,1;"
    epjson = models.EpJson('{"Shading:Building:Detailed": {"Louvre 1": {"vertices": [{}]}}}')
    epjson.set(field, "9")
    assert epjson.data["Shading:Building:Detailed"]["Louvre 1"]["vertices"] == [{}, {"vertex_y_coordinate": 9}]


def test_names_of_models_tell_them_apart(gs):
    from gpu_shading.study.plan import model_names

    names = model_names(["/city/hall.idf", "/city/b2/in.idf", "/city/b2/in.epJSON"])
    assert list(names.values()) == ["hall", "in.idf", "in.epJSON"]
    assert list(model_names(["/a/x/in.idf", "/a/y/in.idf", "/a/y/in.idf"]).values()) == ["x/in", "y/in"]


def test_a_queue_is_asked_for_what_the_plan_says(gs, tmp_path):
    pytest.importorskip("dask_jobqueue", reason="dask-jobqueue is missing: run scripts/setup")
    from gpu_shading.study.engine import open_jobqueue

    with open_jobqueue({"kind": "slurm", "workers": 0, "queue": "short", "walltime": "01:00:00"}, tmp_path) as cluster:
        script = cluster.job_script()
        assert cluster.scheduler_address.startswith("tls://")
    assert "#SBATCH -p short" in script and "#SBATCH -t 01:00:00" in script and "--nthreads 1" in script
    package = energyplus.REPOSITORY / "gpu_shading" / "python"  # not where a job would look
    # Workers start in a private folder, with the study's certificates.
    assert script.index(f"cd {tmp_path}\n") < script.index(" -m ") and "export PYTHONSAFEPATH=1" in script
    assert f"--local-directory {tmp_path}" in script and f"--tls-key {tmp_path}/key.pem" in script
    assert (tmp_path / "key.pem").stat().st_mode & 0o777 == 0o600
    assert f"export PYTHONPATH={package}${{PYTHONPATH:+:$PYTHONPATH}}" in script
    with pytest.raises(gs.InvalidInput, match="--jobqueue sge: expected one of slurm, pbs, lsf"):
        open_jobqueue({"kind": "sge"}, tmp_path)


def test_a_queue_s_workers_make_the_same_table(place, reference, tmp_path):
    """By a queue that starts each job at once."""
    pytest.importorskip("dask_jobqueue", reason="dask-jobqueue is missing: run scripts/setup")
    for name, text in (("sbatch", f'cp "$1" {tmp_path}/$$.job; setsid bash {tmp_path}/$$.job >/dev/null 2>&1 &\n'
                                  'echo "Submitted batch job $!"'), ("scancel", 'kill -TERM -- "-$1"')):
        (tmp_path / name).write_text(f"#!/bin/bash\n{text}\n")
        (tmp_path / name).chmod(0o755)
    (place / "queue.toml").write_text((place / "plan.toml").read_text() + "\n[jobqueue]\nworkers = 2\n")
    # Modules beside the plan are not run.
    (place / "signal.py").write_text("raise SystemExit(1)\n")
    try:
        _, errors = Command(place, "queued", "--jobqueue", "slurm", plan="queue.toml",
                            PATH=f"{tmp_path}:{Path(sys.executable).parent}:{os.environ['PATH']}").finish()
    finally:
        (place / "signal.py").unlink()
    assert "workers of tls://" in errors and "dashboard http://127.0.0.1:" in errors
    assert list(tmp_path.glob("*.job")) and tables(place / "queued") == tables(reference)
    assert not list((place / "queued").glob(".gpu_shading-*"))

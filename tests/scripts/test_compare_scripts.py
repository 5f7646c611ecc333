"""What compare_shading and compare_sampling do to files that are not theirs, with a stand-in for EnergyPlus."""

import os
import signal
import subprocess
import time

import pytest
from shading_runs import energyplus, input_file
from shading_runs.output_folder import MARKER
from shading_runs.version import input_version

MODEL = f"Version,{input_version()};\n" + "Building,{name};\n"
SCRIPTS = ["compare_shading", "compare_sampling"]
FOLDERS = {"compare_shading": "gpu", "compare_sampling": "A"}


@pytest.fixture
def call(tmp_path):
    """Starts a script with the stand-in, whose commands are given."""
    prefix = tmp_path / "prefix"
    prefix.mkdir()
    (tmp_path / "weather.epw").write_text("LOCATION,Nowhere,,,,,40,-105,-7,1800\n")

    def start(script, *arguments, commands="exit 1", wait=True):
        program = prefix / "energyplus"
        program.write_text(f"#!/bin/sh\n{commands}\n")
        program.chmod(0o755)
        process = subprocess.Popen(
            [energyplus.REPOSITORY / "scripts" / script, *arguments, "-w", tmp_path / "weather.epw"],
            env={**os.environ, "GPU_SHADING_PREFIX": str(prefix)}, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True)
        return (*process.communicate(timeout=60), process.returncode) if wait else process

    return start


def write_model(path):
    path.parent.mkdir(exist_ok=True)
    path.write_text(MODEL.format(name=path.stem))
    return path


def contents(folder):
    return {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_missing_model_is_named_in_words(script, call, tmp_path):
    _, errors, status = call(script, tmp_path / "A.idf", "-o", tmp_path / "out")
    assert status == 1
    assert f"{script}: {tmp_path / 'A.idf'}: No such file or directory\n" in errors
    assert "Errno" not in errors


@pytest.mark.parametrize("script", SCRIPTS)
@pytest.mark.parametrize("where", ["in a folder of a run's name", "beside it"])
def test_a_users_folder_is_refused(script, where, call, tmp_path):
    """It used to be deleted where it had the name of a run."""
    model = write_model(tmp_path / "A.idf")
    folder = tmp_path / "project" / (FOLDERS[script] if where != "beside it" else "")
    folder.mkdir(parents=True)
    write_model(folder / "mine.idf")
    (folder / "mine.csv").write_text("1,2,3\n")
    before = contents(tmp_path / "project")
    _, errors, status = call(script, model, "-o", tmp_path / "project")
    assert status == 1
    assert errors == (f"{script}: {tmp_path / 'project'} exists and was not created by {script}: choose a new folder\n")
    assert contents(tmp_path / "project") == before


def test_a_second_model_does_not_overwrite_the_first_ones_neighbour(call, tmp_path):
    """v1/B.idf was overwritten through the link that the run of v1/A.idf had left."""
    first, second = write_model(tmp_path / "v1" / "A.idf"), write_model(tmp_path / "v2" / "B.idf")
    neighbour = tmp_path / "v1" / "B.idf"
    neighbour.write_text("mine")
    for model in (first, second):
        _, errors, status = call("compare_shading", model, "-o", tmp_path / "out")
        assert status == 1
        *stages, error = errors.splitlines()
        assert all(line.startswith("compare_shading: running ") for line in stages)
        assert error == ("compare_shading: PolygonClipping: the run failed: exit status 1 "
                         f"(see {tmp_path}/out.failed/stock/eplusout.err)")
    placed = tmp_path / "out.failed" / "inputs" / "stock" / "B.idf"
    assert placed.read_text().startswith(second.read_text()) and not placed.is_symlink()
    assert neighbour.read_text() == "mine"
    assert not (tmp_path / "out").exists()


def test_a_placed_model_never_goes_through_a_link(tmp_path):
    model = write_model(tmp_path / "v1" / "A.idf")
    folder = tmp_path / "inputs"
    input_file.place_copy(input_file.read(model), model, folder)
    with pytest.raises(FileExistsError):
        input_file.place_copy(input_file.read(model), model, folder)


@pytest.mark.parametrize("output", ["out", "results/deep/out"])
def test_inputs_do_not_lead_to_the_output(output, call, tmp_path):
    """The output lies beside the model, with a file of the user's on the way to it."""
    model = write_model(tmp_path / "project" / "A.idf")
    (tmp_path / "project" / "side.csv").write_text("1\n")
    (tmp_path / "project" / "results").mkdir()
    (tmp_path / "project" / "results" / "table.csv").write_text("2\n")
    for _ in range(2):
        _, errors, status = call("compare_shading", model, "-o", model.parent / output)
        assert status == 1 and "the run failed" in errors
        inputs = (model.parent / output).with_name("out.failed") / "inputs" / "stock"
        assert (inputs / "side.csv").read_text() == "1\n"
        assert (inputs / "results" / "table.csv").read_text() == "2\n"
        # Following links, every file is met once.
        met = [os.path.join(folder, name) for folder, _, names in os.walk(inputs, followlinks=True) for name in names]
        assert len(met) == 3
        for folder, below, _ in os.walk(inputs, followlinks=True):
            for name in below:
                assert "out" not in name, folder


def test_a_model_in_the_folder_that_would_be_replaced_is_refused(call, tmp_path):
    write_model(tmp_path / "A.idf")
    call("compare_shading", tmp_path / "A.idf", "-o", tmp_path / "out")
    (tmp_path / "out.failed").rename(tmp_path / "out")
    model = tmp_path / "out" / "inputs" / "stock" / "A.idf"
    _, errors, status = call("compare_shading", model, "-o", tmp_path / "out")
    assert status == 1
    assert "is inside" in errors and errors.count("\n") == 1
    assert model.is_file()


def test_compare_sampling_refuses_two_models_of_one_name(call, tmp_path):
    models = [write_model(tmp_path / folder / "A.idf") for folder in ("v1", "v2")]
    _, errors, status = call("compare_sampling", *models, "-o", tmp_path / "out")
    assert status == 1 and errors.count("\n") == 1 and "A, A" in errors


def lives(process):
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_kill_in_the_middle(script, call, tmp_path):
    """The former output stays, EnergyPlus ends too, and what it had written goes at the next start."""
    model = write_model(tmp_path / "A.idf")
    call(script, model, "-o", tmp_path / "out")
    (tmp_path / "out.failed").rename(tmp_path / "out")
    before = contents(tmp_path / "out")
    running = tmp_path / "running"
    process = call(script, model, "-o", tmp_path / "out", wait=False,
                   commands=f"echo half > eplusout.sql; echo $$ > {running}; exec sleep 100")
    until = time.monotonic() + 30
    while not (running.exists() and running.read_text().endswith("\n")):
        assert time.monotonic() < until
        time.sleep(0.02)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    child = int(running.read_text())
    while lives(child):
        assert time.monotonic() < until, "EnergyPlus goes on"
        time.sleep(0.02)
    assert contents(tmp_path / "out") == before
    assert len(list(tmp_path.glob(f".out.{script}-*"))) == 1
    call(script, model, "-o", tmp_path / "out")
    assert list(tmp_path.glob(f".out.{script}-*")) == []
    assert not list((tmp_path / "out.failed").rglob("eplusout.sql"))
    assert (tmp_path / "out" / MARKER).is_file()

"""Programs that run EnergyPlus through its C API: they shade as the launcher does."""

import subprocess
import sys
from pathlib import Path

import pytest
from shading_runs import energyplus, input_file, results

HOSTS = Path(__file__).resolve().parent / "hosts"


@pytest.fixture(scope="session")
def c_host(tmp_path_factory):
    program = tmp_path_factory.mktemp("hosts") / "host"
    subprocess.run(["cc", "-Wall", "-Wextra", "-Werror", "-o", program, HOSTS / "host.c", "-ldl"], check=True)
    return [program]


@pytest.fixture(scope="session")
def python_host():
    return [sys.executable, HOSTS / "host.py"]


@pytest.fixture
def model(courtyard, tmp_path):
    model = input_file.read(courtyard)
    results.instrument(model)
    return input_file.place_copy(model, courtyard, tmp_path / "input")


def call(host, prefix, options, runs, folder, model, weather):
    folder.mkdir()
    variables = {key: value for key, value in energyplus.os.environ.items()
                 if key != "DISPLAY" and not key.startswith("GPU_SHADING")}
    command = [*host, prefix, options, str(runs), "-D", "-w", weather, "-d", folder, model]
    done = subprocess.run(command, cwd=folder, env=variables, capture_output=True, text=True)
    return energyplus.Run(done.returncode, done.stdout, done.stderr, folder, 0.0)


@pytest.mark.parametrize("host", ["c_host", "python_host"])
@pytest.mark.parametrize("runs", [1, 2])
def test_host_shades_as_the_launcher(host, runs, patched, model, weather, tmp_path, request):
    host = request.getfixturevalue(host)
    launched = energyplus.run(patched, model, weather, tmp_path / "launcher", ["--gpu-shading=auto", "-D"])
    hosted = call(host, patched.parent, "--gpu-shading=auto", runs, tmp_path / "host", model, weather)
    assert launched.completed, launched.why()
    assert hosted.completed, hosted.errors
    assert hosted.method == "PixelCounting"
    assert results.Results(hosted.folder).values == results.Results(launched.folder).values


@pytest.mark.parametrize("host", ["c_host", "python_host"])
def test_host_is_told_of_bad_options(host, patched, model, weather, tmp_path, request):
    host = request.getfixturevalue(host)
    done = call(host, patched.parent, "--gpu-shading=bogus", 1, tmp_path / "host", model, weather)
    assert done.status == 1
    assert "bogus" in done.errors
    assert not done.completed

"""A GPU that computes wrong answers is found out in the run, and the CPU takes over."""

import shutil
import subprocess

import pytest
from shading_runs import energyplus, input_file, results


@pytest.fixture(autouse=True)
def a_gpu_is_looked_for(monkeypatch):
    """With a driver named, also on a machine that shows no GPU."""
    monkeypatch.setenv("GALLIUM_DRIVER", "llvmpipe")


def with_module(patched, folder, kind="."):
    """A copy of a patched EnergyPlus with another OpenGL module."""
    module = (energyplus.build_folder() / "tests" / "gpu_shading" / "backends" / "wrong_gpu" / kind
              / "libgpu_shading_gl.so")
    if not module.is_file():
        pytest.skip(f"{module} is missing: run scripts/build with the tests")
    prefix = folder / "EnergyPlus"
    shutil.copytree(patched.parent, prefix, symlinks=True)
    shutil.copyfile(module, prefix / module.name)
    return prefix


@pytest.fixture(scope="module")
def on_wrong_gpu(patched, tmp_path_factory):
    """A patched EnergyPlus whose OpenGL module plays a GPU with a broken driver."""
    return with_module(patched, tmp_path_factory.mktemp("wrong_gpu"))


@pytest.fixture
def shade(on_wrong_gpu, weather, sampled_box, tmp_path):
    model = input_file.Idf(sampled_box)
    results.instrument(model)
    model.write(tmp_path / "box.idf")

    def call(*options):
        return energyplus.run(on_wrong_gpu / "energyplus", tmp_path / "box.idf", weather,
                              tmp_path / f"run{len(options)}",
                              [*options, "--gpu-shading-resolution=128", "-D"])

    return call


def test_the_run_goes_on_by_the_cpu_with_one_warning(shade):
    run = shade("--gpu-shading")
    assert run.completed, run.why()
    warnings = [text for kind, text in run.messages if kind == "Warning" and "gpu_shading" in text]
    assert len(warnings) == 1, warnings
    for words in ("Wrong GPU (4.5 (wrong driver 0.1)) computes wrong answers: the sunlit fraction of",
                  "a receiver behind opaque casters", "by the CPU", "tolerance", "continuing on the CPU"):
        assert words in warnings[0].replace("\n", " ")
    assert run.device.startswith("CPU (")
    by_cpu = shade("--gpu-shading", "--gpu-shading-device=cpu")
    assert by_cpu.completed, by_cpu.why()
    sunlit, expected = (results.Results(one.folder).values[results.SUNLIT] for one in (run, by_cpu))
    assert sunlit == expected


@pytest.mark.parametrize("method", ["patched", "opengl"])
def test_the_run_ends_if_a_gpu_is_required(method, shade, tmp_path):
    run = shade("--gpu-shading=require", f"--gpu-shading-method={method}",
                f"--gpu-shading-report={tmp_path / 'report'}")
    assert not run.completed
    assert "Wrong GPU (4.5 (wrong driver 0.1)) computes wrong answers" in run.errors
    assert "continuing" not in run.errors
    # A report would be of a part of the run.
    assert list((tmp_path / "report").iterdir()) == []


def test_a_picture_is_drawn_by_the_cpu_with_a_warning(on_wrong_gpu, courtyard, tmp_path):
    done = subprocess.run([on_wrong_gpu / "gpu_shading", "view", courtyard, "--sun", "200,35", "--size", "64",
                           "-o", tmp_path / "sun.png"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("computes wrong answers") == 1


def test_devices_are_tested(on_wrong_gpu):
    done = subprocess.run([on_wrong_gpu / "gpu_shading", "devices", "--test"], capture_output=True, text=True)
    assert done.returncode == 1, done.stderr
    *_, wrong, cpu = done.stdout.splitlines()
    assert wrong.startswith("0  Wrong GPU (4.5 (wrong driver 0.1)): WRONG: opaque casters by 0.")
    assert "Update its driver" in wrong and "transparent" not in wrong
    assert cpu.startswith("cpu  CPU (") and cpu.endswith(": right")


def test_a_module_of_another_build_is_not_used(patched, sampled_box, weather, tmp_path):
    prefix = with_module(patched, tmp_path, "other_build")
    why = (f"no OpenGL: {prefix / 'libgpu_shading_gl.so'} is from another build than this program; "
           "install both from one package")
    (tmp_path / "box.idf").write_text(sampled_box)
    run = energyplus.run(prefix / "energyplus", tmp_path / "box.idf", weather, tmp_path / "run",
                         ["--gpu-shading", "-D"])
    assert run.completed, run.why()
    assert run.device.startswith("CPU (")
    assert run.errors.count(f"the GPU cannot be used: {why}") == 1
    shown = subprocess.run([prefix / "gpu_shading", "devices"], capture_output=True, text=True)
    assert shown.returncode == 0, shown.stderr
    assert why in shown.stderr and shown.stdout.splitlines()[-1].startswith("cpu  CPU (")
    chosen = subprocess.run([prefix / "gpu_shading", "view", tmp_path / "box.idf", "--sun", "200,35",
                             "--gpu-shading-device=0", "-o", tmp_path / "sun.png"], capture_output=True, text=True)
    assert chosen.returncode == 1
    assert why in chosen.stderr and len(chosen.stderr.splitlines()) == 1

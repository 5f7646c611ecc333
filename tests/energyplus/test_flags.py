"""The user's interface: flags, environment variables, their order, and what is refused."""

import os
import re
import signal
import subprocess
import time
from pathlib import Path

import pytest
from shading_runs import energyplus, input_file, results

SETTINGS = "GPUShading:Settings,\n  {resolution};  !- Resolution\n"


@pytest.fixture
def box(sampled_box):
    return sampled_box


@pytest.fixture
def model(box, tmp_path):
    """One louvre and a sail, one design day, with the outputs that tell one resolution from another."""
    return write_model(box, tmp_path / "box.idf")


def write_model(text, path):
    model = input_file.Idf(text)
    results.instrument(model)
    model.write(path)
    return path


def without_seconds(lines):
    return [re.sub(r", [\d.]+ s$", "", line) for line in lines]


def sunlit(run):
    assert run.completed, run.why()
    return results.Results(run.folder).values[results.SUNLIT]


@pytest.fixture
def shade(patched, weather, tmp_path):
    """Runs a model with the flag; a call a folder."""
    count = 0

    def call(model, *options, environment=None, flag="--gpu-shading"):
        nonlocal count
        count += 1
        options = ([flag] if flag else []) + [*options, "-D"]
        return energyplus.run(patched, model, weather, tmp_path / f"run{count}", options, environment)

    return call


def assert_refused(run, *words):
    """One line of ours that says what is wrong, a failing status, and nothing that looks like a result."""
    assert run.status != 0
    assert not run.completed
    ours = [line for line in run.errors.splitlines() if line.startswith("gpu_shading: ")]
    assert len(ours) == 1, run.errors
    for word in words:
        assert word in ours[0]


@pytest.mark.parametrize(
    "options, words",
    [
        (["--gpu-shading=bogus"], ["--gpu-shading", "bogus", "auto", "require", "off"]),
        (["--gpu-shading-resolution=0"], ["resolution", "0"]),
        (["--gpu-shading-resolution=-512"], ["resolution", "-512"]),
        (["--gpu-shading-resolution=many"], ["resolution", "many"]),
        (["--gpu-shading-error=2"], ["error", "2", "0.1"]),
        (["--gpu-shading-error=0.001", "--gpu-shading-resolution=64"], ["error", "resolution", "one of them"]),
        (["--gpu-shading-update=daily"], ["update", "daily", "idf", "timestep"]),
        (["--gpu-shading-device=99"], ["device", "99"]),
        (["--gpu-shading-device=bogus"], ["device", "bogus"]),
        (["--gpu-shading-file=missing.idf"], ["missing.idf"]),
        (["--gpu-shading-lean=perhaps"], ["lean", "perhaps", "auto", "on", "off"]),
        (["--gpu-shading-assets=some"], ["assets", "some", "restricted", "any"]),
        (["--gpu-shading-bogus=1"], ["--gpu-shading-bogus"]),
    ],
    ids=lambda value: value[0] if isinstance(value, list) and value[0].startswith("--") else "",
)
def test_bad_flag_is_refused_in_one_line(shade, model, options, words):
    assert_refused(shade(model, *options), *words)


@pytest.mark.parametrize("method", ["Scheduled", "Imported"])
def test_other_source_of_sunlit_fractions_is_refused(shade, box, tmp_path, method):
    text = box.replace("PolygonClipping,         !-", f"{method},         !-")
    assert method in text
    assert_refused(shade(write_model(text, tmp_path / "box.idf")), method)


def test_missing_input_is_named(shade, tmp_path):
    assert_refused(shade(tmp_path / "missing.idf"), "missing.idf")


def test_unreadable_input_fails(shade, tmp_path):
    broken = tmp_path / "broken.idf"
    broken.write_bytes(bytes(range(256)) * 64)
    run = shade(broken)
    assert run.status != 0 and not run.completed
    assert run.status > 0, "ended by a signal"


def test_resolution_tells_answers_apart(shade, model):
    coarse, fine = (sunlit(shade(model, f"--gpu-shading-resolution={pixels}")) for pixels in (16, 512))
    assert coarse != fine


def test_value_may_follow_as_a_word(shade, model):
    assert sunlit(shade(model, "--gpu-shading-resolution", "16")) == sunlit(shade(model, "--gpu-shading-resolution=16"))


@pytest.mark.parametrize(
    "variable, value, flag",
    [
        ("GPU_SHADING_RESOLUTION", "16", "--gpu-shading-resolution=16"),
        ("GPU_SHADING_UPDATE", "timestep", "--gpu-shading-update=timestep"),
        ("GPU_SHADING_DEVICE", "cpu", "--gpu-shading-device=cpu"),
    ],
)
def test_environment_variable_equals_flag(shade, model, variable, value, flag):
    by_flag, by_variable = shade(model, flag), shade(model, environment={variable: value})
    assert sunlit(by_flag) == sunlit(by_variable)
    assert without_seconds(by_flag.our_lines) == without_seconds(by_variable.our_lines)
    by_flag_eio, by_variable_eio = (run.text("eplusout.eio").partition("Shadowing/") for run in (by_flag, by_variable))
    assert by_flag_eio[1:] == by_variable_eio[1:]


def test_environment_variable_switches_it_on_and_off(shade, model):
    assert shade(model, flag=None, environment={"GPU_SHADING": "auto"}).method == "PixelCounting"
    assert shade(model, flag=None, environment={"GPU_SHADING": "1"}).method == "PixelCounting"
    assert shade(model, flag=None, environment={"GPU_SHADING": "off"}).method == "PolygonClipping"
    assert shade(model, flag=None, environment={"GPU_SHADING": ""}).method == "PolygonClipping"


def test_bad_environment_variable_is_refused(shade, model):
    assert_refused(shade(model, environment={"GPU_SHADING_RESOLUTION": "0"}), "GPU_SHADING_RESOLUTION", "0")


def test_file_of_extension_objects(shade, model, tmp_path):
    side_file = tmp_path / "settings.idf"
    side_file.write_text(SETTINGS.format(resolution=16))
    wanted = sunlit(shade(model, "--gpu-shading-resolution=16"))
    assert sunlit(shade(model, f"--gpu-shading-file={side_file}")) == wanted
    assert sunlit(shade(model, environment={"GPU_SHADING_FILE": str(side_file)})) == wanted
    model.with_name("box.gpu-shading.idf").write_text(SETTINGS.format(resolution=16))
    assert sunlit(shade(model)) == wanted


def test_extension_objects_in_the_input(shade, box, model, tmp_path):
    own = write_model(box + SETTINGS.format(resolution=16), tmp_path / "own.idf")
    assert sunlit(shade(own)) == sunlit(shade(model, "--gpu-shading-resolution=16"))


def test_line_break_in_a_name_makes_no_flag(shade, model, tmp_path):
    """It ran polygon clipping."""
    report = tmp_path / "a\n--gpu-shading=off"
    run = shade(model, f"--gpu-shading-report={report}")
    assert run.completed, run.why()
    assert run.method == "PixelCounting"
    assert (report / "sunlit.csv").is_file()


def test_report_folder(shade, model, tmp_path):
    for options, environment in (
        ([f"--gpu-shading-report={tmp_path / 'a'}"], None),
        ([], {"GPU_SHADING_REPORT": str(tmp_path / "b")}),
    ):
        run = shade(model, *options, environment=environment)
        assert run.completed, run.why()
    names = [sorted(path.name for path in (tmp_path / folder).rglob("*")) for folder in "ab"]
    assert names[0] and names[0] == names[1]


def test_order_of_precedence(shade, box, tmp_path):
    """Command line, environment, GPUShading:Settings, the input's Pixel Counting Resolution, built in."""
    plain = write_model(box, tmp_path / "plain.idf")
    at = {pixels: sunlit(shade(plain, f"--gpu-shading-resolution={pixels}")) for pixels in (16, 24, 32, 48)}
    assert len({str(answer) for answer in at.values()}) == 4

    model = input_file.Idf(box + SETTINGS.format(resolution=32))
    model.set_field("ShadowCalculation", input_file.SHADOW_RESOLUTION, "48")
    model.set_field("ShadowCalculation", input_file.SHADOW_METHOD, "PixelCounting")
    full = write_model(model.text, tmp_path / "full.idf")
    variable = {"GPU_SHADING_RESOLUTION": "24"}
    assert sunlit(shade(full, "--gpu-shading-resolution=16", environment=variable)) == at[16]
    assert sunlit(shade(full, environment=variable)) == at[24]
    assert sunlit(shade(full)) == at[32]
    model.remove(lambda name: name == "gpushading:settings")
    assert sunlit(shade(write_model(model.text, tmp_path / "field.idf"))) == at[48]
    # Tools write a resolution beside PolygonClipping, without meaning it.
    model.set_field("ShadowCalculation", input_file.SHADOW_METHOD, "PolygonClipping")
    assert sunlit(shade(write_model(model.text, tmp_path / "clipped.idf"))) == sunlit(shade(plain))
    assert sunlit(shade(full, "--gpu-shading-error=0.05")) == sunlit(shade(plain, "--gpu-shading-error=0.05"))
    assert sunlit(shade(plain)) == sunlit(shade(plain, "--gpu-shading-error=0.001"))
    assert sunlit(shade(plain)) != sunlit(shade(plain, "--gpu-shading-error=0.05"))


def test_few_edges_are_exact_whatever_the_fineness(shade, louvres, tmp_path):
    plain = write_model(louvres(1), tmp_path / "plain.idf")
    exact = sunlit(shade(plain))
    for option in ("--gpu-shading-error=0.05", "--gpu-shading-resolution=16"):
        assert sunlit(shade(plain, option)) == exact


def test_interrupt_ends_the_run(patched, courtyard, weather, tmp_path):
    command = [patched, "--gpu-shading", "--gpu-shading-update=timestep", "-w", weather, "-d", tmp_path, courtyard]
    environment = {key: value for key, value in energyplus.os.environ.items() if key != "DISPLAY"}
    # What runs in the background of a shell begins with interrupts ignored.
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)) as process:
        deadline = time.monotonic() + 60
        while not (tmp_path / "eplusout.eso").exists() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.1)
        time.sleep(0.5)  # into the shading of the first days
        assert process.poll() is None, "the run was over too soon to be interrupted"
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=30)
    assert process.returncode != 0, output
    assert not (tmp_path / "eplusout.end").exists()


def test_quiet_leaves_warnings_and_the_error_file(shade, model):
    loud, quiet = shade(model), shade(model, "--gpu-shading-quiet")
    assert loud.completed and quiet.completed, quiet.why()
    assert "gpu_shading: shading rendered by" in loud.errors
    assert "gpu_shading: " not in quiet.errors
    assert quiet.rendering and len(quiet.our_lines) == len(
        [line for line in loud.our_lines if line in loud.text("eplusout.err")])
    refused = shade(model, "--gpu-shading-quiet", "--gpu-shading-error=7")
    assert "gpu_shading: error: " in refused.errors
    by_variable = shade(model, environment={"GPU_SHADING_QUIET": "1"})
    assert by_variable.completed and "gpu_shading: " not in by_variable.errors


def test_stages_are_printed_in_verbose_runs_only(shade, model, tmp_path):
    plain = shade(model, f"--gpu-shading-report={tmp_path / 'report'}")
    assert plain.completed, plain.why()
    assert "stage" not in plain.errors + plain.text("eplusout.err")
    verbose = shade(model, "--gpu-shading-verbose")
    stages = re.search(r"^gpu_shading: time by stage: (.*)$", verbose.errors, re.M)[1]
    with (tmp_path / "report" / "stages.csv").open() as file:
        names = [row.split(",")[0] for row in file.readlines()[1:]]
    assert re.findall(r"(?:^|, )(.*?) [\d.]+ s", stages) == names


# A thread is taken to compute from this many ticks of the scheduler's clock (1/100 s) on.
TICKS = 4


def busy_threads(command, folder):
    """How many threads of a run have computed, as the kernel counts their time."""
    ticks = {}
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        while process.poll() is None:
            for path in Path(f"/proc/{process.pid}/task").glob("*/stat"):
                try:
                    fields = path.read_text().rpartition(")")[2].split()
                except OSError:  # it has just ended
                    continue
                ticks[path.parent.name] = int(fields[11]) + int(fields[12])
            time.sleep(0.005)
    assert process.returncode == 0
    return sum(each >= TICKS for each in ticks.values())


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="one core")
def test_threads_are_bounded(patched, louvres, weather, tmp_path):
    model = tmp_path / "louvres.idf"
    model.write_text(louvres(1500))

    def count(name, *options):
        return busy_threads([patched, "--gpu-shading", "--gpu-shading-device=cpu", "--gpu-shading-error=0.0002",
                             *options, "-D", "-w", weather, "-d", tmp_path / name, model], tmp_path)

    assert count("all") >= 2
    assert count("one", "--gpu-shading-threads=1") == 1
    run = energyplus.run(patched, model, weather, tmp_path / "told", ["--gpu-shading-threads=1", "-D"])
    assert "CPU (1 thread" in run.device
    # A GPU's software renderer is bounded too.
    drawn = busy_threads([patched, "--gpu-shading-device=0", "--gpu-shading-threads=1", "--gpu-shading-error=0.01",
                          "-D", "-w", weather, "-d", tmp_path / "drawn", model], tmp_path)
    assert drawn == 1

"""The gpu_shading program: devices, and what a model's surfaces will be."""

import os
import re
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from PIL import Image
from shading_runs import energyplus
from shading_runs.version import energyplus_release, input_version
from test_screens import write_grey_image

ROOT = energyplus.REPOSITORY


@pytest.fixture
def program(patched):
    def call(*arguments):
        return subprocess.run([patched.parent / "gpu_shading", *arguments], capture_output=True, text=True)

    return call


def test_devices_lists_what_can_render(program):
    done = program("devices")
    assert done.returncode == 0, done.stderr
    *devices, cpu = done.stdout.splitlines()
    for number, line in enumerate(devices):
        assert line.startswith(f"{number}  ")
        assert "software" in line or "GPU" in line
    assert re.fullmatch(r"cpu  CPU \(\d+ threads?, .*\)", cpu)


def test_devices_are_tested_side_by_side(program):
    done = program("devices", "--test")
    assert done.returncode == 0, done.stdout + done.stderr
    table, verdicts = done.stdout.split("\n\n")[1:]
    count = len(verdicts.splitlines())
    titles, units, *rows = table.splitlines()
    assert titles.split()[-1] == "cpu" and units.split() == ["error", "ms"] * count
    assert len(rows) == 8
    for row in rows:
        values = [float(value) for value in row[24:].split()]
        assert len(values) == 2 * count
        assert max(values[::2]) < 4e-3
    assert all(": right" in line for line in verdicts.splitlines())


@pytest.mark.parametrize("command", [["check"], ["view", "--sun", "200,35", "-o", "sun.png"],
                                     ["map", "-w", "WEATHER", "-o", "maps"], ["mask", "-o", "masks"]])
def test_commands_that_render_refuse_off(command, program, courtyard, weather, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = [weather if word == "WEATHER" else word for word in command]
    done = program(words[0], courtyard, *words[1:], "--gpu-shading=off")
    assert done.returncode == 1
    assert done.stderr == ("gpu_shading: error: --gpu-shading (or GPU_SHADING) is off, but this command renders: "
                           "expected auto or require\n")
    assert list(tmp_path.glob("sun*")) == [] and not (tmp_path / "maps" / "maps.csv").exists()


def test_check_prints_what_each_surface_will_be(program, courtyard):
    done = program("check", courtyard)
    assert done.returncode == 0, done.stderr
    rows = {line.split("  ")[0]: line for line in done.stdout.splitlines()}
    assert any("Shading:" in line and "opaque" in line for line in rows.values())
    assert any("window or door" in line for line in rows.values())
    assert any("reveal" in line for line in rows.values())
    assert done.stdout.splitlines()[-1].endswith("surfaces")


@pytest.mark.parametrize("text, words", [
    (f"Version,{input_version()};\nGPUShading:Settings,none;\n", ("GPUShading:Settings", "Resolution", "none")),
    (f"Version,{input_version()};\nGPUShading:Nonsense,1;\n", ("GPUShading:Nonsense", "no such object")),
    ("Version,9.2;\nShadowCalculation,AverageOverDaysInFrequency,20;\n", ("ShadowCalculation", "9.3", "9.2")),
    (f"Version,{input_version()};\n", ("EnergyPlus stopped before its shading",)),
])
def test_check_says_what_is_wrong(program, tmp_path, text, words):
    model = tmp_path / "model.idf"
    model.write_text(text)
    done = program("check", model)
    assert done.returncode == 1
    assert done.stderr.startswith("gpu_shading: error: ")
    for word in words:
        assert word in done.stderr


def test_check_of_a_missing_file(program, tmp_path):
    done = program("check", tmp_path / "missing.idf")
    assert done.returncode == 1
    assert "missing.idf: no such file" in done.stderr


def heed_signals():
    """Where the tests are run by nohup or in the background of a shell, a program would ignore these."""
    for each in (signal.SIGHUP, signal.SIGINT):
        signal.signal(each, signal.SIG_DFL)


class Started:
    """gpu_shading check, with EnergyPlus running."""

    def __init__(self, patched, model, folder):
        self.folder = folder  # of temporary files
        self.process = subprocess.Popen([patched.parent / "gpu_shading", "check", model], text=True,
                                        stderr=subprocess.PIPE, stdout=subprocess.PIPE,
                                        env={**os.environ, "TMPDIR": str(folder)},
                                        preexec_fn=heed_signals)
        children = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children")
        limit = time.monotonic() + 30.0
        while not (found := children.read_text().split()):
            assert self.process.poll() is None and time.monotonic() < limit
            time.sleep(0.001)
        self.energyplus = int(found[0])

    def finish(self):
        """Exit status and what it printed."""
        output, errors = self.process.communicate(timeout=60)
        assert not list(self.folder.iterdir())
        with pytest.raises(ProcessLookupError):
            os.kill(self.energyplus, 0)
        return self.process.returncode, output, errors


@pytest.fixture
def started(patched, courtyard, tmp_path):
    (tmp_path / "temporary").mkdir()
    return Started(patched, courtyard, tmp_path / "temporary")


def test_a_crash_of_energyplus_is_one_error(started):
    os.kill(started.energyplus, signal.SIGSEGV)
    status, output, errors = started.finish()
    assert (status, output) == (1, "")
    assert errors.startswith("gpu_shading: error: ") and len(errors.splitlines()) == 1
    assert "ended by signal 11" in errors


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_an_interrupted_program_takes_energyplus_along(started, sent):
    started.process.send_signal(sent)
    assert started.finish() == (-sent, "", "")


def ended(process):
    """Whether a process is gone, or waits for its parent, which is not ours, to notice."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except FileNotFoundError:
        return True


def test_a_killed_program_takes_energyplus_along(started, patched, tmp_path):
    started.process.kill()
    started.process.communicate()
    limit = time.monotonic() + 10.0
    while not ended(started.energyplus):
        assert time.monotonic() < limit
        time.sleep(0.01)
    # Nobody was left to clear away; the next command does.
    assert len(list(started.folder.iterdir())) == 1
    empty = tmp_path / "empty.idf"
    empty.write_text(f"Version,{input_version()};\n")
    subprocess.run([patched.parent / "gpu_shading", "check", empty], capture_output=True,
                   env={**os.environ, "TMPDIR": str(started.folder)})
    assert not list(started.folder.iterdir())


@pytest.mark.parametrize("size", [16, 20, 27, 38])
def test_small_views_are_drawn(program, courtyard, tmp_path, size):
    picture = tmp_path / "view.png"
    done = program("view", courtyard, "--at", "06-21 12:00", "--size", str(size), "-o", picture)
    assert done.returncode == 0, done.stderr
    assert picture.stat().st_size > 0


def test_errors_come_before_energyplus_starts(patched, courtyard, weather, tmp_path):
    (tmp_path / "file").write_text("mine")
    for flag in ("--gpu-shading-device=99", f"--gpu-shading-report={tmp_path / 'file'}",
                 "--gpu-shading-resolution=1000000"):
        folder = tmp_path / "out"
        done = subprocess.run([patched, "--gpu-shading", flag, "-w", weather, "-d", folder, courtyard], text=True,
                              capture_output=True)
        assert done.returncode == 1, flag
        assert done.stderr.startswith("gpu_shading: error: "), done.stderr
        assert len(done.stderr.splitlines()) == 1, done.stderr
        assert sorted(path.name for path in folder.iterdir()) == ["eplusout.end", "eplusout.err"], flag


@pytest.mark.parametrize("mebibytes, words", [
    (170, "out of memory: ulimit -v allows 170 MiB"), (500, None), (800, None),
])
@pytest.mark.skipif(os.cpu_count() > 4, reason="the stacks of many threads take addresses too")
def test_little_memory_is_enough_or_said(patched, box, weather, tmp_path, mebibytes, words):
    model = tmp_path / "box.idf"
    model.write_text(box)

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (mebibytes << 20, mebibytes << 20))

    done = subprocess.run([patched, "--gpu-shading", "-D", "-w", weather, "-d", tmp_path / "out", model], text=True,
                          capture_output=True, preexec_fn=limit)
    assert done.returncode == (1 if words else 0), done.stderr
    assert (words or "shading rendered by CPU") in done.stderr


def test_shading_starts_in_30_milliseconds(patched, official, box, weather, tmp_path):
    model = tmp_path / "box.idf"
    model.write_text(box)

    def processor_seconds(*command):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run = subprocess.run([*command, "-D", "-w", weather, "-d", tmp_path / "out", model], capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        assert run.returncode == 0, run.stderr
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    # In turn, so that both see the same state of the machine; least of all, without what others do to it.
    times = [(processor_seconds(patched, "--gpu-shading"), processor_seconds(official)) for _ in range(5)]
    ours, theirs = map(min, zip(*times, strict=True))
    assert ours < theirs + 0.030, times


@pytest.mark.parametrize("words, near", [(["veiw", "model.idf"], "view"), (["devices", "--tets"], "--test"),
                                         (["check", "model.idf", "--vertexes"], "--vertices"),
                                         (["view", "--reciever", "x"], "--receiver"),
                                         (["devices", "--gpu-shading-devcie=0"], "--gpu-shading-device")])
def test_a_mistyped_word_is_answered_with_the_near_one(program, words, near):
    done = program(*words)
    assert done.returncode == 1
    assert done.stderr.startswith("gpu_shading: error: ") and done.stderr.count("\n") == 1
    assert f"did you mean {near}?" in done.stderr


@pytest.mark.parametrize("words, message", [
    (("view", "m.idf", "--size", "8"), "--size: Value 8 not in range 16 to 8192"),
    (("view", "m.idf", "--size", "\x1b[31m"), r"--size: Value \x1b[31m not in range 16 to 8192"),
    (("view", "m.idf"), "--output is required"),
    (("check",), "model is required"),
    ((), "A subcommand is required"),
])
def test_errors_of_arguments_are_one_line(program, words, message):
    done = program(*words)
    said = done.stderr.replace("[16 - 8192]", "16 to 8192")  # as CLI11 2.4 writes it
    assert (done.returncode, done.stdout, said) == (1, "", f"gpu_shading: error: {message}\n")


@pytest.mark.parametrize("words", [
    ("screen", "m.idf", "--gpu-shading-device", "7"),
    ("screen", "m.idf", "--gpu-shading-report=out"),
    ("devices", "--gpu-shading-resolution=64"),
    ("check", "m.idf", "--gpu-shading-cache=cache"),
    ("view", "m.idf", "-o", "x.png", "--gpu-shading-update=timestep"),
    ("sample", "m.idf", "-o", "out", "--gpu-shading-update=timestep"),
    ("export", "m.idf", "--scheduled", "out", "--gpu-shading-method=opengl"),
])
def test_a_flag_that_a_command_ignores_is_refused(program, words):
    flag = next(word for word in words if word.startswith("--gpu")).partition("=")[0]
    done = program(*words)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == (f"gpu_shading: error: {flag}: not an option of gpu_shading {words[0]}; "
                           f"see gpu_shading {words[0]} --help-all\n")


def test_the_environment_is_for_all_commands(patched, tmp_path):
    done = subprocess.run([patched.parent / "gpu_shading", "screen", "m.idf"], capture_output=True, text=True,
                          cwd=tmp_path, env={**os.environ, "GPU_SHADING_DEVICE": "7"})
    assert "m.idf" in done.stderr and "device" not in done.stderr.lower()


def test_commands_list_their_own_options_and_with_help_all_those_of_shading(program):
    for command in ("devices", "check", "view", "map", "mask", "screen", "sample", "export"):
        own, all_of_it = (program(command, flag).stdout for flag in ("--help", "--help-all"))
        assert "--gpu-shading" not in own.replace("--gpu-shading-device", "").replace("--gpu-shading-update", "")
        assert "gpu_shading help options" in own
        assert "--gpu-shading-threads N" in all_of_it
        assert ("--gpu-shading-device auto|cpu|N" in all_of_it) == (command not in ("devices", "screen"))
        assert program("help", command).stdout == own
    common, everything = (program("help", "options", *more).stdout for more in ([], ["--help-all"]))
    assert "--gpu-shading-cache DIR|off" in common
    for rare in ("method", "assets", "lean"):
        assert f"--gpu-shading-{rare} " not in common and f"--gpu-shading-{rare} " in everything
    assert max(map(len, everything.splitlines())) <= 100
    assert program("help").stdout == program("--help").stdout


@pytest.mark.parametrize("desktop", [{"DISPLAY": ":0"}, {"WAYLAND_DISPLAY": "wayland-0"}, {}])
def test_docs_opens_the_manual_where_there_is_a_desktop(patched, tmp_path, desktop):
    page = tmp_path / "share" / "doc" / "energyplus-gpu-shading" / "html" / "index.html"
    page.parent.mkdir(parents=True)
    page.write_text("<title>Manual</title>")
    browser = tmp_path / "bin" / "xdg-open"
    browser.parent.mkdir()
    browser.write_text(f'#!/bin/sh\necho "$1" > {tmp_path / "opened"}\n')
    browser.chmod(0o755)
    variables = {key: value for key, value in os.environ.items() if not key.endswith("DISPLAY")} | desktop
    variables |= {"XDG_DATA_DIRS": f"/nowhere:{tmp_path / 'share'}", "PATH": f"{browser.parent}:{os.environ['PATH']}"}
    program = shutil.copy(patched.parent / "gpu_shading", tmp_path)
    done = subprocess.run([program, "docs"], capture_output=True, text=True, env=variables)
    assert (done.returncode, done.stdout) == (0, f"{page}\n"), done.stderr
    opened = tmp_path / "opened"
    assert opened.exists() == bool(desktop)
    assert not desktop or opened.read_text() == f"{page}\n"


def test_docs_says_that_the_manual_is_not_installed(patched, tmp_path):
    # Elsewhere, because the sources may have the site in out/site.
    program = shutil.copy(patched.parent / "gpu_shading", tmp_path)
    done = subprocess.run([program, "docs"], capture_output=True, text=True,
                          env={**os.environ, "XDG_DATA_DIRS": "/nowhere"})
    assert done.returncode == 1
    assert done.stderr.startswith("gpu_shading: error: the manual is not installed: ")


def test_every_program_tells_its_version(program, patched):
    version = re.search(r"project\(gpu_shading VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    for command in ([], ["check"], ["devices"], ["sample"]):
        assert program(*command, "--version").stdout == f"gpu_shading {version}\n"
    with_official = subprocess.run([patched, "--gpu-shading", "--version"], capture_output=True, text=True).stdout
    assert f"gpu_shading {version}\n" in with_official
    assert f"EnergyPlus, Version {energyplus_release()}" in with_official
    official = subprocess.run([patched, "--version"], capture_output=True, text=True).stdout
    assert "gpu_shading" not in official and energyplus_release() in official
    for script in ("patch_energyplus", "compare_shading", "compare_sampling"):
        told = subprocess.run([ROOT / "scripts" / script, "--version"], capture_output=True, text=True).stdout
        assert told == f"{script} {version}\n"


@pytest.mark.parametrize("closed", [(0,), (1,), (2,), (0, 1), (1, 2), (0, 1, 2)], ids=str)
def test_closed_standard_descriptors(closed, patched, box, weather, tmp_path):
    """Files of a model are decoded, and no file that is written gets what was to be printed."""
    write_grey_image(tmp_path / "tile.png", [[255, 0, 90], [0, 255, 0]])
    model = tmp_path / "model.idf"
    model.write_text(box + "GPUShading:PerforatedScreen,Image,Louvre*,Texture,tile.png,,,,,,0.001;\n")
    redirections = " ".join(f"{number}>&-" for number in closed)

    def call(*command):
        return subprocess.run(["sh", "-c", f'exec "$@" {redirections}', "sh", *map(str, command)], cwd=tmp_path,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)

    run = call(patched, "--gpu-shading", "-D", "-w", weather, "-d", "out", model)
    assert run.returncode == 0, run.stderr
    end = (tmp_path / "out" / "eplusout.end").read_text()
    assert end.startswith("EnergyPlus Completed Successfully") and end.count("\n") <= 1
    check = call(patched.parent / "gpu_shading", "check", model)
    if 1 in closed:  # which is an error, but of printing alone
        assert check.returncode == 1
        assert check.stderr in ("", "gpu_shading: error: standard output: cannot be written\n")
    else:
        assert check.returncode == 0 and "LOUVRE 1" in check.stdout, check.stderr
    view = call(patched.parent / "gpu_shading", "view", model, "--sun", "200,35", "--size", "64", "-o", "view.png")
    assert view.returncode == (1 if 1 in closed else 0), view.stderr
    with Image.open(tmp_path / "view.png") as image:
        image.load()

"""Calls to the system that fail, and memory that is refused: each command ends with an error or goes on correctly, does
not crash, and leaves no cut file under a final name."""

import os
import shutil
import subprocess

import pytest
from shading_runs import energyplus

CALLS = ("open", "write", "fsync", "rename", "mkdir")
COMMANDS = ("check", "view", "sample", "export", "run")
WRITERS = (*COMMANDS, "map")


def built(name):
    library = energyplus.build_folder() / "tests" / "faults" / name
    if not library.is_file():
        pytest.skip(f"{library} is missing: run scripts/build")
    return library


@pytest.fixture(scope="module")
def failing_calls():
    return built("libfail_nth.so")


@pytest.fixture(scope="module")
def failing_memory():
    return built("libfail_new.so")


@pytest.fixture(scope="module")
def model(box, tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "box.idf"
    path.write_text(box)
    return path


class Command:
    """A command that can be run again and again. It and its temporary files are in `folder`."""

    def __init__(self, name, words, folder, finals=()):
        self.name = name
        self.words = words
        self.folder = folder
        self.finals = finals  # of files that are complete or not there
        self.temporary = folder / "temporary"

    def run(self, library=None, **variables):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.temporary.mkdir(parents=True)
        variables = {name: str(value) for name, value in variables.items()}
        variables |= {"LD_PRELOAD": str(library)} if library else {}
        variables |= {"GPU_SHADING_DEVICE": "cpu", "TMPDIR": str(self.temporary)}
        elsewhere = self.folder / "current"
        elsewhere.mkdir()
        done = subprocess.run([str(word) for word in self.words], env={**os.environ, **variables}, text=True,
                              errors="replace", capture_output=True, timeout=120, cwd=elsewhere)
        assert not list(elsewhere.iterdir()), "files in the current folder"
        return done

    def files(self):
        # Times are not the same twice.
        return {path.relative_to(self.folder): b"" if path.name == "stages.csv" else path.read_bytes()
                for pattern in self.finals for path in self.folder.glob(pattern) if path.is_file()}

    def run_whole(self):
        """What it prints and writes if nothing fails."""
        done = self.run()
        assert done.returncode == 0, done.stderr
        files = self.files()
        assert files if self.finals else done.stdout
        return done.stdout, files

    def judge(self, done, whole, told):
        """That a run with a fault, compared with the whole one, ended well: `told` says what failed."""
        output, complete = whole
        told = f"{self.name}, {told}: exit status {done.returncode}\n{done.stderr}"
        assert done.returncode in (0, 1), told
        found = self.files()
        for path, contents in found.items():
            assert path in complete, f"{told}: {path} is new"
            if path.suffix != ".sunlit":
                assert contents == complete[path], f"{told}: {path} is cut"
        if done.returncode == 1:
            assert "gpu_shading: error: " in done.stderr, told
            return
        # Nothing is missing but the cache, which a run can do without and warns of.
        missing = [path for path in complete if path not in found and path.suffix != ".sunlit"]
        assert not missing, told
        if len(found) < len(complete):
            assert "--gpu-shading-cache" in done.stderr, told
        if self.name == "check":
            assert done.stdout == output, told


@pytest.fixture(scope="module")
def command(request, patched, model, weather, tmp_path_factory):
    name = request.param
    folder = tmp_path_factory.mktemp("faults") / name
    program = patched.parent / "gpu_shading"
    words, finals = {
        "check": ([program, "check", model], []),
        "view": ([program, "view", model, "--at", "06-21 12:00", "--size", "64", "-o", folder / "picture.png"],
                 ["*.png"]),
        "sample": ([program, "sample", model, "-w", weather, "-o", folder / "out", "--mode", "coarse"],
                   ["out/*.csv", "out/*.json", "out/parts/*.json"]),
        "export": ([program, "export", model, "-w", weather, "--scheduled", folder / "out"], ["out/**/*"]),
        "run": ([patched, "--gpu-shading", f"--gpu-shading-report={folder / 'report'}",
                 f"--gpu-shading-cache={folder / 'cache'}", "-w", weather, "-D", "-d", folder.parent / "energyplus",
                 model], ["report/*.csv", "report/*.png", "report/*.html", "cache/*.sunlit"]),
        "map": ([program, "map", model, "-w", weather, "--from", "06-21", "--to", "06-21", "--receivers", "South",
                 "-o", folder / "out"], ["out/*"]),
    }[name]
    return Command(name, words, folder, finals)


@pytest.mark.parametrize("command", WRITERS, indirect=True)
def test_no_failing_call_leaves_a_cut_file_or_passes_unnoticed(command, failing_calls, tmp_path):
    whole = command.run_whole()
    tried = 0
    for call in CALLS:
        counted = tmp_path / call
        settings = {"FAIL_CALL": call, "FAIL_UNDER": command.folder}
        command.run(failing_calls, FAIL_COUNT=counted, **settings)
        calls = counted.stat().st_size if counted.is_file() else 0
        # The first and the last, and one in the middle of what is written.
        middle = {calls // 2 + 1} if call == "write" else set()
        for nth in sorted({1, calls} | middle if calls else ()):
            done = command.run(failing_calls, FAIL_NTH=nth, **settings)
            command.judge(done, whole, f"{call} {nth} of {calls}")
            tried += 1
    assert tried >= 3


def strides(count):
    """Numbers from 1 to `count`: close to each other at first, where a program starts, and then all along it."""
    steps = 8
    return sorted({round(count ** (i / steps)) for i in range(steps + 1)} |
                  {1 + (count - 1) * i // steps for i in range(steps)})


@pytest.mark.parametrize("command", COMMANDS, indirect=True)
def test_no_lack_of_memory_crashes_or_passes_unnoticed(command, failing_memory, patched, tmp_path):
    whole = command.run_whole()
    ours = patched.parent.resolve()
    command.run(failing_memory, FAIL_FOLDER=ours, FAIL_COUNT=tmp_path)
    calls = {}
    for path in tmp_path.iterdir():
        program = path.name.rpartition(".")[0]
        calls[program] = max(calls.get(program, 0), int.from_bytes(path.read_bytes(), "little"))
    calls = {program: count for program, count in calls.items() if count}
    assert "energyplus" in calls and sum(calls.values()) > 1000, calls
    for program, count in calls.items():
        for nth in strides(count):
            done = command.run(failing_memory, FAIL_FOLDER=ours, FAIL_PROGRAM=program, FAIL_NTH=nth)
            told = f"allocation {nth} of {count} in {program}"
            command.judge(done, whole, told)
            assert done.returncode == 0 or "out of memory" in done.stderr, f"{command.name}, {told}: {done.stderr}"

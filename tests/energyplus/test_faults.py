"""Calls to the system that fail: each command ends with an error, no crash, and no cut file under a final name."""

import os
import shutil
import subprocess

import pytest
from shading_runs import energyplus

CALLS = ("open", "write", "fsync", "rename", "mkdir")


@pytest.fixture(scope="module")
def library():
    built = energyplus.build_folder() / "tests" / "faults" / "libfail_nth.so"
    if not built.is_file():
        pytest.skip(f"{built} is missing: run scripts/build")
    return built


@pytest.fixture(scope="module")
def model(box, tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "box.idf"
    path.write_text(box)
    return path


class Command:
    """A command that writes into `folder`, which can be run again and again."""

    def __init__(self, name, words, folder, finals):
        self.name = name
        self.words = words
        self.folder = folder
        self.finals = finals  # of files that are complete or not there

    def run(self, library, call, nth=None, count=None):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        variables = {**os.environ, "LD_PRELOAD": str(library), "FAIL_CALL": call, "FAIL_UNDER": str(self.folder),
                     "GPU_SHADING_DEVICE": "cpu"}
        variables |= {"FAIL_NTH": str(nth)} if nth else {}
        variables |= {"FAIL_COUNT": str(count)} if count else {}
        return subprocess.run([str(word) for word in self.words], env=variables, text=True, errors="replace",
                              capture_output=True, timeout=120)

    def files(self):
        return {path.relative_to(self.folder): path.read_bytes() for pattern in self.finals
                for path in self.folder.glob(pattern)}


@pytest.fixture(scope="module")
def commands(patched, model, weather, tmp_path_factory):
    base = tmp_path_factory.mktemp("faults")
    program = patched.parent / "gpu_shading"
    picture = base / "view" / "picture.png"
    report = base / "run"
    found = [
        Command("view", [program, "view", model, "--at", "06-21 12:00", "--size", "64", "-o", picture], base / "view",
                ["*.png"]),
        Command("sample", [program, "sample", model, "-w", weather, "-o", base / "sample", "--mode", "paper-coarse"],
                base / "sample", ["*.csv", "*.json", "parts/*.json"]),
        Command("run", [patched, "--gpu-shading", f"--gpu-shading-report={report / 'report'}",
                        f"--gpu-shading-cache={report / 'cache'}", "-w", weather, "-D", "-d", base / "energyplus",
                        model], report, ["report/*.csv", "report/*.png", "cache/*.sunlit"]),
    ]
    return {command.name: command for command in found}


def comparable(name, contents):
    # Times are not the same twice.
    return b"" if name.name == "stages.csv" else contents


@pytest.mark.parametrize("name", ["view", "sample", "run"])
def test_no_fault_leaves_a_cut_file_or_passes_unnoticed(commands, library, name, tmp_path):
    command = commands[name]
    whole = command.run(library, "none")
    assert whole.returncode == 0, whole.stderr
    complete = command.files()
    assert complete
    tried = 0
    for call in CALLS:
        counted = tmp_path / call
        command.run(library, call, count=counted)
        calls = counted.stat().st_size if counted.is_file() else 0
        # The first and the last, and one in the middle of what is written.
        middle = {calls // 2 + 1} if call == "write" else set()
        for nth in sorted({1, calls} | middle if calls else ()):
            done = command.run(library, call, nth)
            told = f"{name}, {call} {nth} of {calls}: exit status {done.returncode}\n{done.stderr}"
            tried += 1
            assert done.returncode in (0, 1), told
            found = command.files()
            for path, contents in found.items():
                assert path in complete, f"{told}: {path} is new"
                if path.suffix != ".sunlit":
                    assert comparable(path, contents) == comparable(path, complete[path]), f"{told}: {path} is cut"
            if done.returncode == 0:
                # Nothing is missing but the cache, which a run can do without and warns of.
                missing = [path for path in complete if path not in found and path.suffix != ".sunlit"]
                assert not missing, told
                if len(found) < len(complete):
                    assert "--gpu-shading-cache" in done.stderr, told
            else:
                assert "gpu_shading: error: " in done.stderr, told
    assert tried >= 3

"""tidy.py checks what a change touches, and everything without a base."""

import json
import os
import subprocess
from pathlib import Path

import pytest
import tidy

NINJA = """
rule cxx
  command = c++ -MD -MF $out.d -I.. -c $in -o $out
  depfile = $out.d
  deps = gcc
build a.o: cxx ../a.cpp
build b.o: cxx ../b.cpp
"""


def git(*arguments):
    subprocess.run(["git", "-c", "user.name=t", "-c", "user.email=t", *arguments], check=True, capture_output=True)


@pytest.fixture
def tree(tmp_path, monkeypatch):
    """A built tree on a branch that equals main: a.cpp includes a.h, b.cpp includes nothing."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tidy, "ROOT", tmp_path)
    monkeypatch.delenv("GPU_SHADING_TIDY_BASE", raising=False)
    for folder in (".ci", "tests", "build"):
        Path(folder).mkdir()
    for name, text in ((".clang-tidy", ""), ("tests/.clang-tidy", ""), (".ci/tidy.py", ""), (".gitignore", "/build/\n"),
                       ("a.h", ""), ("a.cpp", '#include "a.h"\n'), ("b.cpp", ""), ("build/build.ninja", NINJA)):
        Path(name).write_text(text)
    git("init", "-q", "-b", "main")
    git("add", ".")
    git("commit", "-qm", "one")
    git("checkout", "-qb", "change")
    subprocess.run(["ninja", "-C", "build"], check=True, capture_output=True)
    commands = subprocess.run(["ninja", "-C", "build", "-t", "compdb"], check=True, capture_output=True).stdout
    Path("build/compile_commands.json").write_bytes(commands)
    return tmp_path


def commit(path, text):
    Path(path).write_text(text)
    git("add", path)
    git("commit", "-qm", path)


def selected(everything=False):
    work, _ = tidy.select(tidy.ROOT / "build", everything)
    return sorted(source.name for source in work)


@pytest.mark.parametrize(("path", "expected"), [
    ("a.h", ["a.h"]),
    ("b.cpp", ["b.cpp"]),
    ("README.md", []),
    (".clang-tidy", ["a.cpp", "b.cpp"]),
    ("tests/.clang-tidy", ["a.cpp", "b.cpp"]),
    (".ci/tidy.py", ["a.cpp", "b.cpp"]),
])
def test_what_a_commit_touches_is_checked(tree, path, expected):
    commit(path, "// other\n")
    assert selected() == expected


def test_changes_not_committed_count(tree):
    commit("README.md", "text")
    Path("a.h").write_text("// other\n")
    assert selected() == ["a.h"]


def test_a_header_is_checked_as_a_source_that_includes_it_is_compiled(tree):
    commit("a.h", "// other\n")
    work, _ = tidy.select(tree / "build", False)
    assert work[tree / "a.h"][0]["command"] == f"c++ -MD -MF a.o.d -I.. -x c++ -c {tree}/a.h -o a.o"


def test_a_build_whose_includes_are_unknown_is_refused(tree):
    os.remove("build/.ninja_deps")
    with pytest.raises(SystemExit, match="build it first"):
        selected()


def test_without_a_base_all_files_are_checked(tree):
    assert selected() == ["a.cpp", "b.cpp"]  # HEAD is main


def test_on_main_the_recorded_commit_is_the_base(tree):
    (tree / tidy.RECORD).write_text(tidy.git("rev-parse", "HEAD") + "\n")
    commit("b.cpp", "// other\n")
    git("checkout", "-q", "main")
    git("merge", "-q", "--ff-only", "change")
    assert selected() == ["b.cpp"]
    (tree / tidy.RECORD).write_text("0" * 40 + "\n")  # not in this history
    assert selected() == ["a.cpp", "b.cpp"]


@pytest.mark.parametrize("passes", [True, False])
def test_a_pass_is_recorded_and_a_failure_is_not(tree, monkeypatch, passes):
    Path("bin").mkdir()
    Path("bin/clang-tidy").write_text(f"#!/bin/sh\nexit {0 if passes else 1}\n")
    Path("bin/clang-tidy").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tree / 'bin'}:{os.environ['PATH']}")
    monkeypatch.setattr("sys.argv", ["tidy.py", "build", "--record"])
    assert tidy.main() == (0 if passes else 1)
    assert (tree / tidy.RECORD).exists() == passes
    if passes:
        assert (tree / tidy.RECORD).read_text().strip() == tidy.git("rev-parse", "HEAD")
        Path("a.h").write_text("// other\n")
        with pytest.raises(SystemExit, match="not recorded"):
            tidy.main()


def compile_commands(folder, command, file):
    (folder / "compile_commands.json").write_text(
        json.dumps([{"directory": str(folder), "file": file, "command": command}]))
    return [(entry["file"], entry["command"]) for entry in tidy.read_commands(folder)]


def test_headers_that_gcc_precompiled_are_left_out(tmp_path):
    command = "c++ -O2 -fpch-preprocess -Winvalid-pch -include /b/x.dir/cmake_pch.hxx -c a.cpp"
    assert compile_commands(tmp_path, command, "a.cpp") == [(str(tmp_path / "a.cpp"), "c++ -O2 -c a.cpp")]


def test_sources_that_are_compiled_as_one_are_checked_one_by_one(tmp_path):
    (tmp_path / "Unity").mkdir()
    (tmp_path / "Unity/unity_0_cxx.cxx").write_text('/* generated */\n#include "/s/a.cpp"\n\n#include "/s/b.cpp"\n')
    file = f"{tmp_path}/Unity/unity_0_cxx.cxx"
    assert compile_commands(tmp_path, f"c++ -Wshadow=local -o u.o -c {file}", file) == [
        ("/s/a.cpp", "c++ -Wshadow -o u.o -c /s/a.cpp"), ("/s/b.cpp", "c++ -Wshadow -o u.o -c /s/b.cpp")]


def test_a_change_beside_a_source_affects_that_source_alone(tree):
    """a.cpp and b.cpp are compiled as one, from build/Unity/unity_0_cxx.cxx."""
    file = tree / "build/Unity/unity_0_cxx.cxx"
    file.parent.mkdir()
    file.write_text(f'#include "{tree}/a.cpp"\n#include "{tree}/b.cpp"\n')
    Path("build/build.ninja").write_text(NINJA.split("build a.o")[0] + f"build u.o: cxx {file}\n")
    subprocess.run(["ninja", "-C", "build"], check=True, capture_output=True)
    commands = subprocess.run(["ninja", "-C", "build", "-t", "compdb"], check=True, capture_output=True).stdout
    Path("build/compile_commands.json").write_bytes(commands)
    commit("b.cpp", "// other\n")
    assert selected() == ["b.cpp"]
    commit("a.h", "// other\n")
    assert selected() == ["a.h", "b.cpp"]


def test_a_base_can_be_named(tree, monkeypatch):
    commit("b.cpp", "// other\n")
    commit("a.h", "// other\n")
    monkeypatch.setenv("GPU_SHADING_TIDY_BASE", "HEAD~1")
    assert selected() == ["a.h"]
    assert selected(everything=True) == ["a.cpp", "b.cpp"]
    monkeypatch.setenv("GPU_SHADING_TIDY_BASE", "nowhere")
    with pytest.raises(SystemExit):
        selected()


def test_a_pass_is_forgotten_when_a_header_changes(tree):
    def keys():
        return {source.name: key for source, key in tidy.select(tree / "build", True)[0].items()}

    before = keys()
    Path("a.h").write_text("// other\n")
    after = keys()
    assert before["a.cpp"] != after["a.cpp"]
    assert before["b.cpp"] == after["b.cpp"]

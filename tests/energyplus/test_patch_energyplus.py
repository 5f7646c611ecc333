"""The maker of patched prefixes, with stand-ins for what the build makes."""

import importlib.util
import json
import os
import shutil
import signal
import stat
import subprocess
import sys
from importlib.machinery import SourceFileLoader

import pytest
from shading_runs import energyplus, output_folder, self_check
from shading_runs.version import energyplus_release

SCRIPT = energyplus.REPOSITORY / "scripts" / "patch_energyplus"


def load_script():
    loader = SourceFileLoader("patch_energyplus", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


@pytest.fixture
def build(tmp_path):
    folder = tmp_path / "build" / "energyplus_patch"
    folder.mkdir(parents=True)
    (folder / "energyplus").write_text("#!/bin/sh\necho launcher\n")
    (folder / "libgpu_shading_energyplus.so").write_bytes(b"library")
    (folder / "libgpu_shading_api.so").write_bytes(b"our API library")
    return folder.parent


@pytest.fixture
def prefix(tmp_path):
    """An installation in miniature, with helpers that lack the run bit."""
    folder = tmp_path / "EnergyPlus"
    (folder / "PostProcess" / "convert").mkdir(parents=True)
    (folder / "DataSets").mkdir()
    (folder / "pyenergyplus").mkdir()
    files = {
        "energyplus": b"#!/bin/sh\necho official\n",
        "libenergyplusapi.so": f"\x7fELF...\0libenergyplusapi.so.{energyplus_release()}\0...".encode(),
        "pyenergyplus/api.py": b"",
        "Energy+.idd": f"!IDD_Version {energyplus_release()}\n".encode(),
        "runreadvars": b"#!/bin/sh\n",
        "DataSets/Schedules.idf": b"",
        "PostProcess/ReadVarsESO": b"\x7fELF" + bytes(12) + b"\x02\0",
        "PostProcess/convert/notes.txt": b"notes",
    }
    for name, content in files.items():
        (folder / name).write_bytes(content)
    (folder / "energyplus").chmod(0o755)
    return folder


def patch(*arguments):
    return subprocess.run([SCRIPT, *arguments], capture_output=True, text=True)


def tree(folder):
    """Every path below a folder with its kind, mode, content and time of change."""
    state = {}
    for path in sorted(folder.rglob("*")):
        status = path.lstat()
        content = path.read_bytes() if path.is_file() else b""
        state[path] = (status.st_mode, status.st_mtime_ns, content)
    return state


def temporary(folder):
    return [path.name for path in folder.iterdir() if path.name.startswith(".")]


def test_makes_a_prefix_and_leaves_the_original_alone(prefix, build, tmp_path):
    before = tree(prefix)
    dest = tmp_path / "patched"
    done = patch(prefix, dest, "--build", build)
    assert done.returncode == 0, done.stderr
    assert tree(prefix) == before
    assert not (dest / "energyplus").is_symlink()
    assert subprocess.run([dest / "energyplus"], capture_output=True, text=True).stdout == "launcher\n"
    assert subprocess.run([dest / "energyplus-official"], capture_output=True, text=True).stdout == "official\n"
    assert (dest / "Energy+.idd").read_text().startswith((prefix / "Energy+.idd").read_text())
    assert (dest / "DataSets").is_symlink()
    assert (dest / "libenergyplusapi.so").read_bytes() == b"our API library"
    assert (dest / "compare_shading").resolve() == SCRIPT.with_name("compare_shading")
    assert (dest / "libenergyplusapi-official.so").resolve() == prefix / "libenergyplusapi.so"
    # Python looks for the library beside the real folder.
    assert (dest / "pyenergyplus" / "api.py").resolve().parent.parent == dest
    for helper in ("runreadvars", "PostProcess/ReadVarsESO"):
        assert (dest / helper).stat().st_mode & stat.S_IXUSR
        assert not (dest / helper).is_symlink()
    assert (dest / "PostProcess" / "convert").is_symlink()


def test_dictionaries_know_our_objects_and_nothing_else_changes(patched, official):
    for name, read in (("Energy+.idd", objects_of_idd), ("Energy+.schema.epJSON", objects_of_schema)):
        before, after = (read((program.parent / name).read_text(encoding="utf-8")) for program in (official, patched))
        ours = {key for key in after if key.startswith("GPUShading:")}
        assert len(ours) == 9
        assert {key: value for key, value in after.items() if key not in ours} == before


def objects_of_schema(text):
    return json.loads(text)["properties"]


def objects_of_idd(text):
    """The text of each object by its type, without comments."""
    lines = [line.split("!")[0].strip() for line in text.splitlines()]
    found = {}
    for block in "\n".join(lines).split("\n\n"):
        kept = [line for line in block.splitlines() if line and not line.startswith("\\group")]
        if kept:
            found[kept[0].partition(",")[0]] = kept
    return found


def test_again_makes_the_same_anew(prefix, build, tmp_path):
    dest = tmp_path / "patched"
    assert patch(prefix, dest, "--build", build).returncode == 0
    first = sorted(path.name for path in dest.iterdir())
    (prefix / "Energy+.schema.epJSON").write_text('{"properties": {}}')
    (build / "energyplus_patch" / "energyplus").write_text("#!/bin/sh\necho newer\n")
    assert patch(prefix, dest, "--build", build).returncode == 0
    assert sorted(path.name for path in dest.iterdir()) == sorted([*first, "Energy+.schema.epJSON"])
    assert subprocess.run([dest / "energyplus"], capture_output=True, text=True).stdout == "newer\n"
    assert temporary(tmp_path) == []


@pytest.mark.parametrize(
    "case",
    ["dest in prefix", "dest is prefix", "not an installation", "foreign dest", "other version", "patched prefix",
     "no build", "file added", "file added below", "file changed", "file for a link", "link for a file",
     "dest is a link", "dest is a file"],
)
def test_refuses(case, prefix, build, tmp_path):
    dest = tmp_path / "patched"
    if case == "dest in prefix":
        dest = prefix / "patched"
    elif case == "dest is prefix":
        dest = prefix
    elif case == "not an installation":
        (prefix / "libenergyplusapi.so").unlink()
    elif case == "foreign dest":
        dest.mkdir()
        (dest / "mine").write_text("")
    elif case == "other version":
        (prefix / "libenergyplusapi.so").write_bytes(b"\x7fELF\0libenergyplusapi.so.25.1.0\0")
    elif case == "patched prefix":
        assert patch(prefix, dest, "--build", build).returncode == 0
        prefix, dest = dest, tmp_path / "second"
    elif case == "no build":
        build = tmp_path
    elif case == "dest is a file":
        dest.write_text("mine")
    else:
        assert patch(prefix, dest, "--build", build).returncode == 0
        if case == "file added":
            (dest / "my_model.idf").write_text("mine")
        elif case == "file added below":
            (dest / "PostProcess" / "my_notes.txt").write_text("mine")
        elif case == "file changed":
            (dest / "energyplus").write_text("#!/bin/sh\necho mine\n")
        elif case == "file for a link":
            (dest / "Energy+.idd").unlink()
            (dest / "Energy+.idd").write_text("mine")
        elif case == "link for a file":
            (tmp_path / "mine").write_bytes((dest / "energyplus").read_bytes())
            (dest / "energyplus").unlink()
            (dest / "energyplus").symlink_to(tmp_path / "mine")
        elif case == "dest is a link":
            dest.rename(tmp_path / "elsewhere")
            dest.symlink_to(tmp_path / "elsewhere")
    before = tree(tmp_path)
    done = patch(prefix, dest, "--build", build)
    assert done.returncode == 1
    assert done.stderr.startswith("patch_energyplus: ") and done.stderr.count("\n") == 1
    assert tree(tmp_path) == before


def test_force_accepts_another_version(prefix, build, tmp_path):
    (prefix / "libenergyplusapi.so").write_bytes(b"\x7fELF\0libenergyplusapi.so.25.1.0\0")
    assert patch(prefix, tmp_path / "patched", "--build", build, "--force").returncode == 0


def test_another_release_is_checked(patched, official, tmp_path, monkeypatch, capsys):
    """The official release in the place of a release that was never tested."""
    script = load_script()
    monkeypatch.setattr(script, "TESTED_VERSION", "24.1.0")
    script.patch(official.parent, tmp_path / "patched", build=energyplus.build_folder())
    said = capsys.readouterr().err
    assert f"EnergyPlus {energyplus_release()} has not been tested" in said and "agrees with polygon clipping" in said
    assert (tmp_path / "patched" / "energyplus").is_file()


def test_another_release_that_renders_something_else_is_refused(patched, tmp_path):
    """It renders overhangs of half their depth."""
    program = tmp_path / "energyplus"
    program.write_text(f"""\
#!/bin/sh
for model; do :; done
[ "$1" != --gpu-shading ] || sed -i 's/_y_coordinate": -1,/_y_coordinate": -0.5,/g' "$model"
exec {patched} "$@"
""")
    program.chmod(0o755)
    with pytest.raises(self_check.Disagreement, match="sunlit fraction of (SOUTH|WINDOW) that differs by 0"):
        self_check.check(tmp_path, energyplus_release())


def test_another_release_that_does_not_run_is_refused(prefix, build, tmp_path):
    (prefix / "libenergyplusapi.so").write_bytes(b"\x7fELF\0libenergyplusapi.so.25.1.0\0")
    done = patch(prefix, tmp_path / "patched", "--build", build)
    assert done.returncode == 1 and "a short run of it failed" in done.stderr and "--force" in done.stderr
    assert not (tmp_path / "patched").exists()


@pytest.mark.parametrize("step", ["make", "_exchange"])
def test_a_failure_leaves_the_former_prefix(step, prefix, build, tmp_path, monkeypatch):
    script = load_script()
    dest = script.patch(prefix, tmp_path / "patched", build=build)
    before = tree(dest)
    monkeypatch.setattr(script if step == "make" else output_folder, step,
                        lambda *_: (_ for _ in ()).throw(OSError("no space")))
    with pytest.raises(OSError, match="no space"):
        script.patch(prefix, dest, build=build)
    assert tree(dest) == before
    assert temporary(tmp_path) == []


@pytest.mark.parametrize("step", ["make", "_exchange"])
def test_a_kill_leaves_the_former_prefix(step, prefix, build, tmp_path):
    dest = tmp_path / "patched"
    assert patch(prefix, dest, "--build", build).returncode == 0
    before = tree(dest)
    child = os.fork()
    if child == 0:
        script = load_script()

        def killed(*_):
            os.kill(os.getpid(), signal.SIGKILL)

        setattr(script if step == "make" else output_folder, step, killed)
        script.patch(prefix, dest, build=build)
    _, status = os.waitpid(child, 0)
    assert os.WTERMSIG(status) == signal.SIGKILL
    assert tree(dest) == before
    assert len(temporary(tmp_path)) == 1
    assert patch(prefix, dest, "--build", build).returncode == 0
    assert {path for path in tree(dest)} == set(before)
    assert temporary(tmp_path) == []


def made_by_an_earlier_version(prefix, build, dest):
    """It kept no list of what it made, linked to EnergyPlus's dictionary, library and Python package, and made no links
    of ours."""
    assert patch(prefix, dest, "--build", build).returncode == 0
    (dest / output_folder.MARKER).unlink()
    for name in ("libenergyplusapi-official.so", "energyplus-gpu", "gpu_shading_share", "compare_shading"):
        (dest / name).unlink()
    shutil.rmtree(dest / "pyenergyplus")
    for name in ("Energy+.idd", "libenergyplusapi.so", "pyenergyplus"):
        (dest / name).unlink(missing_ok=True)
        (dest / name).symlink_to(prefix / name)


def test_a_prefix_of_an_earlier_version_is_made_anew(prefix, build, tmp_path):
    dest = tmp_path / "patched"
    made_by_an_earlier_version(prefix, build, dest)
    (build / "energyplus_patch" / "energyplus").write_text("#!/bin/sh\necho newer\n")
    done = patch(prefix, dest, "--build", build)
    assert done.returncode == 0, done.stderr
    assert subprocess.run([dest / "energyplus"], capture_output=True, text=True).stdout == "newer\n"


@pytest.mark.parametrize("name", ["mine", "PostProcess/mine", "runreadvars"])
def test_users_files_in_a_prefix_of_an_earlier_version_are_refused(name, prefix, build, tmp_path):
    dest = tmp_path / "patched"
    made_by_an_earlier_version(prefix, build, dest)
    (dest / name).write_text("mine")
    before = tree(tmp_path)
    done = patch(prefix, dest, "--build", build)
    assert done.returncode == 1
    assert done.stderr.startswith(f"patch_energyplus: {dest / name}") or name == "PostProcess/mine"
    assert done.stderr.count("\n") == 1
    assert tree(tmp_path) == before


def test_runs_where_it_is_installed(prefix, build, tmp_path):
    """With no more than what is installed beside it."""
    share = tmp_path / "share"
    (share / "shading_runs").mkdir(parents=True)
    for name in ("patch_energyplus", "shading_runs/__init__.py", "shading_runs/arguments.py",
                 "shading_runs/errors.py", "shading_runs/output_folder.py", "shading_runs/self_check.py",
                 "shading_runs/version.py"):
        shutil.copy2(SCRIPT.parent / name, share / name)
    (share / "lib").mkdir()
    for path in (build / "energyplus_patch").iterdir():
        shutil.copy2(path, share / "lib")
    (share / "VERSION").write_text("1.2.3\n")
    (share / "ENERGYPLUS_RELEASE").write_text(f"{energyplus_release()}\n")
    done = subprocess.run([share / "patch_energyplus", prefix, tmp_path / "patched"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("command, words", [
    (("patch_energyplus", "--forse", "a", "b"), "--forse: no such flag; did you mean --force?"),
    (("patch_energyplus", "a", "b", "c"), "unrecognized arguments: c"),
    (("compare_shading", "-w", "w.epw", "--timeuot=3", "a.idf"), "--timeuot: no such flag; did you mean --timeout?"),
])
def test_a_mistyped_flag_of_a_script_is_named(command, words):
    script = energyplus.REPOSITORY / "scripts" / command[0]
    done = subprocess.run([sys.executable, script, *command[1:]], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == f"{command[0]}: error: {words}"


def test_the_official_wheel_is_accepted(official, build, tmp_path):
    dest = tmp_path / "patched"
    assert patch(official.parent, dest, "--build", build).returncode == 0
    answer = subprocess.run([dest / "energyplus-official", "--version"], capture_output=True, text=True)
    assert energyplus_release() in answer.stdout

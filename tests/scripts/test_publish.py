"""Scripts that make packages: what is the user's in their folder stays, and they say so before they build."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
NONE = {"PATH": os.environ["PATH"], "GPU_SHADING_BUILD": "no-such-build"}


def run(*command, folder=None):
    return subprocess.run([str(word) for word in command], cwd=folder, env=NONE, capture_output=True, text=True,
                          timeout=60)


def publish(target, *files):
    return run(SCRIPTS / "packaging" / "publish", "build_deb", target, *files)


def packages(folder, *names):
    """Files with their names in them."""
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / name).write_text(name)
    return [folder / name for name in names]


def refused(done, path, maker="build_deb"):
    assert done.returncode == 1
    assert done.stderr.startswith(f"{maker}: {path} ") and done.stderr.count("\n") == 1, done.stderr
    assert not done.stdout


def visible(folder):
    return sorted(path.name for path in folder.iterdir() if not path.name.startswith("."))


def test_a_later_version_replaces_an_earlier_one(tmp_path):
    target = tmp_path / "deep" / "out"
    assert publish(target).returncode == 0
    assert not target.parent.exists()
    assert publish(target, *packages(tmp_path / "1", "a_1.deb", "b_1.deb")).returncode == 0
    assert publish(target, *packages(tmp_path / "2", "a_2.deb")).returncode == 0
    assert visible(target) == ["a_2.deb"]
    assert (target / "a_2.deb").read_text() == "a_2.deb"


@pytest.mark.parametrize("case", ["others' packages", "a package added", "a package changed", "a folder of another's"])
def test_what_is_the_users_stays(case, tmp_path):
    target, made = tmp_path / "out", packages(tmp_path / "made", "a_2.deb")
    if case == "others' packages":
        named = packages(target, "mine_1.deb")[0].parent
    else:
        assert publish(target, *packages(tmp_path / "earlier", "a_1.deb")).returncode == 0
        named = {"a package added": target / "mine_1.deb", "a package changed": target / "a_1.deb"}.get(case, target)
        if named == target:
            marker = target / ".gpu_shading_output.json"
            marker.write_text(marker.read_text().replace("build_deb", "build_wheel"))
        else:
            named.write_text("mine")
    before = {path: path.read_bytes() for path in target.iterdir()}
    refused(publish(target), named)
    refused(publish(target, *made), named)
    assert {path: path.read_bytes() for path in target.iterdir()} == before
    assert sorted(path.name for path in tmp_path.glob(".*")) == []


def test_a_missing_package_changes_nothing(tmp_path):
    target = tmp_path / "out"
    assert publish(target, *packages(tmp_path / "1", "a_1.deb")).returncode == 0
    done = publish(target, tmp_path / "1" / "a_1.deb", tmp_path / "none.deb")
    assert done.returncode == 1
    assert done.stderr == f"build_deb: {tmp_path / 'none.deb'}: No such file or directory\n"
    assert visible(target) == ["a_1.deb"]


@pytest.mark.parametrize("script", ["build_deb", "build_wheel"])
def test_scripts_refuse_before_they_build(script, tmp_path):
    """A folder is relative to where the script is called."""
    mine = packages(tmp_path / "out", "mine_1.deb", "mine.whl")
    refused(run(SCRIPTS / "dev" / script, "out", folder=tmp_path), tmp_path / "out", script)
    assert [path.read_text() for path in mine] == ["mine_1.deb", "mine.whl"]


def test_windows_libraries_replace_only_their_own(tmp_path):
    mine = packages(tmp_path / "dependencies", "dependencies.txt")[0]
    done = run(SCRIPTS / "packaging" / "windows" / "dependencies", mine.parent)
    refused(done, mine.parent, "dependencies")
    assert mine.read_text() == "dependencies.txt"


def test_windows_refuses_before_it_builds(tmp_path):
    """Its folder is in that of the sources."""
    (tmp_path / "scripts" / "dev").mkdir(parents=True)
    shutil.copy(SCRIPTS / "dev" / "build_windows", tmp_path / "scripts" / "dev")
    for name in ("packaging", "shading_runs"):
        shutil.copytree(SCRIPTS / name, tmp_path / "scripts" / name)
    target = tmp_path / "out" / "windows"
    target.parent.mkdir()
    mine = packages(target, "mine.zip")[0]
    refused(run(tmp_path / "scripts" / "dev" / "build_windows"), target, "build_windows")
    assert mine.read_text() == "mine.zip"

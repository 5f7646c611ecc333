"""scripts/setup where it cannot go on: one line that says what to do, and nothing changed."""

import os
import shutil
import stat
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def setup(tmp_path):
    """A copy of the script, with the commands that it may use and some that are stood in for."""
    folder = tmp_path / "checkout"
    (folder / "scripts").mkdir(parents=True)
    shutil.copy(ROOT / "scripts" / "setup", folder / "scripts")
    shutil.copy(ROOT / "scripts" / "requirements.txt", folder / "scripts")
    tools = tmp_path / "bin"
    tools.mkdir()
    for name in ("bash", "dirname", "grep", "sed", "sha256sum", "cut", "cat", "ls", "mkdir", "touch", "find"):
        (tools / name).symlink_to(shutil.which(name))

    def call(*options, **stand_ins):
        for name, text in stand_ins.items():
            path = tools / name.replace("_", "-")
            path.write_text(f"#!{shutil.which('bash')}\n{text}\n")
            path.chmod(path.stat().st_mode | stat.S_IXUSR)
        done = subprocess.run([tools / "bash", folder / "scripts" / "setup", *options], env={"PATH": str(tools)},
                              capture_output=True, text=True)
        assert sorted(os.listdir(folder)) == ["scripts"]
        return done

    return call


def refused(done):
    assert done.returncode == 1
    assert done.stderr.startswith("setup: ") and done.stderr.count("\n") == 1, done.stderr
    return done.stderr


def test_without_root_and_sudo_it_lists_what_to_install(setup):
    line = refused(setup(id="echo 1000", dpkg_query="echo installed cmake", apt_get="exit 7"))
    assert "as root: apt-get install" in line
    assert "ninja-build" in line and "libtbb-dev" in line and " cmake " not in line
    assert "libgtest-dev" in line


def test_without_tests_it_lists_less(setup):
    line = refused(setup("--without-tests", id="echo 1000", dpkg_query="exit 1", apt_get="exit 7"))
    assert "libgtest-dev" not in line


def test_without_root_and_sudo_it_asks_for_nothing_that_is_optional(setup):
    """All is installed but libjs-three; a wrong machine then ends the script before it changes anything."""
    but_one = 'for name in "${@:3}"; do test "$name" = libjs-three || echo "installed $name"; done'
    assert "aarch64" in refused(setup(id="echo 1000", dpkg_query=but_one, apt_get="echo called; exit 7",
                                      uname="echo aarch64"))


def test_another_system_is_told_what_is_needed(setup):
    assert "install the equivalents of: cmake" in refused(setup(id="echo 0"))


def all_installed():
    return {"dpkg_query": 'for name in "${@:3}"; do echo "installed $name"; done', "id": "echo 1000"}


def test_another_machine_is_refused(setup):
    assert "aarch64" in refused(setup(**all_installed(), uname="echo aarch64"))


def hashes(package):
    text = (ROOT / "scripts" / "requirements.txt").read_text()
    return text.partition(f"\n{package}==")[2].partition("\n")[2].split("==")[0].count("--hash=")


def test_wheels_of_every_supported_python_are_pinned():
    for package in ("numpy", "matplotlib", "pillow", "markupsafe", "msgpack", "pyyaml"):
        assert hashes(package) >= 3, package
    assert hashes("iniconfig") == 1

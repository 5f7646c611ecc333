"""scripts/setup for a user who cannot install anything."""

import shutil
import subprocess

import pytest
from shading_runs import energyplus


@pytest.fixture
def search_path(tmp_path):
    """A search path without sudo, of a user other than root, and of a Debian in which nothing is installed."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name in ("cat", "dirname", "env", "grep", "sed"):
        (folder / name).symlink_to(shutil.which(name))
    for name, text in (("id", "echo 1000"), ("dpkg-query", "exit 1"), ("apt-get", "echo apt-get was called")):
        (folder / name).write_text(f"#!/bin/sh\n{text}\n")
        (folder / name).chmod(0o755)
    return folder


@pytest.mark.parametrize("options, tests", [([], True), (["--without-tests"], False)])
def test_without_root_it_lists_what_to_install(options, tests, search_path):
    done = subprocess.run(["/bin/bash", energyplus.REPOSITORY / "scripts" / "setup", *options], capture_output=True,
                          text=True, env={"PATH": str(search_path)})
    assert done.returncode == 1 and not done.stdout
    assert done.stderr.startswith("setup: as root: apt-get install --no-install-recommends cmake ")
    assert done.stderr.count("\n") == 1
    assert ("libgtest-dev" in done.stderr) == tests


def test_without_root_it_asks_for_nothing_that_is_optional(search_path):
    """All is installed but libjs-three; a wrong machine then ends the script before it changes anything."""
    (search_path / "dpkg-query").write_text(
        '#!/bin/sh\nfor package; do test "$package" = libjs-three || echo "installed $package"; done\n')
    (search_path / "uname").write_text("#!/bin/sh\necho other\n")
    (search_path / "uname").chmod(0o755)
    done = subprocess.run(["/bin/bash", energyplus.REPOSITORY / "scripts" / "setup"], capture_output=True, text=True,
                          env={"PATH": str(search_path)})
    assert done.returncode == 1 and not done.stdout
    assert done.stderr.startswith("setup: this machine is other") and done.stderr.count("\n") == 1

"""Sources are compiled one by one unless a script or a package turns unity builds on."""

import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# What configures builds of everything.
SCRIPTS = ["scripts/build", "scripts/test", "scripts/dev/build_windows", "scripts/dev/fuzz"]


def test_a_plain_configuration_has_no_unity_build(tmp_path):
    subprocess.run(["cmake", "-S", ROOT, "-B", tmp_path, "-G", "Ninja", "-DGPU_SHADING_TESTS=OFF"], check=True,
                   capture_output=True)
    assert "\nCMAKE_UNITY_BUILD:BOOL=OFF\n" in (tmp_path / "CMakeCache.txt").read_text()


def test_scripts_and_the_wheel_turn_it_on():
    for script in SCRIPTS:
        configured = re.findall(r"cmake -S \. .*", (ROOT / script).read_text())
        assert configured and all("-DCMAKE_UNITY_BUILD=ON" in line for line in configured), script
    assert 'CMAKE_UNITY_BUILD = "ON"' in (ROOT / "scripts" / "wheel" / "pyproject.toml").read_text()

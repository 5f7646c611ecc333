"""A new kind of filter, by the checklist of gpu_shading/README.md: grey_filter/grey_filter.patch adds one that dims the
beam alike at any angle.

It may change few lines besides its own files. GPU_SHADING_GREY_BUILD names a folder in which to build the patched
sources, for a test of everything that the new kind reaches.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from shading_runs import energyplus

PATCH = Path(__file__).resolve().parent / "grey_filter" / "grey_filter.patch"
DICTIONARY = "energyplus_patch/model/extensions/GPUShading.idd"
MOST_LINES = 12
FACTOR = 0.25

SUNLIT = """
import json, pickle
import numpy as np
from gpu_shading import Scene
from gpu_shading.grey import Grey

level = lambda low, size, z: [[low, low, z], [low + size, low, z], [low + size, low + size, z], [low, low + size, z]]
scene = Scene(receivers=[level(0, 1, 0)])
scene.add(level(-9, 20, 1), transmittance=pickle.loads(pickle.dumps(Grey(FACTOR))))
directions = [[180, 80], [90, 50]]
print(json.dumps({
    "sunlit": {device: scene.sunlit(directions, device=device).ravel().tolist() for device in ("cpu", "0")},
    "rays": scene.rays().transmittance([[0.5, 0.5, 0]], [[0, 0.3, 1]]).tolist()}))
"""


def changes():
    """(path, lines changed, whether it is a new file) of each file of the patch."""
    numbers = subprocess.run(["git", "apply", "--numstat", PATCH], cwd=energyplus.REPOSITORY, capture_output=True,
                             text=True, check=True)
    for line in numbers.stdout.splitlines():
        added, removed, path = line.split("\t")
        yield path, max(int(added), int(removed)), not (energyplus.REPOSITORY / path).exists()


def test_changes_few_lines_besides_its_own_files():
    subprocess.run(["git", "apply", "--check", PATCH], cwd=energyplus.REPOSITORY, check=True)
    elsewhere = {path: lines for path, lines, new in changes() if not new and path != DICTIONARY}
    print(elsewhere)
    assert 0 < sum(elsewhere.values()) <= MOST_LINES
    assert all("grey" in path for path, lines, new in changes() if new)


@pytest.fixture(scope="module")
def build():
    """The build folder of the patched sources."""
    if not (folder := os.environ.get("GPU_SHADING_GREY_BUILD")):
        pytest.skip("GPU_SHADING_GREY_BUILD does not name a folder to build in")
    sources = Path(folder).resolve() / "sources"
    subprocess.run(["git", "checkout-index", "--all", "--force", f"--prefix={sources}/"], cwd=energyplus.REPOSITORY,
                   check=True)
    for path, _, new in changes():
        if new:
            (sources / path).unlink(missing_ok=True)
    subprocess.run(["git", "apply", PATCH], cwd=sources, check=True, env=os.environ | {"GIT_DIR": os.devnull})
    build = sources / "build"
    environment = os.environ | {"CCACHE_BASEDIR": str(sources), "CCACHE_NOHASHDIR": "1"}
    for command in (["cmake", "-S", sources, "-B", build, "-G", "Ninja", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache",
                     f"-DGPU_SHADING_ENERGYPLUS={energyplus.official_prefix()}"],
                    ["cmake", "--build", build, "--target", "patched_prefix", "gpu_shading_python", "gl_tests"]):
        subprocess.run(command, check=True, env=environment)
    return build


def test_reaches_back_ends_rays_and_python(build):
    environment = os.environ | {"PYTHONPATH": str(build.parent / "gpu_shading" / "python")}
    done = subprocess.run([sys.executable, "-c", SUNLIT.replace("FACTOR", str(FACTOR))], env=environment,
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    answers = json.loads(done.stdout)
    for device, fractions in answers["sunlit"].items():
        assert fractions == pytest.approx([FACTOR] * 2, abs=1e-6), device
    assert answers["rays"] == [FACTOR]


def test_is_drawn_alike_by_all_back_ends(build):
    done = subprocess.run([build / "tests/gpu_shading/backends/opengl/gl_tests", "--gtest_filter=Of/CheckedDevice.*"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    # Two tests of each of eight kinds.
    assert "[  PASSED  ] 16 tests" in done.stdout, done.stdout


def test_reaches_check_cache_and_page(build, box, weather, tmp_path):
    prefix = build / "EnergyPlus"
    stored = []
    for factor in (FACTOR, 0.75):
        model = tmp_path / f"{factor}.idf"
        model.write_text(f"{box}\nGPUShading:GreyFilter,Dim,*,{factor};")
        listed = subprocess.run([prefix / "gpu_shading", "check", model], capture_output=True, text=True)
        assert f"grey ({factor})" in listed.stdout, listed.stderr
        report = tmp_path / f"report {factor}"
        run = energyplus.run(prefix / "energyplus", model, weather, tmp_path / f"run {factor}",
                             ["--gpu-shading", f"--gpu-shading-cache={tmp_path / 'cache'}",
                              f"--gpu-shading-report={report}", "-D"])
        assert run.completed, run.why()
        assert f'"passes":{factor}' in (report / "index.html").read_text()
        stored.append({path.name for path in (tmp_path / "cache").glob("*.sunlit")})
    assert len(stored[1]) == 2 * len(stored[0]) > 0, "each has answers of its own"

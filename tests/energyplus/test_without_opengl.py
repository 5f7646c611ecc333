"""A machine without EGL, OpenGL, libepoxy and Mesa computes the same on the CPU as OpenGL draws."""

import os
import subprocess
import sys

import pytest
import screened_room
from shading_runs import energyplus, input_file, results
from test_case_studies import load

# Bounds of what counted and drawn sunlit fractions may differ by, mean and largest. Behind shades of many
# transmittances, both sample the same pixels, and OpenGL rounds corners to 1/256 of a pixel. Other views have samples
# of their own on the CPU, so that each errs by itself.
SAME_PIXELS = (2e-5, 3e-4)
OWN_SAMPLES = (6e-5, 1.5e-3)

HIDDEN = r"""
set -e
for library in $(ldconfig -p | sed -nE 's/.* => (.*\/lib(EGL|GL|OpenGL|epoxy|gbm|vulkan).*)/\1/p'); do
  mount --bind /dev/null "$(readlink -f "$library")"
done
for drivers in /usr/lib/*/dri; do mount -t tmpfs none "$drivers"; done
exec "$@"
"""


@pytest.fixture(scope="session")
def without_opengl():
    """The beginning of a command that runs where these libraries cannot be loaded."""
    user = [] if os.geteuid() == 0 else ["--map-root-user"]
    command = ["unshare", *user, "--mount", "sh", "-c", HIDDEN, "sh"]
    load_egl = "import ctypes; ctypes.CDLL('libEGL.so.1')"
    tried = subprocess.run([*command, sys.executable, "-c", "pass"], capture_output=True, text=True)
    if tried.returncode != 0:
        pytest.skip(f"no own mounts: {tried.stderr.strip()}")
    assert subprocess.run([*command, sys.executable, "-c", load_egl], capture_output=True).returncode != 0
    return command


@pytest.fixture(scope="session")
def opengl(patched):
    """The number of a device that draws with OpenGL."""
    devices = subprocess.run([patched.parent / "gpu_shading", "devices"], capture_output=True, text=True).stdout
    numbers = [line.split()[0] for line in devices.splitlines() if line[:1].isdigit()]
    if not numbers:
        pytest.skip("no OpenGL to draw with")
    return numbers[0]


def solar_shading_test():
    path = energyplus.models_folder() / "SolarShadingTest.idf"
    if not path.is_file():
        pytest.skip(f"{path} is missing: GPU_SHADING_MODELS names the folder of models")
    return path.read_text()


TEXTS = {
    "courtyard": lambda: (energyplus.REPOSITORY / "idf_examples" / "courtyard" / "courtyard.idf").read_text(),
    "canopy": lambda: "".join(load("canopy").model()),
    "screened_room": lambda: screened_room.model(screen="small holes"),
    "SolarShadingTest": solar_shading_test,
}


@pytest.mark.parametrize("name", TEXTS)
def test_it_agrees_with_what_is_drawn(name, patched, opengl, without_opengl, weather, tmp_path):
    model = input_file.Idf(TEXTS[name]())
    results.instrument(model)
    model.write(tmp_path / "model.idf")
    drawn = energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "drawn",
                           ["--gpu-shading", "--gpu-shading-device", opengl, "-D"])
    counted = energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "counted", ["--gpu-shading", "-D"],
                             before=without_opengl)
    assert drawn.completed, drawn.why()
    assert counted.completed, counted.why()
    assert "llvmpipe" in drawn.rendering or "GPU" in drawn.rendering
    assert "by CPU (" in counted.rendering
    found = results.differences(*(results.Results(each.folder) for each in (drawn, counted)))
    mean, _, largest = results.summary(found)
    assert min(min(each.reference) for each in found) < 0.9
    print(f"{name}: mean {mean:.1e}, largest {largest:.1e}")
    most = SAME_PIXELS if name == "canopy" else OWN_SAMPLES
    assert mean < most[0] and largest < most[1]


def test_the_devices_are_the_cpu(patched, without_opengl):
    shown = subprocess.run([*without_opengl, patched.parent / "gpu_shading", "devices"], capture_output=True, text=True)
    assert shown.returncode == 0
    assert shown.stdout.splitlines()[-1].startswith("cpu  CPU (")


def test_the_cpu_loads_no_opengl(patched, box, weather, tmp_path):
    """The loader itself says what a run on the device cpu opens."""
    (tmp_path / "model.idf").write_text(box)
    run = energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "out",
                         ["--gpu-shading", "--gpu-shading-device", "cpu", "-D"],
                         {"LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(tmp_path / "loaded")})
    assert run.completed, run.why()
    loaded = "".join(path.read_text(errors="replace") for path in tmp_path.glob("loaded*"))
    assert "libgpu_shading_energyplus" in loaded
    for library in ("libEGL", "libGL.", "libGLX", "libepoxy", "_dri.so", "libgpu_shading_gl"):
        assert library not in loaded

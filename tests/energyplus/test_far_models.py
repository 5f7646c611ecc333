"""Models in the coordinates of national grids, where single precision rounds vertices to 0.25 m."""

import re
import subprocess

import pytest
import window_with_shades
from output_files import values_of

GRID = (500_000, -4_000_000)
LOUVRES = 15
VERTEX = re.compile(r"(-?\d+\.\d{9}),(-?\d+\.\d{9}),(-?\d+\.\d{9})")
SUNLIT = "Surface Outside Face Sunlit Fraction"
OVERHANG = "Shading:Overhang,Awning,Window,0.1,90,0.2,0.2,0.5;\n"
WARNING = "EnergyPlus passes vertices in single precision"


def model(east=0, north=0):
    """A window behind louvres."""
    text = window_with_shades.model("south", False, False)
    shades = [[(-1.6, -0.05, z + 0.1), (-1.6, -0.17, z), (1.6, -0.17, z), (1.6, -0.05, z + 0.1)]
              for z in (1 + 0.2 * i for i in range(LOUVRES))]
    for number, shade in enumerate(shades):
        text += f"Shading:Building:Detailed,Louvre {number},,4,\n"
        text += ",\n".join(f"{x:.9f},{y:.9f},{z:.9f}" for x, y, z in shade) + ";\n"
    text += f"Output:Variable,*,{SUNLIT},Timestep;\n"

    def move(match):
        x, y, z = map(float, match.groups())
        return f"{x + east:.9f},{y + north:.9f},{z:.9f}"

    return VERTEX.sub(move, text)


@pytest.mark.parametrize("lean", ["off", "on"])
def test_far_models_are_shaded_alike(run, lean):
    near, far = (run(text, name, f"--gpu-shading-lean={lean}")
                 for name, text in (("near", model()), ("far", model(*GRID))))
    expected, found = values_of(near, SUNLIT, "Zone Timestep"), values_of(far, SUNLIT, "Zone Timestep")
    assert any(0.01 < value < 0.9 for value in expected["WINDOW"])
    walls = [name for name in expected if "LOUVRE" not in name and "PLACEHOLDER" not in name]
    assert len(walls) > 4
    for name in walls:
        assert found[name] == pytest.approx(expected[name], abs=2e-3), name
    assert not [line for line in far.our_lines if WARNING in line]


def test_check_shows_exact_vertices(patched, tmp_path):
    path = tmp_path / "far.idf"
    path.write_text(model(*GRID))
    done = subprocess.run([patched.parent / "gpu_shading", "check", path, "--vertices"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "-4000000.17" in done.stdout
    assert WARNING not in done.stdout


def test_other_surfaces_are_warned_of(run, patched):
    assert not [line for line in run(model() + OVERHANG, "near").our_lines if WARNING in line]
    done = run(model(*GRID) + OVERHANG, "far")
    check = subprocess.run([patched.parent / "gpu_shading", "check", done.folder.parent / "far.idf"],
                           capture_output=True, text=True)
    assert check.returncode == 0, check.stderr
    for lines in (done.our_lines, check.stdout.splitlines()):
        warnings = [line for line in lines if WARNING in line]
        assert warnings
        for warning in warnings:
            assert "those of 1 surface by up to 0.1 m" in warning
            assert ": AWNING; move the model to the origin" in warning

"""Trees in scenes from arrays."""

import os
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

from gpu_shading import Crown, InvalidInput, Scene

GROUND = [[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]]


def through_sphere(k):
    """Mean transmittance over the disc of a sphere, k being that of its diameter."""
    return 2 * (1 - (1 + k) * np.exp(-k)) / k**2


def grove(trunk=0.0, **choices):
    scene = Scene(receivers={"ground": GROUND})
    scene.add_tree([1, 2, 0], 8, 6, 1.0, crown_base=2, trunk_diameter=trunk, name="oak", **choices)
    return scene


def stopped(scene, **asked):
    return (1 - scene.renderer(device="cpu", resolution=1024).sunlit([0, 90], **asked).item()) * 1600


def test_a_sphere_of_leaves_follows_its_chords():
    disc = np.pi * 9
    assert stopped(grove()) == pytest.approx(disc * (1 - through_sphere(3)), rel=5e-3)
    assert stopped(grove(wood_density=0.5)) == pytest.approx(disc * (1 - through_sphere(4.5)), rel=5e-3)
    falling = grove(wood_density=0.5, leaves="season")
    assert falling.deployments == ["season"]
    assert stopped(falling, deployments={"season": 0.0}) == pytest.approx(disc * (1 - through_sphere(1.5)), rel=5e-3)
    assert stopped(pickle.loads(pickle.dumps(falling)), deployments=[0.0]) == stopped(
        falling, deployments={"season": 0.0})


def test_its_trunk_is_opaque():
    names = grove(0.4).names
    assert names == ["ground"] + 7 * ["oak"]
    rays = grove(0.4).rays()
    assert rays.transmittance([[-5, 2, 1]], [[1, 0, 0]]).item() == 0.0
    assert rays.transmittance([[-5, 2, 5]], [[0, 0, 1]]).item() == 1.0
    assert grove().rays().transmittance([[-5, 2, 5]], [[1, 0, 0]]).item() == pytest.approx(np.exp(-3.0))


def test_mistakes_are_named():
    with pytest.raises(InvalidInput, match="shape"):
        Crown(3, 1, shape="cube")
    with pytest.raises(InvalidInput, match="leaf_density"):
        Crown(3, -1)
    with pytest.raises(InvalidInput, match="neither a transmittance nor a screen"):
        Scene().add(GROUND, crown=Crown(3, 1), transmittance=0.5)
    with pytest.raises(InvalidInput, match="foot"):
        Scene().add_tree([1, 2], 3, 4, 1)


RADIANCE = Path(__file__).resolve().parents[2] / ".venv" / "radiance" / "pyradiance"
# Media that absorb, in the same solids: a sphere, a cylinder and a cone with their ends.
MIST = """\
void glow sky 0 0 4 1 1 1 0
sky source dome 0 0 4 0 0 1 360
void mist light 0 0 3 0.25 0.25 0.25
void mist dense 0 0 3 0.6 0.6 0.6
light sphere one 0 0 4 0 0 3 2
dense cylinder two 0 0 7 5 0 1 5 0 4 1.5
dense ring low 0 0 8 5 0 1 0 0 -1 0 1.5
dense ring high 0 0 8 5 0 4 0 0 1 0 1.5
light cone three 0 0 8 0 6 1 0 6 6 1.8 0
light ring base 0 0 8 0 6 1 0 0 -1 0 1.8
"""


def test_rays_are_dimmed_as_by_radiance(tmp_path):
    if not (RADIANCE / "bin" / "rtrace").is_file():
        pytest.skip(f"{RADIANCE} is missing: scripts/setup could not fetch pyradiance")

    def square(x, y, z, half):
        return [[x - half, y - half, z], [x + half, y - half, z], [x + half, y + half, z], [x - half, y + half, z]]

    scene = Scene()
    scene.add(square(0, 0, 1, 2), crown=Crown(4, 0.5))
    scene.add(square(5, 0, 1, 1.5), crown=Crown(3, 1.2, shape="cylinder"))
    scene.add(square(0, 6, 1, 1.8), crown=Crown(5, 0.5, shape="cone"))
    random = np.random.default_rng(3)
    origins = random.uniform([-6, -6, -3], [9, 9, 0], (500, 3))
    directions = random.uniform([-1, -1, 1], [6, 7, 4], (500, 3)) - origins
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    (tmp_path / "scene.rad").write_text(MIST)
    environment = {**os.environ, "RAYPATH": str(RADIANCE / "lib")}

    def call(program, *words, **options):
        return subprocess.run([RADIANCE / "bin" / program, *words], cwd=tmp_path, env=environment, check=True,
                              capture_output=True, **options).stdout

    (tmp_path / "scene.oct").write_bytes(call("oconv", "scene.rad"))
    lines = "\n".join(" ".join(map(repr, map(float, row))) for row in np.hstack([origins, directions]))
    traced = call("rtrace", "-h", "-ab", "0", "-ma", "0", "0", "0", "scene.oct", input=f"{lines}\n".encode())
    passed = np.array([float(line.split()[0]) for line in traced.decode().splitlines()])
    ours = scene.rays().transmittance(origins, directions)
    assert (ours < 0.9).sum() > 200
    assert ours == pytest.approx(passed, abs=1e-5)

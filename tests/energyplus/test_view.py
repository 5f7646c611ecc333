"""gpu_shading view: pictures of what the sun sees of a receiver."""

import subprocess

import matplotlib as mpl
import numpy as np
import pytest
import window_with_shades
from PIL import Image

YELLOW, BLUE = (255, 255, 0), (0, 0, 255)
CIVIDIS = 4  # of 255: the colours are straight lines between 17 of them


@pytest.fixture
def view(patched, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(window_with_shades.model("south", True, True))

    def call(*arguments):
        return subprocess.run([patched.parent / "gpu_shading", "view", model, *arguments], capture_output=True,
                              text=True, cwd=tmp_path)

    return call


def sunlit_share(path):
    """Of the receiver's pixels."""
    with Image.open(path) as picture:
        colours = {colour: count for count, colour in picture.convert("RGB").getcolors(1 << 24)}
    return colours.get(YELLOW, 0) / (colours.get(YELLOW, 0) + colours.get(BLUE, 0))


def test_the_sunlit_share_of_a_picture_is_the_closed_form(view, tmp_path):
    suns = [(150.0, 30.0), (180.0, 60.0), (215.5, 12.25)]
    lines = [f"{number}.png {azimuth} {altitude} window\n" for number, (azimuth, altitude) in enumerate(suns)]
    (tmp_path / "views.txt").write_text("".join(lines))
    done = view("--list", "views.txt", "-o", "pictures", "--size", "600")
    assert done.returncode == 0, done.stderr
    for number, sun in enumerate(suns):
        exact = window_with_shades.sunlit_area("south", True, True, *sun) / window_with_shades.SIZE**2
        assert 0.05 < exact < 0.95
        # A window of some 400 pixels a side, two edges of shadow, each wrong by half a pixel at most.
        assert sunlit_share(tmp_path / "pictures" / f"{number}.png") == pytest.approx(exact, abs=3e-3)


def test_one_picture(view, tmp_path):
    done = view("--receiver", "Window", "--sun", "180,60", "-o", "sun.png", "--size", "300")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "sun.png") as picture:
        assert max(picture.size) == 300


@pytest.mark.parametrize("arguments, words", [
    (("--receiver", "Door", "--sun", "180,60"), ("receiver Door", "no such surface")),
    (("--receiver", "Window", "--sun", "180,-1"), ("sun altitude -1", "above 0")),
    (("--receiver", "Window"), ("--sun AZIMUTH,ALTITUDE",)),
    (("--list", "views.txt"), ("views.txt, line 2", "nonsense")),
    (("--list", "missing.txt"), ("missing.txt", "cannot be read")),
])
def test_what_is_wrong(view, tmp_path, arguments, words):
    (tmp_path / "views.txt").write_text("a.png 180 60 Window\nnonsense\n")
    done = view(*arguments, "-o", "sun.png")
    assert done.returncode == 1
    assert done.stderr.startswith("gpu_shading: error: ")
    assert len(done.stderr.splitlines()) == 1
    for word in words:
        assert word in done.stderr
    assert not (tmp_path / "sun.png").exists()


def test_a_whole_scene_has_receivers_by_their_sunlit_fraction(view, tmp_path):
    sun = (150.0, 30.0)
    done = view("--sun", ",".join(map(str, sun)), "-o", "scene.png", "--size", "600")
    assert done.returncode == 0, done.stderr
    exact = window_with_shades.sunlit_area("south", True, True, *sun) / window_with_shades.SIZE**2
    assert 0.2 < exact < 0.8
    expected = 255 * np.array(mpl.colormaps["cividis"](exact)[:3])
    with Image.open(tmp_path / "scene.png") as picture:
        pixels = np.asarray(picture.convert("RGB"), float)
    close = np.abs(pixels - expected).max(axis=2) < CIVIDIS
    # The window fills a good part of the picture; nothing else of it is as much in the sun.
    assert close.mean() > 0.02
    assert len({tuple(pixel) for pixel in pixels[close]}) == 1

"""Which sky the ground sees among many buildings: EnergyPlus's clipping gives up, and rays say who is right."""

import re

import numpy as np
import pytest
from sky_by_rays import compare

SIDE = 8  # blocks in a row, and rows
GROUND = "GROUND"
FACES = [f"BLOCK 28 {face}" for face in range(5)]


def block(number, x, y, width, depth, height):
    """Four walls and a roof."""
    a, b, c, d = (x, y), (x + width, y), (x + width, y + depth), (x, y + depth)
    faces = [[(*p, height), (*p, 0), (*q, 0), (*q, height)] for p, q in ((a, b), (b, c), (c, d), (d, a))]
    faces.append([(*p, height) for p in (a, b, c, d)])
    return "".join(f"Shading:Site:Detailed,Block {number} {face},,4,"
                   + ",".join(f"{value:.3f}" for corner in corners for value in corner) + ";\n"
                   for face, corners in enumerate(faces))


@pytest.fixture(scope="module")
def compared(patched, official, weather, box, tmp_path_factory):
    """The box among blocks on a ground of 220 m, with reflections."""
    folder = tmp_path_factory.mktemp("blocks")
    random = np.random.default_rng(7)
    text = re.sub("FullInteriorAndExterior,", "FullExteriorWithReflections,", box)
    text = re.sub(r"Shading:Building:Detailed,[^;]*;|Output:Variable,[^;]*;[^\n]*\n", "", text)
    text += "Shading:Site:Detailed,Ground,,4,-110,-110,-0.1,110,-110,-0.1,110,110,-0.1,-110,110,-0.1;\n"
    pitch = 180 / SIDE
    for number in range(SIDE**2):
        row, column = divmod(number, SIDE)
        (x, y), (width, depth) = pitch * 0.2 * random.random(2), pitch * (0.35 + 0.1 * random.random(2))
        text += block(number + 1, -90 + pitch * column + x, -90 + pitch * row + y, width, depth,
                      7.5 + 7.5 * random.random())
    (folder / "blocks.idf").write_text(text)
    return compare(folder / "blocks.idf", weather, folder, 3000, ["-D"], [GROUND, *FACES])


def test_rendering_agrees_with_rays_on_every_face(compared):
    rows, _ = compared
    assert len(rows) > 5
    for face, _, rendered, rays, error in rows:
        assert rendered == pytest.approx(rays, abs=4.5 * error + 1e-3), face


def test_clipping_is_wrong_where_it_has_too_many_figures(compared):
    rows, warned = compared
    assert "Too many figures" in warned
    ((_, clipped, rendered, rays, error),) = [row for row in rows if row[0] == GROUND]
    print(f"ground: clipped {clipped:.5f}, rendered {rendered:.5f}, by rays {rays:.5f} +- {error:.5f}")
    assert abs(clipped - rays) > 8 * error
    assert abs(rendered - rays) < 4 * error

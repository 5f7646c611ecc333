"""Trees before a window, against an integration over its area of their own."""

import json
import math
import subprocess

import numpy as np
import pytest
import window_with_shades as case
from output_files import values_of
from shading_runs import energyplus
from test_ashrae_1052 import timesteps
from test_daylighting import FACTORS, blacken, factors, without_louvres
from test_site import shade

HALF = case.SIZE / 2
EXAMPLE = energyplus.REPOSITORY / "idf_examples" / "trees"
# Foot, height, diameter and crown base, m; leaf area density, m2/m3.
OAK = ((0.5, -2.8, 0.0), 9.0, 5.0, 2.0, 0.6)
ELM = ((-3.0, -4.0, 0.0), 8.0, 4.0, 1.5, 0.4)


def tree(name, foot, height, diameter, base, density, schedule="", cycle="Evergreen"):
    x, y, z = foot
    return (f"GPUShading:Tree,{name},{x},{y},{z},{height},{diameter},{base},Ellipsoid,0,{cycle},{schedule},"
            f"{density},0;\n")


def sunlit_fraction(trees, azimuth, altitude, share=1.0, hides=None):
    """Over points of the window: the product of exp(-0.5 density x chord of the ellipsoid).

    `hides(points, sun)`: where other objects block the beam.
    """
    a, h = math.radians(azimuth), math.radians(altitude)
    sun = np.array([math.sin(a) * math.cos(h), math.cos(a) * math.cos(h), math.sin(h)])
    side = (np.arange(360) + 0.5) / 360 * case.SIZE
    x, z = np.meshgrid(side - HALF, side + 1.0)
    points = np.stack([x, np.zeros_like(x), z], axis=-1)
    passed = np.ones_like(x)
    for foot, height, diameter, base, density in trees:
        radii = np.array([diameter / 2, diameter / 2, (height - base) / 2])
        centre = np.array(foot) + [0.0, 0.0, (height + base) / 2]
        p, d = (points - centre) / radii, sun / radii
        b, c = p @ d, (p * p).sum(-1) - 1
        chord = 2 * np.sqrt(np.maximum(0.0, b * b - c * (d @ d))) / (d @ d)
        passed *= np.exp(-0.5 * density * share * chord)
    if hides is not None:
        passed[hides(points, sun)] = 0.0
    return passed.mean()


@pytest.fixture
def run(run):
    def call(*arguments):
        done = run(*arguments)
        assert done.severe == []
        return done

    return call


def compare(done, trees, share=1.0, hides=None):
    rows = [row for row in timesteps(done.folder) if row[1] > 1 and 95 < row[0] < 265]
    found = np.array([area / case.SIZE**2 for _, _, area in rows])
    expected = np.array([sunlit_fraction(trees, azimuth, altitude, share, hides) for azimuth, altitude, _ in rows])
    print(f"{len(rows)} times, least {expected.min():.2f}, largest difference {np.abs(found - expected).max():.1e}")
    assert expected.min() < 0.75 and len(rows) > 20
    assert found == pytest.approx(expected, abs=2e-3)


def test_a_window_behind_trees_is_as_integrated(run):
    text = case.model("south", False, False) + tree("Oak", *OAK) + tree("Elm", *ELM)
    done = run(text, "trees")
    compare(done, [OAK, ELM])
    assert any("GPUShading:Tree Oak: 1 tree" in line for line in done.our_lines)


# Y and height of a ridge of terrain from west to east behind the tree, m.
@pytest.mark.parametrize("y, height", [(-30.0, 17.0), (-6.0, 7.0)], ids=["far", "near"])
def test_a_window_behind_trees_and_terrain_is_as_integrated(run, tmp_path, y, height):
    """Nodes of the terrain 2 m apart: level, but for a row with the ridge, whose sides are 2 m wide."""
    metre = 111_132.954 - 559.822 * math.cos(2 * math.radians(33.65)) + 1.175 * math.cos(4 * math.radians(33.65))
    south, step, rows, half = y - 20, 2.0, 21, 400.0
    table = [[315 + (height if row == 10 else 0)] * 3 for row in range(rows)]
    east = half / (metre * math.cos(math.radians(33.65)))
    (tmp_path / "ridge.asc").write_text(
        f"ncols 3\nnrows {rows}\nxllcenter {-84.42 - east:.12f}\nyllcenter {33.65 + south / metre:.12f}\n"
        f"dx {east:.12f}\ndy {step / metre:.12f}\n" + "\n".join(" ".join(map(str, row)) for row in table))

    def hides(points, sun):
        top = points[..., 2] + sun[2] / -sun[1] * -(y - points[..., 1])
        return (sun[1] < 0) & (top < height)

    text = case.model("south", False, False) + tree("Oak", *OAK) + "GPUShading:SiteContext,Ridge,,,,,,,ridge.asc;\n"
    text = text.replace("21 August,8,21,", "21 December,12,21,")
    done = run(text, "ridge")
    compare(done, [OAK], hides=hides)
    suns = [row[:2] for row in timesteps(done.folder) if row[1] > 1 and 95 < row[0] < 265]
    alone = [sunlit_fraction([], *sun, hides=hides) for sun in suns]
    assert any(0.1 < part < 0.9 and sunlit_fraction([OAK], *sun, hides=hides) < 0.9 * part
               for sun, part in zip(suns, alone, strict=True)), "the ridge and the crown never shade together"


def test_a_window_behind_a_tree_and_a_screen_is_as_integrated(run):
    """A thin sheet with square holes half as wide as their pitch, small beside the crown."""
    sheet = shade("Sheet", [(-30, -0.3, 10), (-30, -0.3, 0), (30, -0.3, 0), (30, -0.3, 10)])
    screen = "GPUShading:PerforatedScreen,Holes,Sheet,Square,,Straight,0.005,,0.01,,1e-6;\n"
    done = run(case.model("south", False, False) + tree("Oak", *OAK) + sheet + screen, "screen")
    rows = [row for row in timesteps(done.folder) if row[1] > 1 and 95 < row[0] < 265]
    found = np.array([area / case.SIZE**2 for _, _, area in rows])
    expected = np.array([sunlit_fraction([OAK], azimuth, altitude) / 4 for azimuth, altitude, _ in rows])
    assert expected.min() < 0.75 / 4 and len(rows) > 20
    assert found == pytest.approx(expected, abs=2e-3)


def test_leaves_follow_their_schedule_and_the_season(run):
    schedule = "ScheduleTypeLimits,Any;Schedule:Constant,Leaves,Any,0.25;\n"
    text = case.model("south", False, False) + schedule
    compare(run(text + tree("Oak", *OAK, "Leaves"), "scheduled"), [OAK], 0.25)
    # The design day is in August: in leaf in the north, and bare in the south.
    compare(run(text + tree("Oak", *OAK, "", "Deciduous"), "north"), [OAK])
    southern = text.replace("Site:Location,Atlanta,33.65", "Site:Location,Atlanta,-33.65")
    bare = run(southern + tree("Oak", *OAK, "", "Deciduous"), "south")
    assert values_of(bare, "Surface Outside Face Sunlit Fraction")["WINDOW"] == pytest.approx(
        values_of(run(southern, "none"), "Surface Outside Face Sunlit Fraction")["WINDOW"], abs=1e-6)


def test_daylight_passes_crowns(run, box):
    """A crown like a wall stops what a prism of its shape does, one without leaves nothing, and others a part."""
    room = blacken(without_louvres(box)) + FACTORS
    crown = "GPUShading:Tree,T,3,-6,0,8,6,1,Cylinder,0,Evergreen,,{},0;\n"
    at = [(3 + 3 * math.cos(a), -6 + 3 * math.sin(a)) for a in np.linspace(0, 2 * math.pi, 49)]
    sides = zip(at, at[1:], strict=False)
    prism = "".join(shade(f"Side {i}", [(*a, 8), (*a, 1), (*b, 1), (*b, 8)]) for i, (a, b) in enumerate(sides))
    prism += shade("Top", [(x, y, 8) for x, y in at[:-1]])

    def overcast(done):
        return factors(done)[:, 3].max()

    open_sky = overcast(run(room, "open"))
    stopped = overcast(run(room + crown.format(100), "dense"))
    assert stopped == pytest.approx(overcast(run(room + prism, "prism")), rel=0.01)
    assert stopped < 0.8 * open_sky
    assert overcast(run(room + crown.format(0), "bare")) == pytest.approx(open_sky, rel=1e-6)
    assert stopped * 1.02 < overcast(run(room + crown.format(0.3), "thin")) < open_sky * 0.98


def test_trees_of_a_map_are_listed(patched, tmp_path):
    (tmp_path / "trees.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "id": f"node/{i}", "properties": {"natural": "tree", "height": 8 + i},
         "geometry": {"type": "Point", "coordinates": [-84.42 + 1e-4 * i, 33.649]}} for i in range(3)]}))
    path = tmp_path / "model.idf"
    path.write_text(case.model("south", False, False) + "GPUShading:Tree,Street,,,,,,,,0.2,,,,,,trees.geojson;\n")
    listed = subprocess.run([patched.parent / "gpu_shading", "check", path], capture_output=True, text=True,
                            check=True).stdout
    assert "GPUShading:Tree Street: trees.geojson: 3 trees" in listed
    assert "STREET:NODE/1" in listed and "leaves by GPU SHADING NORTHERN LEAVES" in listed


def test_the_examples_mesh_shades_like_its_oak(patched, weather, tmp_path):
    """The generator's mesh is closed, fills the box of the crown that it replaces, and shades the window like it."""
    subprocess.run([EXAMPLE / "generate.py", tmp_path], check=True)
    fractions = []
    for path in (EXAMPLE / "trees.idf", tmp_path / "trees_mesh.idf"):
        model = tmp_path / path.name
        model.write_text(path.read_text() + "Output:Variable,Window,Surface Outside Face Sunlit Fraction,Timestep;\n")
        done = energyplus.run(patched, model, weather, tmp_path / path.stem, ["-D", "--gpu-shading"])
        assert done.completed, done.why() + done.text("eplusout.err")
        fractions.append(np.array(values_of(done, "Surface Outside Face Sunlit Fraction")["WINDOW"]))
    oak, mesh = fractions
    assert (oak < 0.8).sum() > 5
    assert 0.001 < np.abs(oak - mesh).mean() < 0.05

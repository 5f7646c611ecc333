"""Sunlit fractions of scenes from arrays, against closed forms and exact polygon booleans."""

import copy
import pickle
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from shapes import below_overhang, exact_fraction, overhang, towards, window

import gpu_shading

SUNS = np.array([[azimuth, altitude] for azimuth in range(110, 260, 15) for altitude in range(5, 80, 10)], dtype=float)


@pytest.fixture(scope="module")
def below():
    return gpu_shading.Scene(receivers={"window": window()}, casters=[overhang()])


def test_an_overhang_shades_as_its_profile_angle_says(below):
    found = below.sunlit(SUNS)[:, 0]
    error = np.abs(found - below_overhang(*SUNS.T))
    assert np.count_nonzero((found > 0.05) & (found < 0.95)) > 40
    # By default 99 % are within 1e-3.
    assert np.quantile(error, 0.99) < 1e-3
    assert below.areas.tolist() == [2.0, 22 * 0.5 - 1.0]
    assert below.normals.tolist() == [[0, -1, 0], [0, 0, 1]]


def test_a_smaller_error_is_kept(below):
    error = np.abs(below.renderer(error=1e-5).sunlit(SUNS)[:, 0] - below_overhang(*SUNS.T))
    assert np.quantile(error, 0.99) < 1e-5


def test_polygons_shade_as_exact_booleans_say(shapely):
    """Overlapping stars and triangles at three distances."""
    random = np.random.default_rng(5)
    receiver, casters = window(4.0, 3.0, 0.0), []
    for number in range(12):
        corners = 3 + number % 4 * 2
        angle = (np.arange(corners) + random.uniform(0, 0.8, corners)) * 2 * np.pi / corners
        radius = random.uniform(0.2, 0.8, corners)
        middle = random.uniform([0, 0], [4, 4])
        y = np.full(corners, -0.3 * (1 + number % 3))
        casters.append(np.column_stack([middle[0] + radius * np.cos(angle), y, middle[1] + radius * np.sin(angle)]))
    scene = gpu_shading.Scene(receivers=[receiver], casters=casters, error=1e-4)
    suns = random.uniform([130, 5], [230, 60], (60, 2))
    exact = [exact_fraction(shapely, receiver, casters, towards(*sun)) for sun in suns]
    assert np.ptp(exact) > 0.05 and max(exact) < 0.9
    error = np.abs(scene.sunlit(suns)[:, 0] - exact)
    assert error.max() < 1e-4


def test_directions_are_angles_or_vectors_in_any_shape(below):
    vectors = np.array([towards(*sun) for sun in SUNS]) * 7.0
    flat = below.sunlit(SUNS)
    assert np.abs(below.sunlit(vectors) - flat).max() < 1e-6
    assert below.sunlit(SUNS.reshape(5, -1, 2)).shape == (5, len(SUNS) // 5, 1)
    assert below.sunlit(SUNS[0]).shape == (1,) and below.sunlit(SUNS[:0]).shape == (0, 1)
    # Long vectors do not overflow.
    assert below.sunlit(vectors[0] * 1e300) == pytest.approx(flat[0], abs=1e-6)


def test_behind_and_projected(below):
    assert below.sunlit([[0.0, 45.0], [90.0, 10.0]]).tolist() == [[0.0], [0.0]]
    renderer = below.renderer()
    facing = np.array([-towards(*sun)[1] for sun in SUNS])
    areas = renderer.projected_areas(SUNS)[:, 0]
    assert np.allclose(areas, 2.0 * facing * renderer.sunlit(SUNS)[:, 0], atol=1e-12)


def test_many_directions_are_answered_as_few(below):
    many = np.tile(SUNS, (20, 1))
    assert len(many) > 1024
    assert np.array_equal(below.sunlit(many), np.tile(below.sunlit(SUNS), (20, 1)))


def test_shades_and_holes():
    """A sheet of glass with a hole before half of the window."""
    glass = gpu_shading.Transmittance.polynomial([0.0, 1.1, -0.4])
    scene = gpu_shading.Scene(receivers={"window": window()})
    sheet = [[-9, -0.5, -9], [11, -0.5, -9], [11, -0.5, 19], [-9, -0.5, 19]]
    hole = [[-5, -0.5, -5], [1, -0.5, -5], [1, -0.5, 18], [-5, -0.5, 18]]
    pane = scene.add(sheet, holes=[hole], transmittance=glass)
    assert pane == 1 and scene.areas[1] == pytest.approx(20 * 28 - 6 * 23)
    for altitude in (10.0, 35.0, 60.0):
        tau = glass.tau(altitude)
        cosine = np.cos(np.radians(altitude))
        assert tau == pytest.approx(1.1 * cosine - 0.4 * cosine**2, abs=1e-12)
        assert scene.sunlit([180.0, altitude])[0] == pytest.approx(0.5 + 0.5 * tau, abs=1e-4)


def test_constant_shades_multiply():
    scene = gpu_shading.Scene(receivers=[window()])
    for number, tau in enumerate((0.5, 0.3)):
        scene.add(window(90, 90, -40, -1.0 - number) - [40, 0, 0], transmittance=tau)
    assert scene.sunlit([180.0, 30.0])[0] == pytest.approx(0.15, abs=1e-6)


def test_schedules_are_factors_of_each_direction():
    scene = gpu_shading.Scene(receivers=[window()])
    scene.add(window(90, 90, -40, -1.0) - [40, 0, 0], schedule="leaves")
    suns = [[180.0, 20.0], [200.0, 30.0]]
    assert scene.schedules == ["leaves"]
    assert scene.sunlit(suns, factors={"leaves": 0.25})[:, 0] == pytest.approx([0.25, 0.25], abs=1e-6)
    assert scene.sunlit(suns, factors=[[0.25], [0.75]])[:, 0] == pytest.approx([0.25, 0.75], abs=1e-6)
    with pytest.raises(gpu_shading.InvalidInput, match="needed for the schedules leaves"):
        scene.sunlit(suns)


def test_a_screen_lets_its_transmittance_pass_and_can_be_withdrawn():
    screen = gpu_shading.Screen.pattern("round", 0.005, 0.01, arrangement="straight", thickness=0.002)
    scene = gpu_shading.Scene(receivers=[window()])
    scene.add(window(90, 90, -40, -1.0) - [40, 0, 0], screen=screen, deployment="sail")
    for azimuth, altitude in ((180.0, 0.0), (180.0, 30.0), (150.0, 40.0)):
        theta = np.degrees(np.arccos(-towards(azimuth, altitude)[1]))
        x, _, z = towards(azimuth, altitude)
        tau = float(screen.tau(theta, np.degrees(np.arctan2(z, x))))
        assert scene.sunlit([azimuth, altitude])[0] == pytest.approx(tau, abs=2e-3)
        half = scene.sunlit([azimuth, altitude], deployments={"sail": 0.5})[0]
        assert half == pytest.approx(0.5 + 0.5 * tau, abs=2e-3)


def test_a_scene_can_be_pickled(below):
    """As Dask sends it to workers."""
    scene = gpu_shading.Scene(receivers=[window()])
    scene.add(overhang(), transmittance=gpu_shading.Transmittance.table([0, 45, 90], [0.8, 0.6, 0.0]))
    scene.add(overhang(0.2), screen=gpu_shading.Screen.image(np.eye(16), 0.1, 0.1))
    scene.add(overhang(0.1, 3.0), screen=gpu_shading.Screen.pattern("hexagonal", 0.005, 0.01, thickness=0.001),
              casts="turned away", screen_origin=(0.1, 0.2), screen_rotation=30.0, deployment="sail")
    scene.add(overhang(0.3, 4.0), holes=[overhang(0.1, 4.0, 1.0)], schedule="leaves",
              transmittance=gpu_shading.Transmittance.glazing([[0.8, 0.1, 0.1]]))
    roles = np.zeros((len(scene.surfaces), 4), dtype=int)
    roles[:, 0] = np.arange(len(roles))
    roles[1, 2:] = 3, 4  # shades the fifth surface only
    scene.set_rule(gpu_shading.Rule(roles, np.ones((1, 1), dtype=int)))
    question = {"factors": {"leaves": 0.5}, "deployments": {"sail": 0.75}}
    expected = scene.sunlit(SUNS, **question)
    copies = [pickle.loads(pickle.dumps(scene, protocol)) for protocol in (2, 5)]
    for again in (*copies, copy.deepcopy(scene)):
        assert np.array_equal(again.sunlit(SUNS, **question), expected)
    scene.set_rule(gpu_shading.Rule(np.where(np.arange(4) == 2, 0, roles), np.ones((1, 1), dtype=int)))
    assert not np.array_equal(scene.sunlit(SUNS, **question), expected)


def test_an_added_surface_counts_at_once():
    scene = gpu_shading.Scene(receivers=[window()])
    assert scene.sunlit([180.0, 45.0])[0] == 1.0
    scene.add(overhang())
    assert scene.sunlit([180.0, 45.0])[0] == pytest.approx(0.5, abs=2e-3)


def test_python_goes_on_while_the_library_computes(below):
    """The interpreter's lock is released: another thread counts meanwhile."""
    renderer = below.renderer()
    suns = np.random.default_rng(1).uniform([110, 5], [250, 70], (400_000, 2))
    counted, done = [], threading.Event()

    def count():
        while not done.is_set():
            counted.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    began = time.monotonic()
    thread.start()
    renderer.sunlit(suns)
    ended = time.monotonic()
    done.set()
    thread.join()
    gaps = np.diff([began, *(at for at in counted if at < ended), ended])
    assert ended - began > 0.05, "too short to tell"
    assert gaps.max() < 0.5 * (ended - began)


def test_threads_that_share_a_renderer_get_their_own_answers():
    scene = gpu_shading.Scene(receivers=[window()])
    scene.add(window(90, 90, -40, -1.0) - [40, 0, 0], screen=gpu_shading.Screen.pattern("round", 0.005, 0.01),
              deployment="sail")
    shares = np.linspace(0, 1, 8)
    expected = [scene.sunlit(SUNS, deployments=[share]) for share in shares]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda share: scene.sunlit(SUNS, deployments=[share]), np.tile(shares, 4)))
    assert all(np.array_equal(one, other) for one, other in zip(found, expected * 4, strict=True))


def test_below_the_horizon_there_is_no_sun_unless_asked_for():
    scene = gpu_shading.Scene(receivers={"window": window()}, casters=[])
    scene.add(window() + [3, 0, 0], name="fenced", receives=True, casts="never")
    scene.add([[2, -1, 0], [6, -1, 0], [6, -1, 9], [2, -1, 9]], schedule="hedge")
    suns = np.array([[180.0, 20.0], [180.0, -20.0], [180.0, 0.0], [180.0, -0.01], [180.0, -60.0]])
    factors = [[0.5], [0.25], [0.75], [0.125], [1.0]]
    found = scene.sunlit(suns, factors=factors)
    assert found == pytest.approx(np.array([[1, 0.5], [0, 0], [1, 0.75], [0, 0], [0, 0]]), abs=1e-6)
    vectors = [towards(*sun) for sun in suns]
    renderer = scene.renderer()
    assert renderer.sunlit(vectors, factors=factors) == pytest.approx(found, abs=1e-12)
    asked = renderer.sunlit(suns, factors=factors, below_horizon=True)
    assert asked[[1, 3]] == pytest.approx(np.array([[1, 0.25], [1, 0.125]]), abs=1e-6)
    areas = renderer.projected_areas(suns, factors=factors)
    assert (areas[[1, 3, 4]] == 0).all() and (areas[[0, 2]] > 0).all()
    assert renderer.projected_areas(suns, factors=factors, below_horizon=True)[1, 0] == pytest.approx(
        np.cos(np.radians(20)) * scene.areas[0])
    inside = gpu_shading.Scene(receivers={"window": window(), "wall": window() + [0, 3, 0]})
    assert inside.renderer().interior_areas(suns, 0, [1])[:, 0] == pytest.approx([0, 0, scene.areas[0], 0, 0], abs=0.05)


def test_where_a_surface_looks():
    scene = gpu_shading.Scene(receivers={"window": window(), "clockwise": window()[::-1]})
    scene.add([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], name="roof", receives=True)
    scene.add([[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]], name="soffit")
    scene.add([[0, 0, 0], [0, 1, 0], [-1, 1, 1], [-1, 0, 1]], name="east")
    assert scene.facing[:2] == pytest.approx(np.array([[180, 90], [0, 90]]))
    assert scene.facing[2:4, 1] == pytest.approx([0, 180])
    assert scene.facing[4] == pytest.approx([90, 45])
    lit = scene.sunlit([[180, 30]])[0]
    assert lit[0] == pytest.approx(1.0, abs=1e-6) and lit[1] == 0.0

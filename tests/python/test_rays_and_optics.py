"""Rays, transmittances and perforated sheets, against closed forms."""

import numpy as np
import pytest
from shapes import below_overhang, overhang, towards, window

import gpu_shading


def test_mean_of_rays_is_the_sunlit_fraction():
    scene = gpu_shading.Scene(receivers=[window()], casters=[overhang()])
    x, z = (grid.ravel() for grid in np.meshgrid((np.arange(50) + 0.5) / 25, 1 + (np.arange(400) + 0.5) / 400))
    origins = np.column_stack([x, np.zeros_like(x), z])
    rays = scene.rays()
    for azimuth, altitude in ((180, 30), (200, 40), (150, 20)):
        passed = rays.transmittance(origins, np.tile(towards(azimuth, altitude), (len(x), 1)))
        assert passed.mean() == pytest.approx(below_overhang(azimuth, altitude), abs=1 / 400)


def test_nearest_is_where_a_ray_meets_each_sheet():
    scene = gpu_shading.Scene()
    near = scene.add(window(4, 4, 0, -1.0), transmittance=0.5)
    far = scene.add(window(4, 4, 0, -3.0))
    rays = scene.rays()
    origins = np.array([[1.0, 0, 1], [1.0, -2, 1], [1.0, 0, 1], [9.0, 0, 1]])
    direction = np.array([0.0, -2.0, 0.5])
    slant = np.hypot(1.0, 0.25)  # m of ray for each metre towards the sheets
    hits = rays.nearest(origins, np.tile(direction, (4, 1)), [np.inf, np.inf, 0.5, np.inf])
    assert hits.surfaces.tolist() == [near, far, -1, -1]
    assert hits.distances == pytest.approx([slant, slant, np.inf, np.inf], abs=1e-12)
    opaque = rays.nearest(origins, np.tile(direction, (4, 1)), opaque=True)
    assert opaque.surfaces.tolist() == [far, far, far, -1]
    assert opaque.distances[:3] == pytest.approx([3 * slant, slant, 3 * slant], abs=1e-12)
    assert rays.transmittance(origins, np.tile(direction, (4, 1)), [2.0, 9, 9, 9]) == pytest.approx([0.5, 0, 0, 1])
    assert rays.nearest(origins[:1], [direction], excluded=[near]).surfaces[0] == far


def lens(theta, diameter, pitch, thickness):
    """Straight round holes: two circles apart by the shift between the faces."""
    apart = np.minimum(1.0, thickness * np.tan(np.radians(theta)) / diameter)
    overlap = 2 / np.pi * (np.arccos(apart) - apart * np.sqrt(1 - apart**2))
    return np.pi / 4 * (diameter / pitch) ** 2 * overlap


def test_a_pattern_has_the_overlap_of_its_circles():
    screen = gpu_shading.Screen.pattern("round", 0.006, 0.01, arrangement="straight", thickness=0.003)
    theta, phi = np.linspace(0, 89, 90)[:, None], np.array([0.0, 17.0, 45.0, 200.0])
    assert np.abs(screen.tau(theta, phi) - lens(theta, 0.006, 0.01, 0.003)).max() < 1e-12
    assert screen.open_fraction == pytest.approx(np.pi / 4 * 0.36, rel=1e-12)
    assert screen.hole_size == pytest.approx(0.006) and screen.web == pytest.approx(0.004)


def test_an_image_passes_what_its_slats_leave():
    """Slats along u, half open: nothing is lost along them, and across them what the thickness hides."""
    opacity = np.zeros((64, 8))
    opacity[32:] = 1.0
    screen = gpu_shading.Screen.image(opacity, 0.01, 0.08, thickness=0.02)
    assert screen.tau(30.0, 0.0) == pytest.approx(0.5, abs=2e-3)
    shift = 0.02 * np.tan(np.radians(30.0))
    assert screen.tau(30.0, 90.0) == pytest.approx(0.5 - shift / 0.08, abs=5e-3)


@pytest.mark.parametrize("columns, pitch", [(8, 0.024), (3, 0.03)])
def test_a_wire_of_one_texel_stops_the_run_the_table_and_the_rays_alike(columns, pitch):
    """Level wires one texel wide in a thick sheet. Such images once passed 0.3 and 0.5 where nothing passes."""
    thickness, height = 0.01, 40 * pitch
    opacity = np.zeros((8, columns))
    opacity[:, 1] = 1.0
    screen = gpu_shading.Screen.image(opacity, pitch, pitch, thickness=thickness)
    scene = gpu_shading.Scene(receivers=[window(2.0, height)])
    scene.add(window(90, 90, -40, -1.0) - [40, 0, 0], screen=screen)  # u runs up
    origins = np.column_stack([np.ones(50), np.zeros(50), np.linspace(1.1, 1.0 + height, 50)])
    rays = scene.rays()
    suns = [(180, 20), (160, 10), (215, 40), (150, 60), (240, 45), (180, 70), (200, 75)]
    exact = []
    for azimuth, altitude in suns:
        x, y, z = sun = towards(azimuth, altitude)
        exact.append(max(0.0, 1.0 - 1.0 / columns - thickness * abs(z / y) / pitch))
        theta, phi = np.degrees(np.arccos(-y)), np.degrees(np.arctan2(x, z))
        assert screen.tau(theta, phi) == pytest.approx(exact[-1], abs=5e-3)
        assert rays.transmittance(origins, np.tile(sun, (50, 1))) == pytest.approx(exact[-1], abs=5e-3)
    assert scene.sunlit(suns)[:, 0] == pytest.approx(exact, abs=2e-3)
    assert exact[-1] == 0.0 and scene.sunlit(suns[-1])[0] == 0.0


def leaves(side):
    """Leaves of several directions, cut out of a sheet but for ribs one texel wide along their middles."""
    v, u = np.mgrid[:side, :side] + 0.5
    opacity = np.ones((side, side))
    for n in range(8):
        du, dv = ((place - start * side + side / 2) % side - side / 2
                  for place, start in ((u, 0.7549 * n % 1), (v, 0.5698 * n % 1)))
        along, aside = du * np.cos(2.4 * n) + dv * np.sin(2.4 * n), dv * np.cos(2.4 * n) - du * np.sin(2.4 * n)
        half_length = side * (0.12 + 0.02 * (n % 4))
        opacity[(np.abs(aside) > 0.5) & (np.abs(aside) < 0.4 * half_length * (1 - (along / half_length) ** 2))] = 0
    return opacity


def through(opacity, shift, threshold=0.5, layers=150, points=4):
    """What passes an image interpolated at very many depths, over a shift in texels along u and v."""
    rows, columns = opacity.shape
    row, column = np.mgrid[: rows * points, : columns * points]
    u, v = (column + 0.618 * row % 1) / points, (row + 0.618 * column % 1) / points
    is_open = np.ones_like(u, dtype=bool)
    for depth in np.linspace(0, 1, layers):
        x, y = u + depth * shift[0], v + depth * shift[1]
        column, row = np.floor(x).astype(int), np.floor(y).astype(int)
        x, y = x - column, y - row
        below, above = (opacity[r % rows, column % columns] * (1 - x) + opacity[r % rows, (column + 1) % columns] * x
                        for r in (row, row + 1))
        is_open &= below * (1 - y) + above * y <= threshold
    return is_open.mean()


def test_leaves_pass_what_very_many_layers_pass_in_a_run_and_in_the_table():
    """Layers Auto once passed 1e-2 too much beside a table that knew better."""
    side, texel, thickness = 96, 0.001, 0.003
    opacity = leaves(side)
    screen = gpu_shading.Screen.image(opacity, side * texel, side * texel, thickness=thickness)
    scene = gpu_shading.Scene(receivers=[window(10 * side * texel, 10 * side * texel)])
    scene.add(window(90, 90, -40, -1.0) - [40, 0, 0], screen=screen)  # u runs up, v to the west
    suns = [(180, 35), (170, 50), (200, 60), (225, 40), (135, 55), (180, 75)]
    expected, table = [], []
    for azimuth, altitude in suns:
        x, y, z = towards(azimuth, altitude)
        shift = thickness / texel * np.array([z, -x]) / -y
        theta, phi = np.degrees(np.arccos(-y)), np.degrees(np.arctan2(-x, z))
        expected.append(through(opacity, shift))
        table.append(screen.tau(theta, phi))
    assert scene.sunlit(suns)[:, 0] == pytest.approx(expected, abs=2e-3)
    assert table == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize("make, expected", [
    (lambda: gpu_shading.Transmittance.constant(0.3), lambda angle: 0.3 + 0 * angle),
    (lambda: gpu_shading.Transmittance.polynomial([0.9, -0.01], of="degrees"), lambda angle: 0.9 - 0.01 * angle),
    (lambda: gpu_shading.Transmittance.polynomial([0.0, 0.8]), lambda angle: 0.8 * np.cos(np.radians(angle))),
    (lambda: gpu_shading.Transmittance.table([0, 90], [0.6, 0.0]), lambda angle: 0.6 * (1 - angle / 90)),
])
def test_transmittances_are_what_they_say(make, expected):
    angles = np.linspace(0, 90, 37).reshape(1, 37)
    assert np.abs(make().tau(angles) - expected(angles)).max() < 1e-12


def test_glazing_has_its_value_at_normal_incidence():
    """One clear pane, and two: the series of reflections between them."""
    tau, front, back = 0.8, 0.08, 0.08
    one = gpu_shading.Transmittance.glazing([[tau, front, back]])
    two = gpu_shading.Transmittance.glazing([[tau, front, back]] * 2)
    assert one.tau(0.0) == pytest.approx(tau, abs=1e-9) and one.tau(90.0) < 1e-3
    assert two.tau(0.0) == pytest.approx(tau**2 / (1 - front * back), abs=1e-9)
    assert gpu_shading.Transmittance.simple_glazing(2.0, 0.4).tau(0.0) == pytest.approx(0.33, abs=0.03)

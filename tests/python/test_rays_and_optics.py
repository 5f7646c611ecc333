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

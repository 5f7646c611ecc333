"""What is refused: each in one line that names the argument, and nothing crashes."""

import numpy as np
import pytest
from shapes import overhang, window

import gpu_shading


def scene():
    return gpu_shading.Scene(receivers=[window()], casters=[overhang()])


SUN = [[180.0, 45.0]]
WRONG = {
    "nan in vertices": (lambda: gpu_shading.Scene([window() * np.nan]), "receiver 0: nan"),
    "infinite vertices": (lambda: gpu_shading.Scene(casters=[np.full((4, 3), np.inf)]), "caster 0: "),
    "huge vertices": (lambda: gpu_shading.Scene([window() * 1e300]), "expected 1e.07 m at most"),
    "two columns": (lambda: gpu_shading.Scene([window()[:, :2]]), r"shape \(4, 2\)"),
    "two vertices": (lambda: gpu_shading.Scene([window()[:2]]), "2 vertices, expected 3 to 100000"),
    "too many vertices": (lambda: gpu_shading.Scene([np.zeros((100_001, 3))]), "100001 vertices"),
    "one polygon for a list": (lambda: gpu_shading.Scene(window()), "receiver 0"),
    "ragged vertices": (lambda: gpu_shading.Scene([[[0, 0, 0], [1, 1], [2, 2, 2]]]), "array of numbers"),
    "text": (lambda: gpu_shading.Scene([[["0", "0", "0"]] * 3]), "array of numbers"),
    "complex": (lambda: gpu_shading.Scene([window() * 1j]), "array of numbers"),
    "nothing": (lambda: gpu_shading.Scene([None]), "array of numbers"),
    "no such casting": (lambda: scene().add(window(), casts="sometimes"), "casts: 'sometimes', expected one of"),
    "transmittance": (lambda: scene().add(window(), transmittance=1.5), "1.5, expected 0 to 1"),
    "a hole of two vertices": (lambda: scene().add(window(), holes=[window()[:2]]), "hole: 2 vertices"),
    "origin of a screen": (lambda: scene().add(window(), screen_origin=(0.0, np.nan)), "screen_origin"),
    "a screen that is none": (lambda: scene().add(window(), screen=0.5), "expected a Screen"),
    "nan in directions": (lambda: scene().sunlit([[180.0, np.nan]]), r"directions: nan at \[0, 1\]"),
    "four columns": (lambda: scene().sunlit(np.zeros((3, 4))), r"directions: an array of shape \(3, 4\)"),
    "zero vector": (lambda: scene().sunlit([[0, -1, 0], [0, 0, 0]]), "vector 1 is zero"),
    "altitude": (lambda: scene().sunlit([[180.0, 91.0]]), "altitude 91, expected -90 to 90"),
    "a number": (lambda: scene().sunlit(3.0), "directions: an array of shape"),
    "receivers": (lambda: scene().sunlit(SUN, receivers=[2]), "receivers: 2 to 2, expected 0 to 1"),
    "negative receivers": (lambda: scene().sunlit(SUN, receivers=[-1]), "receivers: -1"),
    "receivers that are numbers": (lambda: scene().sunlit(SUN, receivers=[0.5]), "indices of surfaces"),
    "factors": (lambda: scene().sunlit(SUN, factors=[0.5]), "factors: an array of shape"),
    "unknown factor": (lambda: scene().sunlit(SUN, factors={"leaves": 1.0}), "factors: expected none, got leaves"),
    "device": (lambda: scene().sunlit(SUN, device="gpu"), "gpu"),
    "error": (lambda: scene().renderer(error=0.5), "error 0.5: expected 1e-05 to 0.1"),
    "resolution": (lambda: scene().renderer(resolution=0), "resolution: 0"),
    "huge resolution": (lambda: scene().renderer(resolution=1_000_000), "resolution"),
    "nan in rays": (lambda: scene().rays().transmittance([[0, 0, np.nan]], SUN), "origins: nan"),
    "shapes of rays": (lambda: scene().rays().transmittance([[0, 0, 0]], [[0, 0, 1]] * 2), "expected .1, 3., as"),
    "zero ray": (lambda: scene().rays().nearest([[0, 0, 0]], [[0, 0, 0]]), "vector 0 is zero"),
    "lengths": (lambda: scene().rays().nearest([[0, 0, 0]], [[0, 0, 1]], [1, 2]), "lengths: an array of shape"),
    "receiver of rays": (lambda: scene().rays().nearest([[0, 0, 0]], [[0, 0, 1]], receiver=9), "receiver: 9"),
    "excluded": (lambda: scene().rays().nearest([[0, 0, 0]], [[0, 0, 1]], excluded=[9]), "excluded: 9"),
    "faces": (lambda: scene().rays(faces="none"), "faces: 'none'"),
    "polynomial": (lambda: gpu_shading.Transmittance.polynomial([2.0]), "expected 0 to 1"),
    "table": (lambda: gpu_shading.Transmittance.table([0, 90], [1.0]), "values: 1, expected as many"),
    "table that falls back": (lambda: gpu_shading.Transmittance.table([90, 0], [1.0, 0.0]), "angle"),
    "panes": (lambda: gpu_shading.Transmittance.glazing([[0.9, 0.9, 0.9]]), "reflectance"),
    "no panes": (lambda: gpu_shading.Transmittance.glazing(np.zeros((0, 3))), "panes"),
    "holes that touch": (lambda: gpu_shading.Screen.pattern("round", 0.01, 0.01), "hole size"),
    "no such hole": (lambda: gpu_shading.Screen.pattern("oval", 0.01, 0.02), "hole: 'oval'"),
    "thickness": (lambda: gpu_shading.Screen.pattern("round", 0.01, 0.02, thickness=-1.0), "thickness"),
    "opacity": (lambda: gpu_shading.Screen.image([[2.0]], 1, 1), "opacity: 2 to 2, expected 0 to 1"),
    "empty opacity": (lambda: gpu_shading.Screen.image(np.zeros((0, 4)), 1, 1), "opacity: an array of shape"),
    "size of a tile": (lambda: gpu_shading.Screen.image([[1.0]], -1, 1), "width"),
    "layers": (lambda: gpu_shading.Screen.image([[1.0]], 1, 1, layers=65), "layers: 65, expected 1 to 64"),
    "angles": (lambda: gpu_shading.Screen.pattern("round", 0.01, 0.02).tau([1, 2], [1, 2, 3]), "do not fit"),
    "a model that is not there": (lambda: gpu_shading.check("no.idf"), "model: no.idf: no such file"),
    "samples that are not there": (lambda: gpu_shading.read_samples("nowhere"), "has no samples.json"),
}


@pytest.mark.parametrize("what", WRONG)
def test_it_is_refused_in_one_line(what):
    ask, message = WRONG[what]
    if "samples" in what:
        pytest.importorskip("xarray", reason="xarray is missing: run scripts/setup")
    with pytest.raises(gpu_shading.InvalidInput, match=message) as raised:
        ask()
    assert "\n" not in str(raised.value)


def test_a_device_that_is_not_there():
    with pytest.raises(gpu_shading.DeviceError, match="99"):
        scene().sunlit(SUN, device="99")


def test_surfaces_without_area_are_answered():
    flat = np.zeros((3, 3))
    empty = gpu_shading.Scene(receivers=[flat, window()], casters=[flat, window()[[0, 0, 1, 1]]])
    assert empty.sunlit(SUN).tolist() == [[0.0, 1.0]]
    assert gpu_shading.Scene().sunlit(SUN).shape == (1, 0)


def test_arrays_that_are_changed_later_change_nothing():
    vertices = window()
    made = gpu_shading.Scene(receivers=[vertices])
    vertices *= 0
    assert made.areas.tolist() == [2.0]

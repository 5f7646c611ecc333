"""What is refused: each in one line that names the argument, and nothing crashes."""

import pickle

import numpy as np
import pytest
from shapes import overhang, window

import gpu_shading


def scene():
    return gpu_shading.Scene(receivers=[window()], casters=[overhang()])


def masked(values, *place):
    """An array whose value at a place is hidden by a mask."""
    mask = np.zeros(np.shape(values), dtype=bool)
    mask[place] = True
    return np.ma.array(values, mask=mask)


def rule(roles=((0, 0, 0, 0), (1, 0, 0, 0)), zone_shades=((1,),)):
    return gpu_shading.Rule(np.array(roles), np.array(zone_shades))


def mesh(size=0.005, pitch=0.01, **more):
    return gpu_shading.Screen.pattern("round", size, pitch, **more)


def unpickled(thing, *changes):
    """From a pickle in which texts were replaced: numbers of the same length."""
    data = pickle.dumps(thing, protocol=0)
    for old, new in changes:
        assert data.count(old) == 1, (old, data)
        data = data.replace(old, new)
    return pickle.loads(data)


def unchecked_rule():
    """As unpickling makes it: without calling its constructor."""
    made = object.__new__(gpu_shading.Rule)
    made.__dict__.update(roles=np.zeros((2, 4), dtype=np.uint32), zone_shades=np.zeros((1000, 1), dtype=np.uint8))
    return made


TABLE = gpu_shading.Transmittance.table([0, 90], [0.75, 0.0])
SUN = [[180.0, 45.0]]
RAY = ([[0, 0, 0]], [[0, 0, 1]])
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
    "opacity": (lambda: gpu_shading.Screen.image([[2.0]], 1, 1), r"opacity: 2 at \[0, 0\], expected 0 to 1"),
    "empty opacity": (lambda: gpu_shading.Screen.image(np.zeros((0, 4)), 1, 1), "opacity: an array of shape"),
    "size of a tile": (lambda: gpu_shading.Screen.image([[1.0]], -1, 1), "width"),
    "layers": (lambda: gpu_shading.Screen.image([[1.0]], 1, 1, layers=65), "layers: 65, expected 1 to 64"),
    "angles": (lambda: gpu_shading.Screen.pattern("round", 0.01, 0.02).tau([1, 2], [1, 2, 3]), "do not fit"),
    "masked vertices": (lambda: gpu_shading.Scene([masked(window(), 2, 1)]),
                        r"receiver 0: masked at \[2, 1\], expected"),
    "a masked number in a list": (lambda: scene().sunlit([[180.0, np.ma.masked]]), r"directions: masked at \[0, 1\]"),
    "a masked row in a list": (lambda: scene().sunlit([masked([180.0, 45.0], 0)]), r"directions: masked at \[0, 0\]"),
    "masked receivers": (lambda: scene().sunlit(SUN, receivers=masked([0], 0)), r"receivers: masked at \[0\]"),
    "masked opacity": (lambda: gpu_shading.Screen.image(masked(np.eye(4), 1, 1), 1, 1), r"opacity: masked at \[1, 1\]"),
    "masked texels": (lambda: gpu_shading.Screen.from_texels(masked(np.eye(4, dtype=np.uint16), 3, 0), 1, 1),
                      r"texels: masked at \[3, 0\]"),
    "masked transmittance": (lambda: scene().add(window(), transmittance=np.ma.masked), "transmittance: masked"),
    "texels in a list": (lambda: gpu_shading.Screen.from_texels([[1, 0]], 1, 1), "texels: int64, expected uint16"),
    "negative lengths": (lambda: scene().rays().nearest(*RAY, [-1]), r"lengths: -1 at \[0\], expected 0 to inf m"),
    "angle of a shade": (lambda: TABLE.tau([0, 95]), r"angles: 95 at \[1\], expected 0 to 90 degrees"),
    "negative angle": (lambda: TABLE.tau(-1.0), "angles: -1, expected 0 to 90 degrees"),
    "angle of a screen": (lambda: mesh().tau(95), "theta: 95, expected 0 to 90 degrees"),
    "vast pitch": (lambda: mesh(pitch=1e300), r"pitch is 1e\+300 m, expected 1e-06 to 100000"),
    "minute pitch": (lambda: mesh(1e-301, 1e-300), "hole size is 1e-301 m, expected 1e-06 to 100000"),
    "vast row pitch": (lambda: mesh(row_pitch=1e300), r"row pitch is 1e\+300 m, expected"),
    "vast tile": (lambda: gpu_shading.Screen.image([[1.0]], 1, 1e300), r"tile height is 1e\+300 m, expected"),
    "vast origin": (lambda: scene().add(window(), screen_origin=(0, 1e300)),
                    r"screen_origin: 1e\+300 at \[1\], expected"),
    "vast rotation": (lambda: scene().add(window(), screen_rotation=1e300), r"screen_rotation: 1e\+300, expected"),
    "a schedule without a name": (lambda: scene().add(window(), schedule=5), "schedule: 5, expected a name"),
    "half a pixel": (lambda: scene().renderer(resolution=64.5), "resolution: 64.5, expected a whole number"),
    "layers in parts": (lambda: gpu_shading.Screen.image([[1.0]], 1, 1, layers=1.5), "layers: 1.5, expected a whole"),
    "no threads": (lambda: gpu_shading.limit_threads(0), "count: 0, expected 1 to"),
    "zones in a row": (lambda: scene().set_rule(rule(zone_shades=np.ones((1000, 1)) > 0)),
                       r"zone_shades: an array of shape \(1000, 1\), expected \(zones, zones\)"),
    "zones without rows": (lambda: rule(zone_shades=[1]), r"zone_shades: int64 of shape \(1,\), expected"),
    "zones that are numbers": (lambda: rule(zone_shades=[[0.5]]), "zone_shades: float64"),
    "zones of more than one": (lambda: rule(zone_shades=[[2]]), "zone_shades: 2 to 2, expected 0 to 1"),
    "a zone that is not there": (lambda: rule([[0, 1, 0, 0]]), "roles: zone 1, expected less than 1"),
    "roles of three": (lambda: rule([[0, 0, 0]]), r"roles: an array of shape \(1, 3\), expected \(surfaces, 4\)"),
    "shades": (lambda: rule([[0, 0, 4, 0]]), "roles: shades 4, expected less than 4"),
    "negative roles": (lambda: rule([[0, -1, 0, 0]]), "roles: -1 to 0, expected 0 to 4294967295"),
    "roles of one surface": (lambda: scene().set_rule(rule([[0, 0, 0, 0]])), "roles of 1 surfaces, expected 2"),
    "a rule that is none": (lambda: scene().set_rule((1, 2)), "rule: tuple, expected a Rule"),
    "a rule that was not checked": (lambda: scene().set_rule(unchecked_rule()), "zone_shades: an array of shape"),
    "another version of a shade": (lambda: unpickled(TABLE, (b"(I1\nV", b"(I2\nV")), "pickle: version 2, expected 1"),
    "another version of a scene": (lambda: unpickled(scene(), (b"(I1\n(", b"(I2\n(")), "pickle: version 2, expected 1"),
    "forged count of a shade": (lambda: unpickled(gpu_shading.Transmittance.polynomial([0.5, 0.25, 0.125]), (
        b"I3\n", b"I99999999999999\n")), "coefficients: 24 bytes, expected 799999999999992 for"),
    "forged negative count": (lambda: unpickled(gpu_shading.Transmittance.polynomial([0.5, 0.25, 0.125]), (
        b"I3\n", b"I-3\n")), "coefficients: no array, expected"),
    "forged tile": (lambda: unpickled(gpu_shading.Screen.image(np.eye(5), 1, 1), (
        b"I5\nI5\n", b"I99999\nI99999\n")), "texels: 50 bytes, expected 19999600002 for"),
    "forged make": (lambda: unpickled(TABLE, (b"Vtable", b"Vmro")), "pickle: Transmittance: 'mro', expected one of"),
    "forged vertices": (lambda: unpickled(gpu_shading.Scene([window()]), (b"I4\nI3\n", b"I6\nI3\n")),
                        "vertices: 96 bytes, expected 144"),
    "forged casting": (lambda: unpickled(gpu_shading.Scene([window()]), (b"Vnever", b"Vmaybe")), "casts: 'maybe'"),
    "a pickle without surfaces": (lambda: unpickled(gpu_shading.Scene([window()]), (b"Vsurfaces", b"Vsorfaces")),
                                  "pickle: scene: KeyError: 'surfaces', expected"),
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


def test_masks_that_hide_nothing_are_accepted():
    vertices = np.ma.array(window(), mask=False)
    assert gpu_shading.Scene([vertices]).sunlit(SUN).tolist() == [[1.0]]


def test_a_surface_cannot_be_changed_to_what_would_be_refused():
    made = scene()
    with pytest.raises(ValueError, match="read-only"):
        made.surfaces[0].vertices[0, 0] = np.nan

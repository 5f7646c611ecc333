"""Scenes with values by time as glTF and VTK, read back by trimesh and PyVista."""

import base64
import itertools
import json
import struct
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from large_packages import need
from shading_runs import energyplus

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
HOURS = ["09:00", "12:00", "15:00"]
SUN = [[120.0, 30.0], [180.0, 45.0], [240.0, 30.0]]


@pytest.fixture(scope="module")
def scene(patched):
    """Two windows, a wall with a hole that receives, an overhang and a pane of glass."""
    import gpu_shading

    made = gpu_shading.Scene(receivers={"left": [[0, 0, 1], [2, 0, 1], [2, 0, 2], [0, 0, 2]],
                                        "right": [[4, 0, 1], [6, 0, 1], [6, 0, 2], [4, 0, 2]]},
                             casters=[[[-1, -0.5, 2], [3, -0.5, 2], [3, 0, 2], [-1, 0, 2]]])
    made.add([[0, 5, 0], [6, 5, 0], [6, 5, 3], [0, 5, 3]], name="wall", receives=True, casts="never",
             holes=[[[1, 5, 1], [1, 5, 2], [2, 5, 2], [2, 5, 1]]])
    made.add([[4, -1, 0], [7, -1, 0], [7, -1, 3], [4, -1, 3]], name="pane",
             transmittance=gpu_shading.Transmittance.constant(0.5))
    return made


@pytest.fixture(scope="module")
def sunlit(scene):
    values = scene.sunlit(SUN)
    assert values.shape == (3, 3) and len(np.unique(values.round(3))) > 3
    return values


def test_vtk_has_cells_for_each_hour(scene, sunlit, tmp_path):
    need("pyvista")
    import pyvista

    scene.save(tmp_path / "day.vtp", sunlit, times=HOURS)
    drawn = pyvista.read(tmp_path / "day.vtp")
    of = drawn.cell_data["surface"]
    sizes = drawn.triangulate().compute_cell_sizes()
    for index, area in enumerate(scene.areas):
        assert sizes["Area"][sizes["surface"] == index].sum() == pytest.approx(area), index
    for hour, row in zip(HOURS, sunlit, strict=True):
        cells = drawn.cell_data[f"sunlit {hour}"]
        for column, receiver in enumerate(scene.receivers):
            assert cells[of == receiver] == pytest.approx(row[column], abs=1e-6)
        assert np.isnan(cells[of == scene.index("pane")]).all()
    assert np.allclose(drawn.bounds, [-1, 7, -1, 5, 0, 3])


def test_paraview_has_a_file_for_each_hour(scene, sunlit, tmp_path):
    need("pyvista")
    import pyvista

    scene.save(tmp_path / "day.pvd", sunlit, times=HOURS)
    reader = pyvista.get_reader(tmp_path / "day.pvd")
    assert reader.time_values == [0.0, 1.0, 2.0]
    for step in range(3):
        reader.set_active_time_point(step)
        drawn = reader.read()[0]
        left = drawn.cell_data["sunlit"][drawn.cell_data["surface"] == scene.index("left")]
        assert left == pytest.approx(sunlit[step, 0], abs=1e-6)


def test_gltf_has_a_mesh_for_each_hour(scene, sunlit, tmp_path):
    need("trimesh", large=False)
    import trimesh

    scene.save(tmp_path / "day.glb", sunlit, times=HOURS)
    loaded = trimesh.load(tmp_path / "day.glb", process=False)
    timed = {name: mesh for name, mesh in loaded.geometry.items() if name.startswith("sunlit")}
    assert sorted(timed) == [f"sunlit {hour}" for hour in HOURS]
    for hour, row in zip(HOURS, sunlit, strict=True):
        mesh = timed[f"sunlit {hour}"]
        owners = mesh.vertex_attributes["_SURFACE"].reshape(-1)
        for column, receiver in enumerate(scene.receivers):
            here = owners == receiver
            assert mesh.vertex_attributes["_VALUE"][here] == pytest.approx(row[column], abs=1e-6)
            # From blue to yellow.
            red = mesh.visual.vertex_attributes["color"][here][:, 0]
            assert red == pytest.approx(255 * (0.03 + 0.97 * row[column]), abs=1)
            faces = mesh.area_faces[here.reshape(-1, 3).any(axis=1)]
            assert faces.sum() == pytest.approx(scene.areas[receiver], rel=1e-6)
    # y is up, and -z is north.
    assert timed["sunlit 09:00"].bounds == pytest.approx(np.array([[0, 0, -5], [6, 3, 0]]), abs=1e-6)
    rest = [mesh for name, mesh in loaded.geometry.items() if not name.startswith("sunlit")]
    assert sum(mesh.area for mesh in rest) == pytest.approx(scene.areas[[2, 4]].sum())
    nodes = [loaded.graph.get(name)[0] for name in loaded.graph.nodes_geometry if "sunlit" in name]
    shown = [abs(np.linalg.det(matrix[:3, :3])) > 0.5 for matrix in nodes]
    assert sum(shown) == 1


def test_gltf_plays_the_hours_one_after_another(scene, sunlit, tmp_path):
    scene.save(tmp_path / "day.glb", sunlit, times=HOURS)
    data = (tmp_path / "day.glb").read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document, binary = json.loads(data[20:20 + length]), data[28 + length:]
    assert struct.unpack_from("<I", data, 8)[0] == len(data)

    def array(index):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        return np.frombuffer(binary, "<f4", accessor["count"] * width, view["byteOffset"]).reshape(-1, width)

    (animation,) = document["animations"]
    for moment, expected in ((0.1, 0), (0.6, 1), (1.1, 2)):
        scales = []
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            assert sampler["interpolation"] == "STEP" and channel["target"]["path"] == "scale"
            before = np.flatnonzero(array(sampler["input"])[:, 0] <= moment)
            row = array(sampler["output"])[before[-1] if len(before) else 0]
            scales.append((document["nodes"][channel["target"]["node"]]["name"], row[0]))
        assert [name for name, scale in scales if scale == 1.0] == [f"sunlit {HOURS[expected]}"]


def test_values_may_have_names(scene, sunlit, tmp_path):
    """As those of a run, which has more surfaces and names in capitals."""
    named = {name.upper(): sunlit[:, column] for column, name in enumerate(["left", "right", "wall"])}
    for suffix in (".glb", ".vtp"):
        scene.save(tmp_path / f"a{suffix}", sunlit, times=HOURS)
        scene.save(tmp_path / f"b{suffix}", named | {"FLOOR": sunlit[:, 0]}, times=HOURS)
        assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


def test_errors_say_what_was_expected(scene, sunlit, tmp_path):
    import gpu_shading

    for file, values, times, words in (
            ("day.obj", sunlit, None, "expected a name that ends in one of .glb, .vtp, .pvd"),
            ("day.glb", sunlit[:, :2], None, "expected one value for each of 3 receivers"),
            ("day.vtp", sunlit[:0], None, "0 times, expected 1 to 1000"),
            ("day.glb", sunlit, ["noon"] * 3, "1 different times, expected 3"),
            ("day.glb", {"door": [1.0]}, None, "none of DOOR is a surface"),
            ("day.glb", {"left": [1.0], "right": [1.0, 2.0]}, None, "expected one value of each surface at each time")):
        with pytest.raises(gpu_shading.InvalidInput, match=words):
            scene.save(tmp_path / file, values, times=times)
    assert list(tmp_path.iterdir()) == []
    scene.save(tmp_path / "plain.glb")
    scene.save(tmp_path / "plain.vtp")


def faces_of_glb(path):
    """(triangles, surface of each) of the surfaces without values and of one of the times."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document, binary = json.loads(data[20:20 + length]), data[28 + length:]

    def array(index):
        accessor = document["accessors"][index]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        start = document["bufferViews"][accessor["bufferView"]]["byteOffset"]
        return np.frombuffer(binary, "<f4", accessor["count"] * width, start).reshape(-1, width)

    shown = [node for node in document["nodes"] if node.get("scale") != [0.0, 0.0, 0.0]]
    parts = [part["attributes"] for node in shown for part in document["meshes"][node["mesh"]]["primitives"]]
    return (np.concatenate([array(part["POSITION"]).reshape(-1, 3, 3) for part in parts]).astype(float),
            np.concatenate([array(part["_SURFACE"]).reshape(-1, 3)[:, 0] for part in parts]).astype(int))


def faces_of_vtp(path):
    arrays = {}
    for each in ET.fromstring(path.read_text()).iter("DataArray"):
        kind = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8"}[each.get("type")]
        arrays[each.get("Name")] = np.frombuffer(base64.b64decode(each.text)[8:], kind)
    rings = np.split(arrays["Points"].reshape(-1, 3)[arrays["connectivity"]], arrays["offsets"][:-1])
    return rings, arrays["surface"]


def overlaps(faces, shapely):
    """Areas that two faces in one plane share."""
    found = []
    boxes = np.array([[face.min(axis=0), face.max(axis=0)] for face in faces])
    for first, face in enumerate(faces):
        normal = sum(np.cross(a, b) for a, b in zip(face - face[0], np.roll(face - face[0], -1, axis=0), strict=True))
        if not np.linalg.norm(normal) > 1e-9:
            continue
        normal = normal / np.linalg.norm(normal)
        axes = np.linalg.svd(normal[None])[2][1:]
        meets = ((boxes[first, 0] < boxes[first + 1:, 1] + 1e-4) & (boxes[first, 1] > boxes[first + 1:, 0] - 1e-4))
        for second in first + 1 + np.flatnonzero(meets.all(axis=1)):
            other = faces[second]
            if np.abs((other - face[0]) @ normal).max() < 5e-4:
                one, two = (shapely.Polygon(each @ axes.T).buffer(0) for each in (face, other))
                found.append(one.intersection(two).area)
    return max(found, default=0.0), len(found)


def upright(x0, z0, x1, z1, y=0.0):
    return [[x0, y, z0], [x1, y, z0], [x1, y, z1], [x0, y, z1]]


def test_faces_do_not_lie_on_one_another(patched, tmp_path):
    """A wall with windows, one at its corner and one across its edge, a mirrored duplicate, a neighbour that touches,
    a star over a pane, and a slab just behind."""
    need("shapely", large=False)
    import shapely

    import gpu_shading

    angles = np.linspace(0, 2 * np.pi, 11)[:-1]
    radius = np.where(np.arange(10) % 2, 0.5, 1.3)
    star = np.column_stack([22 + radius * np.cos(angles), 0 * angles, 2 + radius * np.sin(angles)])
    turn = np.radians(33)
    turned = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    polygons = {"wall": upright(0, 0, 10, 4), "window": upright(1, 1, 3, 2), "corner": upright(9, 3, 10, 4),
                "door": upright(5, -0.5, 6, 2), "mirrored": upright(0, 0, 10, 4)[::-1], "beside": upright(10, 0, 12, 4),
                "pane": upright(20, 0, 24, 4), "star": star, "slab": upright(0, 0, 10, 4, 0.01)}
    scene = gpu_shading.Scene()
    for name, polygon in polygons.items():
        scene.add(np.array(polygon) @ turned.T + [100, 50, 3], name=name, receives=name in ("wall", "window", "star"),
                  casts="never" if name in ("wall", "window", "star") else "always")
    values = np.full((2, 3), 0.5)
    expected = dict(zip(polygons, scene.areas, strict=True))
    expected["wall"] -= 2 + 1 + 2  # windows, and the part of the door on it
    expected["mirrored"] = 0.0
    expected["pane"] -= expected["star"]
    for name, read in (("a.glb", faces_of_glb), ("a.vtp", faces_of_vtp)):
        scene.save(tmp_path / name, values, times=["9", "12"])
        faces, surfaces = read(tmp_path / name)
        shared, pairs = overlaps(faces, shapely)
        assert pairs > 20 and shared < 1e-4
        for index, area in enumerate(expected.values()):
            vectors = [sum(np.cross(b - face[0], c - face[0]) for b, c in itertools.pairwise(face[1:])) / 2
                       for face, owner in zip(faces, surfaces, strict=True) if owner == index]
            found = float(np.linalg.norm(np.sum(vectors, axis=0))) if vectors else 0.0
            assert found == pytest.approx(area, abs=1e-4), scene.names[index]


MODELS = [pytest.param(energyplus.REPOSITORY / "idf_examples" / "courtyard" / "courtyard.idf", id="courtyard"),
          *(pytest.param(energyplus.models_folder() / name, id=name) for name in
            ("RefBldgSmallOfficeNew2004_Chicago.idf", "SolarShadingTest.idf", "GeometryTest.idf"))]


@pytest.mark.parametrize("model", MODELS)
def test_faces_of_models_do_not_lie_on_one_another(model, patched, tmp_path):
    need("shapely", large=False)
    import shapely

    import gpu_shading

    if not model.is_file():
        pytest.skip(f"{model} is missing: GPU_SHADING_MODELS names the folder of models")
    scene = gpu_shading.Scene.from_energyplus(model)
    for name, read in (("a.glb", faces_of_glb), ("a.vtp", faces_of_vtp)):
        scene.save(tmp_path / name)
        shared, pairs = overlaps(read(tmp_path / name)[0], shapely)
        assert pairs > 20 and shared < 1e-4

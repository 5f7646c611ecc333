"""Scenes with values by time as glTF and VTK, read back by trimesh and PyVista."""

import json
import struct
import sys

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
            ("day.glb", sunlit, ["noon"] * 3, "1 different times, expected 3"),
            ("day.glb", {"door": [1.0]}, None, "none of DOOR is a surface"),
            ("day.glb", {"left": [1.0], "right": [1.0, 2.0]}, None, "expected one value of each surface at each time")):
        with pytest.raises(gpu_shading.InvalidInput, match=words):
            scene.save(tmp_path / file, values, times=times)
    assert list(tmp_path.iterdir()) == []
    scene.save(tmp_path / "plain.glb")
    scene.save(tmp_path / "plain.vtp")

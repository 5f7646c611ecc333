"""The Honeybee extension: properties survive HBJSON, reach EnergyPlus, and results come back as Honeybee has them."""

import dataclasses
import json
import re
import subprocess
import sys

import numpy as np
import pytest
from large_packages import environment, need
from shading_runs import energyplus

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
DICTIONARY = energyplus.REPOSITORY / "energyplus_patch" / "model" / "extensions" / "GPUShading.idd"
SUNLIT = "Surface Outside Face Sunlit Fraction"


@pytest.fixture(scope="module")
def hb(tmp_path_factory):
    """The extension, with a home for what Honeybee logs."""
    need("honeybee_energy", large=False)
    need("honeybee_radiance", large=False)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOME", str(tmp_path_factory.mktemp("home")))
        import honeybee.model  # noqa: F401
        import honeybee_energy  # noqa: F401
        import honeybee_gpushading

        yield honeybee_gpushading


@pytest.fixture
def office(hb):
    """A room with three louvres before its southern window, a sail of two triangles, and a fence."""
    from honeybee.model import Model
    from honeybee.room import Room
    from honeybee.shade import Shade
    from honeybee.shademesh import ShadeMesh
    from ladybug_geometry.geometry3d import Face3D, Mesh3D, Point3D

    room = Room.from_box("Office", 6, 6, 3)
    room.faces[3].apertures_by_ratio(0.4)
    room.faces[3].apertures[0].louvers_by_count(3, depth=0.3, angle=20)
    room.faces[4].apertures_by_ratio(0.3)
    sail = ShadeMesh("Sail", Mesh3D([Point3D(0, -3, 3), Point3D(4, -3, 3), Point3D(4, -5, 3.5), Point3D(0, -5, 3.5)],
                                    [(0, 1, 2), (0, 2, 3)]))
    fence = Shade("Fence", Face3D([Point3D(0, -9, 0), Point3D(6, -9, 0), Point3D(6, -9, 1), Point3D(0, -9, 1)]))
    return Model("House", [room], orphaned_shades=[fence], shade_meshes=[sail])


def one_day(hb):
    from honeybee_energy.simulation.parameter import SimulationParameter
    from honeybee_energy.simulation.runperiod import RunPeriod
    from ladybug.dt import Date

    parameters = SimulationParameter()
    parameters.run_period = RunPeriod(Date(3, 5), Date(3, 5))
    parameters.output.add_output(SUNLIT)
    return parameters


def dress(hb, model):
    """All kinds of objects."""
    from honeybee_energy.schedule.ruleset import ScheduleRuleset

    angle = ScheduleRuleset.from_constant_value("Angle", 35)
    for shade in model.shades:
        if "OutShd" in shade.identifier:
            shade.properties.gpu_shading.screen = hb.PerforatedScreen(
                "Blades", "Round", hole_size=0.008, pitch=0.012, thickness=0.002)
            shade.properties.gpu_shading.motion = hb.MovingShade(
                "Louvres", "Rotate", maximum_position=80.0, control="Schedule", position_schedule=angle)
        else:
            shade.properties.gpu_shading.transmittance = hb.TransparentShade("Mesh", "Constant", (0.25,))
    model.shade_meshes[0].properties.gpu_shading.transmittance = hb.TransparentShade(
        "Film", "Table", (0.0, 0.5, 90.0, 0.1))
    model.properties.gpu_shading.trees = [hb.Tree("Oak", 3.0, -14.0, 0.0, 8.0, leaf_schedule="Always On")]


OBJECTS = """
GPUShading:PerforatedScreen, Blades, Office_Back_Glz0_OutShd*, Round, , , 0.008, , 0.012, , 0.002;
GPUShading:MovingShade, Louvres, Office_Back_Glz0_OutShd*, Rotate, , , , , , , , , 80, , , Schedule, Angle;
GPUShading:TransparentShade, Mesh, Fence, Constant, 0.25;
GPUShading:TransparentShade, Film, Sail_*, Table, 0, 0.5, 90, 0.1;
GPUShading:Tree, Oak, 3, -14, 0, 8, , , , , , Always On;
"""


def idf_objects(text):
    """Objects as tuples in which numbers are numbers."""
    def value(field):
        try:
            return float(field)
        except ValueError:
            return field.strip()

    return {tuple(value(field) for field in entry.split(",")) for entry in text.split(";") if entry.strip()}


def ours(data, name=""):
    """{identifier: properties} of a model's dictionary."""
    found = {}
    if isinstance(data, dict):
        name = data.get("identifier", name)
        if "gpu_shading" in data:
            found[name] = data["gpu_shading"]
    for value in data.values() if isinstance(data, dict) else data if isinstance(data, list) else ():
        found |= ours(value, name)
    return found


def test_objects_have_the_fields_of_the_dictionary(hb):
    text = DICTIONARY.read_text(encoding="utf-8")
    for kind in (hb.PerforatedScreen, hb.TransparentShade, hb.MovingShade, hb.Tree):
        body = re.search(rf"^{kind.keyword},(.*?)(?:^GPUShading:|\Z)", text, re.M | re.S)[1]
        titles = re.findall(r"\\field (.*)", body)
        keys = [re.sub(r"[^a-z0-9]+", "_", title.lower()) for title in titles if title != "Surface Name"]
        names = [field.name for field in dataclasses.fields(kind)]
        told = [{"value": "value_1"}.get(name, name + "_name" * name.endswith("_schedule")) for name in names]
        assert told == keys, kind
        words = {hint: set(re.findall(r"\\key (.*)", part)) for hint, part in zip(
            keys, re.split(r"\\field .*", re.sub(r"\\field Surface Name\n.*?(?=\\field)", "", body, flags=re.S))[1:],
            strict=True)}
        for name, key, field in zip(names, told, dataclasses.fields(kind), strict=True):
            known = set(re.findall(r'["\']([^"\']+)["\']', str(field.type))) if "Literal" in str(field.type) else set()
            assert known == words[key], (kind, name)


def test_a_program_that_only_knows_honeybee_keeps_properties(hb, office, tmp_path):
    dress(hb, office)
    file = office.to_hbjson("house", str(tmp_path))
    code = ("import sys\nfrom honeybee.model import Model\nmodel = Model.from_file(sys.argv[1])\n"
            "model.duplicate().to_hbjson('again', sys.argv[2])\n")
    done = subprocess.run([sys.executable, "-c", code, file, tmp_path], env=environment(tmp_path), capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    first, again = (json.loads((tmp_path / name).read_text()) for name in ("house.hbjson", "again.hbjson"))
    assert len(ours(first)) == 6 and ours(again) == ours(first)
    from honeybee.model import Model
    read = Model.from_dict(again)
    assert read.shades[0].properties.gpu_shading.motion.position_schedule.identifier == "Angle"
    assert idf_objects(read.to.gpu_shading(read)) == idf_objects(OBJECTS)
    # Alone, as a component of a library, an object has its schedules whole.
    shade = read.shades[0]
    assert type(shade).from_dict(shade.to_dict()).properties.gpu_shading.objects == shade.properties.gpu_shading.objects


def test_a_model_without_objects_is_written_as_ever(hb, office):
    assert "gpu_shading" not in json.dumps(office.to_dict()) and office.to.gpu_shading(office) == ""


def test_what_moves_turns_with_the_model(hb, office):
    from ladybug_geometry.geometry3d import Plane, Point3D, Vector3D

    fence = office.orphaned_shades[0].properties.gpu_shading
    fence.motion = hb.MovingShade("Gate", "Slide", direction_x=1.0, maximum_position=2.0)
    office.properties.gpu_shading.trees = [hb.Tree("Oak", 3.0, -14.0, 0.0, 8.0)]
    office.move(Vector3D(1, 1, 0))
    office.rotate_xy(90, Point3D(0, 0, 0))
    (tree,) = office.properties.gpu_shading.trees
    assert (tree.x, tree.y, tree.height) == pytest.approx((13.0, 4.0, 8.0))
    assert (fence.motion.direction_x, fence.motion.direction_y) == pytest.approx((0.0, 1.0))
    # 1 foot is 0.3048 m.
    office.convert_to_units("Feet")
    assert fence.motion.maximum_position == pytest.approx(2.0 / 0.3048)
    text = office.to.gpu_shading(office)
    moved = next(entry for entry in idf_objects(text) if entry[0] == "GPUShading:MovingShade")
    assert moved[2] == "Fence" and moved[12] == pytest.approx(2.0)
    # An axis of rotation keeps the sense of its turns in a mirror, which a vector of a place does not.
    fence.motion = hb.MovingShade("Gate", "Rotate", "Given", 0.0, 0.0, 1.0)
    office.reflect(Plane(Vector3D(1, 0, 0)))
    assert fence.motion.direction_z == -1.0


def test_errors_are_one_line(hb, office):
    louvres = [shade for shade in office.shades if "OutShd" in shade.identifier]
    blind = hb.MovingShade("Blind", "Rotate", control="TrackSun")
    for shade in (louvres[0], office.orphaned_shades[0]):
        shade.properties.gpu_shading.motion = blind
    with pytest.raises(ValueError, match=r"MovingShade 'Blind': moves Office_Back_Glz0_OutShd0, Fence"):
        office.to.gpu_shading(office)
    properties = louvres[0].properties.gpu_shading
    properties.screen = hb.PerforatedScreen("Blades", "Round")
    with pytest.raises(ValueError, match="Office_Back_Glz0_OutShd0: expected a screen or a transmittance, not both"):
        properties.transmittance = hb.TransparentShade("Mesh", "Constant", (0.5,))
    with pytest.raises(ValueError, match="screen: Tree, expected a PerforatedScreen"):
        properties.screen = hb.Tree("Oak")
    with pytest.raises(ValueError, match="Tree 'Oak': crown: no such field"):
        hb.Tree.from_dict({"type": "Tree", "name": "Oak", "crown": 1})
    with pytest.raises(ValueError, match="expected no comma"):
        hb.Tree("A, B").to_idf("A, B")


def test_surfaces_that_no_pattern_tells_apart_have_an_object_each(hb, office):
    louvres = sorted((shade for shade in office.shades if "OutShd" in shade.identifier), key=lambda s: s.identifier)
    for shade in (louvres[0], louvres[2]):
        shade.properties.gpu_shading.transmittance = hb.TransparentShade("Glass", "Constant", (0.5,))
    names = {entry[1:3] for entry in idf_objects(office.to.gpu_shading(office))}
    assert names == {("Glass", "Office_Back_Glz0_OutShd0"), ("Glass 2", "Office_Back_Glz0_OutShd2")}


def test_a_run_is_that_of_the_objects_by_hand(hb, office, patched, weather, tmp_path):
    dress(hb, office)
    results = hb.run(office, weather, tmp_path / "run", one_day(hb), resolution=128)
    hand = tmp_path / "hand"
    hand.mkdir()
    (hand / "model.idf").write_text((tmp_path / "run" / "model.idf").read_text() + OBJECTS)
    direct = energyplus.run(patched, hand / "model.idf", weather, hand / "out",
                            ["--gpu-shading", "--gpu-shading-resolution=128", "-x"])
    assert direct.completed, direct.why()
    import gpu_shading
    expected = gpu_shading.Run(hand / "out", ()).values(SUNLIT, "Hourly")
    found = {face.identifier.upper(): data for face, data in results.faces()}
    assert len(found) == 7
    from ladybug.datacollection import HourlyContinuousCollection
    for name, data in found.items():
        assert isinstance(data, HourlyContinuousCollection) and data.header.unit == "fraction"
        assert data.values == pytest.approx(tuple(expected[name]), abs=1e-6), name
    window = np.array(found["OFFICE_BACK_GLZ0"].values)
    bare = hb.run(office.duplicate(), weather, tmp_path / "clipping", one_day(hb), shading=False)
    opaque = np.array({face.identifier: data for face, data in bare.faces()}["Office_Back_Glz0"].values)
    # Blades with holes, that turn, behind glass: other shade than opaque blades at rest.
    assert np.abs(window - opaque).max() > 0.05


def test_sun_hours_are_grids(hb, office, weather, tmp_path):
    """A western window, which nothing shades: the sun's path gives the hours."""
    maps = hb.sun_hours(office, weather, first="03-05", last="03-05", receivers="Office_Left_Glz0", spacing=0.5)
    (grid,), (hours,) = maps.grids, maps.hours
    window = next(part for face in office.faces for part in face.apertures if part.identifier == "Office_Left_Glz0")
    assert grid.identifier == grid.display_name == "Office_Left_Glz0" and len(hours) == grid.count > 4
    # maps.csv has the sizes of cells with five digits.
    assert grid.mesh.area == pytest.approx(window.area, rel=1e-3)
    for sensor in grid.sensors:
        assert window.geometry.plane.distance_to_point(type(window.geometry.center)(*sensor.pos)) < 1e-5
        assert np.dot(sensor.dir, [window.normal.x, window.normal.y, window.normal.z]) == pytest.approx(1.0, abs=1e-6)
    from ladybug.epw import EPW
    from ladybug.sunpath import Sunpath
    path = Sunpath.from_location(EPW(str(weather)).location)
    minutes = [path.calculate_sun(3, 5, minute / 60) for minute in range(24 * 60)]
    facing = sum(sun.is_during_day and sun.sun_vector.dot(window.normal) < 0 for sun in minutes) / 60
    # The map's timesteps are of 10 minutes.
    assert hours == pytest.approx([facing] * len(hours), abs=10 / 60)
    maps.write(tmp_path)
    (info,) = json.loads((tmp_path / "sun_hours" / "grids_info.json").read_text())
    assert info["full_id"] == "Office_Left_Glz0" and info["count"] == len(hours)
    assert np.loadtxt(tmp_path / "beam_energy" / "Office_Left_Glz0.res") == pytest.approx(maps.energy[0], rel=1e-4)
    office.properties.radiance.add_sensor_grids(maps.grids)
    assert office.properties.radiance.sensor_grids[0].mesh == grid.mesh


def test_results_of_grids_are_described_as_honeybee_does(hb, tmp_path):
    """By a recipe of honeybee-radiance, and by the class with which honeybee-display reads them."""
    from click.testing import CliRunner
    from honeybee_radiance.cli.postprocess import post_process
    from ladybug.datatype.base import DataTypeBase

    hb.SunHours((), (), ()).write(tmp_path)
    ours = {name: json.loads((tmp_path / name / "vis_metadata.json").read_text())
            for name in ("sun_hours", "beam_energy")}
    theirs = json.loads(CliRunner().invoke(post_process, ["direct-sun-hours-vis-metadata"]).output)
    hours = ours["sun_hours"]
    assert {key: hours[key] for key in ("type", "unit")} == {key: theirs[key] for key in ("type", "unit")}
    assert hours["data_type"] == theirs["data_type"] | {"name": "Sun Hours"}
    for metadata in ours.values():
        kind = DataTypeBase.from_dict(metadata["data_type"])
        assert kind.is_unit_acceptable(metadata["unit"]) and kind.cumulative


TRANSLATE = """
import sys
import openstudio
from honeybee.model import Model
from honeybee_openstudio.writer import model_to_openstudio
model = Model.from_file(sys.argv[1])
workspace = openstudio.energyplus.ForwardTranslator().translateModel(model_to_openstudio(model))
names = [each.nameString() for each in workspace.objects() if each.iddObject().name().startswith("Shading:")]
print("\\n".join(sorted(names)))
print(model.to.gpu_shading(model))
"""


def test_names_are_those_of_openstudio(hb, office, tmp_path):
    """So that the objects are right for the model that honeybee-openstudio writes."""
    need("openstudio")
    need("honeybee_openstudio")
    dress(hb, office)
    file = office.to_hbjson("house", str(tmp_path))
    done = subprocess.run([sys.executable, "-c", TRANSLATE, file], env=environment(tmp_path), capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    names, _, objects = done.stdout.partition("GPUShading:")
    written = set(re.findall(r"Shading:\w+:Detailed,\s*([^,]*),", office.to.idf(office)))
    assert set(names.split()) == written and len(written) == 6
    assert idf_objects("GPUShading:" + objects) == idf_objects(OBJECTS)

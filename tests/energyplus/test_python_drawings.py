"""The Python package's drawings, frames and meshes, against the program's tables and EnergyPlus's own outputs."""

import sys
import warnings

import numpy as np
import pytest
import screened_room
from shading_runs import energyplus, input_file, results

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
sys.path.append(str(energyplus.REPOSITORY / ".venv" / "tools"))
PNG = b"\x89PNG\r\n"


@pytest.fixture(scope="module")
def gs(patched):
    import gpu_shading

    return gpu_shading


@pytest.fixture(scope="module")
def run(gs, courtyard, weather, tmp_path_factory):
    """Two days of the courtyard in November."""
    folder = tmp_path_factory.mktemp("frames")
    model = input_file.read(courtyard)
    model.remove(lambda name: name == "runperiod")
    model.add("RunPeriod", ["Days", 11, 29, 2017, 11, 30, 2017])
    results.instrument(model, "Timestep")
    for frequency in ("Hourly", "Daily"):
        model.add_output_variable(results.SUNLIT, frequency)
    model.write(folder / "courtyard.idf")
    return gs.run(folder / "courtyard.idf", weather, folder / "out")


def test_a_frame_has_the_values_of_eso_and_their_times(run):
    pandas = pytest.importorskip("pandas", reason="pandas is missing: run scripts/setup")
    frame = run.frame(results.SUNLIT)
    values = run.values(results.SUNLIT, "Hourly")
    assert sorted(frame.columns) == sorted(values)
    for name, expected in values.items():
        assert frame[name].to_numpy() == pytest.approx(expected, abs=1e-6)
    # Golden is 7 hours behind; hours end at 01:00 to 24:00.
    assert frame.index[0] == pandas.Timestamp("2017-11-29 01:00", tz="-07:00")
    assert frame.index[-1] == pandas.Timestamp("2017-12-01 00:00", tz="-07:00")
    steps = run.frame(frequency="TimeStep")
    assert list(steps.columns.names) == ["variable", "key"]
    altitude = steps[results.ALTITUDE].iloc[:, 0]
    # The sun is highest at noon of mean solar time, within the equation of time.
    assert abs(altitude.idxmax() - pandas.Timestamp("2017-11-29 12:00", tz="-07:00")) < pandas.Timedelta(minutes=30)
    assert len(run.frame(results.SUNLIT, "Daily")) == 2


def test_a_frame_says_what_is_missing(gs, run, tmp_path):
    pytest.importorskip("pandas", reason="pandas is missing: run scripts/setup")
    with pytest.raises(gs.InvalidInput, match="Zone Mean: none at Hourly"):
        run.frame("Zone Mean")
    with pytest.raises(gs.InvalidInput, match="'Weekly', expected one of TimeStep"):
        run.frame(frequency="Weekly")
    with pytest.raises(gs.InvalidInput, match="needs Output:SQLite"):
        gs.Run(tmp_path, ()).frame()


def test_light_is_that_of_energyplus(gs, courtyard, weather, tmp_path):
    pandas = pytest.importorskip("pandas", reason="pandas is missing: run scripts/setup")
    model = input_file.read(courtyard)
    model.remove(lambda name: name == "runperiod")
    model.add("RunPeriod", ["Days", 11, 29, 2017, 12, 2, 2017])
    model.add("Output:SQLite", ["Simple"])
    kinds = {"all": "", "beam": "Beam ", "sky": "Sky Diffuse ", "reflected by ground": "Ground Diffuse "}
    variables = {kind: f"Surface Outside Face Incident {word}Solar Radiation Rate per Area" for kind, word in
                 kinds.items()}
    for variable in variables.values():
        model.add_output_variable(variable, "Hourly")
    model.write(tmp_path / "courtyard.idf")
    done = gs.run(tmp_path / "courtyard.idf", weather, tmp_path / "out", report=True)
    months, hours = done.light(), done.light("hour")
    window = "WEST COURT BACK WINDOW"
    for kind, variable in variables.items():
        theirs = done.frame(variable)[window]
        beginning = theirs.index - pandas.Timedelta(hours=1)
        for month in (11, 12):
            of_month = theirs[beginning.month == month]
            assert months[kind][window, month] == pytest.approx(of_month.sum() / 1000, abs=0.051)
            noon = of_month[of_month.index.hour == 12].mean()
            assert hours[kind][window, month, 12] == pytest.approx(noon, abs=0.051)
    assert months["all"].sum() > 10
    summary = done.summary()
    for kind, energy in summary.light[window].items():
        assert energy == pytest.approx(months[kind][window].sum(), abs=1e-9)
    assert f"<td>{window}</td>" in summary._repr_html_()
    with pytest.raises(gs.InvalidInput, match="'day', expected month or hour"):
        done.light("day")
    with pytest.raises(gs.InvalidInput, match="the run needs report=True"):
        gs.Run(tmp_path, ()).light()


def test_a_summary_is_that_of_energyplus(run):
    summary = run.summary()
    end = (run.folder / "eplusout.end").read_text()
    assert f"{summary.warnings} Warning; {summary.severe} Severe Errors" in end
    assert results.SUNLIT in summary.variables and 0.0 < summary.seconds < 600.0
    assert any("CPU" in line or "GPU" in line for line in summary.messages)
    assert "Warnings" in run._repr_html_()


def test_masks_are_the_programs(gs, courtyard):
    masks = gs.mask(courtyard, receiver="West Court*Window", step=5)
    assert masks.names == ["WEST COURT BACK WINDOW", "WEST COURT SIDE WINDOW"]
    back = masks["West Court Back Window"]
    assert back.sky.shape == (18, 72) and np.isnan(back.sky[:, :18]).all() and np.isnan(back.sky[:, 54:]).all()
    # From the sky that is drawn: cos(incidence) over the half sphere.
    azimuth, altitude = np.meshgrid(np.radians(back.azimuths), np.radians(back.altitudes))
    weights = np.cos(altitude) * -np.cos(azimuth) * np.cos(altitude)
    weights[np.isnan(back.sky)] = 0.0
    assert (weights * np.nan_to_num(back.sky)).sum() / weights.sum() / 2 == pytest.approx(back.view_factor, abs=0.001)
    assert back.view_factor + sum(back.stopped.values()) == pytest.approx(0.5, abs=0.001)
    scene = gs.Scene.from_energyplus(courtyard)
    hours = [hour for hour in back.hours if hour.sunlit is not None]
    rendered = scene.sunlit([[hour.azimuth, hour.altitude] for hour in hours], receivers=["West Court Back Window"])
    assert rendered[:, 0] == pytest.approx([hour.sunlit for hour in hours], abs=2e-4)
    assert back._repr_png_().startswith(PNG) and back.svg.startswith("<svg")
    assert masks._repr_html_().count("<img") == 2 and "0." in repr(back)
    with pytest.raises(KeyError, match="expected one of WEST COURT BACK"):
        masks["West Wing"]


def test_views_maps_and_screens(gs, courtyard, weather, tmp_path):
    seen = gs.view(courtyard, at="06-21 15:00", size=200)
    assert seen._repr_png_().startswith(PNG)
    seen.save(tmp_path / "view.png")
    assert (tmp_path / "view.png").read_bytes() == seen.png
    pytest.importorskip("PIL.Image")
    assert seen.pixels.shape[2] == 3 and len(np.unique(seen.pixels)) > 10
    with pytest.raises(gs.InvalidInput, match="expected one of at, day and sun"):
        gs.view(courtyard)
    maps = gs.map(courtyard, weather, first="06-21", last="06-21", receivers="West Court Side*", spacing=0.5)
    one = maps["West Court Side"]
    assert one.hours.shape == one.energy.shape and one.mean_hours == pytest.approx(np.nanmean(one.hours), rel=0.05)
    assert one._repr_png_().startswith(PNG) and maps._repr_html_().count("<img") == len(maps) == 2
    (tmp_path / "room.idf").write_text(screened_room.model(screen="large holes"))
    [sheet] = gs.screen(tmp_path / "room.idf")
    assert sheet.tau[0, 0] == pytest.approx(screened_room.generate.OPEN, rel=1e-4)
    assert sheet.tau.shape == (len(sheet.theta), len(sheet.phi)) and (np.diff(sheet.theta) > 0).all()
    assert sheet._repr_png_().startswith(PNG)
    check = gs.check(courtyard)
    assert check._repr_html_().count("<tr>") > 15 and check["surfaces"]


SQUARE = [[0, 0, 0], [2, 0, 0], [2, 0, 2], [0, 0, 2]]


def test_answers_are_labelled(gs):
    xarray = pytest.importorskip("xarray", reason="xarray is missing: run scripts/setup")
    overhang = [[-9, -1, 2], [9, -1, 2], [9, 0, 2], [-9, 0, 2]]
    scene = gs.Scene(receivers={"left": SQUARE, "right": SQUARE}, casters=[overhang])
    suns = [[180, 20], [180, 45], [210, 45]]
    plain = scene.sunlit(suns, device="cpu")
    told = scene.sunlit(suns, device="cpu", labelled=True, receivers=["Right", 0])
    assert isinstance(told, xarray.DataArray) and told.dims == ("direction", "receiver")
    assert list(told.receiver.values) == ["right", "left"]
    assert told.azimuth.values == pytest.approx([180, 180, 210]) and told.altitude.values == pytest.approx([20, 45, 45])
    assert told.sel(receiver="left").values == pytest.approx(plain[:, 0])
    assert (told.error.values == 1e-7).all() and told.error.dims == told.dims
    grid = scene.sunlit([suns, suns], device="cpu", labelled=True)
    assert grid.dims == ("direction_0", "direction_1", "receiver")
    with pytest.raises(gs.InvalidInput, match="middle: no surface of that name"):
        scene.sunlit(suns, receivers=["middle"])
    with pytest.raises(gs.InvalidInput, match="'left', expected a list"):
        scene.sunlit(suns, receivers="left")


def test_labelled_answers_have_their_errors(gs):
    pytest.importorskip("xarray", reason="xarray is missing: run scripts/setup")
    at = np.random.default_rng(3).uniform([-2, -1, 0], [4, -0.1, 4], (2000, 1, 3))
    leaves = list(at + [[0, 0, 0], [0.1, 0, 0], [0.1, 0.05, 0.1], [0, 0.05, 0.1]])
    scene = gs.Scene(receivers={"wall": SQUARE}, casters=leaves)
    suns = np.column_stack([np.linspace(130, 230, 20), np.full(20, 35.0)])
    rough, fine = (scene.renderer(device="cpu", error=error).sunlit(suns, labelled=True) for error in (1e-2, 1e-5))
    assert 1e-4 < rough.error.values.max() <= 1e-2 and fine.error.values.max() <= 1e-5
    true = np.abs(rough.values - fine.values)
    assert true.max() > 1e-4 and np.count_nonzero(true > rough.error.values) <= 1
    fixed = scene.renderer(device="cpu", resolution=64).sunlit(suns, labelled=True)
    assert np.isnan(fixed.error.values).all()


def test_progress_changes_no_answer(gs, capsys):
    pytest.importorskip("tqdm", reason="tqdm is missing: run scripts/setup")
    scene = gs.Scene(receivers={"wall": SQUARE})
    suns = np.column_stack([np.linspace(100, 260, 300), np.full(300, 30.0)])
    assert (scene.sunlit(suns, device="cpu", progress=True) == scene.sunlit(suns, device="cpu")).all()
    assert "300/300" in capsys.readouterr().err


def test_millimetres_are_warned_of(gs):
    with pytest.warns(UserWarning, match="holes of 5 m at a pitch of 8 m: lengths are in metres"):
        gs.Screen.pattern("round", size=5, pitch=8)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        screen = gs.Screen.pattern("round", size=0.005, pitch=0.008)
    assert repr(screen) == "<Screen: round, 35.4% open, holes of 5 mm>"
    assert repr(gs.Scene(receivers=[SQUARE]).renderer(device="cpu")).startswith("<Renderer: 1 receivers, CPU")


class TriangleMesh:
    """What trimesh.Trimesh has."""

    vertices = np.array([*SQUARE, [1.0, -1.0, 1.0]])
    faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 0, 1]])


class PolygonMesh:
    """What pyvista.PolyData has: the number of corners before those of each face."""

    points = TriangleMesh.vertices
    faces = np.array([4, 0, 1, 2, 3, 3, 0, 1, 4])


def test_meshes_become_surfaces(gs):
    scene = gs.Scene()
    assert scene.add_mesh(TriangleMesh(), name="pyramid", receives=True) == [0, 1, 2, 3]
    assert scene.areas == pytest.approx(np.sqrt(2.0))
    assert scene.add_mesh(PolygonMesh(), name="sheet", casts="never") == [4, 5]
    assert scene.areas[4:] == pytest.approx([4.0, np.sqrt(2.0)])
    with pytest.raises(gs.InvalidInput, match="expected a trimesh.Trimesh or a pyvista.PolyData"):
        scene.add_mesh([1, 2], name="none")


def scene_with_a_hole(gs):
    scene = gs.Scene(receivers={"wall": SQUARE})
    hole = [[0.5, 0, 0.5], [1.5, 0, 0.5], [1.5, 0, 1.5], [0.5, 0, 1.5]]
    scene.add(SQUARE, name="frame", holes=[hole, [[0.1, 0, 0.1], [0.1, 0, 0.2], [0.2, 0, 0.1]]])
    scene.add([[0, 0, 0], [3, 0, 0], [3, 3, 0], [2, 3, 0], [2, 1, 0], [1, 1, 0], [1, 3, 0], [0, 3, 0]], name="U")
    scene.add([[0, 0, 0], [0, 0, 2], [0, 2, 2], [0, 2, 0]], name="side")
    return scene


def test_scenes_become_triangles(gs):
    trimesh = pytest.importorskip("trimesh", reason="trimesh is missing")
    scene = scene_with_a_hole(gs)
    solid = scene.to_trimesh()
    assert isinstance(solid, trimesh.Trimesh)
    of = solid.face_attributes["surface"]
    for index, area in enumerate(scene.areas):
        assert solid.area_faces[of == index].sum() == pytest.approx(area), index
        # As much as the outline encloses, so that none overlaps another, and all face its side.
        assert solid.face_normals[of == index] == pytest.approx(np.tile(scene.normals[index], (sum(of == index), 1)))


def test_scenes_become_polygons(gs):
    pyvista = pytest.importorskip("pyvista", reason="pyvista is missing")
    scene = scene_with_a_hole(gs)
    drawn = scene.to_pyvista({"sunlit": [0.25, 1.0, 0.5, 0.0]})
    assert isinstance(drawn, pyvista.PolyData)
    of = drawn.cell_data["surface"]
    assert (drawn.cell_data["sunlit"] == np.array([0.25, 1.0, 0.5, 0.0])[of]).all()
    sizes = drawn.triangulate().compute_cell_sizes()
    for index, area in enumerate(scene.areas):
        assert sizes["Area"][sizes["surface"] == index].sum() == pytest.approx(area)
    back = gs.Scene()
    back.add_mesh(drawn, name="again")
    assert back.areas.sum() == pytest.approx(scene.areas.sum())
    with pytest.raises(gs.InvalidInput, match="expected one value for each of 4 surfaces"):
        scene.to_pyvista({"sunlit": [1.0]})

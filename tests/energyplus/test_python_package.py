"""The Python package with models of EnergyPlus: scenes, runs and samples against what EnergyPlus reports."""

import contextlib
import io
import json
import re
import subprocess
import sys

import numpy as np
import pytest
import screened_room
import test_models
from shading_runs import energyplus, input_file, results

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
TOOLS = energyplus.REPOSITORY / ".venv" / "tools"
sys.path.append(str(TOOLS))
PAGE = energyplus.REPOSITORY / "gpu_shading" / "docs" / "python.md"
NOTEBOOK = energyplus.REPOSITORY / "idf_examples" / "box_with_louvres" / "variants.ipynb"
MODEL_YEAR = 2017
RESOLUTION = 256


@pytest.fixture(scope="session")
def gs(patched):
    import gpu_shading

    return gpu_shading


@pytest.fixture(scope="session")
def hedged(courtyard, tmp_path_factory):
    """The courtyard behind a hedge by schedule and a pane of glass, for a day in November."""
    model = input_file.read(courtyard)
    model.remove(lambda name: name == "runperiod")
    model.add("RunPeriod", ["Day", 11, 30, MODEL_YEAR, 11, 30, MODEL_YEAR])
    model.add("Schedule:Constant", ["Leaves", "", 0.3])
    model.add("Schedule:Compact", ["Buds", "", "Through: 12/31", "For: AllDays", "Until: 12:00", "0.2",
                                   "Until: 24:00", "0.7"])
    model.add("Shading:Building:Detailed", ["Hedge", "Leaves", 4, -2, -3, 2, -2, -3, 0, 14, -3, 0, 14, -3, 2])
    model.add("Shading:Building:Detailed", ["Twigs", "Buds", 4, -2, -4, 3, -2, -4, 0, 8, -4, 0, 8, -4, 3])
    model.add("Shading:Building:Detailed", ["Pane", "", 4, 4, -2, 6, 4, -2, 0, 9, -2, 0, 9, -2, 6])
    model.add("GPUShading:TransparentShade", ["Glass", "Pane", "PolynomialInCosine", 0.0, 1.1, -0.4])
    results.instrument(model, "Timestep")
    path = tmp_path_factory.mktemp("model") / "hedged.idf"
    model.write(path)
    return path


def test_a_scene_of_a_model_is_what_energyplus_is_answered(gs, hedged, weather, tmp_path):
    run = gs.run(hedged, weather, tmp_path / "out", resolution=RESOLUTION, update="timestep")
    scene = gs.Scene.from_energyplus(hedged, weather)
    assert scene.schedules == ["BUDS"] and "PANE" in scene.names
    (azimuth,), (altitude,) = (run.values(name, "TimeStep").values() for name in (results.AZIMUTH, results.ALTITUDE))
    hours = (np.arange(len(azimuth)) + 1) * 24 / len(azimuth)
    fractions = scene.renderer(resolution=RESOLUTION).sunlit(
        np.column_stack([azimuth, altitude]), factors=np.where(hours <= 12, 0.2, 0.7)[:, None])
    names = [scene.names[index] for index in scene.receivers]
    cosines = run.values(results.COSINE, "TimeStep")
    compared = 0
    for name, values in run.values(results.SUNLIT, "TimeStep").items():
        if name not in names:
            continue
        facing = (cosines[name] > results.FACING) & (altitude > 0)
        # EnergyPlus reports the sun up to 0.001 degrees from where it shades by.
        error = np.abs(fractions[:, names.index(name)] - values)[facing]
        assert error.max(initial=0.0) < 1.5e-4, name
        assert not error.size or error.mean() < 5e-5, name
        compared += np.count_nonzero((values > 0.01) & (values < 0.99) & facing)
    assert compared > 100


def test_a_screen_of_a_model_comes_with_it(gs, patched, weather, tmp_path):
    model = tmp_path / "room.idf"
    model.write_text(screened_room.model(screen="small holes"))
    scene = gs.Scene.from_energyplus(model)
    screens = [surface.screen for surface in scene.surfaces if surface.screen]
    assert len(screens) == 1
    assert screens[0].open_fraction == pytest.approx(screened_room.generate.OPEN, rel=1e-5)
    window = scene.index("WINDOW")
    for azimuth, altitude in ((180, 20), (190, 40), (165, 30)):
        behind, tau = screened_room.passing("south", screened_room.generate.HOLES["small holes"], azimuth, altitude)
        found = scene.sunlit([azimuth, altitude], receivers=[window])[0]
        assert found == pytest.approx(1 - behind + behind * tau, abs=3e-3), (azimuth, altitude)


def test_check_says_as_json_what_its_table_says(gs, hedged, patched):
    document = gs.check(hedged)
    command = [patched.parent / "gpu_shading", "check", hedged]
    table = subprocess.run(command, capture_output=True, text=True, check=True)
    rows = [line for line in table.stdout.splitlines() if re.search(r"  (yes|no) {5,6} ", line)]
    assert document["format"] == "gpu_shading check 1" and document["rule"] == []
    assert [remark for remark in document["remarks"] if "reflex corner" not in remark] == []
    assert len(rows) == len(document["surfaces"]) > 20
    for row, surface in zip(rows, document["surfaces"], strict=True):
        name, kind, area, receives, casts = re.split(r" {2,}", row.strip())
        assert (name, kind) == (surface["name"], surface["kind"])
        assert float(area) == pytest.approx(surface["area"], abs=6e-4)
        assert (receives == "yes", casts) == (surface["receives"], surface["casts"] or "not")


def test_an_error_of_the_model_is_one_line(gs, tmp_path, box):
    model = tmp_path / "model.idf"
    model.write_text(box + "GPUShading:TransparentShade,Glass,*,Constant,3;\n")
    for ask in (gs.check, gs.Scene.from_energyplus):
        with pytest.raises(gs.RunError, match="3") as raised:
            ask(model)
        assert "\n" not in str(raised.value) and "GLASS" in str(raised.value).upper()


def test_run_returns_what_was_reported(gs, box, weather, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box + "Output:Variable,South Window,Surface Outside Face Sunlit Fraction,Hourly;\n"
                     "Output:Variable,South Window,Surface Outside Face Sunlit Fraction,Monthly;\n")
    run = gs.run(model, weather, tmp_path / "out", resolution=64)
    hourly = run.values("Surface Outside Face Sunlit Fraction", "Hourly")
    assert list(hourly) == ["SOUTH WINDOW"] and len(hourly["SOUTH WINDOW"]) == 8760
    monthly = run.values("Surface Outside Face Sunlit Fraction", "Monthly")["SOUTH WINDOW"]
    assert len(monthly) == 12 and monthly.mean() == pytest.approx(hourly["SOUTH WINDOW"].mean(), abs=5e-3)
    assert any("64 x 64" in line for line in run.messages)
    with pytest.raises(gs.InvalidInput, match="not empty"):
        gs.run(model, weather, tmp_path / "out")
    with pytest.raises(gs.InvalidInput, match="no Output:Variable"):
        run.values("Zone Mean Air Temperature")
    with pytest.raises(gs.RunError, match="bogus"):
        gs.run(model, weather, tmp_path / "bogus", update="bogus")
    model.write_text(box + "Wall,A;\n")
    with pytest.raises(gs.RunError) as raised:
        gs.run(model, weather, tmp_path / "severe")
    assert "\n" not in str(raised.value)


def test_samples_are_a_dataset_and_files_of_it(gs, hedged, weather, tmp_path):
    xarray = pytest.importorskip("xarray", reason=f"{TOOLS} has no xarray: run scripts/setup")
    pandas = pytest.importorskip("pandas")
    data = gs.sample(hedged, weather, tmp_path / "samples", mode="coarse")
    about = json.loads((tmp_path / "samples" / "samples.json").read_text())
    assert data.sizes["time"] == 365 * 96 and data.sizes["receiver"] == len(about["receivers"])
    assert data.time.values[[0, -1]].astype("datetime64[m]").astype(str).tolist() == [
        "2017-01-01T00:15", "2018-01-01T00:00"]
    # As pandas alone reads the table.
    table = pandas.read_csv(tmp_path / "samples" / "year.csv", parse_dates=["time"], index_col="time")
    assert table.index.is_monotonic_increasing and (table.index == data.time.values).all()
    assert (table[data.receiver.values[0]] == data.sunlit_fraction[:, 0]).all()
    noon = data.sel(time="2017-06-21T12:00")
    assert noon.altitude > 70 and float(noon.sunlit_fraction.max()) > 0.9
    for name, module in (("year.nc", "h5netcdf"), ("year.parquet", "fastparquet")):
        pytest.importorskip(module, reason=f"{TOOLS} has no {module}: run scripts/setup")
        gs.write_samples(data, tmp_path / name)
    assert xarray.load_dataset(tmp_path / "year.nc").identical(data)
    again = pandas.read_parquet(tmp_path / "year.parquet")
    assert (again.to_numpy() == data.sunlit_fraction.to_numpy()).all() and (again.index == data.time.values).all()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["samples", "year.nc", "year.parquet"]
    with pytest.raises(gs.InvalidInput, match="ends in .nc or .parquet"):
        gs.write_samples(data, tmp_path / "year.xls")


def test_samples_that_are_damaged_are_refused(gs, tmp_path):
    pytest.importorskip("xarray", reason=f"{TOOLS} has no xarray: run scripts/setup")
    (tmp_path / "samples.json").write_text('{"format": "gpu_shading samples 1", "receivers": [{"name": "A"}]}')
    for year in ("", "time,azimuth,altitude,B\n", "time,azimuth,altitude,A\n2017-01-01 00:15,1,2\n",
                 "time,azimuth,altitude,A\nnever,1,2,3\n", "time,azimuth,altitude,A\n2017-01-01 00:15,1,2,x\n"):
        (tmp_path / "year.csv").write_text(year)
        with pytest.raises(gs.InvalidInput, match="is not a folder of gpu_shading sample"):
            gs.read_samples(tmp_path)


def test_the_page_says_what_is_so(gs, weather, courtyard, tmp_path, monkeypatch):
    """Its blocks of Python are run one after another."""
    blocks = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    assert len(blocks) > 4
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.idf").symlink_to(courtyard)
    (tmp_path / "weather.epw").symlink_to(weather)
    names = {}
    for block in blocks:
        if "sample" in block:
            for module in ("xarray", "h5netcdf", "fastparquet"):
                pytest.importorskip(module, reason=f"{TOOLS} has no {module}: run scripts/setup")
        said = re.findall(r"^(print\(.*\)) +# (.*)$", block, re.M)
        exec(compile(block, str(PAGE), "exec"), names)
        for call, expected in said:
            assert str(eval(call.removeprefix("print"), names)) == expected, call


def test_the_notebook_runs(gs, tmp_path, monkeypatch):
    """Its cells one after another, as Jupyter would run them, print the numbers that it is stored with."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    monkeypatch.chdir(NOTEBOOK.parent)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    names, pictures = {}, 0
    for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(compile("".join(cell["source"]), NOTEBOOK.name, "exec"), names)
            stored = "".join(line for output in cell["outputs"] for line in output.get("text", ()))
            told, found = (re.findall(r"\d+(?:\.\d+)?", text) for text in (stored, printed.getvalue()))
            # The last digit of a sum may depend on the device.
            assert [float(value) for value in found] == pytest.approx([float(value) for value in told], abs=0.11)
            pictures += sum("image/png" in output.get("data", ()) for output in cell["outputs"])
    assert pictures == 2
    table = names["table"].reshape(4, 5, 4)
    # Deeper blades let less through, and so do those that are tilted more towards the low sun of winter.
    assert (np.diff(table[..., 2:], axis=0) < 0.01).all() and (np.diff(table[:, :, 3], axis=1) < 0.01).all()
    assert table[0, 0, 2] > 2 * table[-1, -1, 2] and table[0, 0, 3] > 5 * table[-1, -1, 3]
    assert names["ratios"] == pytest.approx([1.0, 1.0], abs=5e-4)
    assert len(names["axes"].lines) == 4


def test_types_are_checked(tmp_path):
    """mypy knows the package's types, and tells a wrong argument from a right one."""
    if not (TOOLS / "mypy").is_dir():
        pytest.skip(f"{TOOLS} has no mypy: run scripts/setup")
    user = tmp_path / "user.py"
    user.write_text("import gpu_shading\n"
                    "scene = gpu_shading.Scene()\n"
                    "index: int = scene.add([[0, 0, 0], [1, 0, 0], [1, 1, 0]], casts='never')\n"
                    "scene.add([[0, 0, 0]], casts='maybe')\n"
                    "gpu_shading.Screen.pattern('oval', 1, 2)\n")
    source = energyplus.REPOSITORY / "gpu_shading" / "python"
    paths = {"MYPYPATH": str(source), "PYTHONPATH": f"{TOOLS}:{source}"}
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path, user,
                           source / "gpu_shading", source / "honeybee_gpushading"],
                          env=energyplus.os.environ | paths, capture_output=True, text=True)
    errors = [line for line in done.stdout.splitlines() if " error: " in line]
    assert len(errors) == 2 and '"casts"' in errors[0] and "oval" in errors[1], done.stdout + done.stderr


def with_internal_mass():
    rows = test_models.index()
    return [row for row in rows if row.values[0] is None or re.search(
        r"InternalMass\b", (test_models.MODELS / row.values[0][0]).read_text(errors="replace"), re.IGNORECASE)]


@pytest.mark.parametrize("row", with_internal_mass())
def test_models_with_internal_mass_are_scenes(row, gs):
    """EnergyPlus has it among its surfaces, without vertices."""
    name, weather_name, _, flags = row
    if flags:
        pytest.skip(f"from_energyplus passes no {flags}")
    path, weather = test_models.MODELS / name, energyplus.find_weather(weather_name)
    scene, document = gs.Scene.from_energyplus(path, weather), gs.check(path, weather)
    listed = {surface["name"]: surface for surface in document["surfaces"]}
    without_area = [surface for surface in listed.values() if surface["area"] == 0.0 and surface["name"] not in
                    scene.names]
    assert without_area and not any(surface["receives"] or surface["casts"] for surface in without_area)
    for surface, area in zip(scene.surfaces, scene.areas, strict=True):
        # A wall is listed without its windows.
        if surface.name in listed and listed[surface.name]["kind"] == "window or door":
            assert area == pytest.approx(listed[surface.name]["area"], rel=1e-9, abs=1e-9), surface.name
    building = {name: surface for name, surface in listed.items()
                if surface["kind"] in ("heat transfer surface", "window or door")}
    receiving = {scene.names[index] for index in scene.receivers}
    assert receiving & set(building) == {name for name, surface in building.items() if surface["receives"]}


@pytest.mark.parametrize("row", test_models.index(only=("RefBldgSmallOfficeNew2004_Chicago.idf",)))
def test_a_scene_with_internal_mass_is_what_energyplus_is_answered(row, gs, tmp_path):
    """Each surface has its own place in the rule of which shades which, too."""
    weather = energyplus.find_weather(row[1])
    model = input_file.read(test_models.MODELS / row[0])
    results.instrument(model, "Timestep")
    path = tmp_path / "model.idf"
    model.write(path)
    run = gs.run(path, weather, tmp_path / "out", resolution=RESOLUTION, update="timestep", arguments=["-D"])
    scene = gs.Scene.from_energyplus(path, weather)
    (azimuth,), (altitude,) = (run.values(name, "TimeStep").values() for name in (results.AZIMUTH, results.ALTITUDE))
    fractions = scene.renderer(resolution=RESOLUTION).sunlit(np.column_stack([azimuth, altitude]))
    cosines, compared = run.values(results.COSINE, "TimeStep"), 0
    for name, values in run.values(results.SUNLIT, "TimeStep").items():
        if name in scene.names:
            facing = (cosines[name] > results.FACING) & (altitude > 0)
            error = np.abs(fractions[:, scene.receivers.index(scene.index(name))] - values)[facing]
            assert error.max(initial=0.0) < 1.5e-4, name
            compared += np.count_nonzero((values > 0.01) & (values < 0.99) & facing)
    assert compared > 100

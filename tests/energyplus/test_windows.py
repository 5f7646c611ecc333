"""EnergyPlus for Windows with our files beside it, under Wine: against polygon clipping in the same Windows, and
against the patched EnergyPlus of Linux."""

import re
import shutil
import subprocess

import example_models
import pytest
import screened_room
import windows
from output_files import differing, snapshot
from shading_runs import energyplus, input_file, results

HOSTS = energyplus.REPOSITORY / "tests" / "energyplus" / "hosts"

# As test_models.py has them.
MEAN = 3e-4
PERCENTILE_99 = 3e-3
# With the rounding of counts of 512 x 512 pixels.
SAME = 1e-4


@pytest.fixture(scope="module")
def dropped_in(windows_official, tmp_path_factory):
    """EnergyPlus for Windows with the library beside it."""
    return windows.copy_energyplus(tmp_path_factory.mktemp("our s ü") / "EnergyPlus", windows.library())


def run_in_windows(wine, program, model, weather, folder, options=(), **further):
    run = wine.run_energyplus(program, model, weather, folder, options, **further)
    assert run.completed, run.why()
    return run


def run_on_linux(patched, model, weather, folder, options=()):
    run = energyplus.run(patched, model, weather, folder, ["--gpu-shading", "--gpu-shading-device=cpu", *options])
    assert run.completed, run.why()
    return run


def largest_difference(linux, ours, frequency="Hourly"):
    """Of sunlit fractions, and of beams through windows relative to the largest."""
    one, other = (results.Results(run.folder, frequency) for run in (linux, ours))
    found = results.differences(one, other)
    # Shadows move over at least some receivers.
    assert any(0.05 < value < 0.95 for each in found for value in each.reference)
    fractions = max(each.largest for each in found)
    beams = one.values[results.BEAM]
    most = max((value for values in beams.values() for value in values), default=0.0)
    beam = max((abs(a - b) for name, values in beams.items()
                for a, b in zip(values, other.values[results.BEAM][name], strict=True)), default=0.0)
    return max(fractions, beam / most if most else 0.0)


def assert_same_building(linux, ours):
    """Shading surfaces are not rendered unless they are wanted, so that they are not compared."""
    found = [each for each in results.differences(results.Results(linux.folder), results.Results(ours.folder))
             if each.receiver.zone]
    assert found
    for each in found:
        assert each.largest < SAME, f"{each.receiver.name}: {each.largest} from the answer on Linux"


def assert_matches_clipping(clipping, ours):
    for each in results.differences(results.Results(clipping.folder), results.Results(ours.folder)):
        worst = results.percentile([abs(value) for value in each.values], 0.99)
        assert each.mean < MEAN and worst < PERCENTILE_99, f"{each.receiver.name}: {each.mean}, {worst}"


def place(path, folder, frequency="Hourly", method=None):
    """A copy of a model with the outputs that are compared."""
    model = input_file.read(path)
    results.instrument(model, frequency)
    if method:
        model.set_field("ShadowCalculation", input_file.SHADOW_METHOD, method)
    return input_file.place_copy(model, path, folder)


@pytest.fixture
def write_model(tmp_path, louvres, courtyard):
    """Writes a model of ours, by its name, or a copy of somebody else's."""

    def call(name):
        path = tmp_path / f"{name}.idf"
        if name == "courtyard":
            path.write_text(courtyard.read_text())
        elif name == "canopy":
            path.write_text(example_models.canopy())
        elif name == "screened room":
            path.write_text(screened_room.model(screen="small holes"))
        elif name.endswith(" louvres"):
            path.write_text(louvres(int(name.split()[0])))
        else:
            other = energyplus.models_folder() / f"{name}.idf"
            if not other.is_file():
                pytest.skip(f"{other} is missing: GPU_SHADING_MODELS names the folder of models")
            path.write_text(other.read_text(encoding="utf-8", errors="replace"))
        return path

    return call


# What takes longest, of numbers that do not depend on the system.
ON_LINUX_ALONE = ("Rays.AMillion*", "HolePattern.LetsThrough*", "ScreenRegions.*", "*TabulatedFromARaster*",
                  "*OfAutoLayers*", "OpacityTile.FindsTheWeb*", "SampledSunlit.KeepsToTheBudget*")


@pytest.mark.parametrize("program", ["unit_tests", "filters/optics_tests", "site/site_tests", "sun/solar_tests"])
def test_the_library_passes_its_own_tests(wine, program):
    done = wine.run([windows.build_folder() / "tests" / "gpu_shading" / f"{program}.exe",
                     f"--gtest_filter=-{':'.join(ON_LINUX_ALONE)}"])
    assert done.returncode == 0, done.stdout[-4000:]
    assert "[  PASSED  ]" in done.stdout


@pytest.mark.parametrize("name", ["courtyard", "20 louvres", "1000 louvres"])
def test_the_library_alone(wine, dropped_in, patched, weather, write_model, tmp_path, name):
    """EnergyPlus's own PixelCounting."""
    model = write_model(name)
    error = "0.001" if name == "1000 louvres" else "0.00001"
    ours = run_in_windows(wine, dropped_in, place(model, tmp_path / "counted", method="PixelCounting"), weather,
                          tmp_path / "ours", ["-D"], GPU_SHADING_ERROR=error)
    assert ours.method == "PixelCounting"  # EnergyPlus falls back to polygon clipping without OpenGL
    linux = run_on_linux(patched, place(model, tmp_path / "clipped"), weather, tmp_path / "linux",
                         ["-D", f"--gpu-shading-error={error}"])
    assert_same_building(linux, ours)


# Whether polygon clipping is right there (docs/explanation/accuracy.md).
@pytest.mark.parametrize("name, clips", [
    ("courtyard", True), ("canopy", False), ("screened room", False), ("20 louvres", False), ("1000 louvres", False),
    ("SolarShadingTest", True), ("SolarShadingTest_DisableSelfShadingGroup", True), ("GeometryTest", True),
    ("4ZoneWithShading_Simple_2", True), ("RefBldgSmallOfficeNew2004_Chicago", True), ("SurfaceTest", True)])
def test_rendering_is_that_of_linux(wine, windows_patched, patched, weather, write_model, tmp_path, name, clips):
    """With the same target error, the default, and the same command line; and that of polygon clipping."""
    model = place(write_model(name), tmp_path / "ö ß")
    ours = run_in_windows(wine, windows_patched, model, weather, tmp_path / "our ö", ["-D", "--gpu-shading"])
    assert "rendered by CPU" in ours.errors
    linux = run_on_linux(patched, model, weather, tmp_path / "linux", ["-D"])
    assert largest_difference(linux, ours) < SAME
    if clips:
        model = place(write_model(name), tmp_path / "clipped", method="PolygonClipping")
        clipping = run_in_windows(wine, windows_patched, model, weather, tmp_path / "clipping", ["-D"])
        assert clipping.method == "PolygonClipping"
        assert_matches_clipping(clipping, ours)


def test_without_the_flag_it_is_the_official_program(wine, windows_official, windows_patched, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box)
    folder = tmp_path / "out"
    outputs = []
    for program in (windows_official, windows_patched):
        shutil.rmtree(folder, ignore_errors=True)
        assert wine.run_energyplus(program, model, weather, folder, ["-D"]).status == 0
        outputs.append(snapshot(folder))
    assert differing(*outputs) == []
    failed = wine.run([windows_patched, "--no-such-option"])
    assert failed.returncode == wine.run([windows_official, "--no-such-option"]).returncode != 0


@pytest.mark.parametrize("frequency", ["Periodic", "Timestep"])
def test_schedules_at_the_time_of_a_question(wine, windows_patched, patched, weather, louvres, tmp_path, frequency):
    """Louvres that a schedule opens by the clock, other on design days than on others."""
    path = tmp_path / "louvres.idf"
    text = louvres(3).replace("  Periodic,  ", f"  {frequency},  ")
    for number in (1, 2, 3):
        text = text.replace(f"Louvre {number},,4", f"Louvre {number},Opening,4")
    assert text.count("Opening") == 3 and text.count(f"  {frequency},") == 1
    path.write_text(text + "Schedule:Compact,Opening,,Through: 12/31,For: SummerDesignDay,Until: 11:30,0.1,"
                    "Until: 24:00,0.6,For: AllOtherDays,Until: 10:00,0.2,Until: 14:15,0.7,Until: 24:00,0;\n")
    model = input_file.read(path)
    model.add_unique("RunPeriod", ["Days", 5, 30, 2017, 6, 1],
                     ["name", "begin_month", "begin_day_of_month", "begin_year", "end_month", "end_day_of_month"])
    model.set_field("SimulationControl", input_file.RUN_DESIGN_DAYS, "Yes")
    model.write(path)
    model = place(path, tmp_path / "input", "Timestep")
    ours = run_in_windows(wine, windows_patched, model, weather, tmp_path / "ours", ["--gpu-shading"])
    linux = run_on_linux(patched, model, weather, tmp_path / "linux")
    assert largest_difference(linux, ours, "Zone Timestep") < SAME


def test_a_year_by_sampling_with_a_side_file_and_the_cache(wine, windows_patched, patched, weather, louvres, tmp_path):
    path = tmp_path / "model ö.idf"
    path.write_text(louvres(3))
    (tmp_path / "model ö.gpu-shading.idf").write_text(
        "GPUShading:TransparentShade,Glass,Louvre *,PolynomialInCosine,0,0.9;\n")
    model = place(path, tmp_path / "input")
    options = ["--gpu-shading-update=sampled:coarse"]
    linux = run_on_linux(patched, model, weather, tmp_path / "linux", options)
    runs = []
    for number in range(2):
        runs.append(run_in_windows(wine, windows_patched, model, weather, tmp_path / f"run {number}", [
            "--gpu-shading", *options, f"--gpu-shading-cache={windows.name_path(tmp_path / 'căche')}"]))
        assert largest_difference(linux, runs[-1]) < SAME
    counts = [re.search(r"(\d+) directions rendered, (\d+) from the cache", run.errors).groups() for run in runs]
    assert counts[0] == (counts[1][1], "0") and counts[1][0] == "0"
    assert len(list((tmp_path / "căche").glob("*.sunlit"))) == 1


def test_more_back_surfaces_than_energyplus_has_room_for(wine, windows_patched, patched, weather, box, tmp_path):
    """The beam through a window falls on up to 35 pieces of a floor; the 20 largest get it."""
    floor = "Floor,Floor,Outer Wall,Box,,Adiabatic,,NoSun,NoWind,,4,\n  0,0,0,\n  0,6,0,\n  6,6,0,\n  6,0,0;"
    assert floor in box
    columns, rows = 13, 6
    # No two are as large.
    xs = [6 * i / columns + 0.004 * i * (columns - i) for i in range(columns + 1)]
    ys = [6 * i / rows + 0.02 * i * (rows - i) for i in range(rows + 1)]
    pieces = [
        f"Floor {i} {j},Floor,Outer Wall,Box,,Adiabatic,,NoSun,NoWind,,4,"
        f"{xs[i]},{ys[j]},0,{xs[i]},{ys[j + 1]},0,{xs[i + 1]},{ys[j + 1]},0,{xs[i + 1]},{ys[j]},0;"
        for i in range(columns) for j in range(rows)]
    path = tmp_path / "model.idf"
    path.write_text(box.replace(floor, "\nBuildingSurface:Detailed,".join(pieces)))
    model = input_file.read(path)
    incident = "Surface Inside Face Exterior Windows Incident Beam Solar Radiation Energy"
    model.add_output_variable(incident, "Hourly")
    model.write(path)
    model = place(path, tmp_path / "input")
    ours = run_in_windows(wine, windows_patched, model, weather, tmp_path / "ours", ["-D", "--gpu-shading"])
    linux = run_on_linux(patched, model, weather, tmp_path / "linux", ["-D"])
    assert largest_difference(linux, ours) < SAME
    expected, found = (results.energies(run.folder, incident, "Hourly") for run in (linux, ours))
    most = max(expected.values())
    assert sum(value > 0.01 * most for value in expected.values()) > 20
    for name, value in expected.items():
        assert abs(found[name] - value) < 1e-3 * most, name


def test_an_error_in_an_extension_object_stops_before_the_run(wine, windows_patched, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box + "GPUShading:TransparentShade,Glass,Louvre 1,Constant,,,2;\n")
    done = wine.run_energyplus(windows_patched, model, weather, tmp_path / "out", ["-D", "--gpu-shading"])
    assert done.status == 1 and not (done.folder / "eplusout.eio").exists()
    for text in (done.errors, (done.folder / "eplusout.err").read_text()):
        assert "model.idf: GPUShading:TransparentShade Glass: Value 1 is blank" in text


def test_what_it_lacks_is_one_warning_each(wine, windows_patched, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box.replace("FullInteriorAndExterior", "FullExteriorWithReflections")
                     + "GPUShading:TransparentShade,Glass,Louvre 1,Constant,0.5;\n")
    run = run_in_windows(wine, windows_patched, model, weather, tmp_path / "out", ["-D", "--gpu-shading"])
    for text in (run.errors, run.text("eplusout.err")):
        assert text.count("EnergyPlus does not draw mirrored shading surfaces") == 1


def test_an_error_ends_the_run(wine, dropped_in, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box.replace("PolygonClipping,", "PixelCounting,"))
    ours = wine.run_energyplus(dropped_in, model, weather, tmp_path / "ours", ["-D"], GPU_SHADING_ERROR="two")
    assert ours.status == 1 and not ours.completed
    assert "gpu_shading: error: GPU_SHADING_ERROR is 'two': expected a number, 1e-5 to 0.1" in ours.errors


def compile_host(name, program, *options):
    compiler = shutil.which("x86_64-w64-mingw32-gcc-posix")
    if not compiler:
        pytest.skip("MinGW is missing: run scripts/setup --windows")
    subprocess.run([compiler, "-Wall", "-o", program, HOSTS / name, *options], check=True)
    return program


def test_a_program_that_loads_energyplus_as_python_does(wine, dropped_in, patched, weather, write_model, tmp_path):
    """It lies elsewhere, and loads our library by its path before EnergyPlus's."""
    program = compile_host("windows_host.c", tmp_path / "host.exe", "-municode")
    model = place(write_model("20 louvres"), tmp_path / "counted", method="PixelCounting")
    run = run_in_windows(wine, program, model, weather, tmp_path / "ours",
                         [windows.name_path(dropped_in.parent), "-D"], GPU_SHADING_ERROR="0.00001")
    assert run.method == "PixelCounting"
    linux = run_on_linux(patched, model, weather, tmp_path / "linux", ["-D", "--gpu-shading-error=0.00001"])
    assert_same_building(linux, run)


def test_other_programs_get_the_systems_opengl(wine, tmp_path):
    program = compile_host("opengl_vendor.c", tmp_path / "vendor.exe", "-lopengl32", "-lgdi32")
    with wine.display() as with_display:
        without = with_display.run([program])
        if without.returncode != 0:
            pytest.skip("this Wine has no OpenGL")
        shutil.copy(windows.library(), tmp_path)
        beside = with_display.run([program], WINEDEBUG="+loaddll")
    assert beside.stdout == without.stdout != ""
    assert f"{tmp_path.name}\\\\OPENGL32.dll".lower() in beside.stderr.lower()

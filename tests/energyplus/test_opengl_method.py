"""Sunlit fractions through EnergyPlus's calls of OpenGL (--gpu-shading-method opengl), against the patched ones."""

import os
import shutil
import subprocess

import example_models
import pytest
import screened_room
from shading_runs import energyplus, input_file, results

SCRIPT = energyplus.REPOSITORY / "scripts" / "patch_energyplus"
SAME = 1e-4  # single precision, and counts of 512 x 512 pixels
PASSED = "sunlit fractions are passed to EnergyPlus through its calls of OpenGL"
FLAG = "--gpu-shading-method=opengl"


def compared(patched, model, weather, folder, options=("-D",), frequency="Hourly", program=None):
    """The run through OpenGL, and the largest difference of its sunlit fractions from the patched run's."""
    own = input_file.read(model)
    results.instrument(own, frequency)
    model = input_file.place_copy(own, model, folder / "input")
    reference = energyplus.run(patched, model, weather, folder / "patched", [*options, "--gpu-shading"])
    run = energyplus.run(program or patched, model, weather, folder / "opengl",
                         [*options, "--gpu-shading", *([] if program else [FLAG])])
    assert reference.completed, reference.why()
    assert run.completed, run.why()
    assert run.method == "PixelCounting"
    assert "** Severe" not in run.text("eplusout.err")
    for text in (run.errors, run.text("eplusout.err")):
        assert PASSED in text
    step = ["Zone Timestep"] if frequency == "Timestep" else []
    found = results.differences(results.Results(reference.folder, *step), results.Results(run.folder, *step))
    # Shadows move over at least some receivers.
    assert any(0.05 < value < 0.95 for each in found for value in each.reference)
    return run, max(found, key=lambda each: each.largest)


@pytest.mark.parametrize("name", ["courtyard", "canopy", "screened room", "SolarShadingTest.idf",
                                  "RefBldgSmallOfficeNew2004_Chicago.idf"])
def test_as_patched(name, patched, courtyard, weather, tmp_path):
    model = tmp_path / f"{name.removesuffix('.idf')}.idf"
    options = ["-D"]
    if name == "courtyard":
        model.write_text(courtyard.read_text())
    elif name == "canopy":
        model.write_text(example_models.canopy())
    elif name == "screened room":
        model.write_text(screened_room.model(screen="small holes"))
    else:
        other = energyplus.models_folder() / name
        if not other.is_file():
            pytest.skip(f"{other} is missing: name the collection with GPU_SHADING_MODELS")
        model.write_text(other.read_text(encoding="utf-8", errors="replace"))
    run, worst = compared(patched, model, weather, tmp_path, options)
    assert worst.largest < SAME, worst.receiver.name
    assert "rendered by" in run.errors


# Louvres that open by the clock, while daylight saving is in force, and differ by the kind of day.
OPENING = """
RunPeriodControl:DaylightSavingTime,4/1,10/1;
Schedule:Compact,Opening,,Through: 6/2,For: Saturday,Until: 24:00,0.9,
  For: SummerDesignDay,Until: 11:30,0.1,Until: 24:00,0.6,
  For: AllOtherDays,Until: 10:00,0.2,Until: 14:15,0.7,Until: 24:00,0,
  Through: 12/31,For: AllDays,Until: 12:00,0.3,Until: 24:00,0.8;
"""


def scheduled_louvres(louvres, days, steps):
    model = louvres(3).replace("Timestep,4;", f"Timestep,{steps};").replace("  20;  ", f"  {days};  ")
    text = "\n".join(line.replace(",,4", ",Opening,4") if line.startswith("Shading:") or "Louvre" in line else line
                     for line in model.split("\n"))
    assert text.count("Opening") == 3
    return text + OPENING


@pytest.mark.parametrize("frequency, days, steps", [("Periodic", 20, 6), ("Timestep", 20, 4), ("Periodic", 2, 1)])
def test_schedules_at_the_time_of_a_question(frequency, days, steps, louvres, patched, weather, tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(scheduled_louvres(louvres, days, steps).replace("Periodic,  ", f"{frequency},  "))
    model = input_file.read(path)
    model.add_unique("RunPeriod", ["Days", 5, 30, 2017, 6, 4],
                     ["name", "begin_month", "begin_day_of_month", "begin_year", "end_month", "end_day_of_month"])
    model.set_field("SimulationControl", (3, "run_simulation_for_sizing_periods"), "Yes")
    model.write(path)
    _, worst = compared(patched, path, weather, tmp_path, (), "Timestep")
    assert worst.largest < SAME, worst.receiver.name


@pytest.fixture(scope="session")
def stripped(tmp_path_factory):
    """The program that patch_energyplus makes of an EnergyPlus whose library has no symbols but those it exports."""
    strip = shutil.which("strip")
    if not strip:
        pytest.skip("strip is missing: run scripts/setup")
    folder = tmp_path_factory.mktemp("stripped")
    prefix = folder / "official"
    prefix.mkdir()
    for entry in energyplus.official_prefix().resolve().iterdir():
        if entry.name.startswith("libenergyplusapi"):
            continue
        os.symlink(entry, prefix / entry.name)
    library = next(energyplus.official_prefix().glob("libenergyplusapi.so.*"))
    subprocess.run([strip, "--strip-all", "-o", prefix / library.name, library], check=True)
    os.symlink(library.name, prefix / "libenergyplusapi.so")
    done = subprocess.run([SCRIPT, prefix, folder / "EnergyPlus", "--build", energyplus.patched_prefix().parent],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "cannot be patched: sunlit fractions will be passed through its calls of OpenGL" in done.stdout
    return folder / "EnergyPlus" / "energyplus"


def test_chosen_by_itself_where_the_library_has_no_symbols(stripped, patched, courtyard, weather, tmp_path):
    run, worst = compared(patched, courtyard, weather, tmp_path, program=stripped)
    assert worst.largest < SAME, worst.receiver.name
    assert "this EnergyPlus cannot be patched: " in run.errors
    assert "has no symbol table (stripped)" in run.errors
    assert "schedules" not in run.errors


def test_the_program_uses_it(stripped, patched, courtyard):
    tables = []
    for folder in (patched.parent, stripped.parent):
        done = subprocess.run([folder / "gpu_shading", "check", courtyard], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        tables.append([line for line in done.stdout.splitlines() if " reveal " not in line])
    assert len(tables[0]) > 20 and tables[0] == tables[1]


def test_what_it_lacks_is_one_warning_each(patched, box, weather, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box.replace("FullInteriorAndExterior", "FullExteriorWithReflections")
                     + "GPUShading:TransparentShade,Glass,Louvre 1,Constant,0.5;\n")
    run = energyplus.run(patched, model, weather, tmp_path / "out",
                         ["-D", FLAG, "--gpu-shading-reflections=energyplus"])
    assert run.completed, run.why()
    for text in (run.errors, run.text("eplusout.err")):
        assert text.count("EnergyPlus does not draw mirrored shading surfaces") == 1


def test_an_error_while_it_draws_ends_the_run(box, patched, weather, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box.replace("Louvre 1,,4", "Louvre 1,Nowhere,4"))
    run = energyplus.run(patched, model, weather, tmp_path / "out", ["-D", "--gpu-shading", FLAG])
    assert run.status == 1 and not run.completed
    assert run.errors.count("gpu_shading: error: ") == 1
    assert 'no schedule "NOWHERE"' in run.text("eplusout.err")
    assert "Terminated" in run.text("eplusout.end")

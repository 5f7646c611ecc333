"""EnergyPlus 24.2.0, built from its sources: as they are, and with routes/penumbra/drop_in in place of Penumbra.

GPU_SHADING_STOCK_24_2 and GPU_SHADING_SOURCE_24_2 name the folders of the two builds' programs.
"""

import os
import subprocess
from pathlib import Path

import example_models
import pytest
import screened_room
from output_files import differing, snapshot
from shading_runs import energyplus, input_file, results
from shading_runs.version import input_version

SCRIPT = energyplus.REPOSITORY / "scripts" / "patch_energyplus"
TESTED, OTHER = input_version(), "24.2"

# As test_models.py has them.
MEAN = 3e-4
PERCENTILE_99 = 3e-3
SAME = 1e-4  # the same scene and nearly the same sun

MODELS = ["courtyard", "canopy", "screened room", "SolarShadingTest"]
OPAQUE = ["courtyard", "SolarShadingTest"]  # which polygon clipping can compute


def program_named_by(variable):
    folder = os.environ.get(variable)
    if not folder:
        pytest.skip(f"{variable} does not name a folder with EnergyPlus {OTHER}")
    return Path(folder) / "energyplus"


@pytest.fixture(scope="module")
def stock():
    return program_named_by("GPU_SHADING_STOCK_24_2")


@pytest.fixture(scope="module")
def source():
    return program_named_by("GPU_SHADING_SOURCE_24_2")


@pytest.fixture(scope="module")
def patched_other(stock, tmp_path_factory):
    """The stock program as patch_energyplus patches it, after its self-check."""
    folder = tmp_path_factory.mktemp("patched") / "EnergyPlus"
    done = subprocess.run([SCRIPT, stock.parent, folder, "--build", energyplus.patched_prefix().parent],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder / "energyplus"


def model_text(name, courtyard):
    if name == "courtyard":
        return courtyard.read_text()
    if name == "canopy":
        return example_models.canopy()
    if name == "screened room":
        return screened_room.model(screen="small holes")
    model = energyplus.models_folder() / f"{name}.idf"
    if not model.is_file():
        pytest.skip(f"{model} is missing: name the collection with GPU_SHADING_MODELS")
    return model.read_text(encoding="utf-8", errors="replace")


def place(text, version, folder):
    """The model for a release, with the outputs that are compared."""
    assert TESTED in text
    folder.mkdir(parents=True)
    path = folder / "model.idf"
    path.write_text(text)
    model = input_file.read(path)
    model.set_field("Version", (0, "version_identifier"), version)
    results.instrument(model)
    model.write(path)
    return path


@pytest.fixture(scope="module")
def references():
    return {}


def reference(name, references, patched, courtyard, weather, folder):
    """Results of the tested release."""
    if name not in references:
        model = place(model_text(name, courtyard), TESTED, folder / "reference")
        run = energyplus.run(patched, model, weather, folder / "reference" / "out", ["-D", "--gpu-shading"])
        assert run.completed, run.why()
        references[name] = results.Results(run.folder)
    return references[name]


def compare(expected, run):
    assert run.completed, run.why()
    assert run.method == "PixelCounting"
    found = results.differences(expected, results.Results(run.folder))
    # Shadows move over at least some receivers.
    assert any(0.05 < value < 0.95 for each in found for value in each.reference)
    worst = max(found, key=lambda each: each.largest)
    print(f"{len(found)} receivers, largest difference {worst.largest:.1e} ({worst.receiver.name})")
    assert worst.largest < SAME, worst.receiver.name


@pytest.mark.parametrize("name", MODELS)
def test_built_from_sources(name, source, references, patched, courtyard, weather, tmp_path):
    model = place(model_text(name, courtyard), OTHER, tmp_path / "model")
    run = energyplus.run(source, model, weather, tmp_path / "out", ["-D", "--gpu-shading"])
    compare(reference(name, references, patched, courtyard, weather, tmp_path), run)


@pytest.mark.parametrize("method", ["patched", "opengl"])
@pytest.mark.parametrize("name", MODELS)
def test_patched_in_memory(name, method, patched_other, references, patched, courtyard, weather, tmp_path):
    model = place(model_text(name, courtyard), OTHER, tmp_path / "model")
    run = energyplus.run(patched_other, model, weather, tmp_path / "out",
                         ["-D", "--gpu-shading", f"--gpu-shading-method={method}"])
    compare(reference(name, references, patched, courtyard, weather, tmp_path), run)


@pytest.mark.parametrize("name", OPAQUE)
def test_source_agrees_with_polygon_clipping_of_its_release(name, source, stock, courtyard, weather, tmp_path):
    model = place(model_text(name, courtyard), OTHER, tmp_path / "model")
    rendered = energyplus.run(source, model, weather, tmp_path / "rendered", ["-D", "--gpu-shading"])
    clipped = energyplus.run(stock, model, weather, tmp_path / "clipped", ["-D"])
    assert rendered.completed and clipped.completed
    found = results.differences(results.Results(clipped.folder), results.Results(rendered.folder))
    assert found
    for each in found:
        worst = results.percentile([abs(value) for value in each.values], 0.99)
        print(f"{each.receiver.name}: mean {each.mean:.1e}, 99th percentile {worst:.1e}")
        assert each.mean < MEAN and worst < PERCENTILE_99, each.receiver.name


@pytest.mark.parametrize("name", OPAQUE)
def test_without_the_flag_it_is_the_stock_build(name, source, stock, courtyard, weather, tmp_path):
    model = place(model_text(name, courtyard), OTHER, tmp_path / "model")
    snapshots = []
    for program in (stock, source):
        # A file names the folder.
        run = energyplus.run(program, model, weather, tmp_path / "out", ["-D"])
        assert run.completed, run.why()
        assert run.method == "PolygonClipping"
        snapshots.append(snapshot(run.folder))
        run.folder.rename(tmp_path / str(len(snapshots)))
    assert len(snapshots[0]) > 10
    assert differing(*snapshots) == []

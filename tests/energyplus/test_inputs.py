"""Every form of input that the official program takes: epJSON, relative paths, preprocessing, other folders."""

import subprocess

import pytest
from shading_runs import energyplus, input_file, results


def sunlit(run):
    assert run.completed, run.why()
    assert run.method == "PixelCounting"
    return results.Results(run.folder).values[results.SUNLIT]


@pytest.fixture
def model(courtyard, tmp_path):
    model = input_file.read(courtyard)
    results.instrument(model)
    return input_file.place_copy(model, courtyard, tmp_path / "input")


@pytest.fixture
def shade(patched, weather, tmp_path):
    def call(model, *options, folder="out"):
        return energyplus.run(patched, model, weather, tmp_path / folder, ["--gpu-shading", "-D", *options])

    return call


def test_epjson_gives_the_same_as_idf(shade, official, model, tmp_path):
    subprocess.run([official, "--convert-only", "-d", tmp_path, model], cwd=tmp_path, check=True, capture_output=True)
    converted = next(tmp_path.glob("*.epJSON"))
    from_idf, from_epjson = sunlit(shade(model, folder="idf")), sunlit(shade(converted, folder="epjson"))
    assert from_idf.keys() == from_epjson.keys()
    for name, values in from_idf.items():
        # Written with fewer digits, the vertices differ by less than a pixel.
        assert values == pytest.approx(from_epjson[name], abs=1e-3), name


def test_relative_schedule_file_is_found_beside_the_input(shade, official, weather, model, tmp_path):
    (model.parent / "schedules").mkdir()
    (model.parent / "schedules" / "gains.csv").write_text("value\n" + "1\n" * 8760)
    text = model.read_text() + (
        "ScheduleTypeLimits,Any;\n"
        "Schedule:File,Gains,Any,schedules/gains.csv,1,1,8760,Comma;\n"
        "OtherEquipment,Gain,None,West,Gains,EquipmentLevel,10;\n"
    )
    model.write_text(text)
    stock = energyplus.run(official, model, weather, tmp_path / "stock", ["-D"])
    assert stock.completed, stock.why()
    sunlit(shade(model))


def test_preprocessed_input_is_shaded_too(shade, model):
    plain = sunlit(shade(model, folder="plain"))
    model.write_text(model.read_text() + "HVACTemplate:Thermostat,Unused,,20,,26;\n")
    assert sunlit(shade(model, "-x", folder="expanded")) == plain


def test_macro_input_is_shaded_too(shade, model, tmp_path):
    plain = sunlit(shade(model, folder="plain"))
    macro = tmp_path / "model.imf"
    macro.write_text("##set1 unused[] 1\n" + model.read_text())
    assert sunlit(shade(macro, "-m", folder="macro")) == plain


def test_output_names_do_not_matter(shade, model, tmp_path):
    run = shade(model, "-p", "model", "-s", "C")
    assert run.status == 0, run.why()
    assert "PixelCounting" in next((tmp_path / "out").glob("model*.eio")).read_text()


@pytest.mark.parametrize("end", ["", " ! comment", " ! comment\n", "\n"])
def test_last_object_without_its_semicolon(end, official, shade, model, weather, tmp_path):
    """EnergyPlus takes the end of the file for it, but a line break for part of the field."""
    text = model.read_text().rstrip()
    assert text.endswith(";")
    model.write_text(text[:-1] + end)
    stock = energyplus.run(official, model, weather, tmp_path / "stock", ["-D"])
    ours = shade(model)
    assert stock.completed == (end != "\n"), stock.why()
    assert ours.completed == stock.completed, ours.why()

"""Other people's models: the sunlit fractions of a run with the flag against polygon clipping."""

import csv
from pathlib import Path

import pytest
from shading_runs import energyplus, input_file, results

MODELS = energyplus.models_folder()

# Bounds at the default error of 1e-3, which one in a hundred answers may exceed. Polygon clipping is exact to
# about 1e-4 here.
MEAN = 3e-4
PERCENTILE_99 = 3e-3
# Beam through one window, against the same window and against the model's largest.
BEAM = 3e-3
BEAM_OF_LARGEST = 5e-4

# (model, receiver): why our answer and that of polygon clipping differ there by more than the bound.
NAMED_DIFFERENCES = {}

# Models whose year takes minutes run these days only: begin month, day, end month, day.
SHORT_RUN_PERIODS = {"10x_incr_100zones1win10overhangsFullExIn.idf": (4, 20, 4, 20)}
RUN_PERIOD_FIELDS = ((1, "begin_month"), (2, "begin_day_of_month"), (4, "end_month"), (5, "end_day_of_month"))


# Models compared in Timestep frequency as well.
EVERY_TIMESTEP = ("4ZoneWithShading_Simple_2.idf", "SurfaceTest.idf", "RefBldgSmallOfficeNew2004_Chicago.idf")
FREQUENCY_METHOD = (1, "shading_calculation_update_frequency_method")


def index(only=None):
    """The rows of INDEX.tsv, or one that is skipped with the reason."""
    table = MODELS / "INDEX.tsv"
    if not table.is_file():
        reason = f"{table} is missing: GPU_SHADING_MODELS names the folder of models"
        return [pytest.param(None, marks=pytest.mark.skip(reason=reason), id="models")]
    with open(table, newline="", encoding="utf-8") as file:
        rows = [(row + [""] * 4)[:4] for row in csv.reader(file, delimiter="\t") if row]
    # The same models again as epJSON, where they are.
    rows += [[f"{Path(row[0]).stem}.epJSON", *row[1:]] for row in rows]
    return [pytest.param(row, id=row[0]) for row in rows
            if (MODELS / row[0]).is_file() and (only is None or row[0] in only)]


def prepare(model, name):
    results.instrument(model)
    for (place, value) in zip(RUN_PERIOD_FIELDS, SHORT_RUN_PERIODS.get(name, ()), strict=False):
        model.set_field("RunPeriod", place, str(value))


def offenders(found, model_name):
    """The receivers beyond the bound, worst first, as text."""
    lines = []
    for each in sorted(found, key=lambda each: -each.mean):
        worst = results.percentile([abs(value) for value in each.values], 0.99)
        if each.mean >= MEAN or worst >= PERCENTILE_99:
            lines.append(f"{model_name}: {each.receiver.name} ({each.receiver.kind}, {each.receiver.area:.1f} m2): "
                         f"mean {each.mean:.1e}, 99th percentile {worst:.1e}, max {each.largest:.1e}")
    return "\n".join(lines)


def run_both(row, official, patched, folder, every_timestep=False):
    """A model under both methods: the runs of polygon clipping and of ours."""
    name, weather_name, period, flags = row
    weather = energyplus.find_weather(weather_name)
    options = flags.split() + (["-D"] if period == "dd" else [])
    model = input_file.read(MODELS / name)
    prepare(model, name)
    stock_model = model.copy()
    stock_model.set_field("ShadowCalculation", input_file.SHADOW_METHOD, "PolygonClipping")
    ours_options = ["--gpu-shading", *options]
    if every_timestep:
        stock_model.set_field("ShadowCalculation", FREQUENCY_METHOD, "Timestep")
        ours_options.append("--gpu-shading-update=timestep")

    stock = energyplus.run(official, input_file.place_copy(stock_model, MODELS / name, folder / "stock_input"),
                           weather, folder / "stock", options)
    ours = energyplus.run(patched, input_file.place_copy(model, MODELS / name, folder / "input"), weather,
                          folder / "ours", ours_options)
    assert stock.completed, stock.why()
    assert ours.completed, ours.why()
    assert ours.method == "PixelCounting"
    assert ours.device, "the run did not say which device rendered"
    assert [message for message in ours.severe if message not in stock.severe] == []
    return stock, ours


def assert_agree(name, stock, ours):
    reference, answer = results.Results(stock.folder), results.Results(ours.folder)
    found = [each for each in results.differences(reference, answer)
             if (name, each.receiver.name) not in NAMED_DIFFERENCES]
    mean, percentile_99, largest = results.summary(found)
    print(f"\n{name}: mean {mean:.1e}, 99th percentile {percentile_99:.1e}, max {largest:.1e}, "
          f"{len(found)} receivers, seconds {stock.seconds:.1f} and {ours.seconds:.1f}")
    print(offenders(found, name))
    assert mean < MEAN, offenders(found, name)
    assert percentile_99 < PERCENTILE_99, offenders(found, name)

    windows = {window: reference.total(results.BEAM, window) for window in reference.values[results.BEAM]}
    bound = BEAM_OF_LARGEST * max(windows.values(), default=0.0)
    differing = {window: (beam, answer.total(results.BEAM, window)) for window, beam in windows.items()
                 if (name, window) not in NAMED_DIFFERENCES
                 and abs(answer.total(results.BEAM, window) - beam) > max(BEAM * beam, bound)}
    assert differing == {}, "transmitted beam in kWh, polygon clipping and ours"


@pytest.mark.parametrize("row", index())
def test_agrees_with_polygon_clipping(row, official, patched, tmp_path):
    assert_agree(row[0], *run_both(row, official, patched, tmp_path))


@pytest.mark.parametrize("row", index(only=EVERY_TIMESTEP))
def test_agrees_at_every_timestep(row, official, patched, tmp_path):
    stock, ours = run_both(row, official, patched, tmp_path, every_timestep=True)
    assert ",Timestep," in ours.text("eplusout.eio")
    assert_agree(row[0], stock, ours)


@pytest.mark.parametrize("options", [["-D"], []], ids=["design day", "year"])
def test_our_courtyard_agrees_with_polygon_clipping(options, official, patched, weather, courtyard, tmp_path):
    model = input_file.read(courtyard)
    results.instrument(model)
    placed = input_file.place_copy(model, courtyard, tmp_path / "input")
    stock = energyplus.run(official, placed, weather, tmp_path / "stock", options)
    ours = energyplus.run(patched, placed, weather, tmp_path / "ours", ["--gpu-shading", *options])
    assert stock.completed and ours.completed, (stock.why(), ours.why())
    assert ours.severe == []
    found = results.differences(results.Results(stock.folder), results.Results(ours.folder))
    mean, percentile_99, _ = results.summary(found)
    assert mean < MEAN and percentile_99 < PERCENTILE_99, offenders(found, courtyard.name)

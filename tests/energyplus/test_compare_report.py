"""The report of compare_shading: its numbers against what the runs have reported, and the page in a browser."""

import csv
import hashlib
import html
import re
import sqlite3
import subprocess

import daylit_rooms
import numpy as np
import pytest
from eso_file import EsoFile
from html_page import DARK, Tables, look_at, not_in_tables, number, screenshot
from PIL import Image
from reflecting_scenes import BY_SHADES, INCIDENT
from shading_runs import energyplus, input_file, methods
from shading_runs.energyplus import Run
from shading_runs.version import input_version

SUNLIT = "Surface Outside Face Sunlit Fraction"
COSINE = "Surface Outside Face Beam Solar Incident Angle Cosine Value"
QUANTITIES = {
    "Transmitted solar radiation": "Surface Window Transmitted Solar Radiation Energy",
    "beam alone": "Surface Window Transmitted Beam Solar Radiation Energy",
    "Heating": "Zone Air System Sensible Heating Energy",
    "Cooling": "Zone Air System Sensible Cooling Energy",
}
LIGHT = ("Sky's light on windows", "Reflected light on windows", "of that without the ground")
WEST_ZONES = 3  # of which the model has one
RECEIVERS = 3

# Half a unit of the last digit that the page prints.
ENERGY = 0.005 + 1e-9
PERCENT = 0.0005 + 1e-9
FRACTION = 0.00005 + 1e-9

# Nothing wider than the window, every chart with marks, every picture there; then a sorted column.
LOOK = """() => {
  const folded = [...document.querySelectorAll("details:not([open])")].length;
  document.querySelectorAll("details").forEach((each) => (each.open = true));
  const charts = [...document.querySelectorAll("svg.chart")];
  const marks = (chart) => [...chart.querySelectorAll("path, image, use")].filter((mark) => {
    const box = mark.getBoundingClientRect();
    return box.width > 0 && box.height > 0;
  }).length;
  const outside = [...document.querySelectorAll("main *, header *")].filter((element) =>
    element.getBoundingClientRect().right > innerWidth + 1 && !element.closest(".scroll") && !element.closest("svg"));
  const table = document.querySelector("table.sortable");
  const heading = [...table.tHead.rows[0].cells].findIndex((cell) => cell.textContent.startsWith("max |d|"));
  table.tHead.rows[0].cells[heading].querySelector("button").click();
  return {
    folded,
    width: innerWidth,
    wide: document.documentElement.scrollWidth,
    outside: outside.map((element) => element.outerHTML.slice(0, 200)),
    scrolled: [...document.querySelectorAll(".months table, caption")].filter((element) =>
      element.getBoundingClientRect().right > innerWidth).map((element) => element.textContent.slice(0, 60)),
    charts: charts.map((chart) => [chart.getAttribute("aria-label"), marks(chart), chart.clientWidth]),
    images: [...document.images].map((image) => [image.alt, image.naturalWidth]),
    sorted: [...table.tBodies[0].rows].map((row) => Number(row.cells[heading].dataset.value)),
    smallest: Math.min(...charts.map((chart) => chart.getBoundingClientRect().height)),
    faults: faults(),
    texts: texts(),
  };
}"""


def compare(model, folder, weather, *options):
    return subprocess.run(
        [energyplus.REPOSITORY / "scripts" / "compare_shading", model, "-w", weather, "-o", folder, *options],
        capture_output=True, text=True)


@pytest.fixture(scope="module")
def model(courtyard, tmp_path_factory):
    """The courtyard from 29 September to 1 October, its west zone three times, and beside it, shades of glass."""
    folder = tmp_path_factory.mktemp("model")
    text = courtyard.read_text().replace("Zone,West;", f"Zone,West,0,0,0,0,1,{WEST_ZONES};")
    text = text.replace("Heating Setpoint,Temperature,20;", "Heating Setpoint,Temperature,25;")  # warm at night too
    own = input_file.Idf(text)
    for place, value in ((1, "9"), (2, "29"), (4, "10"), (5, "1")):
        own.set_field("RunPeriod", (place,), value)
    for part in ("", "Beam ", "Sky Diffuse "):
        own.add_output_variable(INCIDENT.format(part), "Hourly")
    own.add_output_variable(BY_SHADES, "Hourly")
    own.write(folder / "yard.idf")
    (folder / "glass.idf").write_text("GPUShading:TransparentShade, Glass, *, Constant, 0.4;\n")
    return folder / "yard.idf"


@pytest.fixture(scope="module")
def variants(patched, model, weather, tmp_path_factory):
    """Rendered as it is, and with glass."""
    folder = tmp_path_factory.mktemp("variants")
    done = compare(model, folder, weather, "--runs", "gpu --gpu-shading-resolution=256",
                   model.with_name("glass.idf"), "--receivers", str(RECEIVERS))
    assert done.returncode == 0, done.stderr
    assert f"report: {folder / 'report.html'}" in done.stdout
    return folder


@pytest.fixture(scope="module")
def page(variants):
    return Tables((variants / "report.html").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def reported(variants):
    return [EsoFile(variants / key / "eplusout.eso") for key in ("a", "b")]


def hourly_sum(eso, variable):
    """{time: kWh of the building}."""
    total = {}
    for key in eso.keys(variable):
        factor = WEST_ZONES if key.startswith("WEST") else 1
        for when, value in eso.values[variable, key].items():
            total[when] = total.get(when, 0.0) + factor * value / 3.6e6
    return total


def test_energies_are_those_reported(page, reported):
    rows = {row[1]: list(map(number, row[2:])) for row in page.tables["table-energy"][1:]}
    assert list(rows) == [*QUANTITIES, *LIGHT]
    for quantity, variable in QUANTITIES.items():
        before, after = (sum(hourly_sum(eso, variable).values()) for eso in reported)
        assert rows[quantity][:2] == pytest.approx([before, after], abs=ENERGY)
        assert rows[quantity][2] == pytest.approx(after - before, abs=ENERGY)
        if before:
            assert rows[quantity][3] == pytest.approx(100 * (after / before - 1), abs=PERCENT)
    assert abs(rows["Transmitted solar radiation"][2]) > 1.0  # of the beam more, of the ground's light less


def test_light_on_windows_is_that_reported(page, variants, reported):
    rows = {row[1]: list(map(number, row[2:4])) for row in page.tables["table-energy"][1:]
            if row[1] in LIGHT[:2]}
    for run, eso in enumerate(reported):
        with sqlite3.connect(variants / "ab"[run] / "eplusout.sql") as data:
            areas = dict(data.execute("SELECT SurfaceName, Area FROM Surfaces"))
        weights = {key: areas[key] * (WEST_ZONES if key.startswith("WEST") else 1) / 1000
                   for key in eso.keys(QUANTITIES["beam alone"])}
        total, beam, sky = (sum(weight * sum(eso.values[INCIDENT.format(part), key].values())
                                for key, weight in weights.items()) for part in ("", "Beam ", "Sky Diffuse "))
        assert rows["Sky's light on windows"][run] == pytest.approx(sky, abs=ENERGY)
        assert rows["Reflected light on windows"][run] == pytest.approx(total - beam - sky, abs=ENERGY)
    # Without objects of ours the light is EnergyPlus's own, which is not told apart.
    by_shades = sum(weight * sum(reported[1].values[BY_SHADES, key].values()) for key, weight in weights.items())
    before, after = next(row[2:4] for row in page.tables["table-energy"][1:] if row[1] == "of that without the ground")
    assert not before.strip("–") and number(after) == pytest.approx(by_shades, abs=ENERGY)
    assert by_shades > 0.5
    # Glass lets more of the sky's light pass.
    assert rows["Sky's light on windows"][1] > rows["Sky's light on windows"][0] > 1


def test_months_are_those_reported(page, reported):
    for number_of, (quantity, variable) in enumerate(QUANTITIES.items(), start=1):
        rows = {row[0]: list(map(number, row[1:])) for row in page.tables[f"table-months-{number_of}"][1:]}
        assert list(rows) == ["Sep", "Oct"]
        for month, name in ((9, "Sep"), (10, "Oct")):
            before, after = (sum(value for when, value in hourly_sum(eso, variable).items() if when[0] == month)
                             for eso in reported)
            assert rows[name] == pytest.approx([before, after, after - before], abs=ENERGY), quantity


def test_hours_are_those_reported(page, reported):
    tables = page.tables
    for number_of, (quantity, variable) in enumerate(QUANTITIES.items(), start=1):
        rows = {row[0]: list(map(number, row[1:])) for row in tables[f"table-hours-{number_of}"][1:]}
        assert len(rows) == 24
        for hour, (name, found) in enumerate(rows.items(), start=1):
            assert name == f"{hour - 1:02d}–{hour:02d} h"
            before, after = (sum(value for when, value in hourly_sum(eso, variable).items() if when[2] == hour)
                             for eso in reported)
            assert found == pytest.approx([before, after, after - before], abs=ENERGY), (quantity, name)
    # The same light as of whole periods.
    whole = {row[1]: row[2:4] for row in tables["table-energy"][1:]}
    for number_of, quantity in enumerate(LIGHT, start=len(QUANTITIES) + 1):
        rows = [row[1:3] for row in tables[f"table-hours-{number_of}"][1:]]
        for run in (0, 1):
            values = [row[run] for row in rows]
            if not whole[quantity][run].strip("–"):
                assert not "".join(values).strip("–")
                continue
            assert sum(map(number, values)) == pytest.approx(number(whole[quantity][run]), abs=24 * ENERGY)


def test_peaks_are_the_largest_hours_reported(page, reported):
    rows = {(row[0], row[1]): row[2:] for row in page.tables["table-peaks"][1:]}
    months = {9: "Sep", 10: "Oct"}
    assert ("Building", "Heating") in rows
    for load in ("Heating", "Cooling"):
        for zone in ("Building", "WEST", "EAST"):
            series = [hourly_sum(eso, QUANTITIES[load]) if zone == "Building"
                      else {when: value / 3.6e6 for when, value in eso.values[QUANTITIES[load], zone].items()}
                      for eso in reported]
            if not any(any(values.values()) for values in series):
                assert (zone, load) not in rows
                continue
            largest = [max(values.items(), key=lambda item: item[1]) for values in series]
            cells = rows[zone, load]
            assert list(map(number, cells[:2])) == pytest.approx([value for _, value in largest], abs=ENERGY)
            for ((month, day, hour), value), text in zip(largest, cells[4:], strict=True):
                assert text == (f"{day} {months[month]}, {hour - 1:02d}–{hour:02d} h" if value else "")


def test_differences_are_those_reported(page, reported, variants):
    before, after = reported
    header, *rows = page.tables["table-receivers"]
    assert header[4:8] == ["A, mean sunlit", "B, mean sunlit", "mean |d|", "max |d|"]
    everything = []
    for row in rows:
        name = row[0]
        facing = [when for when, cosine in before.values[COSINE, name].items() if cosine > 1e-3]
        first, second = (np.array([eso.values[SUNLIT, name][when] for when in facing]) for eso in reported)
        assert int(row[3]) == len(facing)
        if not facing:
            assert row[4:8] == ["–"] * 4
            continue
        # Of a run's hours in a day, those with a cosine above 1 - cos 15 degrees between two more that are faced.
        times = list(before.values[COSINE, name])
        high = {when for when, cosine in before.values[COSINE, name].items() if cosine >= 1 - np.cos(np.pi / 12)}
        whole = [when for earlier, when, later in zip(times, times[1:], times[2:], strict=False)
                 if when in high and {earlier, when, later} <= set(facing)]
        means = [np.mean([eso.values[SUNLIT, name][when] for when in whole]) if whole else None for eso in reported]
        assert [number(cell) if cell != "–" else None for cell in row[4:6]] == pytest.approx(means, abs=FRACTION)
        change = np.abs(second - first)
        assert list(map(number, row[6:8])) == pytest.approx([change.mean(), change.max()], rel=0.06, abs=1e-9)
        everything += list(change)
    tiles = (variants / "report.html").read_text(encoding="utf-8")
    assert f"<dt>mean |d|</dt><dd>{np.mean(everything):.2g}</dd>" in tiles
    assert f"<dt>largest |d|</dt><dd>{max(everything):.2g}</dd>" in tiles
    with open(variants / "hourly.csv", newline="", encoding="utf-8") as file:
        assert sum(1 for _ in csv.reader(file)) - 1 == len(everything)


def test_the_page_says_what_ran(page, variants, model, weather):
    rows = {row[0]: row[1:] for row in page.tables["table-origin"][1:]}
    for title, path in (("Model", model), ("Weather", weather)):
        assert rows[title] == [f"{path.name}, SHA-256 {hashlib.sha256(path.read_bytes()).hexdigest()}"] * 2
    glass = model.with_name("glass.idf")
    assert rows["Extension file"] == ["none", f"glass.idf, SHA-256 {hashlib.sha256(glass.read_bytes()).hexdigest()}"]
    assert rows["Fineness"][0] == "256 x 256 pixels" and rows["Fineness"][1] not in ("", "–")
    assert "--gpu-shading-resolution=256" in rows["Options"][0]
    assert all(cell.startswith(f"EnergyPlus, Version {input_version()}") for cell in rows["Program"])
    for key, device in zip(("a", "b"), rows["Rendered by"], strict=True):
        assert device in (variants / key / "eplusout.err").read_text()
    stages = page.tables["table-stages"]
    named = {row[1] for row in stages}
    # Views are answered exactly, counted on the CPU, or drawn on a GPU.
    assert "rendering: cull" in named
    assert named & {"rendering: other rendering", "rendering: count", "rendering: submit"}
    assert all(number(row[2]) >= 0 for row in stages[1:])
    # What the module's own table says of the second run, which has no pictures to be timed.
    with open(variants / "b" / "stages.csv", newline="", encoding="utf-8") as file:
        cull = next(float(row["seconds"]) for row in csv.DictReader(file) if row["stage"] == "cull")
    shown = [number(row[2]) for row in stages if row[1] == "rendering: cull"]
    assert any(value == pytest.approx(cull, abs=0.01) for value in shown)


def test_the_building_is_drawn_with_its_receivers_numbered(variants):
    text = (variants / "report.html").read_text(encoding="utf-8")
    figure = re.search(r'<figure id="building">.*?</figure>', text, re.DOTALL)[0]
    names = [html.unescape(re.sub("<.*?>", "", name)) for name in re.findall(r"<li>(.*?)</li>", figure)]
    # All but those that the sun never faces.
    rows = Tables(text).tables["table-receivers"][1:]
    assert set(names) == {row[0] for row in rows if row[3] != "0"} and len(names) == len(set(names)) < len(rows)
    seen = set()
    for drawing in re.findall(r'<svg class="building".*?</svg>', figure, re.DOTALL):
        numbers = [int(number) for number in re.findall(r"<text[^>]*>(\d+)</text>", drawing)]
        assert len(numbers) == len(set(numbers))
        seen |= set(numbers)
    # From two corners, all but a few that something hides.
    assert seen <= set(range(1, len(names) + 1)) and len(seen) >= 0.7 * len(names)


def test_the_page_needs_nothing_else(page):
    assert page.references
    assert [reference for reference in page.references if not reference.startswith(("#", "data:"))] == []


@pytest.mark.parametrize("width, options", [(480, DARK), (1280, ())], ids=["phone dark", "desktop"])
def test_the_page_in_a_browser(variants, tmp_path, width, options):
    seen = look_at(variants / "report.html", width, LOOK, tmp_path, *options)
    assert seen["troubles"] == []
    assert seen["faults"] == []
    assert len(seen["texts"]) > 300
    assert not_in_tables(seen["texts"], [variants / f"{name}.csv" for name in ("report", "receivers", "hourly")]) == []
    assert seen["width"] == width
    assert seen["folded"] == RECEIVERS - 1 + 1  # and the hours of the day
    assert seen["wide"] <= width
    assert seen["outside"] == [] and seen["scrolled"] == []
    # Two of all receivers, five of months, five of hours, one of seconds; of each receiver three maps, scatter and
    # histogram.
    assert len(seen["charts"]) == 2 + 5 + 5 + 1 + 5 * RECEIVERS
    for label, marks, chart_width in seen["charts"]:
        assert marks >= 3, label
        assert 150 < chart_width <= width, label
    assert len(seen["images"]) >= 2 + 2 * RECEIVERS
    assert all(natural > 50 for _, natural in seen["images"])
    assert seen["sorted"] == sorted(seen["sorted"], reverse=True) and seen["sorted"][0] > 0.01

    screenshot(variants / "report.html", width, 3000, tmp_path / "page.png", *options)
    with Image.open(tmp_path / "page.png") as picture:
        assert picture.size == (width, 3000)
        assert len(picture.convert("RGB").getcolors(1 << 24)) > 100


def test_polygon_clipping_is_the_reference_where_none_is_named(official, patched, model, weather, tmp_path):
    done = compare(model, tmp_path, weather, "--receivers", "1", "--", "-D")
    assert done.returncode == 0, done.stderr
    assert "EAST END WINDOW" in done.stdout
    assert "PolygonClipping" in done.stdout and "rendered by" in done.stdout
    assert (tmp_path / "receivers.csv").is_file() and (tmp_path / "hourly.csv").is_file()
    tables = Tables((tmp_path / "report.html").read_text(encoding="utf-8")).tables
    assert tables["table-energy"][0][2:4] == ["PolygonClipping kWh", "Renderer kWh"]
    assert [row[0] for row in tables["table-energy"][1:] if row[0]] == ["CLEAR AUTUMN DAY"]
    assert "table-months-1" not in tables  # a design day is no month


def test_one_folder_for_one_model_after_another(patched, courtyard, weather, tmp_path):
    """The second takes the first one's place; the files beside the first stay as they are."""
    first, second = tmp_path / "v1" / "A.idf", tmp_path / "v2" / "B.idf"
    for path in (first, second):
        path.parent.mkdir()
        path.write_bytes(courtyard.read_bytes())
    neighbour = first.with_name("B.idf")
    neighbour.write_text("mine")
    for model in (first, second):
        done = compare(model, tmp_path / "out", weather, "--receivers", "1", "--", "-D")
        assert done.returncode == 0, done.stderr
        assert [path.name for path in (tmp_path / "out" / "inputs" / "gpu").glob("*.idf") if not path.is_symlink()] == [
            model.name]
    assert neighbour.read_text() == "mine"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out", "v1", "v2"]
    report = (tmp_path / "out" / "report.html").read_bytes()
    (tmp_path / "out" / "notes.txt").write_text("mine")
    done = compare(first, tmp_path / "out", weather)
    assert done.returncode == 1
    assert done.stderr.startswith(f"compare_shading: {tmp_path / 'out' / 'notes.txt'} was not created by")
    assert (tmp_path / "out" / "report.html").read_bytes() == report


def test_a_run_that_is_neither_kind_nor_file(model, weather, tmp_path):
    done = compare(model, tmp_path, weather, "--runs", "gpu", "nothing.idf")
    assert done.returncode == 1
    assert done.stderr.startswith("compare_shading: nothing.idf: expected clipping, gpu, pixelcounting, a file")
    assert len(done.stderr.splitlines()) == 1


def test_what_a_run_is_called(model):
    plain = methods.choose(model, ["clipping", "gpu"], False)
    assert [(run.key, run.short, run.is_ours) for run in plain] == [("stock", "clip", False), ("gpu", "gpu", True)]
    named = methods.choose(model, ["gpu", str(model.with_name("glass.idf"))], False)
    assert [(run.key, run.short) for run in named] == [("a", "A"), ("b", "B")]
    assert named[0].extension_file is None and named[1].extension_file == model.with_name("glass.idf")


def test_messages_of_a_run(tmp_path):
    (tmp_path / "eplusout.err").write_text(
        "Program Version,EnergyPlus\n"
        "   ** Warning ** First of two\n"
        "   **   ~~~   ** which goes on\n"
        "   ************* Beginning Simulation\n"
        "   **   ~~~   ** belongs to nothing\n"
        "   ** Severe  ** Second\n"
        "   *************  ** Warning ** Third, again and again\n"
        "   *************  **   ~~~   **   This error occurred 12 total times\n"
        "   **  Fatal  ** Fourth\n")
    run = Run(1, "", "", tmp_path, 1.0)
    assert run.messages == [
        ("Warning", "First of two\nwhich goes on"),
        ("Severe", "Second"),
        ("Warning", "Third, again and again\nThis error occurred 12 total times"),
        ("Fatal", "Fourth"),
    ]
    assert run.severe == ["Severe: Second", "Fatal: Fourth"]


@pytest.fixture(scope="module")
def rooms(patched, louvres, weather, tmp_path_factory):
    """Clipping and the renderer with twelve louvres, the same louvres half transparent, and no louvres."""
    folder = tmp_path_factory.mktemp("rooms")
    model = folder / "day.idf"
    text = louvres(12) + daylit_rooms.control(x=POINT[0], y=POINT[1]) + daylit_rooms.OUTPUTS
    model.write_text(text)
    bare = input_file.Idf(text)
    bare.remove(lambda name: name.startswith("shading:"))
    bare.set_field("Building", (1,), "0.0")
    bare.write(folder / "open.idf")
    (folder / "glass.idf").write_text("GPUShading:TransparentShade,Glass,Louvre *,Constant,0.5;\n")
    done = compare(model, folder / "out", weather, "--runs", "clipping", "gpu", folder / "glass.idf",
                   folder / "open.idf", "--receivers", "1", "--", "-D")
    assert done.returncode == 0, done.stderr
    text = (folder / "out" / "report.html").read_text(encoding="utf-8")
    return text, Tables(text).tables, [folder / "out" / key for key in "abcd"]


POINT = (3.0, 1.5, 0.8)
WINDOW = ((1.5, 0.8), (4.5, 2.8))  # x and z, in the plane y = 0


def hours_of_sun(folder):
    """At the point behind the bare window, from the sun of each timestep, a quarter of an hour."""
    eso = EsoFile(folder / "eplusout.eso", "TimeStep")
    azimuths, altitudes, beams = (eso.values[name, "Environment"] for name in (
        "Site Solar Azimuth Angle", "Site Solar Altitude Angle", "Site Direct Solar Radiation Rate per Area"))
    count = 0
    for when, beam in beams.items():
        azimuth, altitude = np.radians(azimuths[when]), np.radians(altitudes[when])
        south = -np.cos(azimuth) * np.cos(altitude)
        if altitude <= 0 or south <= 0 or beam < 50.0:
            continue
        x = POINT[0] + POINT[1] / south * np.sin(azimuth) * np.cos(altitude)
        z = POINT[2] + POINT[1] / south * np.sin(altitude)
        count += WINDOW[0][0] < x < WINDOW[1][0] and WINDOW[0][1] < z < WINDOW[1][1]
    return count / 4


def test_variants_are_compared_by_what_they_are_chosen_by(rooms):
    _, tables, folders = rooms
    header, *rows = tables["table-variants-1"]
    assert [row[0] for row in rows] == [
        "PolygonClipping (A)", "the model as it is (B)", "glass.idf (C)", "open.idf (D)"]
    columns = {title: [number(row[i]) for row in rows] for i, title in enumerate(header) if i}
    runs = [EsoFile(folder / "eplusout.eso") for folder in folders]
    for title, variable in (("Cooling kWh", QUANTITIES["Cooling"]),
                            ("Sun through windows kWh", QUANTITIES["Transmitted solar radiation"])):
        series = [np.sum([list(run.values[variable, key].values()) for key in run.keys(variable)], axis=0) / 3.6e6
                  for run in runs]
        assert columns[title] == pytest.approx([values.sum() for values in series], rel=0.006), title
        if title == "Cooling kWh":
            assert columns["Cooling peak kW"] == pytest.approx([values.max() for values in series], rel=0.006)
    assert columns["Sun through windows kWh"] == sorted(columns["Sun through windows kWh"])


def test_glare_risk_is_the_sun_at_the_points(rooms):
    _, tables, folders = rooms
    (row,) = tables["table-glare"][1:]
    assert row[:2] == ["CLEAR AUTUMN DAY", "BOX LIGHT, point 1"]
    clipping, opaque, glass, bare = map(number, row[2:])
    assert bare == pytest.approx(hours_of_sun(folders[3])) and bare > 2.0
    assert glass == bare  # half the beam is far above the threshold
    assert clipping == opaque < bare


def test_each_variant_has_its_picture(rooms):
    text, _, folders = rooms
    looks = re.search(r'<div class="looks">(.*?)</div>', text, re.DOTALL)[1]
    assert looks.count("<img ") == 4 and "No picture" not in looks
    pictures = []
    for folder in folders:
        with Image.open(folder.parent / "looks" / f"{folder.name}.png") as picture:
            pictures.append(picture.convert("RGB").tobytes())
    # Stock sees opaque louvres, as the renderer does without the side file.
    assert pictures[0] == pictures[1] and len(set(pictures)) == 3
    assert re.search(r"sun at azimuth [\d.]+°, altitude [\d.]+°", text)


def test_inputs_that_differ_and_what_stock_makes_of_them(rooms):
    text, tables, _ = rooms
    rows = {row[0]: row[1:] for row in tables["table-inputs"][1:]}
    assert rows["GPUShading:TransparentShade"] == ["–", "1 added: Glass", "–"]
    assert "Building" not in rows  # 0 and 0.0 are the same
    assert rows["Shading:Building:Detailed"][:2] == ["–", "–"]
    assert rows["Shading:Building:Detailed"][2].startswith("12 removed: Louvre 1")
    assert "PolygonClipping takes shading surfaces with GPUShading:TransparentShade as opaque" in text
    assert "without them" not in text


def test_daylight_and_lighting_are_those_reported(rooms):
    """More light through louvres that are half transparent, and less electricity."""
    _, tables, folders = rooms
    runs = [EsoFile(folder / "eplusout.eso") for folder in folders]
    (row,) = tables["table-daylight"][1:]
    assert row[0] == "BOX LIGHT, point 1"
    lux = np.array([list(run.values["Daylighting Reference Point 1 Illuminance", "BOX LIGHT"].values())
                    for run in runs])
    lit = lux.max(axis=0) > 0.0
    assert int(row[1]) == lit.sum() >= 8
    means = lux[:, lit].mean(axis=1)
    assert means[2] > 1.1 * means[1]
    assert list(map(number, row[2:6])) == pytest.approx(means, abs=0.006)
    assert number(row[-2]) == pytest.approx(np.abs(lux[2] - lux[0]).max(), abs=0.006)
    lighting = next(row for row in tables["table-energy"] if "Lighting" in row)
    energies = [sum(run.values["Zone Lights Electricity Energy", "BOX"].values()) / 3.6e6 for run in runs]
    assert energies[2] < energies[1]
    assert list(map(number, lighting[2:6])) == pytest.approx(energies, abs=ENERGY)


def test_a_page_of_many_variants_in_a_browser(rooms, tmp_path):
    _, _, folders = rooms
    seen = look_at(folders[0].parent / "report.html", 480, LOOK, tmp_path)
    assert seen["troubles"] == [] and seen["faults"] == [] and seen["outside"] == []
    assert seen["wide"] <= 480

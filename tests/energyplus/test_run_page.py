"""The page of a run (--gpu-shading-report): its numbers against EnergyPlus's own, and the page in a browser."""

import base64
import math
import re
import subprocess

import numpy as np
import pytest
from eso_file import EsoFile
from html_page import DARK, SOFTWARE_WEBGL, content_of, look_at, not_in_tables, print_page, screenshot
from output_files import rows_of
from PIL import Image
from shading_runs import energyplus, input_file

SUNLIT = "Surface Outside Face Sunlit Fraction"
INCIDENT = "Surface Outside Face Incident Beam Solar Radiation Rate per Area"
HOSTILE = "</SCRIPT><IMG SRC=X ONERROR=ALERT(1)> @LIBRARY@ &AMP \" ' \\U003C"
SHADES = """GPUShading:TransparentShade, Glass, Neighbour*, Constant, 0.35;
GPUShading:PerforatedScreen, Mesh, Garden Wall, Round, , Staggered60, 0.1, , 0.15, , 0.01;
"""

LOOK = """() => {
  const fire = (id, value, event) => {
    document.getElementById(id).value = value;
    document.getElementById(id).dispatchEvent(new Event(event));
  };
  const text = (id) => document.getElementById(id).textContent;
  const outside = [...document.querySelectorAll("main *, header *")].filter((element) =>
    element.getBoundingClientRect().right > innerWidth + 1 && !element.closest(".scroll, svg, canvas, select"));
  const colours = () => {
    view.drawNow?.();
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [300, 200];
    copy.getContext("2d").drawImage(document.getElementById("view"), 0, 0, 300, 200);
    const pixels = new Uint32Array(copy.getContext("2d").getImageData(0, 0, 300, 200).data.buffer);
    return [new Set(pixels).size, pixels.reduce((sum, pixel) => (sum * 31 + pixel) % 1000003, 7)];
  };
  const opened = {chosen: text("chosen-name"), area: content.receivers[state.receiver][0]};
  const box = document.getElementById("view").getBoundingClientRect();
  const under = view.numberAt({clientX: box.left + box.width / 2, clientY: box.top + box.height / 2});
  const seen = {opened, under: content.names[under], width: innerWidth, wide: document.documentElement.scrollWidth,
    outside: outside.map((element) => element.outerHTML.slice(0, 200)), faults: faults(),
    drawn: view.constructor.name, begins: colours(), missing: text("view-missing"), notes: text("notes"),
    injected: document.querySelectorAll("img").length};
  fire("day", 0, "input");
  fire("hour", 2, "input");
  seen.moment = text("moment");
  seen.moved = colours();
  fire("colouring", "energy", "change");
  seen.mapped = colours();
  seen.scale = text("legend-title");
  fire("colouring", "", "change");
  const press = (key) =>
    document.getElementById("view").dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true}));
  press("ArrowLeft");
  seen.turned = colours();
  press("0");
  seen.reset = colours();
  fire("receiver", content.names.findIndex((name) => name.includes("SCRIPT")), "change");
  seen.chosen = text("chosen-name");
  seen.numbers = [...document.querySelectorAll("#numbers dd")].map((value) => value.textContent);
  seen.fields = document.querySelectorAll("#carpet .field").length;
  seen.beams = [...document.querySelectorAll("#beam-plot .field title")].map((title) => title.textContent);
  const tab = (key) => document.querySelector("[role=tab][aria-selected=true]").dispatchEvent(
    new KeyboardEvent("keydown", {key, bubbles: true}));
  tab("ArrowRight");
  seen.months = [...document.querySelectorAll("#months-plot .bar title")].map((title) => title.textContent);
  seen.meanDays = KINDS_OF_LIGHT.map((_, kind) => {
    fire("light", String(kind), "change");
    return [...document.querySelectorAll("#mean-days-plot .field title")].map((title) => title.textContent);
  });
  tab("ArrowRight");
  seen.suns = document.querySelectorAll("#sky-plot circle").length;
  seen.skyKeys = [...document.querySelectorAll("#sky-keys li")].map((key) => key.textContent);
  seen.cells = document.querySelectorAll("#sky-plot .sky-cell").length;
  fire("projection", "cylindrical", "change");
  seen.cylinder = document.querySelector("#sky-plot svg").getAttribute("viewBox");
  seen.chart = chartText(document.querySelector("#sky-plot svg"));
  tab("ArrowRight");
  seen.panel = document.querySelector(".panel:not([hidden])").id;
  document.querySelector("#receivers thead th:nth-child(2) button").click();
  seen.rows = [...document.querySelectorAll("#receivers tbody tr")].map((row) =>
    [...row.cells].map((cell) => cell.textContent));
  seen.texts = texts();
  fire("filter", "roof", "input");
  seen.filtered = document.querySelectorAll("#receivers tbody tr").length;
  return seen;
}"""


@pytest.fixture(scope="module")
def run(patched, courtyard, weather, tmp_path_factory):
    """(run, its report) of three weeks in March, shading every 20 days, with a hostile name, glass and a screen."""
    folder = tmp_path_factory.mktemp("page")
    text = re.sub("East Court Back Window", lambda _: HOSTILE, courtyard.read_text(), flags=re.IGNORECASE)
    (folder / "courtyard.idf").write_text(text)
    model = input_file.read(folder / "courtyard.idf")
    model.remove(lambda name: name in ("runperiod", "shadowcalculation", "output:variable"))
    model.add("RunPeriod", ["Period", 3, 1, "", 3, 22, "", "Sunday"])
    model.add("ShadowCalculation", ["PixelCounting", "Periodic", 20])
    for name in (SUNLIT, INCIDENT):
        model.add_output_variable(name, "Timestep")
    model.write(folder / "courtyard.idf")
    (folder / "courtyard.gpu-shading.idf").write_text(SHADES)
    report = folder / "report"
    report.mkdir()
    drawn = subprocess.run([energyplus.patched_prefix() / "gpu_shading", "map", folder / "courtyard.idf", "-w", weather,
                            "--from", "03-01", "--to", "03-02", "--spacing", "1", "--receivers", "East*",
                            "-o", report / "maps"], capture_output=True, text=True)
    assert drawn.returncode == 0, drawn.stderr
    done = energyplus.run(patched, folder / "courtyard.idf", weather, folder / "out",
                          ["--gpu-shading", f"--gpu-shading-report={report}"])
    assert done.completed, done.why()
    return done, report


@pytest.fixture(scope="module")
def page(run):
    return run[1] / "index.html"


def done_model(run):
    return run[0].folder.parent / "courtyard.idf"


def outputs(run):
    return EsoFile(run.folder / "eplusout.eso", "TimeStep")


def test_beam_is_that_of_energyplus(run):
    done, report = run
    theirs = outputs(done)
    rows = rows_of(report / "run_receivers.csv")
    assert len(rows) == 18
    for row in rows:
        values = theirs.values[INCIDENT, row["receiver"]].values()
        beam = sum(values) / (4 * 1000)
        assert float(row["beam [kWh/m2]"]) == pytest.approx(beam, abs=0.051), row["receiver"]
        total = float(row["beam [kWh]"])
        assert total == pytest.approx(beam * float(row["area [m2]"]), rel=3e-4, abs=0.1), row["receiver"]
    assert sum(float(row["beam [kWh/m2]"]) > 10 for row in rows) >= 12


def test_sunlit_fractions_are_those_of_energyplus(run):
    done, report = run
    theirs = outputs(done)
    rows = rows_of(report / "run_hours.csv")
    assert {row["day"] for row in rows} == {"03-01", "03-21"}
    compared = 0
    for row in rows:
        month, day = map(int, row["day"].split("-"))
        for receiver in list(row)[5:]:
            value = theirs.values[SUNLIT, receiver][month, day, int(row["hour"]), 60]
            assert float(row[receiver]) == pytest.approx(value, abs=6e-5), (receiver, row["day"], row["hour"])
            compared += 0.01 < value < 0.99
    assert compared > 50


@pytest.fixture(scope="module")
def on_desktop(page, tmp_path_factory):
    return look_at(page, 1400, LOOK, tmp_path_factory.mktemp("desktop"), *SOFTWARE_WEBGL)


@pytest.fixture(scope="module")
def on_phone_in_the_dark(page, tmp_path_factory):
    return look_at(page, 390, LOOK, tmp_path_factory.mktemp("phone"), *SOFTWARE_WEBGL, *DARK)


def test_the_page_has_the_numbers_of_the_tables(run, on_desktop):
    report, seen = run[1], on_desktop
    hours = [row for row in rows_of(report / "run_hours.csv") if row["day"] == "03-01"]
    third = hours[2]
    assert seen["moment"].startswith(f"1 March, {int(third['hour']):02}:00")
    assert f"{float(third['sun azimuth [deg]']):.1f}\u00b0" in seen["moment"]
    assert seen["chosen"] == HOSTILE
    assert seen["numbers"][0] in (f"{100 * float(third[HOSTILE]):.0f} %", "faces away from the sun")
    assert seen["fields"] == len(rows_of(report / "run_hours.csv"))
    columns = ("receiver", "area [m2]", "azimuth [deg]", "tilt [deg]", "mean sunlit fraction", "beam [kWh/m2]",
               "beam [kWh]")
    theirs = {row["receiver"]: [row[column] for column in columns[1:]] for row in rows_of(report / "run_receivers.csv")}
    shown = {row[0]: ["" if cell == "–" else cell.replace(",", "") for cell in row[1:]] for row in seen["rows"]}
    assert shown == theirs
    areas = [float(row[1].replace(",", "")) for row in seen["rows"]]
    assert areas == sorted(areas, reverse=True)
    assert seen["filtered"] == 2


def test_the_page_opens_on_the_largest_window(run, on_desktop):
    windows = [row for row in rows_of(run[1] / "run_receivers.csv")
               if "WINDOW" in row["receiver"] or row["receiver"] == HOSTILE]
    largest = max(windows, key=lambda row: float(row["area [m2]"]))
    assert on_desktop["opened"] == {"chosen": largest["receiver"], "area": pytest.approx(float(largest["area [m2]"]))}
    assert on_desktop["under"]


def test_beam_by_hour_and_month(run, on_desktop):
    """The beams of a day's hours, times the days that it stands for, are EnergyPlus's beam of the receiver."""
    done, report = run
    theirs = outputs(done).values[INCIDENT, HOSTILE]
    [march] = [float(row["beam [kWh/m2]"]) for row in rows_of(report / "run_months.csv")
               if (row["receiver"], row["month"]) == (HOSTILE, "3")]
    assert march == pytest.approx(sum(theirs.values()) / 4000, abs=0.051)
    of_beam = [month for month in on_desktop["months"] if ", beam: " in month]
    assert of_beam[2] == f"March, beam: {march:.1f} kWh/m\u00b2"
    assert sum(float(month.split(": ")[1].split()[0]) for month in of_beam) == pytest.approx(march)
    # 1 March stands for 20 days, 21 March for two.
    beams = [text.split(": ") for text in on_desktop["beams"]]
    assert len(beams) == on_desktop["fields"]
    energy = sum({"1 March, ": 20, "21 March,": 2}[when[:9]] * float(beam.split()[0]) / 1000
                 for when, beam in ((f"{day} ", beam) for day, beam in beams) if beam.endswith("m\u00b2"))
    assert energy == pytest.approx(march, rel=0.05)


def test_light_by_month_and_hour(run, on_desktop):
    table = rows_of(run[1] / "run_mean_days.csv")
    for kind, fields in zip(("beam", "sky", "reflected by ground", "reflected by shades", "all"),
                            on_desktop["meanDays"], strict=True):
        rows = [row for row in table if row["receiver"] == HOSTILE]
        for field, row in zip(fields, rows, strict=True):
            when, watts = field.rsplit(": ", 1)
            assert when == f"mean day of March, {int(row['hour']):02}:00"
            assert float(watts.split()[0]) == pytest.approx(float(row[f"{kind} [W/m2]"]), abs=0.551), (kind, when)
        [month] = [float(row[f"{kind} [kWh/m2]"]) for row in rows_of(run[1] / "run_months.csv")
                   if (row["receiver"], row["month"]) == (HOSTILE, "3")]
        assert sum(float(row[f"{kind} [W/m2]"]) for row in rows) * 22 / 1000 == pytest.approx(month, abs=0.07)


def test_the_sky_of_a_receiver(run, on_desktop):
    report = run[1]
    content = content_of(report / "index.html")
    receiver = content["names"].index(HOSTILE)
    [sky] = [one for one in content["skies"]["list"] if one["receiver"] == receiver]
    program = energyplus.patched_prefix() / "gpu_shading"
    done = subprocess.run([program, "mask", done_model(run), "--receiver", "*LIBRARY*", "-o", report.parent / "masks"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    [mask] = rows_of(report.parent / "masks" / "masks.csv")
    assert sky["unshaded"] == 0.5
    assert sky["view"] == pytest.approx(float(mask["sky view factor"]), abs=0.01)
    assert on_desktop["cells"] > 100 and on_desktop["suns"] > 10
    assert on_desktop["skyKeys"][0] == "clear sky" and "the building itself" in on_desktop["skyKeys"]
    assert on_desktop["cylinder"] == "0 0 360 200" and on_desktop["panel"] == "panel-hours"
    assert on_desktop["chart"].startswith("<svg") and "url(" not in on_desktop["chart"]


def test_every_number_is_in_a_table(run, on_desktop):
    tables = [*run[1].glob("run_*.csv"), run[1] / "maps" / "maps.csv"]
    texts = on_desktop["texts"]
    assert len(tables) == 7 and len(texts) > 150
    assert not_in_tables(texts, tables) == []
    assert not_in_tables([*texts, "7.654321 kWh"], tables) == ["7.654321"]


@pytest.mark.parametrize("where, width", [("on_desktop", 1400), ("on_phone_in_the_dark", 390)])
def test_the_page_in_a_browser(request, where, width):
    seen = request.getfixturevalue(where)
    assert seen["troubles"] == []
    assert seen["faults"] == []
    assert seen["outside"] == [] and seen["wide"] <= max(width, seen["width"])
    assert seen["injected"] == 0
    assert seen["drawn"] == "ModelView" and seen["missing"] == ""
    assert seen["begins"][0] > 100
    # Another hour, another direction: other pictures. Key 0 brings the first direction back.
    assert len({seen[key][1] for key in ("begins", "moved", "turned", "mapped")}) == 4
    assert seen["scale"] == "Beam energy, kWh/m\u00b2, 1 Mar to 2 Mar"
    assert seen["reset"] == seen["moved"]


@pytest.mark.parametrize("width, options", [(1400, ()), (390, DARK)], ids=["desktop", "phone dark"])
def test_a_picture_of_the_page(page, tmp_path, width, options):
    screenshot(page, width, 1500, tmp_path / "page.png", *SOFTWARE_WEBGL, *options)
    with Image.open(tmp_path / "page.png") as picture:
        assert len(picture.convert("RGB").getcolors(1 << 24)) > 200
    print(tmp_path / "page.png")


def test_the_page_on_paper(page, tmp_path):
    print_page(page, tmp_path / "page.pdf", *SOFTWARE_WEBGL, *DARK)
    # Hatched fields, each with a picture of its own, made it 6 MB.
    assert 20_000 < (tmp_path / "page.pdf").stat().st_size < 1_000_000
    print(tmp_path / "page.pdf")


def test_maps_are_on_the_page(run):
    report = run[1]
    content = content_of(report / "index.html")
    receivers = content["names"][:len(content["receivers"])]
    rows = {row["receiver"]: row for row in rows_of(report / "maps" / "maps.csv") if row["receiver"] in receivers}
    assert len(content["maps"]["list"]) == len(rows) >= 8
    for one in content["maps"]["list"]:
        row = rows[content["names"][one["receiver"]]]
        means = [float(row["sunlit mean [h]"]), float(row["beam mean [kWh/m2]"])]
        assert one["means"] == pytest.approx(means, rel=1e-9)
        array = np.load(report / "maps" / f"{row['files']}.npy")
        assert array.shape == (2, one["rows"], one["columns"])
        codes = np.frombuffer(base64.b64decode(one["hours"]), np.uint8).reshape(array.shape[1:])
        known = np.isfinite(array[0])
        assert (codes[~known] == 255).all()
        assert codes[known] == pytest.approx(250 * array[0][known] / content["maps"]["most"][0], abs=0.51)
        # The bounding rectangle.
        area = float(row["area [m2]"])
        assert np.linalg.norm(np.cross(one["right"], one["up"])) >= area * (1 - 1e-5)


CHANGING = """
GPUShading:PerforatedScreen,Mesh,Blind,Round,,Straight,0.05,,0.1,,0.001,,,,,,,,,,,Drawn;
ScheduleTypeLimits,Share,0,1,Continuous;
Schedule:Compact,Drawn,Share,Through: 4/30,For: AllDays,Until: 24:00,0.2,Through: 12/31,For: AllDays,Until: 24:00,1;
Schedule:Compact,Sail,Share,Through: 4/30,For: AllDays,Until: 24:00,0.6,Through: 12/31,For: AllDays,Until: 24:00,0.1;
Shading:Building:Detailed,Blind,,4,1,-1,2,1,-1,1,2,-1,1,2,-1,2;
Shading:Building:Detailed,Sail,Sail,4,3,-1,2,3,-1,1,4,-1,1,4,-1,2;
Output:Variable,*,Schedule Value,Hourly;
"""
SHEETS = """() => ({seen: content.days.map((_, day) => {
  go(day, Math.floor(content.days[day].hours.length / 2));
  view.drawNow?.();
  return view.sheets.map(({style, material, mesh}) => ({kind: style.kind, opacity: material.opacity,
    colour: material.color.getHex(), casts: mesh.castShadow, passes: passesNow(style, view.time)}));
})})"""


def test_shades_are_drawn_as_their_schedules_have_them(patched, weather, tmp_path):
    """Trees by the leaves, a screen by the share that is drawn, and a sail by the transmittance of each day."""
    example = energyplus.REPOSITORY / "idf_examples" / "trees"
    text = (example / "trees.idf").read_text() + CHANGING
    (tmp_path / "trees.idf").write_text(re.sub(r"GPUShading:Tree,\s*Street.*?;", "", text, flags=re.DOTALL))
    done = energyplus.run(patched, tmp_path / "trees.idf", weather, tmp_path / "out",
                          ["--gpu-shading", f"--gpu-shading-report={tmp_path / 'report'}"])
    assert done.completed, done.why()
    values = EsoFile(done.folder / "eplusout.eso", "Hourly").values
    page = tmp_path / "report" / "index.html"
    content = content_of(page)
    looked = look_at(page, 1000, SHEETS, tmp_path, *SOFTWARE_WEBGL)
    assert looked["troubles"] == []
    kinds = {"foliage": "GPU SHADING NORTHERN LEAVES", "screen": "DRAWN", "glass": "SAIL"}
    styles = {style["kind"]: style for style in content["styles"]}
    seen = {kind: set() for kind in kinds}
    for day, sheets in zip(content["days"], looked["seen"], strict=True):
        hour = day["hours"][len(day["hours"]) // 2][0]
        assert sorted(sheet["kind"] for sheet in sheets) == sorted(kinds)
        for sheet in sheets:
            kind = sheet["kind"]
            share = values["Schedule Value", kinds[kind]][day["month"], day["day"], hour]
            # Of one face of the oak's crown, 9 m high; of holes beside what is not drawn; of the schedule alone.
            expected = {"foliage": math.exp(-0.25 * (0.9 * share + 0.15) * 9),
                        "screen": 1 - share * (1 - styles["screen"]["passes"]), "glass": share}[kind]
            assert sheet["passes"] == pytest.approx(expected, abs=0.012), (kind, day)
            assert sheet["opacity"] == pytest.approx(share if kind == "screen" else 0.65 - 0.5 * expected, abs=0.012)
            seen[kind].add((round(sheet["opacity"], 2), sheet["colour"]))
    assert all(len(found) > 1 for found in seen.values())
    assert styles["screen"]["passes"] == pytest.approx(math.pi / 16, abs=1e-3)
    # A bare crown has the colour of wood.
    assert len({colour for _, colour in seen["foliage"]}) > 1
    assert content["skies"]["state"] == "trees in full leaf, screens fully deployed, transmittances at their lowest"


NO_WEBGL = """<script>HTMLCanvasElement.prototype.getContext = ((whole) => function (kind, ...more) {
  return kind === "webgl" ? null : whole.call(this, kind, ...more);
})(HTMLCanvasElement.prototype.getContext);</script>"""


def without_library(text):
    """The page as a build without three.js writes it."""
    library = re.compile(r"<script>\(function.*?</script>\n(?=<script>\n\"use strict\")", re.DOTALL)
    return library.sub("", text)


@pytest.mark.parametrize("lacks", ["WebGL", "library"])
def test_without_webgl_there_is_a_plain_drawing(page, tmp_path, lacks):
    text = page.read_text(encoding="utf-8")
    plain = tmp_path / "plain.html"
    plain.write_text(without_library(text) if lacks == "library" else text, encoding="utf-8")
    seen = look_at(plain, 1000, LOOK, tmp_path, before=NO_WEBGL if lacks == "WebGL" else "")
    assert seen["troubles"] == [] and seen["faults"] == []
    assert seen["drawn"] == "PlainDrawing" and lacks in seen["missing"]
    assert seen["begins"][0] > 20 and len({seen[key][1] for key in ("begins", "moved", "mapped")}) == 3
    assert len(seen["rows"]) == 18


def test_the_page_loads_nothing(page):
    text = page.read_text(encoding="utf-8")
    assert "default-src 'none'" in text
    assert HOSTILE not in text
    content = content_of(page)
    assert HOSTILE in content["names"]
    kinds = {style["kind"] for style in content["styles"]}
    assert kinds == {"receiver", "opaque", "glass", "screen"}


def test_an_index_page_of_somebody_else_is_left_alone(patched, box, weather, tmp_path):
    (tmp_path / "box.idf").write_text(box)
    (tmp_path / "report").mkdir()
    (tmp_path / "report" / "index.html").write_text("<html>mine</html>")
    done = subprocess.run([patched, "--gpu-shading", f"--gpu-shading-report={tmp_path / 'report'}", "-D", "-w", weather,
                           "-d", tmp_path / "out", tmp_path / "box.idf"], capture_output=True, text=True)
    assert done.returncode == 1
    assert "index.html is not of an earlier report" in done.stderr
    assert (tmp_path / "report" / "index.html").read_text() == "<html>mine</html>"


def test_maps_in_the_same_command(patched, box, weather, tmp_path):
    (tmp_path / "box.idf").write_text(box + "GPUShading:PVModules,Modules,East,1,1,,2,2,1,0,0,1,1;\n")
    done = energyplus.run(patched, tmp_path / "box.idf", weather, tmp_path / "out",
                          ["-D", "--gpu-shading", f"--gpu-shading-report={tmp_path / 'report'}", "--gpu-shading-maps"])
    assert done.completed, done.why()
    rows = rows_of(tmp_path / "report" / "maps" / "maps.csv")
    content = content_of(tmp_path / "report" / "index.html")
    names = [content["names"][one["receiver"]] for one in content["maps"]["list"]]
    assert sorted(names) == sorted(row["receiver"] for row in rows) and len(names) > 4
    assert [field["surface"] for field in content["modules"]["fields"]] == [
        row["surface"] for row in rows_of(tmp_path / "report" / "modules" / "modules.csv")]


@pytest.mark.parametrize("arguments, why", [
    (["-w"], "--gpu-shading-maps: expected --gpu-shading-report with it"),
    (["--gpu-shading-report=report"], "--gpu-shading-maps: expected a weather file, -w, with it")])
def test_maps_need_a_report_and_weather(patched, box, weather, tmp_path, arguments, why):
    (tmp_path / "box.idf").write_text(box)
    given = ["-w", weather] if arguments == ["-w"] else arguments
    done = subprocess.run([patched, "--gpu-shading", "--gpu-shading-maps", *given, "-D", "-d", tmp_path / "out",
                           tmp_path / "box.idf"], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 1 and why in done.stderr

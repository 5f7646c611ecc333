"""What the programs say of names and files that nobody expects: for a terminal, and with the file that is meant."""

import csv
import json
import os
import re
import resource
import subprocess
from pathlib import Path

import pytest
from html_page import Tables
from shading_runs import energyplus
from shading_runs.version import input_version
from test_screens import write_grey_image

HUGE_PAGES = Path("/sys/kernel/mm/transparent_hugepage/enabled")
TRIANGLE = "o T\nusemtl M\nv 1 2 3\nv 2 2 3\nv 1 3 3\nf 1 2 3\n"
ESCAPES = "Lou\x1b[31mvre\x07 \u009b1m"
SHOWN = r"LOU\x1b[31MVRE\x07 \xc2\x9b1M"


@pytest.fixture
def model(box, tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(box, encoding="utf-8")
    return path


@pytest.fixture
def call(patched, tmp_path):
    def run(*arguments, **variables):
        return subprocess.run([patched.parent / "gpu_shading", *arguments], capture_output=True, text=True,
                              cwd=tmp_path, env={**os.environ, **variables})

    return run


@pytest.fixture
def launch(patched, weather, tmp_path):
    """EnergyPlus for a day, in the test's folder."""
    def run(*arguments, flags=("--gpu-shading",)):
        done = subprocess.run([patched, *flags, "-D", "-w", weather, "-d", "out", *arguments], capture_output=True,
                              text=True, cwd=tmp_path)
        assert "filesystem error" not in done.stderr and "json.exception" not in done.stderr
        return done

    return run


def is_safe(text):
    return not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", text)


@pytest.mark.parametrize("form", [(), ("--vertices",), ("--json",), ("--json", "--vertices")], ids=" ".join)
def test_names_do_not_reach_the_terminal_as_commands(call, box, model, form):
    model.write_text(box.replace("Louvre 1", ESCAPES), encoding="utf-8")
    done = call("check", model, *form)
    assert done.returncode == 0 and is_safe(done.stdout + done.stderr), done.stderr
    if "--json" in form:
        assert ESCAPES.upper() in [surface["name"] for surface in json.loads(done.stdout)["surfaces"]]
    else:
        assert SHOWN in done.stdout


def test_a_comparison_does_not_print_names_as_commands(official, patched, box, model, weather, tmp_path):
    model.write_text(box.replace("South Window", "South\x1b[31m\u009b1m"), encoding="utf-8")
    done = subprocess.run([energyplus.REPOSITORY / "scripts" / "compare_shading", model, "-w", weather, "-o",
                           tmp_path / "out", "--", "-D"], capture_output=True, text=True)
    assert done.returncode == 0 and is_safe(done.stdout + done.stderr), done.stderr
    assert r"SOUTH\x1b[31M\x9b1M" in done.stdout


@pytest.mark.parametrize("arguments, variables, message", [
    (("check", "model.idf", "--gpu-shading-report="), {}, '--gpu-shading-report is blank, expected a folder'),
    (("check", "model.idf", "--gpu-shading-file="), {}, '--gpu-shading-file is blank, expected a file'),
    (("check", "model.idf"), {"TMPDIR": "model.idf"},
     'TMPDIR is "model.idf", expected a folder for temporary files (Not a directory)'),
    (("check", "loop"), {}, "loop: Too many levels of symbolic links"),
    (("check", "model.idf", "-w", "loop"), {}, "loop: Too many levels of symbolic links"),
    (("check", "model.idf", "--gpu-shading-file=loop"), {}, "{folder}/loop: Too many levels of symbolic links"),
    (("screen", "loop"), {}, "loop: Too many levels of symbolic links"),
])
def test_errors_of_files_are_one_line_in_our_words(call, model, tmp_path, arguments, variables, message):
    (tmp_path / "loop").symlink_to("loop")
    done = call(*arguments, **variables)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == f"gpu_shading: error: {message.format(folder=tmp_path)}\n"


def test_a_file_of_extension_objects_is_no_model(call, tmp_path):
    (tmp_path / "shades.idf").write_text("GPUShading:TransparentShade, Half, Screen, Constant, 0.5;\n")
    done = call("check", "shades.idf")
    assert done.stderr == ("gpu_shading: error: shades.idf: has GPUShading:... objects alone, expected a model: give "
                           "this file by --gpu-shading-file\n")


@pytest.mark.parametrize("fields, message", [
    ("Geometry,Tree,loop.obj,m,Z", "GPUShading:Geometry Tree: File Name: loop.obj"),
    ("PerforatedScreen,Veil,Louvre*,Texture,loop.png,,,,,,0.001",
     "GPUShading:PerforatedScreen Veil: Texture File Name: loop.png"),
    ("SiteContext,Town,loop.geojson,,,,,9", "GPUShading:SiteContext Town: Buildings File Name: loop.geojson"),
])
def test_a_loop_of_links_is_named_with_its_object(call, box, model, tmp_path, fields, message):
    for ending in ("obj", "png", "geojson"):
        (tmp_path / f"loop.{ending}").symlink_to(f"loop.{ending}")
    model.write_text(box + f"GPUShading:{fields};\n")
    done = call("check", "model.idf")
    assert done.returncode == 1 and "filesystem" not in done.stderr
    assert done.stderr == f"gpu_shading: error: model.idf: {message}: Too many levels of symbolic links\n"


@pytest.mark.parametrize("text, kind", [("[1]", "array"), ("7", "number"), ('"Zone"', "string"), ("null", "null")])
def test_json_that_is_no_model(call, patched, tmp_path, text, kind):
    (tmp_path / "list.epJSON").write_text(text)
    message = f"list.epJSON: expected a JSON object, got: {kind}"
    assert call("check", "list.epJSON").stderr == f"gpu_shading: error: {message}\n"
    run = subprocess.run([patched, "--gpu-shading", "-D", "-d", "out", "list.epJSON"], capture_output=True, text=True,
                         cwd=tmp_path)
    assert run.returncode != 0 and message in run.stderr and "json.exception" not in run.stderr


SCREEN = "GPUShading:PerforatedScreen, Sheet, {}, Round, , Staggered60, {}, , {}, , {};\n"


@pytest.mark.parametrize("fields, said", [
    (SCREEN.format("Louvre 1", 6.35, 8.55, 0.00635),
     "Hole Size is 6.35 m, more than 1 m: lengths are in metres; is it in millimetres (0.00635), centimetres (0.0635), "
     "inches (0.1613)?"),
    (SCREEN.format("Louvre 1", 3, 5, 0.001), "Pitch is 5 m, more than 1 m: lengths are in metres; is it in "),
    (SCREEN.format("Louvre 1", 40, 60, 0.001), "Hole Size is 40 m, more than 1 m: lengths are in metres; is it in "
     "millimetres (0.04), centimetres (0.4)?"),
    ("GPUShading:PVModules, String, Louvre 1, 68, 1.6;\n", "Module Width is 68 m, more than 10 m: lengths are in "
     "metres; is it in millimetres (0.068), centimetres (0.68), inches (1.727)?"),
    ("GPUShading:Tree, Oak, 9, 9, 0, 10, 6, 2, , , , , 30;\n", None),
    ("GPUShading:Tree, Oak, 9, 9, 0, 180, 120;\n", "Tree Oak: Crown Diameter is 120 m, more than 70 m: lengths are in "
     "metres; is it in "),
])
def test_lengths_in_other_units_are_questioned(call, box, model, weather, launch, fields, said):
    model.write_text(box + fields)
    done = call("check", "model.idf")
    if said is None:
        assert "lengths are in metres" not in done.stdout + done.stderr
        return
    assert done.returncode == 0 and said in done.stdout, done.stdout + done.stderr
    assert f"warning: GPUShading:{fields.split(':')[1].split(',')[0]}" in launch("model.idf").stderr


def test_a_length_out_of_range_is_questioned(call, box, model):
    model.write_text(box + SCREEN.format("Louvre 1", 0.00635, 0.00855, 6.35))
    done = call("check", "model.idf")
    assert done.returncode == 1 and 'Thickness is "6.35", expected a number' in done.stderr
    assert done.stderr.endswith(": lengths are in metres; is it in millimetres (0.00635), centimetres (0.0635), "
                                "inches (0.1613)?\n")


@pytest.mark.parametrize("fields", [
    "GPUShading:TransparentShade, Half, Louvre 1, Constant, 0,5;\n",
    "GPUShading:PerforatedScreen, Sheet, Louvre 1, Round, , Staggered60, 0,005, , 0,008, , 0,001;\n",
    "GPUShading:Tree, Oak,\n  2,5,\n  -8,\n  0,\n  9,\n  6;\nGPUShading:Tree, Fir,\n  2,5,\n  -8,\n  0,\n  x,\n  6;\n",
])
def test_a_decimal_comma_is_questioned(call, box, model, fields):
    model.write_text(box + fields)
    done = call("check", "model.idf")
    assert done.returncode == 1 and done.stderr.count("\n") == 1
    assert done.stderr.endswith("umbers take a decimal point\n")


@pytest.mark.parametrize("arguments", [("--gpu-shading-error", "0,01"), ("--gpu-shading-cache-size", "0,5")])
def test_a_decimal_comma_of_an_option_is_named(call, model, arguments):
    done = call("check", "model.idf", *arguments)
    assert done.returncode == 1 and done.stderr.endswith(": numbers take a decimal point\n")


@pytest.mark.parametrize("surface, reason", [
    ("Louvr 1", "which no shading surface of the model matches; did you mean LOUVRE 1?"),
    ("South Window", "which matches a window or door: expected a shading surface (Shading:...)"),
    ("nor*h", "which matches a wall, floor or roof: expected a shading surface (Shading:...)"),
])
@pytest.mark.parametrize("text", [SCREEN, "GPUShading:TransparentShade, Sheet, {}, Constant, 0.5;\n"],
                         ids=["screen", "shade"])
def test_names_of_other_surfaces_are_explained(call, box, model, surface, reason, text):
    model.write_text(box + text.format(surface, 0.005, 0.008, 0.001))
    assert call("check", "model.idf").stderr.endswith(f'Sheet: Surface Name is "{surface}", {reason}\n')


def test_unknown_fields_list_the_known(call, model, tmp_path):
    (tmp_path / "side.epJSON").write_text('{"GPUShading:Settings": {"S": {"resolutoin": 64}}}')
    done = call("check", "model.idf", "--gpu-shading-file", "side.epJSON")
    assert done.stderr.endswith('"resolutoin": no such field; known: resolution, update_frequency, device, error, '
                                'sky_model, reflections; did you mean resolution?\n')


@pytest.mark.parametrize("arguments, message", [
    (("-w", "nothere.epw"), "-w nothere.epw: no such file"),
    (("-d", "model.idf/out"), "-d model.idf/out: cannot be written to (Not a directory)"),
    (("-d", "/proc/out"), "-d /proc/out: cannot be written to (No such file or directory)"),
    (("-d", "model.idf"), "-d model.idf: cannot be written to (Not a directory)"),
], ids="{0[0]}{0[1]}".format)
def test_files_of_a_run_are_checked_first(launch, model, arguments, message):
    done = launch(*arguments, model.name)
    assert done.returncode == 1 and done.stderr == f"gpu_shading: error: {message}\n"


@pytest.mark.parametrize("name, content, reason", [
    ("model.epJSON", "IDF", "is not JSON: an IDF needs the ending .idf"),
    ("model.epJSON", "{", "is not valid JSON: parse error at line 1, column 2"),
    ("model2.idf", '{"Version": {}}', "is JSON: epJSON needs the ending .epJSON"),
])
def test_the_ending_of_a_model_is_explained(call, launch, box, tmp_path, name, content, reason):
    (tmp_path / name).write_text(box if content == "IDF" else content)
    for done in (call("check", name), launch(name)):
        assert done.returncode == 1 and done.stderr.startswith(f"gpu_shading: error: {name}: {reason}")


def of_version(box, version):
    return re.sub(r"(Version,\s*)[\d.]+", rf"\g<1>{version}", box)


@pytest.mark.parametrize("version, relation, action", [
    *((version, "older", "to be sure, update the model with IDFVersionUpdater, which comes with the EnergyPlus of "
       "energyplus.net/downloads") for version in ("9.3", "22.2", "24.1", "25.1")),
    ("26.1", "newer", "to be sure, use that EnergyPlus")])
def test_a_model_of_another_version_runs_with_a_warning(call, launch, official, box, model, weather, tmp_path, version,
                                                        relation, action):
    model.write_text(of_version(box, version))
    line = (f"model.idf: Version is {version}, {relation} than this EnergyPlus, {input_version()}, which reads all "
            f"fields as its own; {action}\n")
    checked = call("check", "model.idf")
    assert checked.returncode == 0 and line in checked.stdout, checked.stderr
    run = launch("model.idf")
    assert run.returncode == 0 and f"gpu_shading: warning: {line}" in run.stderr
    # As EnergyPlus alone.
    stock = subprocess.run([official, "-D", "-w", weather, "-d", "stock", "model.idf"], capture_output=True,
                           cwd=tmp_path)
    assert stock.returncode == 0
    theirs = [text for text in (tmp_path / "stock" / "eplusout.err").read_text().splitlines() if "Version:" in text]
    assert theirs and set(theirs) <= set((tmp_path / "out" / "eplusout.err").read_text().splitlines())


def test_a_model_whose_fields_moved_is_refused(call, launch, box, model):
    model.write_text(of_version(box, "9.2").replace("  PolygonClipping,", "  AverageOverDaysInFrequency,"))
    for done in (call("check", "model.idf"), launch("model.idf")):
        assert done.returncode == 1 and done.stderr.startswith(
            "gpu_shading: error: model.idf: ShadowCalculation: its fields changed in EnergyPlus 9.3, and the model's "
            "Version is 9.2: update the model with IDFVersionUpdater, ")


GROUP = "  20,,,,,,{},{};"


@pytest.mark.parametrize("switches, refused", [("Yes,No", True), ("No,Yes", True), ("No,No", False)])
def test_a_zone_list_that_does_not_exist(call, launch, box, model, switches, refused):
    model.write_text(re.sub(r"^  20; .*$", GROUP.format(switches, "Nowhere"), box, count=1, flags=re.M))
    for done in (call("check", "model.idf"), launch("model.idf")):
        assert done.returncode == (1 if refused else 0), done.stderr
        if refused:
            assert done.stderr == ("gpu_shading: error: model.idf: ShadowCalculation: Shading Zone Group 1 ZoneList "
                                   'Name is "NOWHERE", which no ZoneList of the model has\n')


@pytest.mark.parametrize("text, warned", [
    ("GPUShading:Settings, , timestep;\n", "GPUShading:Settings"),
    ("  gpushading:transparentshade, S, Louvre 1, Constant, 0.5;\n", "gpushading:transparentshade"),
    ("! GPUShading:Settings, , timestep;\n", ""),
], ids=["object", "lower case", "comment"])
def test_extension_objects_without_the_flag_are_explained(launch, box, model, text, warned):
    model.write_text(box + text)
    done = launch("model.idf", flags=())
    warning = (f"gpu_shading: warning: model.idf: {warned} needs --gpu-shading: EnergyPlus alone stops at it\n")
    assert (warning in done.stderr) == bool(warned) and ("gpu_shading" in done.stderr) == bool(warned)
    assert (done.returncode == 0) == (not warned)


def test_coordinates_that_cannot_be_name_their_file(call, box, model, tmp_path):
    (tmp_path / "far.obj").write_text(TRIANGLE.replace("v 1 2 3", "v 1e30 2 3"))
    model.write_text(box + "GPUShading:Geometry,Tree,far.obj,m,Z;\n")
    assert re.fullmatch(r"gpu_shading: error: .*model\.idf: GPUShading:Geometry Tree: File Name: far\.obj: vertex 1 of "
                        r"M:T is \(1\.0\d*e\+30, 2, 3\) m, expected 10000000 m at most from the origin\n",
                        call("check", model).stderr)
    assert box.rstrip().endswith(";")
    model.write_text(box.rstrip()[:-1].rsplit(",", 1)[0] + ",nan;\n")
    assert re.match(r"gpu_shading: error: model\.idf: surface LOUVRE 1: vertex \d is \(.*nan.*\) m, expected",
                    call("check", model).stderr)


@pytest.mark.parametrize("levels, height, message", [
    (None, "100000", 'Default Height is "100000", expected a number above 0 and at most 10000 m'),
    (None, "10001", 'Default Height is "10001", expected a number above 0 and at most 10000 m'),
    (5000, "", "building:levels is 5000 of 3 m each, expected a height of at most 10000 m"),
    (3000, "10000", None),
])
def test_no_building_is_higher_than_promised(call, box, model, tmp_path, levels, height, message):
    ring = [[-105.0, 40.0], [-104.999, 40.0], [-104.999, 40.001], [-105.0, 40.001], [-105.0, 40.0]]
    (tmp_path / "town.geojson").write_text(json.dumps({
        "type": "Feature", "properties": {"building:levels": levels},
        "geometry": {"type": "Polygon", "coordinates": [ring]}}))
    model.write_text(box + f"GPUShading:SiteContext,Town,town.geojson,,,,,{height};\n")
    done = call("check", model)
    assert message in done.stderr if message else done.returncode == 0, done.stderr


@pytest.mark.skipif((os.cpu_count() or 1) > 4, reason="the stacks of many threads take addresses too")
@pytest.mark.parametrize("mebibytes, message", [
    (390, "; ulimit -v allows 390 MiB of addresses, and decoding needs 600"),
    (440, "it takes more than 440 MiB of memory"),
    (600, None),
])
def test_a_texture_in_little_memory_is_read_or_said(patched, box, model, weather, tmp_path, mebibytes, message):
    write_grey_image(tmp_path / "tile.png", [[255, 0, 90], [0, 255, 0]])
    model.write_text(box + "GPUShading:PerforatedScreen,Image,Louvre*,Texture,tile.png,,,,,,0.001;\n")

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (mebibytes << 20, mebibytes << 20))

    done = subprocess.run([patched, "--gpu-shading", "-D", "-w", weather, "-d", tmp_path / "out", model], text=True,
                          capture_output=True, preexec_fn=limit)
    assert done.returncode == (1 if message else 0), done.stderr
    assert "terminate called" not in done.stderr
    assert (message or "shading rendered by CPU") in done.stderr


def faults(call, model):
    """Minor page faults of a check, in all its processes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt
    done = call("check", model)
    assert done.returncode == 0, done.stderr
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt - before


def meshes(box, files):
    return box + "".join(f"GPUShading:Geometry,Tree {i},{file},m,Z;\n" for i, file in enumerate(files))


def test_a_mesh_does_not_cost_thousands_of_page_faults(call, box, model, tmp_path):
    """Assimp fills 16 MiB for each OBJ file: 4,096 pages of 4 KiB, which are most of the time of a small one."""
    if not HUGE_PAGES.is_file() or "[never]" in HUGE_PAGES.read_text():
        pytest.skip("this system has no transparent huge pages")
    count = 20
    for i in range(count):
        (tmp_path / f"{i}.obj").write_text(TRIANGLE)
    model.write_text(meshes(box, ["0.obj"]))
    one = faults(call, model)
    model.write_text(meshes(box, [f"{i}.obj" for i in range(count)]))
    assert (faults(call, model) - one) / (count - 1) < 3000


def test_a_file_that_many_objects_name_is_decoded_once(call, box, model, tmp_path):
    (tmp_path / "tree.obj").write_text(TRIANGLE)
    model.write_text(meshes(box, ["tree.obj"]))
    one = faults(call, model)
    count = 100
    model.write_text(meshes(box, ["tree.obj"] * count))
    assert (faults(call, model) - one) / count < 50
    names = {surface["name"] for surface in json.loads(call("check", "--json", model).stdout)["surfaces"]}
    assert sum(name.startswith("TREE ") for name in names) == count


def rows_of(folder, name):
    with open(folder / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.fixture
def report(patched, weather, tmp_path):
    def run(model, folder, *options):
        done = subprocess.run([patched, "--gpu-shading", f"--gpu-shading-report={folder}", *options, "-w", weather,
                               "-d", tmp_path / "out", model], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return rows_of(folder, "sunlit.csv")

    return run


def test_a_warm_cache_has_the_rows_of_a_cold_one(report, model, tmp_path):
    cache = f"--gpu-shading-cache={tmp_path / 'cache'}"
    cold = report(model, tmp_path / "cold", "-D", cache)
    warm = report(model, tmp_path / "warm", "-D", cache)
    assert len(cold) > 100 and cold == warm
    assert report(model, tmp_path / "without", "-D") == cold
    assert rows_of(tmp_path / "cold", "pictures.csv") == rows_of(tmp_path / "warm", "pictures.csv")


def test_the_highest_sun_is_a_sun(report, courtyard, tmp_path):
    """The sky's patches, which EnergyPlus asks about too, are not drawn as the sun."""
    rows = report(courtyard, tmp_path / "report", "-D")
    altitude = "sun altitude [deg]"
    suns = [float(row[altitude]) for row in rows_of(tmp_path / "report", "run_hours.csv")]
    # Between the ends of two hours it gains less than 3 degrees on the higher one.
    assert max(float(row[altitude]) for row in rows) > max(suns) + 3.0, "no patch of the sky is higher than the sun"
    drawn = [float(row[altitude]) for row in rows_of(tmp_path / "report", "pictures.csv")]
    assert drawn and max(drawn) < max(suns) + 3.0


def test_a_page_names_no_folder_of_this_computer(patched, report, model, weather, tmp_path):
    folder = tmp_path / "report"
    made = subprocess.run([patched.parent / "gpu_shading", "map", model, "-w", weather, "--from", "06-21", "--to",
                           "06-21", "--spacing", "1", "-o", folder / "maps"], capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    for array in (folder / "maps").glob("*.npy"):
        array.write_bytes(b"cut")
    report(model, folder, "-D")
    notes = [row["value"] for row in rows_of(folder, "run_facts.csv") if row["fact"] == "Note"]
    assert any(note.startswith("Maps are left out: maps/") for note in notes), notes
    for name in ("index.html", "run_facts.csv"):
        assert str(tmp_path) not in (folder / name).read_text(encoding="utf-8")


def test_a_comparison_s_report_names_no_folder_of_this_computer(patched, model, weather, tmp_path):
    other = tmp_path / "elsewhere" / "side.idf"
    other.parent.mkdir()
    other.write_text("GPUShading:TransparentShade,Glass,*,Constant,0.35;\n")
    done = subprocess.run([energyplus.REPOSITORY / "scripts" / "compare_shading", model, "-w", weather, "-o",
                           tmp_path / "out", "--runs", "gpu", f"gpu --gpu-shading-file={other}", "--", "-D"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for name in ("report.html", "report.csv"):
        text = (tmp_path / "out" / name).read_text(encoding="utf-8")
        assert str(tmp_path) not in text and "--gpu-shading-file=side.idf" in text


def test_mean_sunlit_fractions_are_the_same_everywhere(official, patched, report, model, weather, tmp_path):
    """On the page of a run, in the comparison's tables and in its report: 1 without shade, though hours are faced in
    part."""
    report(model, tmp_path / "page", "-D")
    page = {row["receiver"]: row["mean sunlit fraction"] for row in rows_of(tmp_path / "page", "run_receivers.csv")}
    done = subprocess.run([energyplus.REPOSITORY / "scripts" / "compare_shading", model, "-w", weather, "-o",
                           tmp_path / "compared", "--", "-D"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    table = {row["receiver"]: row for row in rows_of(tmp_path / "compared", "receivers.csv")}
    for name in ("EAST", "WEST", "ROOF"):
        assert float(page[name]) == float(table[name]["clip sunlit"]) == 1.0, name
    # The mean of EnergyPlus's own hourly values is below.
    values = [float(row["clip sunlit fraction"]) for row in rows_of(tmp_path / "compared", "hourly.csv")
              if row["receiver"] == "EAST"]
    assert sum(values) / len(values) < 0.99
    assert float(table["SOUTH WINDOW"]["clip sunlit"]) < 0.99
    assert float(page["SOUTH WINDOW"]) == pytest.approx(float(table["SOUTH WINDOW"]["clip sunlit"]), abs=1e-4)
    # All receivers are in each of the tables, and the one that the sun does not face has no mean.
    rows = Tables((tmp_path / "compared" / "report.html").read_text(encoding="utf-8")).tables["table-receivers"][1:]
    assert [row[0] for row in rows] == list(table)
    north = next(row for row in rows if row[0] == "NORTH")
    assert page["NORTH"] == table["NORTH"]["clip sunlit"] == "" and north[3:5] == ["0", "–"]


# What users give by mistake: (file names and texts, arguments of energyplus, the message)
MISTAKES = {
    "a ZIP archive as weather": ({"w.zip": "PK\x03\x04x"}, ["-w", "w.zip", "model.idf"],
                                 "-w w.zip: is a ZIP archive; expected the weather file (.epw) in it: unpack it"),
    "a model as weather": ({}, ["-w", "model.idf", "model.idf"],
                           "-w model.idf: is not a weather file (.epw), which begins with LOCATION"),
    "an empty IDF": ({"empty.idf": " \n! nothing\n"}, ["empty.idf"], "empty.idf: has no objects; expected a model"),
    "an empty epJSON": ({"empty.epJSON": "{}"}, ["empty.epJSON"], "empty.epJSON: has no objects; expected a model"),
    "no such model": ({}, ["nowhere.idf"], "nowhere.idf: no such file"),
    "an OpenStudio model": ({"m.osm": "OS:Version,a,3.9.0;"}, ["m.osm"],
                            "m.osm: is an OpenStudio model; expected an .idf or .epJSON file: export it as IDF from "
                            "OpenStudio"),
    "an OpenStudio model as IDF": ({"m.idf": "OS:Version,a,3.9.0;"}, ["m.idf"],
                                   "m.idf: is an OpenStudio model; expected an IDF: export it from OpenStudio"),
    "a Honeybee model": ({"m.hbjson": '{"type": "Model"}'}, ["m.hbjson"],
                         "m.hbjson: is a Honeybee model; expected an .idf or .epJSON file: translate it with "
                         "honeybee-energy translate model-to-idf"),
    "a Honeybee model as epJSON": ({"m.epJSON": '{"type": "Model"}'}, ["m.epJSON"],
                                   "m.epJSON: is JSON of another program (a Honeybee model?); expected epJSON: "
                                   "translate it with honeybee-energy translate model-to-idf"),
    "weather as a model": ({"w.epw": "LOCATION,a"}, ["w.epw"],
                           "w.epw: is a weather file; expected an .idf or .epJSON file: -w names the weather file"),
    "macros": ({"m.idf": f"Version,{input_version()};\n\n  ##include other.idf\n"}, ["m.idf"],
               "m.idf: line 3: ##include is a macro: run energyplus with -m, so that EPMacro expands it, or give the "
               "expanded IDF"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_wrong_file_is_explained(call, launch, model, tmp_path, mistake):
    files, arguments, message = MISTAKES[mistake]
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    checked = call("check", *[each for each in arguments if each != "-D"])
    for done in (checked, launch(*arguments)):
        assert (done.returncode, done.stderr) == (1, f"gpu_shading: error: {message}\n")


def test_latin_1_is_named_with_its_line(call, launch, box, tmp_path):
    text = box.replace("South Window", "Südfenster")
    (tmp_path / "model.idf").write_text(text, encoding="latin-1")
    line = next(number for number, words in enumerate(text.splitlines(), 1) if "Südfenster" in words)
    for done in (call("check", "model.idf"), launch("model.idf")):
        assert done.returncode == 1 and done.stderr.startswith(
            f"gpu_shading: error: model.idf: line {line}: FenestrationSurface:Detailed S")
        assert done.stderr.endswith(" is not UTF-8 text (Latin-1?): save the file as UTF-8\n")
    # EnergyPlus does not mind comments.
    (tmp_path / "model.idf").write_text(box + "! Büro\n", encoding="latin-1")
    assert launch("model.idf").returncode == 0


@pytest.mark.parametrize("type_, fields", [("HVACTemplate:Thermostat", "All,,20,,26"),
                                           ("GroundHeatTransfer:Control", "Ground,Yes,No")])
def test_templates_need_a_flag(launch, box, model, type_, fields):
    model.write_text(f"{box}{type_},{fields};\n")
    assert launch("model.idf").stderr == (f"gpu_shading: error: model.idf: {type_} needs ExpandObjects: give -x to "
                                          "energyplus\n")


def test_a_comment_about_templates_needs_none(launch, box, model):
    model.write_text(box + "! HVACTemplate:Thermostat\n")
    assert launch("model.idf").returncode == 0


def test_a_missing_weather_file_is_named_before_the_run(patched, box, model, weather, tmp_path):
    def run(*arguments):
        return subprocess.run([patched, "--gpu-shading", "-d", "out", *arguments, "model.idf"], capture_output=True,
                              text=True, cwd=tmp_path)

    message = ("gpu_shading: error: -w: a weather file (.epw) is required for the run periods of model.idf; -D runs "
               "design days alone\n")
    assert run().stderr == message and run("-a").stderr == message
    assert run("-D").returncode == 0
    model.write_text(box.replace("Yes;                     !- Run Simulation for Weather", "No;  !- Weather"))
    assert run().stderr != message
    model.write_text(box)
    (tmp_path / "in.epw").symlink_to(weather)
    assert run().returncode == 0


def test_the_first_error_of_energyplus_is_shown(launch, box, model, tmp_path):
    model.write_text(box + "Schedule:Constant,Wrong,Nowhere Limits,word;\nSchedule:Constant,Worse,,word;\n")
    done = launch("model.idf")
    assert done.returncode == 1
    first = next(text for text in (tmp_path / "out" / "eplusout.err").read_text().splitlines() if "** Severe" in text)
    assert done.stderr.splitlines()[-1] == (f"gpu_shading: error: model.idf: EnergyPlus stopped: Severe: "
                                            f"{first.split('** ')[-1].strip()}; more in out/eplusout.err")


@pytest.mark.parametrize("arguments, message", [
    (("run", "model.idf"), "run: no such subcommand; to run a model, type energyplus --gpu-shading -w WEATHER.epw "
     "model.idf"),
    (("simulate",), "simulate: no such subcommand; to run a model, type energyplus --gpu-shading -w WEATHER.epw "
     "MODEL.idf"),
    (("model.idf",), "model.idf: expected a subcommand before it, such as check model.idf; to run a model, type "
     "energyplus --gpu-shading -w WEATHER.epw model.idf"),
    (("veiw", "model.idf"), "veiw: no such subcommand; did you mean view?"),
    (("view", "model.idf", "--sun", "180,40", "-o", "o.txt"), "-o o.txt: expected the name of a picture, such as o.png "
     "(also .jpg, .tif, .gif, .bmp, .tga and .exr)"),
    (("map", "model.idf", "-w", "w.epw", "-o", "o.txt"), "--output: o.txt: expected the name of a folder, which gets "
     "several files"),
    (("sample", "model.idf", "-w", "w.epw", "-o", "year.csv"), "--output: year.csv: expected the name of a folder, "
     "which gets several files"),
])
def test_guesses_are_answered(call, model, weather, tmp_path, arguments, message):
    (tmp_path / "w.epw").symlink_to(weather)
    before = sorted(tmp_path.iterdir())
    done = call(*arguments)
    assert (done.returncode, done.stderr) == (1, f"gpu_shading: error: {message}\n")
    assert sorted(tmp_path.iterdir()) == before


def test_a_side_file_that_is_read_is_named(call, launch, model, tmp_path):
    said = "GPUShading:... objects are also read from model.gpu-shading.idf"
    for present in (False, True):
        if present:
            (tmp_path / "model.gpu-shading.idf").write_text("GPUShading:TransparentShade,Half,Louvre 1,Constant,0.5;\n")
        assert (said in call("check", "model.idf").stdout) == present
        assert (said in launch("model.idf").stderr) == present
        assert (said in (tmp_path / "out" / "eplusout.err").read_text()) == present


@pytest.mark.parametrize("objects, said", [
    ("Shading:Building:Detailed,Old House,,4, -20,30,9, -20,-20,9, 30,-20,9, 30,30,9;\n",
     "Shading:Building:Detailed OLD HOUSE lies over the whole model: if it is the modelled building itself, remove it"),
    ("Shading:Building,Old House,180,0,-20,-20,9,50,50;\n",
     "Shading:Building OLD HOUSE lies over the whole model: if it is the modelled building itself, remove it"),
    ("Shading:Site:Detailed,Ground,,4, -20,30,-1, -20,-20,-1, 30,-20,-1, 30,30,-1;\n", None),
    ("Shading:Building:Detailed,Next Door,,4, 20,30,9, 20,-20,9, 70,-20,9, 70,30,9;\n", None),
    ("Shading:Building:Detailed,Glass,,4, -20,30,9, -20,-20,9, 30,-20,9, 30,30,9;\n"
     "GPUShading:TransparentShade,Roof,Glass,Constant,0.9;\n", None),
    ("GPUShading:SiteContext,Town,town.geojson,,,,,9;\n", "encloses the model's"),
])
def test_a_neighbour_that_encloses_the_model_is_named(call, launch, box, model, tmp_path, objects, said):
    ring = [[-105.181, 39.739], [-105.179, 39.739], [-105.179, 39.741], [-105.181, 39.741], [-105.181, 39.739]]
    (tmp_path / "town.geojson").write_text(json.dumps({
        "type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}))
    model.write_text(box + objects)
    for text in (call("check", "model.idf").stdout, launch("model.idf").stderr):
        if said:
            assert said in text
        else:
            assert "lies over the whole model" not in text and "encloses" not in text

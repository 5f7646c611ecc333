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


def test_lengths_in_millimetres_are_questioned(call, box, model):
    question = "lengths are in metres, is it in millimetres?"
    model.write_text(box + SCREEN.format("Louvre 1", 6.35, 8.55, 0.00635))
    done = call("check", "model.idf")
    assert done.returncode == 0 and f"Hole Size is 6.35 m, more than 1 m: {question}" in done.stdout
    model.write_text(box + SCREEN.format("Louvre 1", 0.00635, 0.00855, 6.35))
    done = call("check", "model.idf")
    assert done.returncode == 1 and done.stderr.endswith(f": {question}\n") and 'Thickness is "6.35"' in done.stderr


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
                                'sky_model; did you mean resolution?\n')


@pytest.fixture
def launch(patched, weather, tmp_path):
    """EnergyPlus for a day, in the test's folder."""
    def run(*arguments, flags=("--gpu-shading",)):
        done = subprocess.run([patched, *flags, "-D", "-w", weather, "-d", "out", *arguments], capture_output=True,
                              text=True, cwd=tmp_path)
        assert "filesystem error" not in done.stderr and "json.exception" not in done.stderr
        return done

    return run


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


def test_a_model_of_another_version_is_named(call, launch, box, model):
    model.write_text(re.sub(r"(Version,\s*)[\d.]+", r"\g<1>24.1", box))
    for done in (call("check", "model.idf"), launch("model.idf")):
        assert done.stderr.startswith("gpu_shading: error: model.idf: Version: Version Identifier is 24.1, this ")


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

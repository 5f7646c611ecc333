"""What our programs write is there as a whole or not at all, and the user's files are as they were."""

import contextlib
import os
import signal
import subprocess
import time

import pytest
import window_with_shades
from PIL import Image
from shading_runs import energyplus

STAGE = ".gpu_shading-"


@pytest.fixture
def model(tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(window_with_shades.model("south", True, True))
    return path


@pytest.fixture
def program(patched):
    def call(*arguments, **options):
        options = {"capture_output": True, "text": True, "stdin": subprocess.DEVNULL} | options
        return subprocess.run([call.path, *arguments], **options)

    call.path = patched.parent / "gpu_shading"
    return call


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name != "full" and STAGE not in str(path)}


def one_error(done):
    assert done.returncode == 1
    lines = done.stderr.splitlines()
    assert len(lines) == 1 and lines[0].startswith("gpu_shading: error: "), done.stderr
    return lines[0]


# Files that ExpandObjects overwrites or deletes in the current folder.
OWN_FILES = ("expanded.idf", "in.idf", "Energy+.idd", "expandedidf.err")


@pytest.fixture
def templates(model):
    """A model that has to be expanded, beside files of the user under the names of that."""
    model.write_text(model.read_text() + "HVACTemplate:Thermostat,Unused,,20,,26;\n")
    for name in OWN_FILES:
        (model.parent / name).write_text(f"the user's own {name}\n")
    return model


def test_check_of_templates_writes_nothing_beside_the_model(program, templates):
    before = contents(templates.parent)
    calls = [subprocess.Popen([program.path, "check", templates.name], cwd=templates.parent, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) for _ in range(3)]
    answers = [(*call.communicate(), call.returncode) for call in calls]
    assert [status for _, _, status in answers] == [0, 0, 0], answers
    assert "WINDOW" in answers[0][0] and len({printed for printed, _, _ in answers}) == 1
    assert contents(templates.parent) == before


def test_templates_in_a_folder_that_cannot_be_written(program, templates, tmp_path_factory):
    if os.geteuid() == 0:
        command = ["unshare", "--mount", "sh", "-c",
                   'mount --bind "$0" "$0" && mount -o remount,bind,ro "$0" && cd "$0" && exec "$@"', templates.parent]
        tried = subprocess.run([*command, "true"], capture_output=True, text=True)
        if tried.returncode != 0:
            pytest.skip(f"no folder can be mounted read-only: {tried.stderr.strip()}")
    else:
        templates.parent.chmod(0o500)
        command = ["env", "-C", templates.parent]
    for name in OWN_FILES:
        (templates.parent / name).unlink(missing_ok=True)
    temporary = tmp_path_factory.mktemp("temporary")
    done = subprocess.run([*command, program.path, "check", templates.name], capture_output=True, text=True,
                          env={**os.environ, "TMPDIR": str(temporary)})
    templates.parent.chmod(0o700)
    assert done.returncode == 0, done.stderr
    assert "WINDOW" in done.stdout


@pytest.mark.parametrize("options", [["-d", "out"], ["--output-directory=out"]])
def test_run_of_templates_leaves_the_users_files(options, patched, templates, weather):
    before = contents(templates.parent)
    done = subprocess.run([patched, "--gpu-shading", "-x", "-D", "-w", weather, *options, templates.name],
                          cwd=templates.parent, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    out = templates.parent / "out"
    assert "HVACTemplate" in (out / "eplusout.expidf").read_text()
    assert "Successfully" in (out / "eplusout.end").read_text()
    after = {name: data for name, data in contents(templates.parent).items() if name.parts[0] != "out"}
    assert after == before


def test_export_of_templates_leaves_the_users_files(program, templates, weather):
    templates.write_text(templates.read_text() + "RunPeriod,June day,6,21,,6,21;\n")
    before = contents(templates.parent)
    done = program("export", templates.name, "-x", "-w", weather, "--scheduled", "shaded", cwd=templates.parent)
    assert done.returncode == 0, done.stderr
    after = contents(templates.parent)
    made = {name for name in after if name.parts[0] == "shaded"}
    assert made
    assert {name: data for name, data in after.items() if name not in made} == before


VIEWS = {
    "png": ("--sun", "180,40", "-o", "sun.png", "--size", "300"),
    "gif": ("--day", "06-21", "-o", "day.gif", "--size", "100"),
    "list": ("--list", "views.txt", "-o", ".", "--size", "300"),
}


@pytest.mark.parametrize("kind", VIEWS)
def test_view_onto_a_full_disk_leaves_the_old_pictures(kind, program, model, small_disk):
    folder, fill = small_disk(2000, 4)
    (folder / "views.txt").write_text("a.png 180 40 Window\nb.png 150 30\n")
    assert program("view", model, *VIEWS[kind], cwd=folder).returncode == 0
    before = contents(folder)
    assert len(before) == {"png": 2, "gif": 2, "list": 3}[kind]
    fill()
    # Other pictures than before.
    arguments = [word.replace("180,40", "150,20").replace("06-21", "03-21") for word in VIEWS[kind]]
    error = one_error(program("view", model, *arguments, cwd=folder))
    assert "No space left on device" in error
    assert contents(folder) == before


@pytest.mark.parametrize("command", ["view", "check"])
def test_a_full_folder_for_temporary_files_is_an_error(command, program, model, small_disk, tmp_path):
    folder, fill = small_disk(100, 4)
    fill()
    arguments = ["--sun", "180,40", "-o", tmp_path / "sun.png"] if command == "view" else []
    done = program(command, model, *arguments, env={**os.environ, "TMPDIR": str(folder)})
    assert "No space left on device" in one_error(done)
    assert done.stdout == ""
    assert not (tmp_path / "sun.png").exists()


def test_listing_that_cannot_be_printed_is_an_error(program, model):
    with open("/dev/full", "w") as full:
        done = program("check", model, capture_output=False, stdout=full, stderr=subprocess.PIPE)
    assert "standard output: " in one_error(done) or "No space" in done.stderr


def test_check_says_when_a_texture_cannot_be_decoded(program, model, tmp_path):
    Image.effect_noise((64, 64), 50).save(tmp_path / "mesh.png")
    data = (tmp_path / "mesh.png").read_bytes()
    (tmp_path / "mesh.png").write_bytes(data[: len(data) // 2])
    model.write_text(model.read_text() + "GPUShading:PerforatedScreen,Mesh,*Fin,Texture,mesh.png,,,,,,0.003;\n")
    done = program("check", model)
    assert done.returncode == 1 and done.stdout == ""
    assert "mesh.png" in one_error(done)


def run(patched, model, weather, report, folder, **options):
    return energyplus.run(patched, model, weather, folder,
                          ["--gpu-shading", f"--gpu-shading-report={report}", "-D"], **options)


def test_report_on_a_full_disk_is_an_error_and_leaves_the_old_one(patched, model, weather, small_disk, tmp_path):
    folder, fill = small_disk(2000, 8)
    report = folder / "report"
    done = run(patched, model, weather, report, tmp_path / "first")
    assert done.completed, done.why()
    before = contents(report)
    assert {"sunlit.csv", "pictures.csv", "stages.csv"} < {path.name for path in before}
    fill()
    done = run(patched, model, weather, report, tmp_path / "second")
    assert not done.completed and done.status != 0
    assert "--gpu-shading-report" in done.errors and "No space left on device" in done.errors
    assert contents(report) == before


def test_a_killed_run_leaves_the_old_report(patched, model, weather, tmp_path):
    """The table was emptied when a run began. A run that ends before the kill writes the same but for its times."""
    report = tmp_path / "report"
    first = run(patched, model, weather, report, tmp_path / "first")
    assert first.completed, first.why()

    def but_for_times():
        return {path: data for path, data in contents(report).items() if path.name != "stages.csv"}

    before = but_for_times()
    for share in (0.3, 0.6, 0.8):
        kill_after(share * first.wall, [patched, "--gpu-shading", f"--gpu-shading-report={report}", "-D",
                                        "-w", weather, "-d", tmp_path / "killed", model])
        assert but_for_times() == before
        assert (report / "stages.csv").read_text().startswith("stage,seconds\n")


def test_report_is_not_written_through_a_link(patched, model, weather, tmp_path):
    report = tmp_path / "report"
    report.mkdir()
    (tmp_path / "mine.csv").write_text("mine")
    (report / "sunlit.csv").symlink_to(tmp_path / "mine.csv")
    done = run(patched, model, weather, report, tmp_path / "out")
    assert done.status != 0
    assert f"--gpu-shading-report: {report / 'sunlit.csv'}: cannot be written (it is a link" in done.errors
    assert (tmp_path / "mine.csv").read_text() == "mine"


def test_pictures_of_alike_names_are_all_there(patched, model, weather, tmp_path):
    names = ["W 1", "W.1", "W_1", "S\u00fcd/Fenster", "\u5357"]
    text = model.read_text()
    start = text.index("FenestrationSurface:Detailed,Window")
    end = text.index(";", start) + 1
    width = window_with_shades.SIZE / len(names)
    windows = []
    for number, name in enumerate(names):
        left = number * width - window_with_shades.SIZE / 2
        corners = [(left, 4.0), (left, 1.0), (left + width, 1.0), (left + width, 4.0)]
        windows.append(f"FenestrationSurface:Detailed,{name},Window,Window,Front,,,,,4,\n"
                       + ",\n".join(f"  {x},0,{z}" for x, z in corners) + ";\n")
    model.write_text(text[:start] + "".join(windows) + text[end:], encoding="utf-8")
    report = tmp_path / "report"
    done = run(patched, model, weather, report, tmp_path / "out")
    assert done.completed, done.why()
    rows = [line.split(",") for line in (report / "pictures.csv").read_text(encoding="utf-8").splitlines()[1:]]
    pictures = [row[0].strip('"') for row in rows]
    assert len(set(pictures)) == len(pictures)
    assert sorted(pictures) == sorted(path.name for path in report.glob("*.png"))
    assert {row[1].strip('"') for row in rows} >= {name.upper() for name in names[:3]}
    assert any(name.startswith("\u5357_") for name in pictures)
    for name in pictures:
        with Image.open(report / name) as picture:
            picture.load()


def test_a_name_that_is_given_twice_is_refused(program, model, tmp_path):
    (tmp_path / "views.txt").write_text("a.png 180 40 Window\nb.png 180 40\n\na.png 150 40 Window\n")
    error = one_error(program("view", model, "--list", tmp_path / "views.txt", "-o", tmp_path / "out"))
    assert 'views.txt, line 4: "a.png"' in error and "line 1" in error
    assert not (tmp_path / "out").exists()


def kill_after(seconds, command, **options):
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True, **options)
    time.sleep(seconds)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def test_a_killed_view_leaves_whole_pictures(patched, program, model, tmp_path):
    folder = tmp_path / "pictures"
    lines = [f"{number:03}.png {100 + number} 30\n" for number in range(60)]
    (tmp_path / "views.txt").write_text("".join(lines))
    arguments = ["view", model, "--list", tmp_path / "views.txt", "-o", folder, "--size", "200"]
    began = time.monotonic()
    assert program(*arguments).returncode == 0
    whole = time.monotonic() - began
    before = contents(folder)
    assert len(before) == len(lines)
    # Among others where it copies its pictures, at the end.
    for share in (0.2, 0.9, 0.94, 0.96, 0.98, 1.0):
        kill_after(share * whole, [patched.parent / "gpu_shading", *arguments])
        for path in folder.glob("*.png"):
            with Image.open(path) as picture:
                picture.load()
        assert len(list(folder.glob("*.png"))) == len(lines)
    assert program(*arguments).returncode == 0
    assert contents(folder) == before
    assert [path.name for path in folder.iterdir() if path.name.startswith(STAGE)] == []


def test_export_is_there_as_a_whole(patched, program, model, weather, tmp_path):
    folder = model.parent / "exported"
    folder.mkdir()
    arguments = ["export", model, "-w", weather, "--scheduled", folder]
    done = program(*arguments)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == str(folder / "model.idf")
    assert (folder / "model.idf").is_file() and not (folder / "exported").exists()
    assert not list(folder.glob(STAGE + "*")) and not list(folder.parent.glob(STAGE + "*"))


def test_export_links_only_what_the_model_needs(official, program, model, weather):
    folder = model.parent
    text = model.read_text().replace("SimulationControl,No,No,No,Yes,No;", "SimulationControl,No,No,No,No,Yes;")
    model.write_text(text + "RunPeriod,June day,6,21,,6,21;\nOutput:Variable,*,Schedule Value,Hourly;\n"
                     "Schedule:File,Occupancy,,data\\occupancy.csv,1,0;\n")
    (folder / "data").mkdir()
    (folder / "data" / "occupancy.csv").write_text("0.25\n" * 8760)
    (folder / "model.rvi").write_text("eplusout.eso\nchosen.csv\n0\n")
    for old in ("eplusout.eso", "eplusout.sql", "model.err", "notes.txt", "data/other.csv", "earlier/eplusout.end"):
        (folder / old).parent.mkdir(exist_ok=True)
        (folder / old).write_text("earlier")
    done = program("export", model, "-w", weather, "--scheduled", folder / "exported")
    assert done.returncode == 0, done.stderr
    exported = folder / "exported"
    names = {str(path.relative_to(exported)) for path in exported.rglob("*") if not path.is_dir()}
    assert names == {"model.idf", "gpu_shading_sunlit.csv", "data/occupancy.csv", "model.rvi"}
    run = energyplus.run(official, exported / "model.idf", weather, folder / "out", [])
    assert run.completed, run.why()
    assert ",0.25\n" in (folder / "out" / "eplusout.eso").read_text()


@pytest.mark.parametrize("option", ["--convert-only", "--convert", "-c"])
def test_conversion_loses_no_object(option, patched, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box + "GPUShading:Settings,,timestep;\n")
    call = [patched, "--gpu-shading", option, "-d", "out", model.name]
    refused = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True)
    assert refused.returncode == 1
    assert refused.stderr == ("gpu_shading: error: model.idf: GPUShading:Settings would be lost in the conversion: "
                              "expected it in model.gpu-shading.idf\n")
    (tmp_path / "model.gpu-shading.idf").write_text("GPUShading:Settings,,timestep;\n")
    model.write_text(box)
    converted = subprocess.run([*call, "-D"], cwd=tmp_path, capture_output=True, text=True)
    assert converted.returncode == 0, converted.stderr
    assert list(tmp_path.rglob("model.epJSON")) or list(tmp_path.rglob("*.epJSON"))

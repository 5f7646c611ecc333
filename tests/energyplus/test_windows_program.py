"""gpu_shading.exe, reports, and files by the names that Windows has for them, under Wine."""

import csv
import os
import subprocess
from itertools import chain

import numpy as np
import pytest
import screened_room
import windows
from PIL import Image
from shading_runs import energyplus, input_file, results

FOLDER = "Мост 東京 ü"
SAME = 1e-4


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / FOLDER
    made.mkdir()
    return made


def call(wine, program, arguments, folder):
    """Runs a program of either system, which lies in the same place of a patched EnergyPlus."""
    is_windows = program.suffix == ".exe"
    environment = {key: value for key, value in os.environ.items()
                   if key != "DISPLAY" and not key.startswith("GPU_SHADING")}
    return subprocess.run([*(wine.before if is_windows else ()), program, *map(str, arguments)], cwd=folder,
                          env=environment | (wine.environment if is_windows else {}), capture_output=True, text=True,
                          encoding="utf-8", errors="replace", stdin=subprocess.DEVNULL)


@pytest.fixture
def on_both(wine, windows_patched, patched, folder):
    """Runs gpu_shading on both systems, each in a folder of its own; returns [(folder, output)], Windows first."""
    def run(files, *arguments):
        done = []
        for program in (windows_patched.parent / "gpu_shading.exe", patched.parent / "gpu_shading"):
            own = folder / program.name
            own.mkdir()
            for name, text in files.items():
                (own / name).write_text(text, encoding="utf-8")
            ended = call(wine, program, arguments, own)
            assert ended.returncode == 0, ended.stderr
            done.append((own, ended.stdout))
        return done

    return run


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def largest_difference(one, other):
    """Of the numbers of two tables, whose texts are equal."""
    assert [len(row) for row in one] == [len(row) for row in other]
    assert len(one) > 1
    most = 0.0
    for a, b in zip(chain(*one), chain(*other), strict=True):
        try:
            most = max(most, abs(float(a) - float(b)))
        except ValueError:
            assert a == b
    return most


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB"), dtype=int)


def test_check(on_both, courtyard):
    (_, ours), (_, linux) = on_both({"Häuser 家.idf": courtyard.read_text()}, "check", "Häuser 家.idf")
    # Reveals are numbered from the drawing.
    tables = [[line.rstrip() for line in text.splitlines() if " reveal " not in line] for text in (ours, linux)]
    assert len(tables[0]) > 20 and tables[0] == tables[1]


@pytest.mark.parametrize("form", ["drive", "slashes", "relative", "of any length"])
def test_names_of_files(wine, windows_patched, box, folder, form):
    (folder / "model.idf").write_text(box)
    name = windows.name_path(folder / "model.idf")
    if form == "slashes":
        name = name.replace("\\", "/")
    elif form == "relative":
        name = rf"..\{FOLDER}\model.idf"
    elif form == "of any length":
        name = "\\\\?\\" + name
    done = call(wine, windows_patched.parent / "gpu_shading.exe", ["check", name], folder)
    assert done.returncode == 0, done.stderr
    assert "SOUTH WINDOW" in done.stdout


def test_what_is_missing_is_named_as_it_was_given(wine, windows_patched, folder):
    name = rf"..\{FOLDER}\none.idf"
    done = call(wine, windows_patched.parent / "gpu_shading.exe", ["check", name], folder)
    assert done.returncode == 1
    assert done.stderr.strip() == f"gpu_shading: error: {name}: no such file"


def test_views_are_those_of_linux(on_both, courtyard):
    files = {"model.idf": courtyard.read_text(), "views.txt": "noon_ä.png 180 40\nmorning.png 120 20\n"}
    (ours, _), (linux, _) = on_both(files, "view", "model.idf", "--list", "views.txt", "-o", "pictures ü", "--size",
                                    "200")
    for name in ("noon_ä.png", "morning.png"):
        one, other = (pixels(each / "pictures ü" / name) for each in (ours, linux))
        assert one.shape == other.shape and len(np.unique(one.reshape(-1, 3), axis=0)) > 10
        assert np.mean(np.any(one != other, axis=2)) < 1e-3


def test_a_sheet_of_views(on_both, box):
    """Captions are drawn by other programs, in other fonts; all else is the same."""
    (ours, _), (linux, _) = on_both({"model.idf": box}, "view", "model.idf", "--day", "06-21", "-o", "day ü.png",
                                    "--size", "100")
    one, other = (pixels(each / "day ü.png") for each in (ours, linux))
    assert one.shape == other.shape
    differing = np.any(one != other, axis=2)
    assert 0 < np.mean(differing) < 0.15
    assert np.mean(np.any(one != 255, axis=2)[differing]) < 0.9
    # Grey is text alone: about as much of it.
    texts = [np.mean(np.all(each < 128, axis=2) & (np.ptp(each, axis=2) == 0)) for each in (one, other)]
    assert texts[0] == pytest.approx(texts[1], rel=0.5) and texts[0] > 0.003


def test_maps_are_those_of_linux(on_both, box, weather):
    (ours, _), (linux, _) = on_both({"model.idf": box}, "map", "model.idf", "-w", weather, "-o", "maps ü", "--from",
                                    "06-21", "--to", "06-21", "--receivers", "South Window", "--spacing", "0.2")
    tables = [rows_of(each / "maps ü" / "maps.csv") for each in (ours, linux)]
    assert largest_difference(*tables) < 1e-3
    pictures = [sorted((each / "maps ü").glob("*.png")) for each in (ours, linux)]
    assert [path.name for path in pictures[0]] == [path.name for path in pictures[1]] != []
    for one, other in zip(*pictures, strict=True):
        assert pixels(one).shape == pixels(other).shape


def test_samples_are_those_of_linux(on_both, box, weather):
    (ours, _), (linux, _) = on_both({"model.idf": box}, "sample", "model.idf", "-w", weather, "--mode", "coarse", "-o",
                                    "samples ü")
    for name in ("samples.csv", "year.csv"):
        assert largest_difference(*(rows_of(each / "samples ü" / name) for each in (ours, linux))) < SAME


def test_screens_are_those_of_linux(on_both):
    model = screened_room.model(screen="small holes")
    (ours, one), (linux, other) = on_both({"model.idf": model}, "screen", "model.idf", "-o", "screens ü")
    assert one.replace("\\", "/") == other
    names = [sorted(path.name for path in (each / "screens ü").iterdir()) for each in (ours, linux)]
    assert names[0] == names[1] != []
    for name in names[0]:
        if name.endswith(".csv"):
            assert largest_difference(*(rows_of(each / "screens ü" / name) for each in (ours, linux))) < 1e-6
        elif name.endswith(".png"):
            assert pixels(ours / "screens ü" / name).shape == pixels(linux / "screens ü" / name).shape


def of_two_days(text):
    model = input_file.Idf(text)
    model.remove(lambda name: name == "runperiod")
    model.add("RunPeriod", ["Days", 3, 1, 2017, 3, 2, 2017])
    results.instrument(model)
    return model


def test_an_exported_model_runs_without_us(on_both, wine, windows_official, weather, box, folder):
    text = of_two_days(box).contents()
    (ours, printed), (linux, _) = on_both({"model ö.idf": text}, "export", "model ö.idf", "-w", weather, "--scheduled",
                                          "expörted")
    assert printed.strip() == r"expörted\model ö.idf"
    tables = [rows_of(each / "expörted" / "gpu_shading_sunlit.csv") for each in (ours, linux)]
    assert largest_difference(*tables) < SAME
    run = wine.run_energyplus(windows_official, ours / "expörted" / "model ö.idf", weather, folder / "run")
    assert run.completed, run.why()
    assert run.method == "Scheduled"


def test_named_files_and_a_report(wine, windows_patched, patched, weather, louvres, folder):
    """Relative names hold; the page of a run has its pictures and tables."""
    data = "\n".join(f"{hour % 24 / 24:.4f}" for hour in range(8760)) + "\n"
    (folder / "model").mkdir()
    names = {"data.csv": "Louvre 1", r"more\data.csv": "Louvre 2", r"..\beside ü.csv": "Louvre 3"}
    text = of_two_days(louvres(3)).contents()
    for number, (name, louvre) in enumerate(names.items()):
        path = folder / "model" / name.replace("\\", "/")
        path.parent.mkdir(exist_ok=True)
        path.write_text(data)
        text = text.replace(f"{louvre},,4", f"{louvre},Opening {number},4")
        text += f"Schedule:File,Opening {number},,{name},1,0,8760,Comma,No,60,No;\n"
    assert text.count(",Opening") == 6
    (folder / "model" / "model.idf").write_text(text, encoding="utf-8")
    (folder / "report").mkdir()
    report = windows.name_path(folder / "report")
    ours = wine.run_energyplus(windows_patched, folder / "model" / "model.idf", weather, folder / "ours",
                               ["--gpu-shading", f"--gpu-shading-report={report}"])
    assert ours.completed, ours.why()
    (folder / "model" / "linux.idf").write_text(text.replace("\\", "/"), encoding="utf-8")
    linux = energyplus.run(patched, folder / "model" / "linux.idf", weather, folder / "linux",
                           ["--gpu-shading", "--gpu-shading-device=cpu"])
    assert linux.completed, linux.why()
    found = results.differences(results.Results(linux.folder), results.Results(ours.folder))
    assert any(0.05 < value < 0.95 for each in found for value in each.reference)
    assert max(each.largest for each in found) < SAME
    page = (folder / "report" / "index.html").read_text(encoding="utf-8")
    assert "SOUTH WINDOW" in page and "THREE" in page
    assert len(rows_of(folder / "report" / "run_receivers.csv")) > 1
    pictures = list((folder / "report").glob("*.png"))
    assert pictures and all(len(np.unique(pixels(path).reshape(-1, 3), axis=0)) > 1 for path in pictures)

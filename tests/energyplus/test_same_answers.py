"""The same input gives the same outputs: twice with the flag, and without it as the official program."""

import re
import shutil

import pytest
from output_files import differing, masked, snapshot
from shading_runs import energyplus, input_file, results


@pytest.fixture
def model(courtyard, tmp_path):
    model = input_file.read(courtyard)
    results.instrument(model)
    return input_file.place_copy(model, courtyard, tmp_path / "input")


def run(program, model, weather, folder, options):
    """The run and its outputs; all go to the same folder, since its name is in some of them."""
    shutil.rmtree(folder, ignore_errors=True)
    done = energyplus.run(program, model, weather, folder, options)
    return done, snapshot(folder)


def test_two_runs_write_the_same_outputs(patched, model, weather, tmp_path):
    runs = [run(patched, model, weather, tmp_path / "out", ["--gpu-shading", "-D", "-r"]) for _ in range(2)]
    assert all(done.completed for done, _ in runs)
    assert differing(runs[0][1], runs[1][1]) == []


@pytest.mark.parametrize("options", [["-D", "-r"], ["-D", "-r", "-s", "C", "-p", "model"]], ids=["plain", "named"])
def test_without_the_flag_it_is_the_official_program(official, patched, model, weather, tmp_path, options):
    stock, stock_files = run(official, model, weather, tmp_path / "out", options)
    same, same_files = run(patched, model, weather, tmp_path / "out", options)
    assert stock.status == same.status == 0
    assert masked(stock.output.encode()) == masked(same.output.encode())
    assert masked(stock.errors.encode()) == masked(same.errors.encode())
    assert differing(stock_files, same_files) == []


@pytest.mark.parametrize("arguments", [["--version"], ["--help"], ["--no-such-option"], ["missing.idf"]])
def test_without_the_flag_it_answers_as_the_official_program(official, patched, tmp_path, arguments):
    answers = []
    for program in (official, patched):
        done = energyplus.subprocess.run([program, *arguments], cwd=tmp_path, capture_output=True, text=True)
        # --help names the program by its path, and the minute at which it is asked.
        text = done.stdout.replace(str(program), "energyplus").replace(str(program.resolve()), "energyplus")
        if program == patched and arguments == ["--help"]:
            hint = "GPU shading: energyplus --gpu-shading --help lists its options\n\n"
            assert text.startswith(hint)
            text = text.removeprefix(hint)
        answers.append((done.returncode, re.sub(r"YMD=[\d. :]+", "", text), done.stderr))
    assert answers[0] == answers[1]


def test_without_the_flag_a_failing_run_fails_alike(official, patched, box, weather, tmp_path):
    broken = tmp_path / "broken.idf"
    broken.write_text(box.replace("Construction,Window,Glazing;", ""))
    stock, stock_files = run(official, broken, weather, tmp_path / "out", ["-D"])
    same, same_files = run(patched, broken, weather, tmp_path / "out", ["-D"])
    assert stock.status == same.status != 0
    assert masked(stock.errors.encode()) == masked(same.errors.encode())
    assert differing(stock_files, same_files) == []


def test_off_is_polygon_clipping(official, patched, model, weather, tmp_path):
    stock = energyplus.run(official, model, weather, tmp_path / "stock", ["-D"])
    off = energyplus.run(patched, model, weather, tmp_path / "off", ["--gpu-shading=off", "-D"])
    assert stock.completed and off.completed
    assert off.method == "PolygonClipping"
    reference, answer = results.Results(stock.folder), results.Results(off.folder)
    assert reference.values == answer.values

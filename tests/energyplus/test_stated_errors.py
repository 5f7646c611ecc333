"""The errors that a run states: in eplusout.eio and eplusout.err, in the tables and on the page of its report, and in
Python."""

import random
import re
import sys

import pytest
from output_files import rows_of
from shading_runs import energyplus, results

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
import gpu_shading  # noqa: E402

ROUNDING = "1e-07"
SHADE = "Shading:Building:Detailed, {}, , {}, {};\n"


def shade(name, *vertices):
    return SHADE.format(name, len(vertices), ", ".join(f"{value:.4f}" for vertex in vertices for value in vertex))


def leafy(box):
    """The box behind leaves, and an L of 11 mm, too thin to be brought within 1e-5."""
    model = box.replace("FullInteriorAndExterior", "FullExterior")
    assert model != box
    at = random.Random(7)
    for number in range(600):
        x, y, z, u, v = (at.uniform(low, high) for low, high in ((-1, 21), (-2, -1), (0, 4), (-0.1, 0.1), (-0.1, 0.1)))
        model += shade(f"Leaf {number}", (x, y, z), (x + 0.1, y + u, z), (x + 0.1, y + u + v, z + 0.1),
                       (x, y + v, z + 0.1))
    model += shade("Edge", (0, -0.5, 0), (60, -0.5, 0), (60, -0.5, 0.011), (0.011, -0.5, 0.011), (0.011, -0.5, 60),
                   (0, -0.5, 60))
    return model + f"Output:Variable, Edge, {results.SUNLIT}, Hourly;\n"


def run_of(folder, weather, text, **options):
    folder.mkdir()
    (folder / "model.idf").write_text(text)
    return gpu_shading.run(folder / "model.idf", weather, folder / "out", device="cpu", arguments=["-D"], **options)


def stated(run):
    """The fields of the line in eplusout.eio."""
    head, fields = re.search(r"^! <GPU Shading Error>, (.*)\nGPU Shading Error,(.*)$",
                             (run.folder / "eplusout.eio").read_text(), re.MULTILINE).groups()
    return dict(zip(head.split(", "), fields.split(","), strict=True))


@pytest.fixture(scope="module")
def missing(patched, box, weather, tmp_path_factory):
    return run_of(tmp_path_factory.mktemp("missing") / "run", weather, leafy(box), error=1e-5, report=True)


def test_the_line_counts_the_answers_of_the_table(missing):
    line = stated(missing)
    errors = [row["error"] for row in rows_of(missing.folder / "report" / "sunlit.csv")]
    sampled = sorted(float(error) for error in errors if error not in ("", ROUNDING))
    assert len(sampled) > 100 and errors.count(ROUNDING) > 100
    assert line["Target Error"] == "1e-05"
    assert int(line["Sampled Views"]) == len(sampled)
    assert int(line["Exact Views"]) == errors.count(ROUNDING)
    assert int(line["Views Without Measured Error"]) == errors.count("") == 0
    assert float(line["Largest Error"]) == sampled[-1]
    assert float(line["Error of 99 % of Sampled Views"]) == pytest.approx(sampled[-1 - len(sampled) // 100], rel=0.1)


def test_page_tables_and_python_state_the_same(missing):
    line = stated(missing)
    most = line["Error of 99 % of Sampled Views"]
    text = (f"99 % of {line['Sampled Views']} sampled views within {most}, all within {line['Largest Error']}; "
            f"{line['Exact Views']} views exact, within {ROUNDING}")
    report = missing.folder / "report"
    assert {"fact": "Errors of sunlit fractions", "value": text} in rows_of(report / "run_facts.csv")
    assert text in (report / "index.html").read_text()
    assert any(message.endswith(f"; errors: {text}") for message in missing.messages)
    errors = missing.summary().shading
    assert (errors.target, errors.sampled, errors.exact, errors.not_measured) == (
        1e-5, int(line["Sampled Views"]), int(line["Exact Views"]), 0)
    assert (errors.within, errors.largest) == (float(most), float(line["Largest Error"]))
    by_receiver = {}
    for row in rows_of(report / "sunlit.csv"):
        by_receiver.setdefault(row["receiver"], []).append(float(row["error"]))
    listed = {row["receiver"]: float(row["largest error"]) for row in rows_of(report / "run_receivers.csv")}
    assert listed and listed == {name: max(by_receiver[name]) for name in listed}


def test_a_receiver_that_misses_the_target_is_named(missing):
    [named] = re.findall(r"gpu_shading: sunlit fractions of 1 receiver cannot be brought within the target error of "
                         r"1e-05: EDGE \(within (.*)\); see docs/explanation/accuracy\.md",
                         (missing.folder / "eplusout.err").read_text())
    assert named == stated(missing)["Largest Error"] and float(named) > 2e-5


def test_threads_state_the_same(patched, box, weather, tmp_path):
    """At the default, no receiver misses its target."""
    lines = []
    for threads in (1, 2):
        run = run_of(tmp_path / f"{threads}", weather, leafy(box), threads=threads)
        lines.append(stated(run))
        assert "target error" not in (run.folder / "eplusout.err").read_text()
    assert lines[0] == lines[1]
    assert 1e-4 < float(lines[0]["Largest Error"]) <= 1e-3


def test_exact_views_state_rounding(patched, box, weather, tmp_path):
    run = run_of(tmp_path / "run", weather, box)
    line = stated(run)
    assert (line["Sampled Views"], line["Largest Error"]) == ("0", ROUNDING) and int(line["Exact Views"]) > 100
    assert any(message.endswith(f"; errors: {line['Exact Views']} views exact, within {ROUNDING}")
               for message in run.messages)


def test_a_fixed_resolution_states_that_errors_are_not_measured(patched, box, weather, tmp_path):
    run = run_of(tmp_path / "run", weather, leafy(box), resolution=64)
    line = stated(run)
    assert (line["Target Error"], line["Sampled Views"], line["Largest Error"]) == ("", "0", "")
    assert int(line["Views Without Measured Error"]) > 100
    errors = run.summary().shading
    assert (errors.target, errors.within, errors.largest) == (None, None, None)

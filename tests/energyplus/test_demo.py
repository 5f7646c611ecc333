"""The end of scripts/demo, with few louvres: what it says is what it measured."""

import re
import subprocess
import sys

from shading_runs import energyplus

SCRIPT = energyplus.REPOSITORY / "scripts" / "dev" / "demo_louvres"


def test_the_sentence_says_what_was_measured(patched, tmp_path):
    (tmp_path / "receivers.csv").write_text("receiver,gpu mean |d|\nWALL,2e-05\nROOF,0.00013\n")
    done = subprocess.run([sys.executable, SCRIPT, "60", "--compared", tmp_path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    seconds = {what: float(value) for what, value in re.findall(r"^  ([a-z ]+): ([\d.]+) s$", done.stdout, re.M)}
    assert set(seconds) == {"rendering", "polygon clipping"}
    shown = done.stdout.strip().splitlines()[-1]
    ratio = int(re.search(r"is (\d+) times as fast as polygon clipping behind 60 louvres", shown)[1])
    assert abs(ratio - seconds["polygon clipping"] / seconds["rendering"]) < 1 + 0.1 * ratio
    assert re.search(r"on CPU \(\d+ threads?, \w+\)|on .* Mesa|on .*GPU", shown), shown
    assert "differ by 1e-04 on average or less" in shown and shown.endswith(f"report: {tmp_path / 'report.html'}")
    assert [line for line in done.stderr.splitlines() if not line.startswith("demo_louvres: a year by ")] == []


def test_without_a_comparison_it_says_so(patched, tmp_path):
    done = subprocess.run([sys.executable, SCRIPT, "--compared", tmp_path], capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr.startswith("demo_louvres: ") and "receivers.csv" in done.stderr

"""`gpu_shading suite`: scores, messages, and what it does with scenes and tools that are not what they should be."""

import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
COMMAND = ROOT / "gpu_shading" / "python" / "gpu_shading" / "suite" / "__main__.py"
SCENE = {"scene": "one", "feature": "overhangs", "tests": "Half a wall.", "source": "made here", "tolerance": 1e-6,
         "surfaces": [{"name": "Wall", "receives": True, "casts": False,
                       "vertices": [[0, 0, 2], [0, 0, 0], [2, 0, 0], [2, 0, 2]]},
                      {"name": "Slat", "vertices": [[0, -1, 0.1], [0, -1, 0], [2, -1, 0], [2, -1, 0.1]],
                       "copies": {"count": 3, "step": [0, 0, 0.2]}}],
         "suns": [{"azimuth": 180, "altitude": 0.5, "sunlit": {"Wall": 0.5}}]}


def run(*arguments, **more):
    return subprocess.run([sys.executable, COMMAND, *arguments], capture_output=True, text=True, timeout=120, **more)


@pytest.fixture
def scenes(tmp_path):
    folder = tmp_path / "scenes"
    folder.mkdir()
    (folder / "one.json").write_text(json.dumps(SCENE))
    return folder


def tool(folder, name, body):
    """NAME=COMMAND of a script that has `scene` in its body."""
    script = folder / f"{name}.py"
    script.write_text(f"import json, sys, time\nscene = json.load(open(sys.argv[-1]))\n{body}\n")
    return f"--tool={name}={sys.executable} {script}"


def test_tools_are_scored_by_feature(tmp_path, scenes):
    other = SCENE | {"scene": "two", "feature": "glass | and more"}
    (scenes / "two.json").write_text(json.dumps(other))
    done = run(scenes, "-o", tmp_path / "out",
               tool(tmp_path, "right", "print(json.dumps([sun['sunlit'] for sun in scene['suns']]))"),
               tool(tmp_path, "off", "print('[{\"Wall\": 0.505}]')"),
               tool(tmp_path, "opaque", "print(json.dumps({'not supported': 'glass'}) if 'glass' in scene['feature'] "
                                        "else '[{\"Wall\": 0.5000001}]')"))
    assert done.returncode == 0, done.stderr
    assert "| overhangs | 1 | 1 / 1 / 1 of 1; 0 | 0 / 0 / 1 of 1; 0.005 | 1 / 1 / 1 of 1; 1e-07 |" in done.stdout
    assert "| glass \\| and more | 1 | 1 / 1 / 1 of 1; 0 | 0 / 0 / 1 of 1; 0.005 | not supported |" in done.stdout
    assert "| all | 2 | 2 / 2 / 2 of 2; 0 | 0 / 0 / 2 of 2; 0.005 | 1 / 1 / 1 of 1; 1e-07 |" in done.stdout
    assert (tmp_path / "out" / "scores.md").read_text() == done.stdout
    with open(tmp_path / "out" / "scores.csv", newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert [(row["scene"], row["tool"], row["error"]) for row in rows if row["tool"] == "off"] == [
        ("one", "off", "0.005"), ("two", "off", "0.005")]
    assert [row["why there is none"] for row in rows if row["tool"] == "opaque"] == ["", "not supported: glass"]
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"scores.md", "scores.csv", "one.png", "two.png"}


@pytest.mark.parametrize("body, why", [
    ("sys.exit('no licence')", "no licence"),
    ("sys.exit(3)", "ended with status 3"),
    ("print('nonsense')", "printed no answers"),
    ("print('[]')", "printed no answers: expected 1 suns"),
    ("print('[{\"Wall\": NaN}]')", "printed no answers: expected a number"),
    ("print('[{\"Wand\": 0.5}]')", "printed no answers: expected a fraction for each of Wall"),
    ("print('[' * 100000)", "printed no answers"),
    ("print('{\"answers\": 1}')", "printed no answers"),
    ("time.sleep(60)", "took more than 2 s"),
    ("sys.stdout.write('[' + ' ' * (1 << 25) + ']')", "printed no answers"),
])
def test_a_tool_without_answers_has_a_reason(tmp_path, scenes, body, why):
    done = run(scenes, "-o", tmp_path / "out", "--limit", "2", tool(tmp_path, "tool", body))
    assert done.returncode == 0, done.stderr
    assert "0 / 0 / 0 of 1; no answer" in done.stdout
    assert f"- one, tool: {why}" in done.stdout


def test_what_a_slow_tool_started_ends_with_it(tmp_path, scenes):
    body = ("import subprocess\nchild = subprocess.Popen(['sleep', '60'])\n"
            f"open({str(tmp_path / 'child')!r}, 'w').write(str(child.pid))\ntime.sleep(60)")
    done = run(scenes, "-o", tmp_path / "out", "--limit", "2", tool(tmp_path, "tool", body))
    assert "took more than 2 s" in done.stdout
    state = Path(f"/proc/{(tmp_path / 'child').read_text()}/stat")
    assert not state.exists() or state.read_text().split()[2] == "Z"


@pytest.mark.parametrize("text, why", [
    ("", "is not a scene of the suite: Expecting value"),
    ("[1]", "something is missing, or of another kind"),
    ("[" * 200_000, "is not a scene of the suite"),
    (json.dumps(SCENE | {"tolerance": "small"}), "expected a number"),
    (json.dumps(SCENE).replace("0.5}", "1e999}"), "expected a number"),
    (json.dumps(SCENE).replace('"count": 3', '"count": 1000000000'), "copies: expected a count of 1 to 100000"),
    (json.dumps(SCENE).replace('"Wall": 0.5', '"Wand": 0.5'), "expected a fraction for each of Wall"),
    (json.dumps({key: value for key, value in SCENE.items() if key != "suns"}), "suns is missing"),
])
def test_a_scene_that_is_none_is_refused(tmp_path, scenes, text, why):
    (scenes / "bad.json").write_text(text)
    done = run(scenes, "-o", tmp_path / "out", "--tool", "true")
    assert (done.returncode, done.stdout) == (1, "")
    [line] = done.stderr.splitlines()
    assert line.startswith(f"gpu_shading suite: {scenes / 'bad.json'}: ") and why in line
    assert not (tmp_path / "out").exists()


def test_a_pipe_is_no_scene(tmp_path, scenes):
    os.mkfifo(scenes / "pipe.json")
    done = run(scenes, "-o", tmp_path / "out", "--tool", "true")
    assert done.returncode == 1
    assert done.stderr == f"gpu_shading suite: {scenes / 'pipe.json'}: is not a file\n"


@pytest.mark.parametrize("arguments, why", [
    (["--tool", "missing-program"], "--tool missing-program: missing-program: No such file or directory"),
    (["--tool", "a=true", "--tool", "a=false"], "--tool: two tools have the same name"),
    (["--tool", "a="], "--tool a=: expected NAME=COMMAND"),
    (["--tool", "a='"], "--tool a=': No closing quotation"),
    (["--tool", "true", "--limit", "0"], "--limit 0: expected 0 to 1e6 seconds"),
    (["--tool", "true", "--limit", "nan"], "--limit nan: expected 0 to 1e6 seconds"),
])
def test_wrong_arguments_are_one_line(tmp_path, scenes, arguments, why):
    done = run(scenes, "-o", tmp_path / "out", *arguments)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.splitlines()[-1].startswith(f"gpu_shading suite: {why}")
    assert not (tmp_path / "out").exists()


def test_a_folder_of_others_stays_as_it_is(tmp_path, scenes):
    out = tmp_path / "out"
    out.mkdir()
    (out / "scores.csv").write_text("mine")
    done = run(scenes, "-o", out, "--tool", "true")
    assert done.returncode == 1
    assert done.stderr == f"gpu_shading suite: -o {out}: is not an empty folder; expected a new or empty one\n"
    assert [path.read_text() for path in out.iterdir()] == ["mine"]


def test_help_needs_no_package(tmp_path):
    done = subprocess.run([sys.executable, "-S", "-E", COMMAND, "--help"], capture_output=True, text=True, cwd=tmp_path,
                          env={"PATH": os.environ["PATH"]})
    assert (done.returncode, done.stderr) == (0, "")
    assert "--tool" in done.stdout and not list(tmp_path.iterdir())

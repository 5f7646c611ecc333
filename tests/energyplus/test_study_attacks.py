"""Studies with hostile plans, models, records and folders: one line and exit status 1, in bounded time and memory."""

import asyncio
import contextlib
import importlib.util
import json
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest
from shading_runs import energyplus

PACKAGES = energyplus.REPOSITORY / "gpu_shading" / "python"
sys.path.insert(0, str(PACKAGES))
COMMAND = PACKAGES / "gpu_shading" / "study" / "__main__.py"
IDF = """Building,House;
Schedule:Constant,cooling,,26;
Shading:Building:Detailed,Louvre 1,,4,0,0,0,1,0,0,1,0,1,0,0,1;
"""
EPJSON = '{"Building": {"House": {}}, "Shading:Building:Detailed": {"Louvre 1": {"vertices": 5}}}'
PLAN = 'models = "in.idf"\nweather = "weather.epw"\n'
SET = PLAN + "[[variant]]\nset = {{ \"{}\" = {} }}\n"
COOLING, VERTEX = "Schedule:Constant/cooling/Hourly Value", "Shading:Building:Detailed/Louvre 1/Vertex {} X-coordinate"
HEAD = "model,weather,variant\n"


def pipe(path):
    os.mkfifo(path)


def folder(path):
    path.mkdir()


def sparse(size):
    def make(path):
        with open(path, "wb") as file:
            file.truncate(size)
    return make


def link_to(target):
    return lambda path: path.symlink_to(target)


def loops(path):
    """2^40 names for one folder without a model."""
    path.mkdir()
    for name in "ab":
        (path / name).symlink_to(".")


AROUND = {"in.idf": IDF, "weather.epw": "LOCATION,a,b,c,d,e,1,2,3,4\n", "pipe.idf": pipe, "big.idf": sparse(1 << 40),
          "loops": loops}

# (plan.toml, what the line says), or (files, what the line says) with the plan first; beside the files AROUND it.
PLANS = [
    # TOML that is none.
    (b"\xff\xfe", "is not TOML: "),
    (b'models = "in\0.idf"', "is not TOML: "),
    ("a = " + "[" * 100_000, "is nested too deeply"),
    ("a = " + "{a = " * 100_000, "is nested too deeply"),
    ("a." * 100_000 + "a = 1", "is nested too deeply"),
    ("[" + '"a b" . ' * 30_000 + "a]", "is nested too deeply"),
    ("tries = " + "9" * 5000, "is not TOML: "),
    (PLAN + "tries = 0x" + "f" * 5000, "tries: a value too long to print, expected a whole number"),
    ("limit = 2021-13-45", "is not TOML: "),
    (sparse(1 << 40), "has 1099511627776 bytes; expected at most 4 MiB"),
    (pipe, "is not a regular file"),
    (folder, "is not a regular file"),
    (link_to("/dev/zero"), "is not a regular file"),
    (link_to("plan.toml"), "Too many levels of symbolic links"),
    (link_to("nothing"), "No such file"),
    ({"plan.txt": ""}, "plan.txt: expected a name that ends in .toml or .csv"),
    ("", "models: missing"),
    # Values of other types.
    ("models = 5", "models: 5, expected text in one line"),
    ("models = [1, 2]", "models: [1, 2], expected text in one line"),
    ('models = {a = "b"}', "models: {'a': 'b'}, expected text in one line"),
    ('models = "\\u0000"', "models: '\\x00', expected text in one line"),
    ('models = "\\u001b[31mred"', "models: '\\x1b[31mred', expected text in one line"),
    (f'models = "{"x" * 300_000}"', "models: 'xxx"),
    ('models = "in.idf"\nweather = "in\\n.epw"', "weather: 'in\\n.epw', expected text in one"),
    (PLAN + "limit = nan", "limit: nan, expected a number of at least 1"),
    (PLAN + "limit = inf", "limit: inf, expected a number of at least 1"),
    (PLAN + "limit = true", "limit: True, expected a number of at least 1"),
    (PLAN + "tries = 1e9", "tries: 1000000000.0, expected a whole number"),
    (PLAN + "tries = 1000000", "tries: 1000000, expected a whole number of at least 1 and at"),
    (PLAN + "shards = 1000000000", "shards: 1000000000, expected a whole number"),
    (PLAN + "shards = 1.5", "shards: 1.5, expected a whole number"),
    (PLAN + "task = 1", "task: 1, expected text in one line"),
    (PLAN + 'mode = "\\u001b]0;title\\u0007"\n', "mode: '\\x1b]0;title\\x07', expected text"),
    (PLAN + "outputs = [[1]]", "outputs: [[1]], expected text in one line"),
    (PLAN + 'keep = ["all", 3]', "keep: ['all', 3], expected text in one line"),
    (PLAN + "variant = 5", "variant: 5, expected tables [[variant]]"),
    (PLAN + "variant = [1, 2]", "variant 1: 1, expected a table"),
    (PLAN + "variant = []", "has no runs"),
    (PLAN + "[[variant]]\nname = 7", "variant 1.name: 7, expected text in one line"),
    (PLAN + '[[variant]]\nname = "\\u001b[2J"', "variant 1.name: '\\x1b[2J', expected text"),
    (PLAN + '[[variant]]\n"\\u001b[2J" = 1', "variant 1.\\x1b[2J: 1, expected no such key"),
    (PLAN + "[[variant]]\nset = 5", "variant 1.set: 5, expected a table"),
    (PLAN + '[[variant]]\nextensions = "plan.toml/x"', "variant 1.extensions: 'plan.toml/x', expected a"),
    (PLAN + '[[variant]]\nobjects = "pipe.idf"', "variant 1.objects: 'pipe.idf', exp"),
    (PLAN + '[[variant]]\nobjects = "big.idf"', "variant 1.objects: big.idf: has 1099511627776"),
    (PLAN + '[[variant]]\nobjects = "Zone,A; Zone,B"', "objects: 'Zone,A; Zone,B', expected IDF text th"),
    (PLAN + 'arguments = ["-D", "-d", "/home"]', "arguments: '-d': a study decides where weather and results are"),
    (PLAN + 'arguments = "--output-prefix=../../x"', "arguments: '--output-prefix=../../x': a study decides where"),
    (PLAN + "options = { error = nan }", "options.error: nan, expected a finite number"),
    (PLAN + "options = { error = [1] }", "options.error: [1], expected a finite number"),
    (PLAN + "options = { cache = 5, cache-size = -inf }", "options.cache-size: -inf, expected a finite"),
    (PLAN + 'options = { device = "\\u001b[1m" }', "options.device: '\\x1b[1m', expected a finite numb"),
    (PLAN + "[jobqueue]\nkind = 5\nworkers = 1e300", "jobqueue.workers: 1e+300, expected at least 0"),
    (PLAN + '[jobqueue]\nkind = "slurm"\njob_script_prologue = 5', "jobqueue.job_script_prologue: 5, ex"),
    # Files that are named.
    ('models = "loops"', "models: 'loops', expected files or folders"),
    ('models = "loops/**/*.idf"', "models: 'loops/**/*.idf', expected files"),
    ('models = "pipe.idf"', "models: 'pipe.idf', expected files or fold"),
    ('models = "/dev/zero"', "models: '/dev/zero', expected files or folders"),
    ('models = "big.idf"\nweather = "weather.epw"', "big.idf: has 1099511627776 bytes"),
    ('models = "in.idf"\nweather = "pipe.idf"', "weather: 'pipe.idf', expected a weather file"),
    ('models = "in.idf"\nweather = "/dev/zero"', "weather: '/dev/zero', expected a weather"),
    ('models = "in.idf"\nweather = "big.idf"', "big.idf: has 1099511627776 bytes"),
    ({"plan.toml": PLAN, "in.gpu-shading.idf": pipe}, "in.gpu-shading.idf: is not a regular file"),
    ({"plan.toml": PLAN, "in.gpu-shading.idf": link_to("/dev/zero")}, "in.gpu-shading.idf: is not a regular file"),
    ({"plan.toml": PLAN, "in.gpu-shading.idf": sparse(1 << 40)}, "in.gpu-shading.idf: has 1099511627776 bytes"),
    ('models = "\\u202ein.idf"\nweather = "weather.epw"', "models: '\\u202ein.idf', expected text"),
    # Values that become text of a model.
    (SET.format(COOLING, '"0,5"'), f"in/weather: '{COOLING}': '0,5', expected a number with a decimal p"),
    (SET.format(COOLING, '"1; Zone,X"'), f"'{COOLING}': '1; Zone,X', expected one value, without , ; !"),
    (SET.format(COOLING, '"1 ! x"'), f"'{COOLING}': '1 ! x', expected one value, without , ; !"),
    (SET.format(COOLING, '"1\\n2"'), f"'{COOLING}': '1\\n2', expected a finite number, or text in one l"),
    (SET.format(COOLING, "nan"), f"'{COOLING}': nan, expected a finite number"),
    (SET.format(COOLING, "[1]"), f"'{COOLING}': [1], expected a finite number"),
    (SET.format(COOLING, "true"), f"'{COOLING}': True, expected a finite number"),
    (SET.format(COOLING, "0x" + "f" * 9000), f"'{COOLING}': a value too long to print, expected a finite"),
    (SET.format(VERTEX.format(999_999_999), 1), "Shading:Building:Detailed has 4 of these; expected at"),
    (SET.format(VERTEX.format(6), 1), "Shading:Building:Detailed has 4 of these; expected at most numb"),
    (SET.format(VERTEX.format("9" * 5000), 1), "Shading:Building:Detailed has 4 of these; expected at most number 5"),
    (SET.format("*" * 100_000 + "/a/b", 1), "EnergyPlus has no class '****"),
    (SET.format("Building/" + "*a" * 50_000 + "/North Axis", 1), "in.idf has no such object"),
    (PLAN + '[[variant]]\nremove = ["\\u0007"]', "variant 1.remove: ['\\x07'], expected text in one line"),
    # epJSON.
    *(({"plan.toml": 'models = "x.epJSON"\nweather = "weather.epw"\n' + more, "x.epJSON": text}, words)
      for text, more, words in [
        ("[" * 100_000, "", "x.epJSON: is nested over 100 deep"),
        ('{"Building": {"House": {"a": ' + "[" * 200 + "]" * 200 + "}}}", "", "x.epJSON: is nested over 100 deep"),
        ("5", "", "x.epJSON: the model: 5, expected a table of {}"),
        ('{"Building": [1]}', "", "x.epJSON: Building: [1], expected a table of {}"),
        ('{"Building": {"\\u001b": 1}}', "", "x.epJSON: Building '\\x1b': 1, expected a table of {}"),
        ('{"Building": {"a": {"b": NaN}}}', "", "x.epJSON: NaN is not a number that a model may have"),
        ('{"Building": {"a": {"b": ' + "9" * 9000 + "}}}", "", "x.epJSON: Exceeds the limit"),
        (b"{\xff", "", "x.epJSON: Expecting property name"),
        (EPJSON, f'[[variant]]\nset = {{ "{VERTEX.format(2)}" = 1 }}', "has 0 of these; expected at most number 1"),
        (EPJSON, '[[variant]]\nobjects = "Zone,A;"', "objects: can be added to an IDF, not to epJSON"),
        (EPJSON, '[[variant]]\nset = { "Building/House/North Axis" = "0,5" }', "expected a number with a decimal poin"),
      ]),
    # CSV.
    ({"plan.csv": b"\xff\xfe"}, "plan.csv: after line 0: is not CSV: 'utf-8' codec"),
    ({"plan.csv": HEAD + "in.idf," + "x" * 200_000}, "plan.csv: after line 1: is not CSV: field larger"),
    ({"plan.csv": HEAD + "in.idf,weather.epw,a\0b\n"}, "plan.csv: line 2.variant: 'a\\x00b', expected text"),
    ({"plan.csv": HEAD + 'in.idf,weather.epw,"a\nb"\n'}, "plan.csv: line 3.variant: 'a\\nb', expected text"),
    ({"plan.csv": HEAD + "in.idf\n"}, "plan.csv: line 2: expected 3 values"),
    ({"plan.csv": HEAD + "in.idf,weather.epw,a,b\n"}, "plan.csv: line 2: expected 3 values"),
    ({"plan.csv": "model,weather,model\n"}, "plan.csv: column 'model': is there 2 times; expected once"),
    ({"plan.csv": "model,weather,\x1b[2J\n"}, "plan.csv: column '\\x1b[2J': expected model, weather"),
    ({"plan.csv": HEAD + ",weather.epw,a\n" * 2 + "nothing,,\n"}, "plan.csv: line 2.model: '', expected files"),
    ({"plan.csv": f"model,weather,set:{COOLING}\nin.idf,weather.epw,\"0,5\"\n"}, "expected a number"),
    ({"plan.csv": ""}, "plan.csv: has no runs"),
    ({"plan.csv": sparse(1 << 40)}, "plan.csv: has 1099511627776 bytes; expected at most 1024 MiB"),
    ({"plan.csv": sparse(1 << 29)}, "plan.csv: after line 0: is not CSV: "),
    ({"plan.csv": pipe}, "plan.csv: is not a regular file"),
]

# What is in the folder of a study before it starts.
FOLDERS = [
    ({"out/runs.csv": "mine"}, "out/runs.csv: was not written by this study; move it, or choose another folder"),
    ({"out/times.csv": "mine"}, "out/times.csv: was not written by this study"),
    ({"out/runs.parquet": b"mine"}, "out/runs.parquet: was not written by this study"),
    ({"out/runs.csv": link_to("../in.idf")}, "out/runs.csv: was not written by this study"),
    ({"out/runs.csv": pipe}, "out/runs.csv: was not written by this study"),
    ({"out/runs.csv": folder}, "out/runs.csv: was not written by this study"),
    ({"out/runs.csv": "mine", "out/.gpu_shading_study.json": "[" * 50_000}, "out/runs.csv: was not written by this st"),
    ({"out/runs.csv": "mine", "out/.gpu_shading_study.json": '{"runs.csv": 5}'}, "out/runs.csv: was not written by"),
    ({"out/runs.csv": "mine", "out/.gpu_shading_study.json": sparse(1 << 40)}, "out/runs.csv: was not written by this"),
    ({"out/.lock": link_to("../in.idf")}, "out/.lock: is a link; expected a file of this study"),
    ({"out/.lock": pipe}, "out/.lock: is not a regular file"),
    ({"out/.lock": folder}, "out/.lock: Is a directory"),
    ({"out/runs": link_to("..")}, "out/runs: is a link; expected a folder of this study"),
    ({"out/scenes": "mine"}, "out/scenes: is not a folder; expected a folder of this study"),
    ({"out/shading": link_to("/tmp")}, "out/shading: is a link; expected a folder of this study"),
    ({"out": "mine"}, "out: File exists"),
]

# (arguments, what the line says)
ARGUMENTS = [
    (["plan.toml", "-o", ""], "-o '': expected the name of a folder"),
    (["plan.toml", "-o", "x" * 300], "File name too long"),
    (["plan.toml"], "the following arguments are required: -o/--output"),
    (["nothing\x1b[31m.toml", "-o", "out"], "nothing\\x1b[31m.toml: no such file"),
    (["plan.toml", "-o", "out", "--\x1b[31m"], "unrecognized arguments: --\\x1b[31m"),
    (["plan.toml", "-o", "out", "--workers", "1000000"], "--workers: 1000000, expected at least 1 and at most 10000"),
    (["plan.toml", "-o", "out", "--workers", "9" * 5000], "argument --workers: invalid int value"),
    (["plan.toml", "-o", "out", "--limit", "nan"], "--limit: nan, expected at least 1"),
    (["plan.toml", "-o", "out", "--tries", "0"], "--tries: 0, expected at least 1"),
    (["plan.toml", "-o", "out", "--keep", "\x1b"], "keep: '\\x1b', expected one of tables, sql, all, nothing"),
    (["plan.toml", "-o", "out", "--jobqueue", "\x1b"], "--jobqueue \\x1b: expected one of slurm, pbs, lsf"),
    (["plan.toml", "-o", "out", "--scheduler", "\x1b"], "--scheduler \\x1b: "),
    (["plan.toml", "-o", "in.idf"], "in.idf: File exists"),
]

# Runs the command for each list of arguments that standard input has, in a process of its own with bounds.
DRIVER = """
import json, os, resource, runpy, sys, time
command, cases = sys.argv[1], json.load(sys.stdin)
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(command))))
import gpu_shading.study.study, gpu_shading.study.models
with __import__("contextlib").suppress(ValueError):
    gpu_shading.study.models.find_field("Building/x/y")
results = []
for folder, arguments in cases:
    began, child = time.monotonic(), os.fork()
    if child == 0:
        os.chdir(folder)
        os.dup2(os.open("stdout", os.O_CREAT | os.O_WRONLY), 1)
        os.dup2(os.open("stderr", os.O_CREAT | os.O_WRONLY), 2)
        resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
        resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
        sys.argv = [command, *arguments]
        try:
            runpy.run_path(command, run_name="__main__")
        except SystemExit as end:
            sys.stderr.flush()
            os._exit(end.code or 0)
        except BaseException:
            import traceback
            traceback.print_exc()
        os._exit(99)
    results.append((os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), time.monotonic() - began))
print(json.dumps(results))
"""


@pytest.fixture(scope="module", autouse=True)
def dask(patched):
    if not importlib.util.find_spec("distributed"):
        pytest.skip("Dask is missing: run scripts/setup")


def make(place, files):
    place.mkdir(parents=True)
    for name, content in {**AROUND, **files}.items():
        path = place / name
        path.parent.mkdir(exist_ok=True)
        if callable(content):
            content(path)
        else:
            path.write_bytes(content if isinstance(content, bytes) else content.encode())


def listing(place):
    """Names, kinds and content of all in a folder."""
    found = {}
    for path in sorted(place.rglob("*")):
        content = path.lstat().st_mode, path.lstat().st_mtime_ns
        if path.is_file() and path.stat().st_size < 1 << 20:
            content = *content, path.read_bytes()
        found[str(path.relative_to(place))] = content
    return found


def drive(cases):
    """(exit status, seconds, standard error) of the command in each folder."""
    words = [(str(place), arguments) for place, arguments in cases]
    done = subprocess.run([sys.executable, "-c", DRIVER, COMMAND], input=json.dumps(words), capture_output=True,
                          text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    for (place, _), (status, seconds) in zip(cases, json.loads(done.stdout), strict=True):
        yield status, seconds, (place / "stderr").read_text()


def why_not(status, seconds, errors, words, file=""):
    """What is wrong with the answer to an attack; "" if nothing is."""
    right = {
        "status": status == 1, "time": seconds < 20, "words": words in errors and file in errors,
        "printable": errors[:-1].isprintable(),
        "one line": errors.startswith("gpu_shading study: ") and errors.endswith("\n") and errors.count("\n") == 1,
        "length": len(errors) < 2300}
    wrong = [name for name, is_right in right.items() if not is_right]
    return f"{', '.join(wrong)}: {words!r}: status {status}, {seconds:.1f} s: {errors[-1000:]}" if wrong else ""


def test_each_bad_plan_is_one_line(tmp_path):
    assert len(PLANS) + len(FOLDERS) + len(ARGUMENTS) > 100
    cases = []
    for number, (given, _) in enumerate(PLANS):
        place = tmp_path / f"plan {number}"
        files = given if isinstance(given, dict) else {"plan.toml": given}
        make(place, files)
        cases.append((place, [next(iter(files)), "-o", "out"]))
    found = [why_not(*answer, words, "" if isinstance(given, dict) else "plan.toml: ")
             for answer, (given, words) in zip(drive(cases), PLANS, strict=True)]
    assert not list(filter(None, found)), "\n".join(filter(None, found))
    assert not [place for place, _ in cases if (place / "out").exists()]


def test_each_bad_argument_is_one_line(tmp_path):
    cases = []
    for number, (arguments, _) in enumerate(ARGUMENTS):
        place = tmp_path / f"arguments {number}"
        make(place, {"plan.toml": PLAN})
        cases.append((place, arguments))
    found = [why_not(*answer, words) for answer, (_, words) in zip(drive(cases), ARGUMENTS, strict=True)]
    assert not list(filter(None, found)), "\n".join(filter(None, found))


@pytest.mark.parametrize("flags", [[], ["--dry-run"]], ids=["run", "dry run"])
def test_what_is_in_the_folder_stays(tmp_path, flags):
    cases, before, wanted = [], [], []
    for number, (files, words) in enumerate(FOLDERS):
        if flags and ".lock" in words or words.endswith("File exists"):
            continue
        place = tmp_path / f"folder {number}"
        make(place, {"plan.toml": PLAN, **files})
        before.append(listing(place))
        wanted.append(words)
        cases.append((place, ["plan.toml", "-o", "out", *flags]))
    found = [why_not(*answer, words) for answer, words in zip(drive(cases), wanted, strict=True)]
    assert not list(filter(None, found)), "\n".join(filter(None, found))
    for (place, _), was in zip(cases, before, strict=True):
        now = listing(place)
        new = {name: now.pop(name) for name in set(now) - set(was)}
        assert set(new) <= {"stdout", "stderr", "out/.lock"}
        was.pop("out", None), now.pop("out", None)  # its time may be another
        assert now == was


def study(place, *arguments, status=0, program=(sys.executable, COMMAND), **variables):
    """Standard error of the command."""
    done = subprocess.run([*program, "plan.toml", "-o", "out", "--workers", "1", *arguments], cwd=place,
                          env=os.environ | variables, capture_output=True, text=True, timeout=120)
    assert done.returncode == status, done.stderr
    return done.stderr


@pytest.fixture(scope="module")
def finished(box, weather, tmp_path_factory):
    """A study of one run, beside files of the user under names that were ours once."""
    place = tmp_path_factory.mktemp("finished")
    text = box + "Output:Variable,*,Surface Outside Face Sunlit Area,Hourly;\n"
    (place / "in.idf").write_text(text)
    (place / "plan.toml").write_text(
        f'models = "in.idf"\nweather = "{weather}"\narguments = "-D"\n'
        'outputs = ["Surface Outside Face Sunlit Area", "Schedule Value"]\noptions = { lean = "on" }\nkeep = "sql"\n')
    (place / "out" / "work").mkdir(parents=True)
    (place / "out" / "work" / "thesis.txt").write_text("three years")
    study(place)
    return place


def test_a_folder_named_work_is_the_user_s(finished):
    assert (finished / "out" / "work" / "thesis.txt").read_text() == "three years"
    study(finished, "--dry-run")
    assert (finished / "out" / "work" / "thesis.txt").read_text() == "three years"
    kept = {"work", "runs", "scenes", "shading", "runs.csv", "times.csv", "runs.parquet", ".lock",
            ".gpu_shading_study.json"}
    assert {path.name for path in (finished / "out").iterdir()} <= kept


def test_a_dry_run_leaves_no_trace(finished):
    was = listing(finished)
    study(finished, "-o", "nowhere", "--dry-run")
    assert listing(finished) == was


def test_placeholders_are_no_columns(finished):
    (file,) = (finished / "out").glob("runs/*/eplusout.sql")
    with contextlib.closing(sqlite3.connect(file)) as base:
        keys = [key for key, in base.execute("SELECT KeyValue FROM ReportDataDictionary")]
    assert sum("GPU SHADING PLACEHOLDER" in (key or "") for key in keys) >= 8  # mirror images, too
    head = (finished / "out" / "runs.csv").read_text().splitlines()[0]
    assert "Surface Outside Face Sunlit Area, " in head and "Schedule Value, " in head
    assert "GPU SHADING" not in head.upper()


def test_a_plan_is_not_replaced_by_its_results(box, weather, tmp_path):
    (tmp_path / "in.idf").write_text(box)
    plan = f"model,weather\nin.idf,{weather}\n"
    (tmp_path / "runs.csv").write_text(plan)
    done = subprocess.run([sys.executable, COMMAND, "runs.csv", "-o", "."], cwd=tmp_path, capture_output=True,
                          text=True)
    assert done.returncode == 1 and "runs.csv: was not written by this study; move it" in done.stderr, done.stderr
    assert (tmp_path / "runs.csv").read_text() == plan


def test_a_table_that_was_changed_is_kept(finished, tmp_path):
    place = tmp_path / "copy"
    shutil.copytree(finished, place)
    with open(place / "out" / "runs.csv", "a") as table:
        table.write("my remark\n")
    assert "runs.csv: was not written by this study" in study(place, status=1)
    assert (place / "out" / "runs.csv").read_text().endswith("my remark\n")


RECORDS = [b"", b"{", b"[]", b"5", b"null", b"\xff\xfe", b"[" * 200_000, b'{"values": {}, "times": {}}',
           b'{"values": 5, "times": [], "digest": "0"}', b'{"values": {"a": NaN}, "times": {}, "digest": 5}',
           b'{"values": {}, "times": {"seconds": ' + b"9" * 5000 + b'}, "digest": ""}', sparse(1 << 40), pipe, folder,
           link_to("/dev/zero"), link_to("record.json")]


def test_each_damaged_record_is_told_and_repeated(finished, tmp_path, capsys):
    from gpu_shading.study import tasks
    from gpu_shading.study.records import Results

    (record,) = (finished / "out").glob("runs/*/record.json")
    good = json.loads(record.read_text())
    damaged = {**good, "values": {**good["values"], "Transmitted Solar [kWh]": 1e9}}
    job = tasks.Job("in/weather", "", record.parent.name, "", "w.epw", None, {}, (), (), "", (), (), (), None, "", "")
    for number, content in enumerate([*RECORDS, json.dumps(damaged).encode(), record.read_bytes()[:-9]]):
        place = tmp_path / f"record {number}"
        make(place / "runs" / job.id, {tasks.RECORD: content})
        assert Results(place, [job]).missing() == [job], content
        errors = capsys.readouterr().err
        assert errors.count("\n") == 1 and "record.json: is not a record of a study (" in errors, (content, errors)
    assert not Results(finished / "out", [job]).missing() and not capsys.readouterr().err


def test_a_study_goes_on_after_damage(finished, tmp_path):
    """The damaged folder is renamed; what scenes/ and shading/ have is computed again, or refused."""
    place = tmp_path / "copy"
    shutil.copytree(finished, place)
    table = (place / "out" / "runs.csv").read_bytes()
    (record,) = (place / "out").glob("runs/*/record.json")
    (scene,) = (place / "out" / "scenes").iterdir()
    for content in ("../../../etc", "\xff", ""):
        record.write_text("{")
        scene.write_text(content)
        assert f"{record}: is not a record of a study" in study(place)
        assert (place / "out" / "runs.csv").read_bytes() == table
    assert len(list((place / "out" / "runs").glob("*.damaged-*/record.json"))) == 3
    record.unlink()
    (shading,) = (place / "out" / "shading").iterdir()
    shading.rename(tmp_path / "elsewhere")
    shading.symlink_to(tmp_path / "elsewhere")
    was = listing(tmp_path / "elsewhere")
    errors = study(place, status=1)
    assert errors.splitlines()[-1].endswith(f"{shading}: is a link; expected a folder of this study")
    assert listing(tmp_path / "elsewhere") == was


MODULES = ("signal", "json", "sitecustomize", "usercustomize", "socket", "threading", "pickle", "os", "re", "struct",
           "random", "ssl", "selectors", "warnings", "multiprocessing", "encodings", "numpy", "dask", "distributed",
           "tornado", "cryptography", "pyarrow", "gpu_shading", "csv", "tomllib", "logging", "tempfile")


@pytest.mark.parametrize("flags", [[], ["-E"]], ids=["safe path", "no safe path"])
def test_modules_of_the_current_folder_are_not_run(finished, tmp_path, flags):
    """-E ignores PYTHONSAFEPATH, as Python 3.10 does."""
    place = tmp_path / "copy"
    shutil.copytree(finished, place, ignore=shutil.ignore_patterns("out"))
    for name in MODULES:
        (place / f"{name}.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'a').write('{name} ')\n")
    study(place, program=(sys.executable, *flags, COMMAND))
    assert not (tmp_path / "ran").exists(), (tmp_path / "ran").read_text()


@pytest.fixture
def hanging(finished, patched, tmp_path):
    """A study whose run hangs, with its temporary folder, of a short name, as sockets need."""
    prefix, temporary = tmp_path / "prefix", Path(tempfile.mkdtemp())
    prefix.mkdir()
    for entry in patched.parent.iterdir():
        if entry.name != "energyplus":
            (prefix / entry.name).symlink_to(entry)
    (prefix / "energyplus").write_text("#!/bin/bash\nsleep 1000\n")
    (prefix / "energyplus").chmod(0o755)
    # As another user of the machine may make it first.
    (temporary / "dask-scratch-space").mkdir(parents=True)
    shutil.copytree(finished, tmp_path / "copy", ignore=shutil.ignore_patterns("out"))
    process = subprocess.Popen([sys.executable, COMMAND, "plan.toml", "-o", "out", "--workers", "1"], text=True,
                               cwd=tmp_path / "copy", stderr=subprocess.PIPE, start_new_session=True,
                               env=os.environ | {"TMPDIR": str(temporary), "GPU_SHADING_PREFIX": str(prefix)})
    yield process, temporary
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    shutil.rmtree(temporary)


def test_only_the_study_can_give_its_workers_work(hanging):
    import distributed

    process, temporary = hanging
    address = re.search(r"workers of (tls://127\.0\.0\.1:\d+);", process.stderr.readline())[1]
    for stranger in (address.replace("tls", "tcp"), address):
        security = distributed.Security.temporary() if stranger == address else None
        with pytest.raises(OSError), distributed.Client(stranger, security=security, timeout=2) as client:
            client.submit(os.getpid).result()
    assert process.poll() is None
    folders = list(temporary.glob(".gpu_shading-*"))
    assert folders and all(path.stat().st_mode & 0o777 == 0o700 for path in folders)
    assert any((path / "dask-scratch-space").is_dir() for path in folders)
    assert not list((temporary / "dask-scratch-space").iterdir())


def test_a_signal_leaves_nothing_temporary(hanging, tmp_path):
    process, temporary = hanging
    folder = tmp_path / "copy" / "out"
    limit = time.monotonic() + 60
    while not list(folder.glob(".gpu_shading-*/*/out")):
        assert time.monotonic() < limit
        time.sleep(0.1)
    process.terminate()
    assert process.wait(timeout=60) == 128 + signal.SIGTERM
    assert process.stderr.read().endswith("gpu_shading study: interrupted; the same command resumes\n")
    assert not list(folder.glob(".gpu_shading-*")) and not list(temporary.glob(".gpu_shading-*"))


@pytest.mark.parametrize("failing", ["hangs", "ends"])
def test_a_worker_that_cannot_start_is_waited_for_within_bounds(finished, tmp_path, monkeypatch, failing):
    import distributed.nanny
    from gpu_shading.study import engine

    from gpu_shading import RunError, Study

    async def start(_):
        if failing == "ends":
            raise RuntimeError("no memory")
        await asyncio.sleep(1000)

    monkeypatch.setattr(distributed.nanny.WorkerProcess, "start", start)
    monkeypatch.setattr(engine, "_LOCAL_PATIENCE", 2.0)
    began = time.monotonic()
    with pytest.raises(RunError, match="no worker could start within 2 s"):
        Study(finished / "plan.toml", tmp_path / "out", workers=1, keep="nothing", tries=1).run()
    assert time.monotonic() - began < 30


def test_workers_that_are_gone_are_waited_for_within_bounds(finished, tmp_path):
    import distributed
    from gpu_shading.study.engine import Engine, Workers

    from gpu_shading import RunError

    with distributed.LocalCluster(n_workers=0, processes=False, dashboard_address=None) as cluster, \
            distributed.Client(cluster) as client:
        engine = Engine(Workers(client, 3.0), 1)
        engine.submit(os.getpid, then=None)
        with pytest.raises(RunError, match="no worker for"):
            engine.run()


def test_names_are_escaped_wherever_they_are_told(finished, tmp_path):
    """Of models, in messages and tables: control characters, marks that turn text, and bytes that are not UTF-8."""
    names = [b"\x1b[31mred", b"two\nlines", "\u202eright".encode(), b"latin \xff", b"=1+1"]
    for name in names:
        (tmp_path / os.fsdecode(name + b".idf")).write_text("Version,1;\nZone,\x1b[2J;\n")
    weather = re.search('weather = .*', (finished / "plan.toml").read_text())[0]
    (tmp_path / "plan.toml").write_text(f'models = "."\n{weather}\ntries = 1\n')
    for flags in ([], ["--dry-run"]):
        done = subprocess.run([sys.executable, COMMAND, "plan.toml", "-o", "out \x1b[1m", "--workers", "2", *flags],
                              cwd=tmp_path, capture_output=True, text=True, timeout=120)
        assert done.returncode == 1, done.stderr
        told = done.stdout + done.stderr
        assert all(line.isprintable() for line in told.split("\n")), told
        for name in ("\\x1b[31mred", "two lines", "\\u202eright", "latin \ufffd", "=1+1"):
            assert flags or name in told, (name, told)
    table = (tmp_path / "out \x1b[1m" / "runs.csv").read_text()
    assert all(line.isprintable() for line in table.split("\n")) and table.count("\n") == 6 and "\n'=1+1/" in table

"""A run that is refused leaves the files that EnergyPlus leaves when it stops on its input, which OpenStudio and
Honeybee read: same names, same folder, same lines, compared with the official program's own."""

import os
import re
import subprocess

import pytest

OUTPUTS = {
    "default": [],
    "folder": ["-d", "out"],
    "new folders": ["--output-directory=a/b/c"],
    "prefix": ["-d", "out", "-p", "room"],
    "prefix of nothing": ["-d", "out", "--output-prefix="],
    "legacy suffix": ["-d", "out", "-s", "L"],
    "dash suffix": ["-d", "out", "--output-suffix", "D"],
    "capital suffix": ["-d", "out", "-s", "c", "--output-prefix", "room"],
}


def refused_model(box, folder, method="Imported"):
    path = folder / "model.idf"
    path.write_text(box.replace("PolygonClipping,         !-", f"{method},         !-"))
    assert method in path.read_text()
    return path.name


def run(program, folder, arguments, **variables):
    return subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, env=os.environ | variables)


def written(folder):
    return {str(path.relative_to(folder)): path.read_text() for path in folder.rglob("*")
            if path.is_file() and path.name != "model.idf"}


def shape(text):
    """The text without what differs between two errors and two times."""
    text = re.sub(r"YMD=\d{4}\.\d\d\.\d\d \d\d:\d\d", "YMD", text)
    text = re.sub(r"(Severe  \*\*|Fatal  \*\*|Last severe error=).*", r"\1", text)
    return re.sub(r"Time=\d\dhr \d\dmin [ \d]\d\.\d\dsec", "Time", text)


@pytest.fixture(scope="module")
def stock(official, tmp_path_factory):
    """What EnergyPlus writes, for some arguments, about one severe error: an object without a valid field."""
    def write(arguments, weather, box):
        folder = tmp_path_factory.mktemp("stock")
        (folder / "model.idf").write_text(box + "Schedule:Constant,Wrong,Nowhere Limits,word;\n")
        done = run(official, folder, [*arguments, "-w", weather, "model.idf"])
        assert done.returncode == 1, done.stderr
        files = written(folder)
        assert all("1 Severe Errors" in text for text in files.values())
        return files

    return write


@pytest.mark.parametrize("outputs", OUTPUTS)
def test_files_are_those_of_energyplus(outputs, stock, patched, box, weather, tmp_path):
    arguments = OUTPUTS[outputs]
    done = run(patched, tmp_path, ["--gpu-shading", *arguments, "-w", weather, refused_model(box, tmp_path)])
    assert done.returncode == 1
    ours, expected = written(tmp_path), stock(arguments, weather, box)
    assert {name: shape(text) for name, text in ours.items()} == {name: shape(text) for name, text in expected.items()}
    error = done.stderr.removeprefix("gpu_shading: error: ").strip()
    err = next(text for name, text in ours.items() if name.endswith(".err"))
    assert f"   ** Severe  ** gpu_shading: {error}\n" in err and "Imported" in error
    assert f"   ..... Last severe error=gpu_shading: {error}\n" in err


REFUSALS = {
    "method": ("Scheduled", [], {}, "Scheduled"),
    "flag": ("PolygonClipping", ["--gpu-shading-error", "many"], {}, "many"),
    "unknown flag": ("PolygonClipping", ["--gpu-shading-nothing"], {}, "--gpu-shading-nothing"),
    "environment": ("PolygonClipping", [], {"GPU_SHADING_ERROR": "many"}, "GPU_SHADING_ERROR"),
    "device": ("PolygonClipping", ["--gpu-shading-device", "99"], {}, "99"),
    "conversion": ("PolygonClipping", ["--convert-only"], {}, "would be lost"),
    "method of schedules": ("Imported", ["--gpu-shading-method", "scheduled"], {}, "Imported"),
    "method of OpenGL": ("Imported", ["--gpu-shading-method", "opengl"], {}, "Imported"),
    "expanded": ("Imported", ["-x"], {}, "Imported"),
}


@pytest.mark.parametrize("refusal", REFUSALS)
def test_every_refusal_is_in_the_files(refusal, patched, box, weather, tmp_path):
    method, flags, variables, word = REFUSALS[refusal]
    text = box + "GPUShading:Settings,,timestep;\n" if refusal == "conversion" else box
    done = run(patched, tmp_path, ["--gpu-shading", *flags, "-d", "out", "-w", weather,
                                   refused_model(text, tmp_path, method)], **variables)
    assert done.returncode == 1 and word in done.stderr
    assert sorted(written(tmp_path)) == ["out/eplusout.end", "out/eplusout.err"]
    severe = [line for line in written(tmp_path)["out/eplusout.err"].splitlines() if "** Severe  **" in line]
    assert severe == ["   ** Severe  ** gpu_shading: " + done.stderr.removeprefix("gpu_shading: error: ").strip()]


def test_only_what_energyplus_overwrites_is_overwritten(stock, patched, box, weather, tmp_path):
    arguments = ["-d", "out", "-w", weather, refused_model(box, tmp_path)]
    (tmp_path / "out").mkdir()
    earlier = ("eplusout.eso", "eplusout.eio", "eplusout.sql", "eplustbl.htm", "eplusout.err", "eplusout.end", "in.idf")
    for name in earlier:
        (tmp_path / "out" / name).write_text("earlier")
    (tmp_path / "elsewhere").write_text("earlier")
    (tmp_path / "out" / "eplusout.end").unlink()
    (tmp_path / "out" / "eplusout.end").symlink_to(tmp_path / "elsewhere")
    assert run(patched, tmp_path, ["--gpu-shading", *arguments]).returncode == 1
    changed = {name for name, text in written(tmp_path).items() if text != "earlier"}
    assert changed == {"out/eplusout.err", "out/eplusout.end", "elsewhere"}


def test_folder_that_cannot_be_made_is_a_warning(patched, box, weather, tmp_path):
    (tmp_path / "out").write_text("a file")
    arguments = ["--gpu-shading", "-d", "out/in", "-w", weather, refused_model(box, tmp_path)]
    done = run(patched, tmp_path, [*arguments, "--gpu-shading-error", "many"])
    assert done.returncode == 1
    error, warning = done.stderr.splitlines()
    assert error.startswith("gpu_shading: error: ") and "many" in error
    assert warning == "gpu_shading: warning: out/in: cannot be created (Not a directory)"
    # Where it is the error, it is said once.
    done = run(patched, tmp_path, arguments)
    assert done.stderr == "gpu_shading: error: -d out/in: cannot be written to (Not a directory)\n"


@pytest.mark.parametrize("question", ["--help", "--version"])
def test_a_question_leaves_no_files(question, patched, tmp_path):
    done = run(patched, tmp_path, ["--gpu-shading", question], GPU_SHADING_ERROR="many")
    assert done.returncode == 1
    assert written(tmp_path) == {}

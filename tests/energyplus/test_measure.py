"""The OpenStudio measure without OpenStudio: files that it must not touch, and hostile files of objects."""

import importlib.util
import os
import sys
import types
import zlib

import pytest
from shading_runs import energyplus

MEASURE = energyplus.REPOSITORY / "gpu_shading/python/gpu_shading/measures/render_shading/measure.py"


class Optional:
    def __init__(self, value):
        self.value = value

    def is_initialized(self):
        return self.value is not None

    def empty(self):
        return self.value is None

    def get(self):
        return self.value


class IdfObject:
    """Fields between commas, as OpenStudio reads an object."""

    @staticmethod
    def load(text):
        if text.count(",") == 0:
            return Optional(None)
        made = IdfObject()
        made.fields = [field.strip() for field in text.rstrip(";").split(",")]
        return Optional(made)

    def numFields(self):
        return len(self.fields)

    def getString(self, index):
        return Optional(self.fields[index])


class Runner:
    def __init__(self, folder, **arguments):
        self.folder, self.given, self.errors, self.done = folder, arguments, [], []

    def workflow(self):
        return self

    def findFile(self, name):
        return Optional(None)

    def absoluteRunDir(self):
        return self.folder

    def validateUserArguments(self, arguments, given):
        return True

    def getStringArgumentValue(self, name, given):
        return str(self.given[name])

    def registerError(self, text):
        self.errors.append(text)

    def registerFinalCondition(self, text):
        self.done.append(text)


@pytest.fixture(scope="module")
def measure():
    class Base:
        def registerWithApplication(self):
            pass

        def run(self, workspace, runner, arguments):
            pass

    class Argument:
        def makeStringArgument(self, *_):
            return types.SimpleNamespace(setDisplayName=str, setDescription=str, setDefaultValue=str)

    parts = types.SimpleNamespace(EnergyPlusMeasure=Base, OSArgumentVector=list, OSArgument=Argument())
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "openstudio", types.SimpleNamespace(measure=parts, IdfObject=IdfObject))
        spec = importlib.util.spec_from_file_location("render_shading_measure", MEASURE)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        yield module


@pytest.fixture
def call(measure, tmp_path, monkeypatch):
    """Runs it on the text of a file of objects; (errors, objects added)."""
    (tmp_path / "prefix").mkdir()
    (tmp_path / "prefix" / "gpu_shading").write_text("")
    (tmp_path / "objects").mkdir()
    (tmp_path / "workflow" / "run").mkdir(parents=True)
    monkeypatch.setenv("ENERGYPLUS_EXE_PATH", "")
    monkeypatch.setenv("GPU_SHADING", "")

    def run(text=None, file=tmp_path / "objects" / "objects.idf"):
        if text is not None:
            file.write_bytes(text if isinstance(text, bytes) else text.encode())
        runner = Runner(tmp_path / "workflow" / "run", prefix=tmp_path / "prefix", objects=file)
        added = []
        workspace = types.SimpleNamespace(addObject=lambda each: (added.append(each), Optional(each))[1])
        done = measure.RenderShading().run(workspace, runner, {})
        assert done == (not runner.errors) == bool(runner.done)
        for line in runner.errors:
            assert line.isprintable() and len(line) < 1100, line
        return runner.errors, added

    return run


def texture(name):
    return f"GPUShading:PerforatedScreen,Screen,Sheet,Texture,{name},,,,,,0.001;\n"


def tree(folder):
    return {str(path.relative_to(folder)): os.readlink(path) if path.is_symlink() else path.read_bytes()
            if path.is_file() else None for path in folder.rglob("*")}


def test_files_in_the_folder_and_below_are_copied(call, tmp_path):
    (tmp_path / "objects" / "a").mkdir()
    (tmp_path / "objects" / "a" / "leaf.png").write_bytes(b"leaf" * 1000)
    (tmp_path / "objects" / "tile 'x'.png").write_bytes(b"tile")
    (tmp_path / "objects" / "inner.png").symlink_to("a/leaf.png")
    for _ in range(2):  # again: what is there already is the same
        errors, added = call("".join(map(texture, ("a/leaf.png", "tile 'x'.png", "inner.png", "none.png"))))
        assert errors == [] and len(added) == 4
    run = tmp_path / "workflow" / "run"
    assert tree(run) == {"a": None, "a/leaf.png": b"leaf" * 1000, "tile 'x'.png": b"tile", "inner.png": b"leaf" * 1000}


def test_a_name_that_leaves_the_folder_is_refused(call, tmp_path):
    for folder in ("", "workflow"):
        (tmp_path / folder / "textures").mkdir()
        (tmp_path / folder / "textures" / "leaf.png").write_text(f"of {folder}")
    (tmp_path / "objects" / "good.png").write_text("good")
    (tmp_path / "objects" / "link.png").symlink_to("../textures/leaf.png")
    (tmp_path / "objects" / "folder").symlink_to("../textures")
    (tmp_path / "objects" / "self.png").symlink_to("self.png")
    objects = tmp_path / "objects" / "objects.idf"
    objects.write_text("")
    before = tree(tmp_path)
    for name in ("../textures/leaf.png", "link.png", "folder/leaf.png", "folder/../textures/leaf.png"):
        errors, added = call(texture("good.png") + texture(name))
        objects.write_text("")
        assert errors == [f"objects: {objects}: {name} leaves {objects.parent}; expected a file in that folder or "
                          "below it, without .. and links out of it"]
        assert added == [] and tree(tmp_path) == before


def test_another_file_in_the_run_folder_is_not_replaced(call, tmp_path):
    run = tmp_path / "workflow" / "run"
    (tmp_path / "mine.png").write_text("mine")
    (tmp_path / "objects" / "leaf.png").write_text("leaf")
    places = {"another file": lambda: (run / "leaf.png").write_text("leaf, but longer"),
              "another, shorter": lambda: (run / "leaf.png").write_text("le"),
              "link": lambda: (run / "leaf.png").symlink_to(tmp_path / "mine.png"),
              "dangling": lambda: (run / "leaf.png").symlink_to(run / "none"),
              "pipe": lambda: os.mkfifo(run / "leaf.png")}
    for make in places.values():
        make()
        before = tree(run)
        errors, added = call(texture("leaf.png"))
        assert len(errors) == 1 and "leaf.png" in errors[0] and added == []
        assert tree(run) == before and (tmp_path / "mine.png").read_text() == "mine"
        (run / "leaf.png").unlink()
    (tmp_path / "out").mkdir()
    (tmp_path / "objects" / "a").mkdir()
    (tmp_path / "objects" / "a" / "leaf.png").write_text("leaf")
    (run / "a").symlink_to(tmp_path / "out")
    errors, _ = call(texture("a/leaf.png"))
    assert len(errors) == 1 and list((tmp_path / "out").iterdir()) == []


def test_only_files_of_bounded_size_are_copied(call, measure, tmp_path, monkeypatch):
    os.mkfifo(tmp_path / "objects" / "pipe")
    (tmp_path / "objects" / "leaf.png").write_bytes(b"1" * 1001)
    errors, added = call(texture("pipe") + texture("/dev/zero") + texture("x" * 5000))
    assert errors == [] and len(added) == 3 and tree(tmp_path / "workflow" / "run") == {}
    monkeypatch.setattr(measure, "MOST_BYTES", 1000)
    errors, added = call(texture("leaf.png"))
    assert len(errors) == 1 and "leaf.png: more than" in errors[0] and added == []
    assert tree(tmp_path / "workflow" / "run") == {}


def test_hostile_files_of_objects(call, measure, tmp_path, monkeypatch):
    objects = tmp_path / "objects" / "objects.idf"
    assert call(b"! comment\nGPUShading:Settings,\xff;\n")[0] == [
        f"objects: {objects}, line 2: not UTF-8; expected a text file saved as UTF-8"]
    assert call("Zone, Core;\n")[0] == [f"objects: {objects}: Zone: only GPUShading:... objects belong in this file"]
    assert call("GPUShading:\x1b[2J\n;")[0] == [f"objects: {objects}: cannot be added: GPUShading:\\x1b[2J;"]
    assert len(call("Zone\x1b]0;")[0]) == 1
    assert len(call("x" * 100_000)[0]) == 1
    monkeypatch.setattr(measure, "MOST_TEXT", 1000)
    assert call(texture("a") * 100)[0] == [f"objects: {objects}: more than 0 MiB"]
    for path, why in ((tmp_path / "none", "cannot be read (No such file or directory)"), (tmp_path, "not a file"),
                      ("/dev/zero", "not a file"), (tmp_path / ("x" * 300), "cannot be read (File name too long)")):
        assert call(file=path)[0] == [f"objects: {path}: {why}"]
    os.mkfifo(tmp_path / "pipe")
    assert call(file=tmp_path / "pipe")[0] == [f"objects: {tmp_path / 'pipe'}: not a file"]


def test_a_home_of_nobody(measure, tmp_path):
    runner = Runner(tmp_path, prefix="~nobody_of_this_name/EnergyPlus", objects="")
    assert not measure.RenderShading().run(None, runner, {})
    assert runner.errors == ["prefix: ~nobody_of_this_name/EnergyPlus is not a folder that patch_energyplus created"]


def test_its_description_has_the_checksum_of_its_code():
    text = MEASURE.with_suffix(".xml").read_text()
    assert f"<checksum>{zlib.crc32(MEASURE.read_bytes()):08X}</checksum>" in text

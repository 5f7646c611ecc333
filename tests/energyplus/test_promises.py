"""What reliability.md promises of every program of ours, C++, scripts and Python alike: a test for each row."""

import contextlib
import os
import re
import subprocess
import sys
import tempfile

import our_programs
import pytest
from our_programs import PROGRAMS
from shading_runs import energyplus

DOCUMENT = energyplus.REPOSITORY / "energyplus_patch" / "docs" / "explanation" / "reliability.md"
ROW = re.compile(r"^\| .* \| `(test_\w+)` \|$", re.M)
CONTROLS = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]|\r(?!\n)")
ESCAPES = "Lou\x1b[31mvre\x07 \u009b1m"
MINE = b"the user's own\n"
# Of the programs, of what they start, and of scripts that call the package.
ERROR = r"(gpu_shading: )?error: |gpu_shading study: (?!\d)|compare_\w+: (?!running)"


class Place:
    """A folder with a model, and a program to run there."""

    def __init__(self, name, folder, weather):
        self.program, self.folder, self.weather = PROGRAMS[name], folder, weather
        self.out = folder / self.program.out
        our_programs.furnish(folder, weather)

    def call(self, **more):
        return our_programs.call(self.program, self.folder, self.weather, **more)


def make(name, folder, weather):
    if why := PROGRAMS[name].why_not():
        pytest.skip(why)
    folder.mkdir(exist_ok=True)
    return Place(name, folder, weather)


@pytest.fixture(params=PROGRAMS)
def place(request, patched, weather, tmp_path):
    return make(request.param, tmp_path / "place", weather)


@pytest.fixture(params=[name for name, program in PROGRAMS.items() if program.out])
def writer(request, patched, weather, tmp_path):
    return make(request.param, tmp_path / "place", weather)


@pytest.fixture(scope="module")
def names_written(patched, weather, tmp_path_factory):
    """Of the files that a program writes into a new folder."""
    known = {}

    def names(place):
        if place.program not in known:
            name = next(name for name, program in PROGRAMS.items() if program == place.program)
            new = make(name, tmp_path_factory.mktemp("reference") / "place", weather)
            done = new.call()
            assert done.returncode == 0, done.stderr
            known[place.program] = [path.relative_to(new.out) for path in sorted(new.out.rglob("*"))
                                    if path.is_file()] if new.out.is_dir() else []
        return known[place.program]

    return names


def contents(folder):
    return {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def one_error(done):
    """The line with which a program refuses; there may be others on its progress, its parts, and of EnergyPlus."""
    assert done.returncode in (1, 2), (done.returncode, done.stdout, done.stderr)
    assert "Traceback" not in done.stderr and "terminate called" not in done.stderr, done.stderr
    errors = [line for line in done.stderr.splitlines() if re.match(ERROR, line)]
    assert errors and "Errno" not in done.stderr, done.stderr
    return errors[-1]


def refused(place, done):
    if place.program.warns and done.returncode == 0:
        assert len(re.findall(r"^gpu_shading: warning: ", done.stderr, re.M)) == 1, done.stderr
    else:
        one_error(done)


def test_the_table_names_each_test():
    rows = ROW.findall(DOCUMENT.read_text(encoding="utf-8"))
    assert rows == [name for name in globals() if name.startswith("test_")][2:]


def test_every_command_is_among_the_programs(patched):
    """Those that neither read a model nor write what is named to them are left out, and suite (tests/suite)."""
    told = subprocess.run([patched.parent / "gpu_shading", "--help"], capture_output=True, text=True, check=True).stdout
    commands = set(re.findall(r"^  (\w+)  ", told.partition("ubcommands:")[2], re.M | re.I))
    assert commands - {"devices", "docs", "example", "help", "suite"} == {
        program.words[1] for program in PROGRAMS.values() if program.words[0] == "gpu_shading"}


def test_other_files_stay(writer, names_written):
    """Whether they have names of their own, or those that the program would like to give."""
    folder = writer.out if names_written(writer) else writer.folder
    folder.mkdir(exist_ok=True)
    mine = [folder / name for name in ("notes.txt", "work/mine.txt", "temporary/mine.txt", "scenes/mine.txt",
                                       "runs/mine.txt", "inputs/mine.txt")]
    mine += [folder / name for name in names_written(writer) if writer.program.names_files]
    for path in mine:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(MINE)
    done = writer.call()
    if done.returncode != 0:
        one_error(done)
    assert [path for path in mine if path.read_bytes() != MINE] == []


def test_links_are_not_followed(writer, names_written, tmp_path):
    mine = tmp_path / "mine"
    mine.write_bytes(MINE)
    for name in names_written(writer):
        (writer.out / name).parent.mkdir(parents=True, exist_ok=True)
        (writer.out / name).symlink_to(mine)
    if not names_written(writer):
        writer.out.symlink_to(mine)
    for folder in (writer.folder, writer.out):
        if folder.is_dir() and not (folder / ".lock").is_symlink():
            (folder / ".lock").symlink_to(mine)
    refused(writer, writer.call())
    assert mine.read_bytes() == MINE


def test_a_full_disk_leaves_what_was_there(writer, tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m", "tmpfs", disk], capture_output=True, text=True)
    if mounted.returncode != 0:
        pytest.skip(f"no small file system can be mounted: {mounted.stderr.strip()}")
    try:
        out = disk / writer.program.out
        done = writer.call(out=out)
        assert done.returncode == 0, done.stderr
        before = contents(disk)
        assert before
        status = os.statvfs(disk)
        # Of a page, which the name of a hidden folder takes.
        (disk / "full").write_bytes(b"\0" * (status.f_bavail * status.f_frsize - 4096))
        model = writer.folder / "model.idf"
        model.write_text(model.read_text().replace("0.008", "0.009").replace("Deck,1,1.6", "Deck,1,1.5"))
        refused(writer, writer.call(out=out))
        (disk / "full").unlink()
        assert {path: data for path, data in contents(disk).items() if path in before} == before
    finally:
        subprocess.run(["umount", disk], check=True)


def test_no_code_of_the_current_folder_runs(place, tmp_path):
    """Modules of Python by any name that Python or the package may import."""
    trace, module = tmp_path / "trace", tmp_path / "module.py"
    module.write_text(f"open({str(trace)!r}, 'a').write(__name__ + '\\n')\n")
    others = ("numpy", "distributed", "dask", "tornado", "tomli", "gpu_shading", "sitecustomize", "usercustomize",
              "jinja2", "matplotlib", "PIL", "shading_runs", "pyarrow", "yaml", "cryptography")
    for name in {*sys.stdlib_module_names, *others}:
        (place.folder / f"{name}.py").symlink_to(module)
    done = place.call()
    assert not trace.exists(), trace.read_text()
    assert done.returncode == 0, done.stderr


def test_names_reach_no_terminal_as_commands(place):
    model = place.folder / "model.idf"
    model.write_text(model.read_text().replace("Louvre 1", ESCAPES).replace("South Window", f"South Window {ESCAPES}"))
    views = place.folder / "views.txt"
    views.write_text(views.read_text().replace("South Window", f"South Window {ESCAPES}"))
    unheard_of = place.folder / f"{ESCAPES}.idf"
    for done in (place.call(), place.call(model=unheard_of)):
        # What EnergyPlus itself says goes to standard output.
        said = done.stderr if place.program.words[0] == "energyplus" else done.stdout + done.stderr
        found = CONTROLS.search(said)
        assert not found, repr(said[max(0, found.start() - 60):found.end() + 20])


def _fifo(path):
    os.mkfifo(path)


HOSTILE = {
    "a folder": ("model.idf", lambda path: path.mkdir()),
    "a pipe": ("model.idf", _fifo),
    "no file": ("model.idf", lambda path: None),
    "a device": ("model.idf", lambda path: path.symlink_to("/dev/zero")),
    "rubbish": ("model.idf", lambda path: path.write_bytes(bytes(range(256)) * 64)),
    "a deep nest": ("model.epJSON", lambda path: path.write_text("[" * 100_000)),
}


@pytest.mark.parametrize("kind", HOSTILE)
def test_a_hostile_model_is_one_error(place, kind):
    (place.folder / "model.idf").unlink()
    name, create = HOSTILE[kind]
    create(place.folder / name)
    with contextlib.suppress(FileNotFoundError):
        plan = place.folder / "plan.toml"
        plan.write_text(plan.read_text().replace("model.idf", name))
    done = place.call(model=name)
    assert not CONTROLS.search(one_error(done)) and name in done.stderr, done.stderr


def test_a_blank_name_is_refused(writer):
    names = {path.name for path in writer.folder.iterdir()}
    one_error(writer.call(out=""))
    # A run that is refused says so in its own folder.
    assert {path.name for path in writer.folder.iterdir()} <= names | {"run"}


def test_results_do_not_replace_what_is_read(writer):
    before = contents(writer.folder)
    one_error(writer.call(out=writer.folder / "model.idf"))
    assert {path: data for path, data in contents(writer.folder).items() if path in before} == before


def test_nothing_temporary_stays(place):
    with tempfile.TemporaryDirectory() as temporary:  # a short name, as sockets need
        done = place.call(TMPDIR=temporary)
        assert done.returncode == 0, done.stderr
        assert os.listdir(temporary) == []
    assert [path for path in place.folder.rglob(".*") if path.name.startswith((".gpu_shading-", ".model"))] == []

"""What the Python package writes is there as a whole or not at all, and the user's files are as they were."""

import os
import re
import signal
import subprocess
import sys
import time
import types

import numpy as np
import pytest
from shading_runs import energyplus

PACKAGE = energyplus.REPOSITORY / "gpu_shading" / "python"
sys.path.insert(0, str(PACKAGE))


@pytest.fixture(scope="module")
def files(patched):
    from gpu_shading import _files

    return _files


def everything(folder):
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else None
            for path in folder.rglob("*") if path.name != "full"}


def refused(files, path, content="new"):
    """The reason, of a message of one line that begins with the path as it was given."""
    with pytest.raises(files.FileError) as error:
        files.write_whole(path, content)
    text = str(error.value)
    assert text.startswith(f"{path}: cannot be written (") and text.endswith(")") and "\n" not in text
    return text.removeprefix(f"{path}: cannot be written (")[:-1]


def test_a_file_is_made_and_replaced(files, tmp_path, monkeypatch):
    path = tmp_path / "a.txt"
    files.write_whole(path, "Süd\n")
    assert path.read_bytes() == "Süd\n".encode()
    files.write_whole(str(path), b"\xff\x00")
    monkeypatch.chdir(tmp_path)
    files.write_whole("b.txt", "relative")
    assert everything(tmp_path) == {path.relative_to(tmp_path): b"\xff\x00",
                                    (tmp_path / "b.txt").relative_to(tmp_path): b"relative"}


def test_nothing_but_a_file_is_replaced(files, tmp_path):
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "link").symlink_to("mine")
    (tmp_path / "dangling").symlink_to("nowhere")
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")
    before = everything(tmp_path)
    assert refused(files, tmp_path / "link").startswith("it is a link")
    assert refused(files, tmp_path / "dangling").startswith("it is a link")
    assert refused(files, tmp_path / "folder") == "it is a folder"
    assert refused(files, tmp_path / "pipe") == "it is not a file"
    assert refused(files, "/dev/full") == "it is not a file"
    assert refused(files, tmp_path / "none" / "a") == "No such file or directory"
    assert refused(files, tmp_path / "mine" / "a") == "Not a directory"
    with pytest.raises(files.FileError) as error:
        files.write_whole(tmp_path / "none\n\x1b[2J" / "a", "new")
    assert str(error.value).isprintable()
    assert refused(files, ".") == "it is not the name of a file"
    assert everything(tmp_path) == before


def test_a_full_disk_leaves_the_old_file(files, small_disk):
    folder, fill = small_disk(400, 40)
    files.write_whole(folder / "a.txt", "old" * 1000)
    fill()
    assert refused(files, folder / "a.txt", "new" * 30000) == "No space left on device"
    fill_rest(folder)
    assert refused(files, folder / "a.txt") == "No space left on device"
    assert everything(folder) == {(folder / "a.txt").relative_to(folder): b"old" * 1000, **rest(folder)}


def fill_rest(folder):
    with open(folder / "rest", "wb", buffering=0) as file:
        try:
            while file.write(b"\0" * 1024):
                pass
        except OSError:
            pass


def rest(folder):
    return {(folder / "rest").relative_to(folder): (folder / "rest").read_bytes()}


def test_an_error_of_the_writer_leaves_the_old_files(files, tmp_path):
    files.write_whole(tmp_path / "list", "old")
    with pytest.raises(ZeroDivisionError), files.staged(tmp_path / "list") as temporary:
        temporary.write_text("half")
        temporary.with_name("step").write_text("half")
        raise ZeroDivisionError
    with pytest.raises(FileNotFoundError, match="elsewhere"), files.staged(tmp_path / "list") as temporary:
        (tmp_path / "elsewhere").read_text()
    assert {path.name for path in tmp_path.iterdir()} == {"list"} and (tmp_path / "list").read_text() == "old"


def test_a_list_is_never_there_with_other_files_than_its_own(files, tmp_path, monkeypatch):
    (tmp_path / "step").write_text("old")
    (tmp_path / "list").write_text("old")
    seen = []
    replace = type(tmp_path).replace
    monkeypatch.setattr(type(tmp_path), "replace", lambda path, to: (
        seen.append((to.name, (tmp_path / "list").exists())), replace(path, to)))
    with files.staged(tmp_path / "list") as temporary:
        temporary.write_text("new")
        temporary.with_name("step").write_text("new")
    assert seen == [("step", False), ("list", False)]
    # A step whose name is taken: refused before anything is replaced.
    (tmp_path / "other").mkdir()
    with pytest.raises(files.FileError, match="other: cannot be written .it is a folder"), \
            files.staged(tmp_path / "list") as temporary:
        temporary.write_text("newer")
        temporary.with_name("other").write_text("newer")
        temporary.with_name("step").write_text("newer")
    assert (tmp_path / "list").read_text() == (tmp_path / "step").read_text() == "new"


def test_what_a_killed_process_left_is_deleted_by_the_next(files, tmp_path):
    code = ("from gpu_shading import _files\nimport sys\nwith _files.staged(sys.argv[1]) as path:\n"
            "    path.write_text('half')\n    print('written', flush=True)\n    sys.stdin.read()\n")
    with subprocess.Popen([sys.executable, "-c", code, tmp_path / "a"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          env={**os.environ, "PYTHONPATH": str(PACKAGE)}) as process:
        assert process.stdout.readline() == b"written\n"
        files.write_whole(tmp_path / "b", "whole")
        assert len(list(tmp_path.glob(".gpu_shading-*/a"))) == 1  # of a process that lives
        os.kill(process.pid, signal.SIGKILL)
    (tmp_path / ".gpu_shading-01234567").mkdir()
    (tmp_path / ".gpu_shading-01234567" / ".lock").write_text("the user's own")
    deadline = time.monotonic() + 10
    while list(tmp_path.glob(".gpu_shading-*/a")) and time.monotonic() < deadline:
        files.write_whole(tmp_path / "b", "whole")
    assert sorted(path.name for path in tmp_path.iterdir()) == [".gpu_shading-01234567", "b"]


TALL = [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]


def scene_file(name):
    def write(folder, number):
        import gpu_shading

        scene = gpu_shading.Scene(receivers=[np.array(TALL) + [i, 0, 0] for i in range(400)])
        scene.save(folder / name, np.full((3, 400), 0.25 * number), times=["9", "12", "15"])

    return write


def picture(folder, number):
    from gpu_shading.drawings import Picture

    Picture(bytes([number]) * 100_000).save(folder / "a.png")


def pv_powers(number):
    field = types.SimpleNamespace(name="Roof", clock=np.ones((4000, 4), int), reduction=np.full(4000, 0.1 * number),
                                  beam_reduction=np.full(4000, 0.2 * number))
    return [field]


def reductions(folder, number):
    import gpu_shading

    gpu_shading.write_reductions(pv_powers(number), folder / "pv.csv")


def table(folder, number):
    pytest.importorskip("pandas")
    pytest.importorskip("fastparquet")
    from gpu_shading import pv_modules

    values = np.random.default_rng(number).random((4000, 4))
    pv_modules._write(pv_modules._frame(values, np.arange(4000).astype("datetime64[m]"),
                                        [("Roof", i) for i in range(4)], ["surface", "module"]), folder / "pv.parquet")


def samples(name):
    def write(folder, number):
        xarray = pytest.importorskip("xarray")
        pytest.importorskip("h5netcdf" if name.endswith(".nc") else "fastparquet")
        import gpu_shading

        values = np.random.default_rng(number).random((4000, 4))
        data = xarray.Dataset({"sunlit_fraction": (("time", "receiver"), values)},
                              coords={"time": np.arange(4000), "receiver": list("abcd")})
        gpu_shading.write_samples(data, folder / name)

    return write


def sun_hours(folder, number):
    pytest.importorskip("ladybug")
    import honeybee_gpushading

    grids = tuple(types.SimpleNamespace(identifier=f"grid_{i}", count=4000) for i in range(3))
    values = ((0.1 * number,) * 4000,) * 3
    honeybee_gpushading.SunHours(grids, values, values).write(folder)


WRITERS = {"glb": scene_file("a.glb"), "vtp": scene_file("a.vtp"), "pvd": scene_file("a.pvd"), "picture": picture,
           "reductions": reductions, "modules": table, "nc": samples("a.nc"), "parquet": samples("a.parquet"),
           "sun hours": sun_hours}


@pytest.mark.parametrize("kind", WRITERS)
def test_writers_onto_a_full_disk_leave_the_old_files(kind, files, small_disk):
    folder, fill = small_disk(2000, 16)
    WRITERS[kind](folder, 1)
    before = everything(folder)
    assert len(before) >= {"pvd": 4, "sun hours": 12}.get(kind, 1)
    fill()
    with pytest.raises(files.FileError) as error:
        WRITERS[kind](folder, 2)
    text = str(error.value)
    assert text.startswith(f"{folder}/") and ": cannot be written (" in text and "\n" not in text, text
    assert everything(folder) == before
    (folder / "full").unlink()
    WRITERS[kind](folder, 2)
    after = everything(folder)
    assert after.keys() == before.keys() and after != before


@pytest.mark.parametrize("kind", WRITERS)
def test_writers_do_not_write_through_links(kind, files, tmp_path):
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
    WRITERS[kind](tmp_path / "first", 1)
    for made in [path for path in (tmp_path / "first").rglob("*") if path.is_file()]:
        place = tmp_path / "second" / made.relative_to(tmp_path / "first")
        place.parent.mkdir(exist_ok=True)
        mine = tmp_path / f"mine {made.name}"
        mine.write_text("mine")
        place.symlink_to(mine)
        with pytest.raises(files.FileError, match="it is a link"):
            WRITERS[kind](tmp_path / "second", 2)
        assert mine.read_text() == "mine" and place.is_symlink()
        place.unlink()


def test_the_package_has_no_other_way_to_write_a_file():
    """Whatever writes by itself does so where `staged` has said. Studies write models into folders of their own."""
    writing = re.compile(r"""write_text|write_bytes|to_(csv|parquet|netcdf|json)\(|savefig|\.save\(|savetxt|np\.save
                             |copy(file|2)?\(|\bopen\(.*["'][rb]*[wxa+]""", re.VERBOSE)
    found = [f"{path.name}:{number}: {line.strip()}"
             for path in sorted(PACKAGE.rglob("*.py")) if path.name not in ("_files.py", "measure.py")
             and "study" not in path.parts
             for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
             if writing.search(line) and "temporary" not in line and ".copy()" not in line and "as room:" not in line]
    assert found == []

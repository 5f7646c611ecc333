"""What the Python package writes is there as a whole or not at all, and the user's files are as they were."""

import os
import signal
import subprocess
import sys
import time

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

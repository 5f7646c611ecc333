"""Folders of output: what they replace, what they refuse, and what a kill or a full disk leaves."""

import contextlib
import ctypes
import os
import signal
import stat
import subprocess

import pytest
from shading_runs import output_folder
from shading_runs.errors import in_words
from shading_runs.output_folder import MARKER, NotOurs, replacing, write_file

MAKER = "a_script"


def tree(folder):
    """{path: (mode, contents or where a link leads)} of all below a folder, the markers left out."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.name == MARKER:
            continue
        status = path.lstat()
        contents = os.readlink(path) if path.is_symlink() else path.read_bytes() if path.is_file() else b""
        found[path.relative_to(folder)] = (stat.S_IFMT(status.st_mode), contents)
    return found


def make(target, files, **options):
    with replacing(target, MAKER, **options) as folder:
        for name, text in files.items():
            (folder.path / name).parent.mkdir(parents=True, exist_ok=True)
            (folder.path / name).write_text(text)
    return folder


def names(folder):
    return sorted(path.name for path in folder.iterdir() if path.name != MARKER)


def test_replaces_its_own_folder_as_a_whole(tmp_path):
    target = tmp_path / "deep" / "out"
    make(target, {"a.csv": "1", "gpu/run.err": "1"})
    make(target, {"b.csv": "2"})
    assert names(target) == ["b.csv"]
    assert names(target.parent) == ["out"]


@pytest.mark.parametrize("before", ["nothing", "empty"])
def test_needs_a_new_or_an_empty_folder(before, tmp_path):
    target = tmp_path / "out"
    if before == "empty":
        target.mkdir()
    make(target, {"a": "1"})
    assert (target / "a").read_text() == "1"


def damage(case, target):
    """Does to the folder what a user might; returns what the message names."""
    if case == "file added":
        (target / "notes.txt").write_text("mine")
        return target / "notes.txt"
    if case == "file added below":
        (target / "gpu" / "model.idf").write_text("mine")
        return target / "gpu" / "model.idf"
    if case == "folder added":
        (target / "gpu" / "mine").mkdir()
        return target / "gpu" / "mine"
    if case == "file changed":
        (target / "gpu" / "run.err").write_text("2")
        return target / "gpu" / "run.err"
    if case == "link for a file of the same contents":
        (target.parent / "mine").write_text("1")
        (target / "gpu" / "run.err").unlink()
        (target / "gpu" / "run.err").symlink_to(target.parent / "mine")
        return target / "gpu" / "run.err"
    if case == "link for a folder of the same contents":
        (target / "gpu").rename(target.parent / "mine")
        (target / "gpu").symlink_to(target.parent / "mine")
        return target / "gpu"
    if case == "pipe added":
        os.mkfifo(target / "pipe")
        return target / "pipe"
    if case == "folder is a link":
        target.rename(target.parent / "mine")
        target.symlink_to(target.parent / "mine")
        return target
    if case == "marker deleted":
        (target / MARKER).unlink()
        return target
    if case == "marker damaged":
        (target / MARKER).write_text((target / MARKER).read_text()[:-9])
        return target
    if case == "marker of another version":
        (target / MARKER).write_text((target / MARKER).read_text().replace('"version": 1', '"version": 2'))
        return target
    if case == "marker of another script":
        (target / MARKER).write_text((target / MARKER).read_text().replace(MAKER, "other"))
        return target
    raise KeyError(case)


@pytest.mark.parametrize("case", [
    "file added", "file added below", "folder added", "file changed", "link for a file of the same contents",
    "link for a folder of the same contents", "pipe added", "folder is a link", "marker deleted", "marker damaged",
    "marker of another version", "marker of another script",
])
def test_refuses_what_it_did_not_make(case, tmp_path):
    target = tmp_path / "out"
    make(target, {"a.csv": "1", "gpu/run.err": "1"})
    named = damage(case, target)
    before = tree(tmp_path)
    with pytest.raises(NotOurs) as refused:
        make(target, {"b.csv": "2"})
    assert str(refused.value).startswith(str(named)) and "\n" not in str(refused.value)
    assert tree(tmp_path) == before


def test_a_file_added_during_the_run_is_kept(tmp_path):
    """And what the run made is in the other folder."""
    target = tmp_path / "out"
    make(target, {"a.csv": "1"})
    with pytest.raises(NotOurs, match="notes.txt"), replacing(target, MAKER) as folder:
        (folder.path / "b.csv").write_text("2")
        (target / "notes.txt").write_text("mine")
    assert names(target) == ["a.csv", "notes.txt"]
    assert names(tmp_path / "out.failed") == ["b.csv"]


def test_an_error_leaves_the_former_output_and_the_new_one_beside_it(tmp_path):
    target = tmp_path / "out"
    make(target, {"a.csv": "1"})
    for text in ("first", "second"):
        with pytest.raises(ValueError, match=text), replacing(target, MAKER) as folder:
            (folder.path / "run.err").write_text(text)
            raise ValueError(text)
        assert names(tmp_path) == ["out", "out.failed"]
        assert (tmp_path / "out.failed" / "run.err").read_text() == text
        assert folder.said(f"see {folder.path}/run.err") == f"see {tmp_path}/out.failed/run.err"
    assert names(target) == ["a.csv"]
    (tmp_path / "out.failed" / "mine").write_text("mine")
    with pytest.raises(ValueError), replacing(target, MAKER) as folder:
        (folder.path / "run.err").write_text("third")
        raise ValueError
    assert names(tmp_path / "out.failed") == ["mine", "run.err"]
    assert (tmp_path / "out.failed" / "run.err").read_text() == "second"
    assert names(tmp_path) == ["out", "out.failed"]


def test_an_interrupted_run_leaves_nothing(tmp_path):
    with pytest.raises(KeyboardInterrupt), replacing(tmp_path / "out", MAKER) as folder:
        (folder.path / "a").write_text("1")
        raise KeyboardInterrupt
    assert names(tmp_path) == []


def test_others_are_kept_where_that_is_asked_for(tmp_path):
    target = tmp_path / "out"
    make(target, {"a.csv": "1", "run/old": "1", "other/deep/x": "1"})
    with replacing(target, MAKER, keep_others=True) as folder:
        (folder.path / "link").symlink_to("nowhere")
        (folder.path / "run").mkdir()
        (folder.path / "run" / "new").write_text("2")
    make(target, {"b.csv": "3"}, keep_others=True)
    assert names(target) == ["a.csv", "b.csv", "link", "other", "run"]
    assert names(target / "run") == ["new"]
    assert (target / "other" / "deep" / "x").read_text() == "1"
    assert os.readlink(target / "link") == "nowhere"
    make(target, {"b.csv": "4"})
    assert names(target) == ["b.csv"]


def killed(action):
    """Runs an action in a child process that is killed where it calls what it is given."""
    child = os.fork()
    if child == 0:
        with contextlib.suppress(BaseException):
            action(lambda *_: os.kill(os.getpid(), signal.SIGKILL))
        os._exit(0)
    _, status = os.waitpid(child, 0)
    assert os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGKILL


STEPS = ["mkdir", "_write_marker", "block", "listing", "_exchange", "_sync", "_remove_listed"]


@pytest.mark.parametrize(("step", "former"), [
    *((step, True) for step in STEPS), *((step, False) for step in STEPS if step != "_remove_listed")])
def test_a_kill_leaves_the_former_output_or_the_new_one(step, former, tmp_path):
    target = tmp_path / "out"
    if former:
        make(target, {"a.csv": "1", "gpu/run.err": "1"})
    old = tree(target)

    def action(kill):
        if step == "mkdir":
            output_folder._lock = kill
        elif step == "_sync":  # the last one, of the folder that holds the target
            sync = output_folder._sync
            output_folder._sync = lambda path: kill() if path == tmp_path else sync(path)
        elif step != "block":
            setattr(output_folder, step, kill)
        with replacing(target, MAKER) as folder:
            (folder.path / "b.csv").write_text("2")
            if step == "block":
                kill()

    killed(action)
    is_new = step in ("_sync", "_remove_listed")
    assert (tree(target) if target.exists() else {}) == ({target.relative_to(target) / "b.csv": (stat.S_IFREG, b"2")}
                                                         if is_new else old)
    make(target, {"c.csv": "3"})
    assert names(target) == ["c.csv"]
    assert names(tmp_path) == ["out"]


def test_a_kill_on_a_file_system_that_cannot_exchange(tmp_path, monkeypatch):
    """Two renames, and between them there is no output: the next script puts the former one back."""
    target = tmp_path / "out"
    make(target, {"a.csv": "1"})
    monkeypatch.setattr(output_folder.ctypes, "CDLL", lambda *_, **__: object())

    def action(kill):
        rename = output_folder.Path.rename
        output_folder.Path.rename = lambda path, to: kill() if path.name.startswith(".") and target.name == to.name \
            and not target.exists() else rename(path, to)
        make(target, {"b.csv": "2"})

    killed(action)
    assert not target.exists()
    with pytest.raises(ValueError), replacing(target, MAKER):
        assert names(target) in (["a.csv"], ["b.csv"])
        raise ValueError
    make(target, {"c.csv": "3"})
    assert names(target) == ["c.csv"]
    assert names(tmp_path) == ["out"]


def test_two_at_once_do_not_clean_each_other(tmp_path):
    target = tmp_path / "out"
    with replacing(target, MAKER) as first:
        (first.path / "first").write_text("1")
        make(target, {"second": "2"})
        assert names(target) == ["second"]
    assert names(target) == ["first"]
    assert names(tmp_path) == ["out"]


def test_only_its_own_temporary_folders_are_cleaned(tmp_path):
    users = tmp_path / f".out.{MAKER}-12345678"
    users.mkdir()
    (users / "mine").write_text("mine")
    (tmp_path / f".out.{MAKER}-link").symlink_to(users)
    make(tmp_path / "out", {"a": "1"})
    assert (users / "mine").read_text() == "mine"


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 256 kB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", folder], capture_output=True, text=True)
    if done.returncode != 0:
        pytest.skip(f"no small file system can be mounted: {done.stderr.strip()}")
    yield folder
    subprocess.run(["umount", folder], check=True)


def test_a_full_disk_leaves_the_former_output(small_disk):
    target = small_disk / "out"
    make(target, {"a.csv": "1" * 100_000})
    before = tree(target)
    for _ in range(2):
        with pytest.raises(OSError, match="No space left"):
            make(target, {"a.csv": "2" * 300_000})
        assert tree(target) == before
        assert [name for name in names(small_disk) if name.startswith(".")] == []
    picture = small_disk / "picture.png"
    write_file(picture, b"1" * 50_000)
    with pytest.raises(OSError, match="No space left") as raised:
        write_file(picture, b"2" * 300_000)
    assert in_words(raised.value) == f"{picture}: No space left on device"
    assert picture.read_bytes() == b"1" * 50_000
    assert [name for name in names(small_disk) if name.startswith(".")] == []


def test_a_mount_point_is_refused(small_disk):
    with pytest.raises(NotOurs, match="mount point"):
        make(small_disk, {"a": "1"})


def test_a_limit_on_file_sizes_leaves_the_former_file(tmp_path):
    path = tmp_path / "table.svg"
    write_file(path, "old")
    child = os.fork()
    if child == 0:
        import resource

        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        try:
            write_file(path, "n" * 2000)
        except OSError:
            os._exit(3)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
    assert path.read_text() == "old"
    assert names(tmp_path) == ["table.svg"]


def test_a_file_is_not_written_through_a_link(tmp_path):
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "out.svg").symlink_to(tmp_path / "mine")
    with pytest.raises(NotOurs, match="is a link"):
        write_file(tmp_path / "out.svg", "new")
    assert (tmp_path / "mine").read_text() == "mine"


def test_an_error_names_the_file_that_was_wanted(tmp_path):
    with pytest.raises(FileNotFoundError) as raised:
        write_file(tmp_path / "none" / "out.svg", "new")
    assert in_words(raised.value) == f"{tmp_path / 'none' / 'out.svg'}: No such file or directory"


def test_the_kernel_exchanges_folders_here():
    """Or else the tests above have only walked the way around it."""
    assert hasattr(ctypes.CDLL(None), "renameat2")

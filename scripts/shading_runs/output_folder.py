"""Output folders that replace only what the same script created.

    with output_folder.replacing(target, "compare_shading") as folder:
        ...  # write into folder.path

The script writes into a new folder beside the target, `.TARGET.MAKER-xxxxxxxx`. When the block ends, the two are
exchanged in one step and the old output is deleted. If the script is killed, the old output stays complete, and the
next script deletes the unfinished folder. Rules:

- The target must not exist, be empty, or contain a marker of the same maker that lists each of its files with a hash
  of the contents. A file that is not listed, or that has changed since, stops the script (NotOurs).
- Nothing is written through a link: the new folder has none at first, and a target that is a link is refused.
- If the block ends with an error, what it wrote is kept in TARGET.failed, under the same rules.

Only Python's standard library is used, because this file is installed with patch_energyplus.
"""

import contextlib
import hashlib
import json
import os
import secrets
import shutil
import stat
from pathlib import Path

MARKER = ".gpu_shading_output.json"
VERSION = 1  # of the marker's format
IS_WINDOWS = os.name == "nt"
if not IS_WINDOWS:
    import ctypes
    import fcntl
FOLDER, LINK = "folder", "link "  # in the list; a file is listed by its hash


class NotOurs(ValueError):
    """The script would have to delete or overwrite something that it cannot prove it created; one line."""


def _open_itself(path, *further):
    """A descriptor for reading, never through a link; `further`: flags that not all systems have."""
    flags = os.O_RDONLY
    for name in ("O_NOFOLLOW", "O_BINARY", *further):
        flags |= getattr(os, name, 0)
    return os.open(path, flags)


def _read_marker(folder):
    """The marker of a folder, {} if there is no valid one."""
    try:
        descriptor = _open_itself(folder / MARKER, "O_NONBLOCK")
        with open(descriptor, encoding="ascii") as file:
            marker = json.load(file)
    except (OSError, ValueError):
        return {}
    known = isinstance(marker, dict) and marker.get("version") == VERSION and isinstance(marker.get("entries"), dict)
    return marker if known else {}


def _write_marker(folder, maker, complete, entries):
    text = json.dumps({"maker": maker, "version": VERSION, "complete": complete, "entries": entries}, indent=0)
    write_file(folder / MARKER, text.encode("ascii"))


def _entry(path):
    """The list entry of a path; raises NotOurs for what no script creates, such as a device."""
    mode = path.lstat().st_mode
    if stat.S_ISLNK(mode):
        return LINK + os.readlink(path)
    if stat.S_ISDIR(mode):
        return FOLDER
    if not stat.S_ISREG(mode):
        raise NotOurs(f"{path} is neither a file nor a folder nor a link: move it, or choose another folder")
    descriptor = _open_itself(path)
    with open(descriptor, "rb") as file:
        digest = hashlib.sha256()
        while block := file.read(1 << 20):
            digest.update(block)
        return digest.hexdigest()


def _paths(folder, parent=""):
    """Yields (path, name in the folder) of everything but the marker, each folder before its contents."""
    for path in sorted(folder.iterdir(), key=os.fsencode):
        name = parent + path.name
        if name == MARKER:
            continue
        yield path, name
        if stat.S_ISDIR(path.lstat().st_mode):
            yield from _paths(path, name + "/")


def _sync(path):
    if IS_WINDOWS:  # it flushes neither folders nor what is open for reading
        return
    descriptor = _open_itself(path)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def listing(folder):
    """{name: list entry} of the contents of a folder, which it flushes to disk."""
    entries = {}
    for path, name in _paths(folder):
        entries[name] = _entry(path)
        if not entries[name].startswith(LINK):
            _sync(path)
    return entries


def _foreign(folder, entries):
    """The first path in a folder that differs from its entry or has none; None if there is no such path."""
    return next((path for path, name in _paths(folder) if entries.get(name) != _entry(path)), None)


def _remove_listed(folder, entries):
    """Deletes what entries list, then the marker and the folder; raises NotOurs if there is anything else."""
    for path, name in reversed(list(_paths(folder))):
        if entries.get(name) != _entry(path):
            raise NotOurs(f"{path} was not created by this script and is kept")
        if entries[name] == FOLDER:
            path.rmdir()
        else:
            path.unlink()
    (folder / MARKER).unlink(missing_ok=True)
    folder.rmdir()


def mark(folder, maker):
    """Marks the contents of a folder as created by maker."""
    _write_marker(folder, maker, True, listing(folder))


def absolute(path):
    """The absolute path with links in its parents resolved; if it is a link itself, it stays one."""
    path = Path(path).absolute()
    return path.resolve() if path.name in ("", "..") else path.parent.resolve() / path.name


def check(target, maker):
    """Raises NotOurs unless maker may replace target. Returns the entries of its marker."""
    if target.is_symlink():
        raise NotOurs(f"{target} is a link: give the folder itself")
    if not target.exists():
        return {}
    if not target.is_dir():
        raise NotOurs(f"{target} is not a folder: choose another name")
    if os.path.ismount(target):
        raise NotOurs(f"{target} is a mount point and cannot be replaced: choose a new folder in it")
    if not any(target.iterdir()):
        return {}
    marker = _read_marker(target)
    if marker.get("maker") != maker:
        raise NotOurs(f"{target} exists and was not created by {maker}: choose a new folder")
    foreign = _foreign(target, marker["entries"])
    if foreign:
        raise NotOurs(f"{foreign} was not created by {maker} or has been changed: move it, or choose a new folder")
    return marker["entries"]


def _exchange_at_once(new, target):
    """Whether the system could."""
    if IS_WINDOWS:
        return False
    at_fdcwd, rename_exchange = -100, 2
    libc = ctypes.CDLL(None, use_errno=True)
    arguments = (at_fdcwd, os.fsencode(new), at_fdcwd, os.fsencode(target), rename_exchange)
    return hasattr(libc, "renameat2") and libc.renameat2(*arguments) == 0


def _exchange(new, target):
    """Renames new to target and, if target exists, target to new."""
    try:
        new.rename(target)  # nothing there, or an empty folder
        return
    except OSError:
        if not target.is_dir():
            raise
    if _exchange_at_once(new, target):
        return
    # The file system cannot exchange folders: two steps. If the script is killed between them, _clean repairs it.
    old = new.with_name(new.name + ".old")
    target.rename(old)
    new.rename(target)
    old.rename(new)


def _lock(folder):
    """A descriptor that locks a folder until it is closed or the process ends; None if another process has it.

    Windows does not rename a folder in which a file is open: there, nothing is locked.
    """
    if IS_WINDOWS:
        return os.open(os.devnull, os.O_RDONLY)
    descriptor = _open_itself(folder, "O_DIRECTORY")
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        return None
    return descriptor


def _prefix(target, maker):
    return f".{target.name}.{maker}-"


def _clean(target, maker):
    """Deletes what killed scripts left beside target; restores an old output that one had moved away."""
    if IS_WINDOWS or not target.parent.is_dir():  # without locks, they may be of a script that still runs
        return
    prefix = _prefix(target, maker)
    for folder in sorted(target.parent.iterdir()):
        if not folder.name.startswith(prefix) or folder.is_symlink() or not folder.is_dir():
            continue
        lock = _lock(folder)
        if lock is None:
            continue
        try:
            marker = _read_marker(folder)
            if marker.get("maker") != maker:
                with contextlib.suppress(OSError):
                    folder.rmdir()  # killed before the marker was written
            elif not marker.get("complete"):
                shutil.rmtree(folder)
            elif not target.exists():
                folder.rename(target)
            else:
                with contextlib.suppress(NotOurs):
                    _remove_listed(folder, marker["entries"])
        finally:
            os.close(lock)


def _keep_others(old, entries, new):
    """Links the entries of old into new, except those whose first folder or file exists in new."""
    made = {path.name for path in new.iterdir()}
    for name, kind in entries.items():
        source, target = old / name, new / name
        if name.partition("/")[0] in made or not os.path.lexists(source):
            continue
        if kind == FOLDER:
            target.mkdir()
        elif kind.startswith(LINK):
            target.symlink_to(kind.removeprefix(LINK))
        else:
            try:
                os.link(source, target, follow_symlinks=False)
            except OSError:  # no hard links on this file system
                shutil.copy2(source, target, follow_symlinks=False)


class OutputFolder:
    """path is where to write; it is renamed to target, or to failed after an error."""

    def __init__(self, target, maker):
        self.target, self.maker = target, maker
        self.failed = target.with_name(target.name + ".failed")
        self._put_in = target  # where the files are when the block has ended
        self._is_put = False
        target.parent.mkdir(parents=True, exist_ok=True)
        self._lock = None
        while self._lock is None:  # another script may clean up between the two steps
            self.path = target.with_name(_prefix(target, maker) + secrets.token_hex(4))
            self.path.mkdir()
            with contextlib.suppress(FileNotFoundError):
                self._lock = _lock(self.path)
        _write_marker(self.path, maker, False, {})

    def said(self, text):
        """A message in which paths are those that are valid when the block has ended."""
        return str(text).replace(str(self.path), str(self._put_in))

    def _put(self, target, complete):
        """Replaces target and deletes its old contents if they are still those that were checked."""
        _write_marker(self.path, self.maker, complete, listing(self.path))
        before = check(target, self.maker)
        _exchange(self.path, target)
        self._is_put, self._put_in = True, target
        _sync(target.parent)
        if self.path.exists():
            _remove_listed(self.path, before)

    def publish(self, keep_others):
        if keep_others:
            _keep_others(self.target, check(self.target, self.maker), self.path)
        self._put(self.target, True)

    def keep_failed(self):
        if not self._is_put and any(_paths(self.path)):
            with contextlib.suppress(NotOurs, OSError):
                self._put(self.failed, False)

    def close(self):
        """Deletes the folder unless it has replaced another."""
        if not self._is_put:
            shutil.rmtree(self.path)
        os.close(self._lock)


@contextlib.contextmanager
def replacing(target, maker, keep_others=False, keep_failed=True):
    """An OutputFolder that replaces target when the block ends. Raises NotOurs and OSError.

    keep_others: entries of the old output that the new one does not have are kept.
    keep_failed: if the block ends with an error, what it wrote is kept in TARGET.failed.
    """
    target = absolute(target)
    check(target, maker)
    _clean(target, maker)
    folder = OutputFolder(target, maker)
    try:
        yield folder
        folder.publish(keep_others)
    except KeyboardInterrupt:
        raise
    except BaseException:
        if keep_failed:
            folder.keep_failed()
        raise
    finally:
        folder.close()


def write_file(path, contents):
    """Writes bytes or text to a temporary file beside path, flushes it, and renames it to path."""
    path = Path(path)
    if path.is_symlink():
        raise NotOurs(f"{path} is a link: give the file itself")
    if path.exists() and not path.is_file():
        raise NotOurs(f"{path} is not a file")
    if isinstance(contents, str):
        contents = contents.encode("utf-8")
    beside = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    try:
        with open(beside, "xb") as file:
            file.write(contents)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
    except OSError as error:
        error.filename = path  # not the temporary file
        raise
    finally:
        beside.unlink(missing_ok=True)

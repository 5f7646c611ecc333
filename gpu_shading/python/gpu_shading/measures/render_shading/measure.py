"""Adds GPUShading objects to a workspace, and has OpenStudio run an EnergyPlus with rendered shading.

OpenStudio runs this in a Python of its own, in which the package that this file comes with cannot be imported.
"""

from __future__ import annotations

import contextlib
import os
import re
import secrets
import stat
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import Any, BinaryIO

import openstudio  # type: ignore

PREFIX = "~/EnergyPlus-gpu"  # as patch_energyplus creates it
# OpenStudio has objects that its dictionary lacks as Catchall, with the type in the first field.
UNKNOWN = "Catchall"
COMMENT = re.compile(r"![^\n]*")
MOST_TEXT = 64 << 20  # bytes of a file of objects
MOST_BYTES = 1 << 30  # of a file that is copied
CHUNK = 1 << 20


class Refused(Exception):
    """Why nothing is done, in one line."""


class RenderShading(openstudio.measure.EnergyPlusMeasure):  # type: ignore
    """The measure; names of methods are OpenStudio's."""

    def name(self) -> str:
        return "Render Shading"

    def description(self) -> str:
        return ("Computes solar shading by rendering: perforated screens, transparent and moving shades, trees, "
                "neighbours and thousands of louvres.")

    def modeler_description(self) -> str:
        return ("Adds the GPUShading objects of a file to the workspace, and sets ENERGYPLUS_EXE_PATH and GPU_SHADING, "
                "so that the EnergyPlus of a folder that patch_energyplus created runs. Images and other files that "
                "the objects name are copied into the run's folder.")

    def arguments(self, workspace: Any = None) -> Any:
        arguments = openstudio.measure.OSArgumentVector()
        for name, title, description, default in (
                ("prefix", "Patched EnergyPlus", "A folder that patch_energyplus created",
                 os.environ.get("GPU_SHADING_PREFIX") or PREFIX),
                ("objects", "GPUShading objects",
                 "An IDF with GPUShading objects alone; blank: those that the workspace has", "")):
            argument = openstudio.measure.OSArgument.makeStringArgument(name, False)
            argument.setDisplayName(title)
            argument.setDescription(description)
            argument.setDefaultValue(default)
            arguments.append(argument)
        return arguments

    def run(self, workspace: Any, runner: Any, user_arguments: Any) -> bool:
        super().run(workspace, runner, user_arguments)
        if not runner.validateUserArguments(self.arguments(workspace), user_arguments):
            return False
        try:
            prefix = _prefix(runner.getStringArgumentValue("prefix", user_arguments))
            count = _add_objects(workspace, runner, runner.getStringArgumentValue("objects", user_arguments))
        except Refused as refused:
            runner.registerError(_line(str(refused)))
            return False
        os.environ["ENERGYPLUS_EXE_PATH"] = str(prefix.resolve() / "energyplus")
        os.environ.setdefault("GPU_SHADING", "1")
        runner.registerFinalCondition(_line(f"{count} GPUShading objects added; {prefix} runs the model"))
        return True


def _line(text: str) -> str:
    """One line, without control characters and not too long."""
    shown = "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in " ".join(text.split()))
    return shown if len(shown) <= 1000 else shown[:1000] + "..."


def _prefix(name: str) -> Path:
    prefix = Path(name)
    with contextlib.suppress(RuntimeError):  # no such user
        prefix = prefix.expanduser()
    if not (prefix / "gpu_shading").is_file():
        raise Refused(f"prefix: {prefix} is not a folder that patch_energyplus created")
    return prefix


def _add_objects(workspace: Any, runner: Any, name: str) -> int:
    """Adds the objects of a file, and copies what they name. Returns their number."""
    if not name:
        return 0
    found = runner.workflow().findFile(name)
    file = Path(str(found.get()) if found.is_initialized() else name).absolute()
    folder, run_folder = file.parent, Path(str(runner.workflow().absoluteRunDir()))
    objects = [_loaded(file, text) for text in _texts(file)]
    names = dict.fromkeys(value for loaded in objects for value in _names(loaded, folder))
    for value in [value for value in names if _is_missing(file, value, run_folder)]:
        _copy(folder / value, run_folder / value)
    for loaded in objects:
        if workspace.addObject(loaded).empty():
            raise Refused(f"objects: {file}: cannot be added: {loaded}")
    return len(objects)


def _texts(file: Path) -> list[str]:
    """The text of each object of a file."""
    with _opened(file) as lines:
        content = lines.read(MOST_TEXT + 1)
    if len(content) > MOST_TEXT:
        raise Refused(f"objects: {file}: more than {MOST_TEXT >> 20} MiB")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[:error.start].count(b"\n") + 1
        raise Refused(f"objects: {file}, line {line}: not UTF-8; expected a text file saved as UTF-8") from None
    objects = []
    for each in COMMENT.sub("", text).split(";"):
        kind = each.split(",")[0].strip()
        if kind.upper().startswith("GPUSHADING:"):
            objects.append(each.strip() + ";")
        elif each.strip() and kind.upper() != "VERSION":
            raise Refused(f"objects: {file}: {kind[:80]}: only GPUShading:... objects belong in this file")
    return objects


def _loaded(file: Path, text: str) -> Any:
    try:
        loaded = openstudio.IdfObject.load(text)
        if loaded.is_initialized():
            return loaded.get()
    except (RuntimeError, TypeError, UnicodeError):  # of OpenStudio's library
        pass
    raise Refused(f"objects: {file}: cannot be added: {text}")


def _names(loaded: Any, folder: Path) -> list[str]:
    """The fields that name something relative to a folder."""
    values = (loaded.getString(index).get() for index in range(1, loaded.numFields()))
    return [value for value in values if value and not Path(value).is_absolute() and _is_file(folder / value)]


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # too long for a name
        return False


def _is_missing(file: Path, value: str, run_folder: Path) -> bool:
    """Whether the file that an object names is to be copied into the folder where EnergyPlus runs."""
    source, target = file.parent / value, run_folder / value
    if ".." in Path(value).parts or not (_is_below(source, file.parent) and _is_below(target, run_folder)):
        raise Refused(f"objects: {file}: {value} leaves {file.parent}; expected a file in that folder or below it, "
                      "without .. and links out of it")
    if not os.path.lexists(target):
        return True
    with _opened(source) as one, _opened(target) as other:
        if target.is_symlink() or any(chunk != other.read(CHUNK) for chunk in chain(_chunks(one, source), [b""])):
            raise Refused(f"objects: {file}: {value} would replace another {target}; move that one away")
    return False


def _is_below(path: Path, folder: Path) -> bool:
    try:
        return folder.resolve() in path.resolve().parents
    except (OSError, RuntimeError):  # links in a circle
        return False


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[BinaryIO]:
    """A regular file."""
    # Opening a pipe would wait for a writer.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    try:
        descriptor = os.open(path, flags)
    except (OSError, ValueError) as error:
        raise Refused(f"objects: {path}: cannot be read ({getattr(error, 'strerror', None) or error})") from None
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise Refused(f"objects: {path}: not a file")
    with open(descriptor, "rb") as file:
        yield file


def _chunks(file: BinaryIO, name: Path) -> Iterator[bytes]:
    total = 0
    while chunk := file.read(CHUNK):
        total += len(chunk)
        if total > MOST_BYTES:
            raise Refused(f"objects: {name}: more than {MOST_BYTES >> 20} MiB")
        yield chunk


def _copy(source: Path, target: Path) -> None:
    """Into a new file, whole or not at all."""
    staged = target.with_name(f".gpu_shading-{secrets.token_hex(8)}")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            with _opened(source) as content, open(staged, "xb") as file:
                file.writelines(_chunks(content, source))
                file.flush()
                os.fsync(file.fileno())
            staged.replace(target)
        finally:
            staged.unlink(missing_ok=True)
    except OSError as error:
        raise Refused(f"objects: {target}: cannot be written ({error.strerror or error})") from None


RenderShading().registerWithApplication()

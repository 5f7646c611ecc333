"""Adds GPUShading objects to a workspace, and has OpenStudio run an EnergyPlus with rendered shading.

OpenStudio runs this in a Python of its own, in which the package that this file comes with cannot be imported.
"""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from typing import Any

import openstudio  # type: ignore

PREFIX = "~/EnergyPlus-gpu"  # as patch_energyplus creates it
# OpenStudio has objects that its dictionary lacks as Catchall, with the type in the first field.
UNKNOWN = "Catchall"
COMMENT = re.compile(r"![^\n]*")


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
        prefix = Path(runner.getStringArgumentValue("prefix", user_arguments)).expanduser()
        if not (prefix / "gpu_shading").is_file():
            runner.registerError(f"prefix: {prefix} is not a folder that patch_energyplus created")
            return False
        name = runner.getStringArgumentValue("objects", user_arguments)
        try:
            objects, file = _objects(runner, name) if name else ([], None)
        except (OSError, ValueError) as error:
            runner.registerError(f"objects: {error}")
            return False
        for text in objects:
            loaded = openstudio.IdfObject.load(text)
            if not loaded.is_initialized() or workspace.addObject(loaded.get()).empty():
                runner.registerError(f"objects: {name}: cannot be added: {' '.join(text.split())}")
                return False
            if file is not None:
                _copy_files(loaded.get(), file.parent, _run_folder(runner))
        os.environ["ENERGYPLUS_EXE_PATH"] = str(prefix.resolve() / "energyplus")
        os.environ.setdefault("GPU_SHADING", "1")
        runner.registerFinalCondition(f"{len(objects)} GPUShading objects added; {prefix} runs the model")
        return True


def _objects(runner: Any, name: str) -> tuple[list[str], Path]:
    """The text of each object of a file, and the file."""
    found = runner.workflow().findFile(name)
    file = Path(str(found.get()) if found.is_initialized() else name).absolute()
    objects = []
    for text in COMMENT.sub("", file.read_text(encoding="utf-8-sig")).split(";"):
        kind = text.split(",")[0].strip()
        if kind.upper().startswith("GPUSHADING:"):
            objects.append(text.strip() + ";")
        elif text.strip() and kind.upper() != "VERSION":
            raise ValueError(f"{file}: {kind}: only GPUShading:... objects belong in this file")
    return objects, file


def _run_folder(runner: Any) -> Path:
    return Path(str(runner.workflow().absoluteRunDir()))


def _copy_files(loaded: Any, source: Path, target: Path) -> None:
    """What fields name in the folder of the objects, for the folder where EnergyPlus runs."""
    for index in range(1, loaded.numFields()):
        value = loaded.getString(index).get()
        if value and not Path(value).is_absolute() and (source / value).is_file() and source != target:
            (target / value).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source / value, target / value)


RenderShading().registerWithApplication()

"""Where the library and the programs are (beside this package, in a wheel, in a build tree, or on the system), and how
programs are run."""

from __future__ import annotations

import importlib
import importlib.util
import os
import re
import subprocess
import warnings
from collections.abc import Sequence
from pathlib import Path

from gpu_shading.errors import InvalidInput, RunError

Name = str | os.PathLike[str]
_PACKAGE = Path(__file__).resolve().parent
_LIBRARY = "libgpu_shading_python.so"
_WARNING = "gpu_shading: warning: "
_MARKER = ".gpu_shading_prefix.json"  # of patch_energyplus


def _build() -> Path | None:
    """The build folder of the sources in which this package lies."""
    sources = _PACKAGE.parents[2]
    if not (sources / "CMakeLists.txt").is_file():
        return None
    return sources / os.environ.get("GPU_SHADING_BUILD", "build")


def _wheel() -> Path | None:
    found = importlib.util.find_spec("energyplus_gpu_shading")
    return Path(found.origin).parent if found is not None and found.origin else None


def library() -> Path:
    """The shared library that this package calls."""
    folders = []
    build, wheel = _build(), _wheel()
    if build:
        folders.append(build / "gpu_shading")
    # cmake --install puts this package into lib/python3/dist-packages.
    folders.append(_PACKAGE.parents[3] / "libexec" / "gpu_shading")
    if wheel:
        folders.append(wheel / "libexec" / "gpu_shading")
    for folder in folders:
        if (folder / _LIBRARY).is_file():
            return folder / _LIBRARY
    searched = ", ".join(map(str, folders))
    raise ImportError(f"gpu_shading: {_LIBRARY} is in none of {searched}: install the package again")


def prefix() -> Path:
    """The patched EnergyPlus: the one that GPU_SHADING_PREFIX names, that of the wheel or of the build, the one in the
    search path, or ~/EnergyPlus-gpu. Raises RunError if there is none."""
    chosen, build = os.environ.get("GPU_SHADING_PREFIX"), _build()
    if chosen:
        folder = Path(chosen)
    elif build:
        folder = build / "EnergyPlus"
    elif _wheel():
        folder = _prefix_of_wheel()
    else:
        in_path = (Path(name) for name in os.get_exec_path())
        folder = next((path for path in in_path if (path / _MARKER).is_file()), Path.home() / "EnergyPlus-gpu")
    if not (folder / "gpu_shading").is_file():
        raise RunError(f"{folder} is not a folder that patch_energyplus created: name one in GPU_SHADING_PREFIX")
    return folder


def _prefix_of_wheel() -> Path:
    wheel = importlib.import_module("energyplus_gpu_shading")
    try:
        return Path(wheel.prefix())
    except SystemExit as error:
        raise RunError(str(error.code)) from None


def measures() -> Path:
    """The folder of OpenStudio measures, for measure_paths of a workflow."""
    return _PACKAGE / "measures"


def file(name: Name, what: str) -> Path:
    """The absolute path of a file that must be there."""
    path = Path(name)
    if not path.is_file():
        raise InvalidInput(f"{what}: {path}: no such file")
    return path.absolute()


def folder(name: Name | None, otherwise: Path) -> Path:
    """The absolute path of a folder for results. A blank name would be the current folder."""
    if name is not None and not os.fspath(name):
        raise InvalidInput("folder: blank; expected the name of a folder")
    return Path(otherwise if name is None else name).absolute()


def inputs(model: Name, weather: Name | None) -> list[str | Path]:
    """The arguments that name a model and its weather file, which must be there."""
    arguments: list[str | Path] = [file(model, "model")]
    if weather is not None:
        arguments += ["-w", file(weather, "weather")]
    return arguments


def flags(**values: object) -> list[str]:
    """--name=value for each value that is not None; _ in a name stands for -."""
    return [f"--{name.replace('_', '-')}={value}" for name, value in values.items() if value is not None]


def environment() -> dict[str, str]:
    """Without the variables of this software, so that a run is what its arguments say."""
    return {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}


def gpu_shading(arguments: Sequence[str | Path]) -> str:
    """What the gpu_shading program prints. Its warnings become Python's; raises RunError with its message."""
    done = subprocess.run([prefix() / "gpu_shading", *arguments], capture_output=True,
                          stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise RunError(last_message(done.stderr.decode(errors="replace"), "gpu_shading", done.returncode))
    for line in done.stderr.decode(errors="replace").splitlines():
        if line.startswith(_WARNING):
            warnings.warn(line.removeprefix(_WARNING), RuntimeWarning, stacklevel=3)
    return done.stdout.decode(errors="replace")


def last_message(text: str, program: str, status: int) -> str:
    """The last error among a program's lines."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if re.search(r"\berror: ", line)] or lines
    return re.sub(r"^gpu_shading: error: ", "", errors[-1]) if errors else f"{program}: exit status {status}"

"""Whole runs of EnergyPlus, and what they report."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gpu_shading import _programs
from gpu_shading._arrays import Floats
from gpu_shading.errors import InvalidInput, RunError

_FREQUENCIES = ("Each Call", "TimeStep", "Hourly", "Daily", "Monthly", "RunPeriod", "Annual")


@dataclass(frozen=True)
class Run:
    """A run that EnergyPlus completed."""

    folder: Path
    """What EnergyPlus wrote: eplusout.eso, eplusout.err, ..."""
    messages: tuple[str, ...]
    """What our module said: the device that rendered, warnings."""

    def values(self, variable: str, frequency: str | None = None) -> dict[str, Floats]:
        """An output variable by its key, such as {"WINDOW 1": array}: its values in the last environment of the run,
        which is the last run period if there is one. Reads eplusout.eso, which has the variables that the model asks
        for with Output:Variable. `frequency`: "Each Call", "TimeStep", "Hourly", "Daily", "Monthly", "RunPeriod" or
        "Annual", if the variable is reported at several."""
        if frequency is not None and frequency not in _FREQUENCIES:
            raise InvalidInput(f"frequency: {frequency!r}, expected one of {', '.join(_FREQUENCIES)}")
        keys: dict[str, str] = {}
        found: dict[str, list[float]] = {}
        with open(self.folder / "eplusout.eso", encoding="utf-8", errors="replace") as lines:
            for line in lines:
                if line.startswith("End of Data Dictionary"):
                    break
                number, key = _entry(line, variable, frequency)
                if number:
                    keys[number] = key
            for line in lines:
                number, _, rest = line.partition(",")
                if number == "1":
                    found = {key: [] for key in keys.values()}
                elif number in keys:
                    found[keys[number]].append(float(rest.partition(",")[0]))
        if not keys:
            raise InvalidInput(f"{variable}: not in {self.folder / 'eplusout.eso'}: the model has no Output:Variable "
                               "for it")
        return {key: np.array(values) for key, values in found.items()}


def run(model: _programs.Name, weather: _programs.Name, folder: _programs.Name | None = None, *,
        shading: bool = True, error: float | None = None, resolution: int | None = None, update: str | None = None,
        device: str | None = None, extensions: _programs.Name | None = None, threads: int | None = None,
        arguments: Sequence[str] = ()) -> Run:
    """Runs `energyplus --gpu-shading` on an IDF or epJSON file with an EPW file.

    `folder`: where results go; it must be empty or not exist, and without it one is made in the folder for temporary
    files. `shading`: False for EnergyPlus's own polygon clipping. Then options of the renderer, each as its flag
    (`--gpu-shading-error` and so on): `error` or `resolution`, `update`, `device`, a side file of `extensions`, and the
    number of `threads`. `arguments`: more for EnergyPlus, such as ["-D"]. Raises RunError, with EnergyPlus's reason,
    if the run does not complete.
    """
    program = _programs.prefix() / "energyplus"
    flags = ["--gpu-shading" if shading else "--gpu-shading=off"]
    for name, value in (("error", error), ("resolution", resolution), ("update", update), ("device", device),
                        ("file", None if extensions is None else _programs.file(extensions, "extensions")),
                        ("threads", threads)):
        if value is not None:
            flags.append(f"--gpu-shading-{name}={value}")
    inputs = [_programs.file(weather, "weather"), _programs.file(model, "model")]
    out = _empty_folder(folder)
    command: list[str | Path] = [program, *flags, *arguments, "-w", inputs[0], "-d", out, inputs[1]]
    variables = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    # A session of its own, so that helpers of EnergyPlus end with it.
    with subprocess.Popen(command, cwd=out, env=variables, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, start_new_session=True) as process:
        try:
            errors = process.communicate()[1].decode(errors="replace")
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    if process.returncode != 0 or "Completed Successfully" not in _text(out / "eplusout.end"):
        raise RunError(_reason(errors, out, process.returncode))
    own = (line.partition("gpu_shading: ")[2] for line in errors.splitlines() if "gpu_shading: " in line)
    return Run(out, tuple(own))


def _empty_folder(folder: _programs.Name | None) -> Path:
    if folder is None:
        return Path(tempfile.mkdtemp(prefix="gpu_shading_run_"))
    path = Path(folder).absolute()
    path.mkdir(parents=True, exist_ok=True)
    if any(path.iterdir()):
        raise InvalidInput(f"folder: {path} is not empty")
    return path


def _entry(line: str, variable: str, frequency: str | None) -> tuple[str, str]:
    """(number, key) of a line of the dictionary that is about the variable, such as
    "53,1,WINDOW,Surface Outside Face Sunlit Fraction [] !Hourly"."""
    front, _, told = line.strip().partition(" !")
    parts = front.split(",")
    if len(parts) < 4 or parts[3].rpartition(" [")[0] != variable:
        return "", ""
    if frequency is not None and told.split("[")[0].strip() != frequency:
        return "", ""
    return parts[0], parts[2]


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""


def _reason(errors: str, folder: Path, status: int) -> str:
    """Why a run failed, in one line."""
    if "gpu_shading: error: " in errors:
        return _programs.last_message(errors, "energyplus", status)
    for line in _text(folder / "eplusout.err").splitlines():
        for kind in ("** Severe  **", "**  Fatal  **"):
            if kind in line:
                return f"EnergyPlus: {line.partition(kind)[2].strip()} ({folder / 'eplusout.err'})"
    return _programs.last_message(errors, "energyplus", status)

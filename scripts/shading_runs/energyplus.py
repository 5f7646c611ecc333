"""Runs EnergyPlus and reads how the run ended."""

import importlib.util
import json
import os
import platform
import re
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from shading_runs.arguments import add_version

REPOSITORY = Path(__file__).resolve().parents[2]
_LATITUDE = 6  # of the fields of the first line of an EPW file
PREFIX_MARKER = ".gpu_shading_prefix.json"  # of patch_energyplus


def program_name(name):
    """The file of a program, as this system names it."""
    return f"{name}.exe" if os.name == "nt" else name


def in_checkout():
    """Whether these scripts are in the sources, and not installed."""
    return (REPOSITORY / "CMakeLists.txt").is_file()


def official_prefix():
    """The EnergyPlus that GPU_SHADING_OFFICIAL names, that scripts/setup fetches, or that was patched."""
    chosen = os.environ.get("GPU_SHADING_OFFICIAL")
    if chosen or in_checkout():
        return Path(chosen) if chosen else REPOSITORY / ".venv" / "EnergyPlus"
    marker = patched_prefix() / PREFIX_MARKER
    return Path(json.loads(marker.read_text())["energyplus"]) if marker.is_file() else patched_prefix()


def build_folder():
    """The folder in which scripts/build builds."""
    return REPOSITORY / os.environ.get("GPU_SHADING_BUILD", "build")


def patched_prefix():
    """The patched EnergyPlus that GPU_SHADING_PREFIX names; that of the build, or one in PATH or the home folder."""
    chosen = os.environ.get("GPU_SHADING_PREFIX")
    if chosen or in_checkout():
        return Path(chosen) if chosen else build_folder() / "EnergyPlus"
    for folder in os.get_exec_path():
        if (Path(folder) / PREFIX_MARKER).is_file():
            return Path(folder)
    return Path.home() / "EnergyPlus-gpu"


def how_to_get_patched():
    """What to do where patched_prefix() is not there."""
    if in_checkout():
        return "run scripts/build"
    return "put the folder that patch_energyplus created in PATH, or name it in GPU_SHADING_PREFIX"


def out_folder():
    """Where output goes that no -o names."""
    return (REPOSITORY if in_checkout() else Path.cwd()) / "out"


def python_packages():
    """Folders in which the package gpu_shading may be, where Python does not find it by itself."""
    if in_checkout():
        return [REPOSITORY / "gpu_shading" / "python"]
    # cmake --install puts these scripts into share/gpu_shading.
    return [REPOSITORY.parent / "lib" / "python3" / "dist-packages"]


def processor():
    """Name and number of cores of this machine's processor."""
    try:
        found = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    except OSError:
        found = None
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"{found.group(1) if found else platform.processor()}, {cores} cores"


def use_own_python(*needed):
    """Restarts the script with the Python of scripts/setup if the current one lacks a needed package."""
    missing = [name for name in needed if not importlib.util.find_spec(name)]
    if not missing:
        return
    own = REPOSITORY / ".venv" / "bin" / "python"
    if own.is_file() and Path(sys.prefix) != own.parents[1]:
        os.execv(own, [str(own), *sys.argv])
    packages = ", ".join("pillow" if name == "PIL" else name for name in missing)
    raise SystemExit(f"{Path(sys.argv[0]).name}: this Python lacks {packages}: install them with pip or apt-get")


def parse_arguments(parser):
    """(parsed arguments before --, arguments after it, which are for the program that is run)."""
    add_version(parser)
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    return parser.parse_args(words[:cut]), words[cut + 1:]


def models_folder():
    """The folder with the collection of other people's models, which need not exist."""
    chosen = os.environ.get("GPU_SHADING_MODELS")
    return Path(chosen) if chosen else REPOSITORY.parent / "shared" / "models"


def find_weather(name):
    """The path of a weather file, given by path or by its name in one of the known folders."""
    folders = (Path(), models_folder() / "weather", official_prefix() / "WeatherData")
    for folder in folders:
        if (folder / name).is_file():
            return (folder / name).resolve()
    raise FileNotFoundError(f"weather file {name}: not found here, in {folders[1]} or in {folders[2]}")


def move_weather(path, latitude, folder):
    """Writes a copy of an EPW file for another latitude (degrees, north positive). Returns its path.

    EnergyPlus takes the sun positions from that file's location.
    """
    first, rest = path.read_text(encoding="latin-1").split("\n", 1)
    fields = first.split(",")
    fields[_LATITUDE] = f"{latitude:.2f}"
    moved = folder / f"{path.stem}_at_{latitude:g}.epw"
    moved.write_text(",".join(fields) + "\n" + rest, encoding="latin-1")
    return moved


@dataclass
class Run:
    """One finished run. seconds: time reported by EnergyPlus; wall: wall-clock time."""

    status: int
    output: str
    errors: str
    folder: Path
    wall: float
    timed_out: bool = False

    def text(self, name):
        path = self.folder / name
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    @property
    def completed(self):
        return self.status == 0 and "Completed Successfully" in self.text("eplusout.end")

    @property
    def seconds(self):
        found = re.search(r"Elapsed Time=(\d+)hr +(\d+)min +([\d.]+)sec", self.text("eplusout.end"))
        if not found:
            return self.wall
        return int(found[1]) * 3600 + int(found[2]) * 60 + float(found[3])

    @property
    def messages(self):
        """[(Warning, Severe or Fatal, text with its continuation lines)] of eplusout.err, in order."""
        found, last = [], None
        for line in self.text("eplusout.err").splitlines():
            start = re.match(r"[ *]*\*\* +(Warning|Severe|Fatal) +\*\* *(.*)", line)
            further = re.match(r"[ *]*\*\* +~~~ +\*\* *(.*)", line)
            if start:
                last = [start[1], start[2].strip()]
                found.append(last)
            elif further and last:
                last[1] += "\n" + further[1].strip()
            else:
                last = None
        return [tuple(message) for message in found]

    @property
    def severe(self):
        """The severe and fatal errors of eplusout.err, without their asterisks."""
        return [f"{kind}: {text}" for kind, text in self.messages if kind != "Warning"]

    @property
    def method(self):
        """The shading method that EnergyPlus reports, or ''."""
        found = re.search(r"^ *Shadowing/Sun Position Calculations Annual Simulations, *([^,\n]*)",
                          self.text("eplusout.eio"), re.MULTILINE)
        return found.group(1) if found else ""

    @property
    def gave_up_on_overlaps(self):
        """Whether polygon clipping met more overlapping shadows than it can hold, so that its answer is wrong."""
        return "Too many figures" in self.text("eplusout.err")

    @property
    def our_lines(self):
        """The messages of our module."""
        lines = (self.errors + "\n" + self.text("eplusout.err")).splitlines()
        found = (re.search(r"gpu_shading: .*", line) for line in lines)
        return list(dict.fromkeys(match.group().strip() for match in found if match))

    @property
    def device(self):
        """The device that rendered, as our module reports it, or ''."""
        return self._rendered()[0]

    @property
    def fineness(self):
        """The resolution or target error that it rendered with, or ''."""
        return self._rendered()[1]

    def _rendered(self):
        found = re.search(r"rendered by (.*), ([^:]*): \d+ receivers", self.rendering)
        return (found[1].strip(), found[2].strip()) if found else ("", "")

    @property
    def rendering(self):
        """Our module's message about the rendering: device, resolution, counts, seconds."""
        return next((line.removeprefix("gpu_shading: ") for line in self.our_lines if "rendered by" in line), "")

    def why(self):
        """A short reason why the run failed."""
        if self.timed_out:
            return f"stopped after {self.wall:.0f} s"
        for line in [*self.severe, *reversed(self.errors.splitlines())]:
            if line.strip():
                return line.strip()
        return f"exit status {self.status}"


if os.name == "nt":
    _end_with_parent = None

    def _kill(process):
        process.kill()
else:
    import ctypes

    _LIBC = ctypes.CDLL(None)

    def _end_with_parent():
        """Called in the child process: the kernel kills it when its parent ends, however that ends."""
        set_parent_death_signal = 1
        _LIBC.prctl(set_parent_death_signal, signal.SIGKILL)

    def _kill(process):
        """With what it started."""
        os.killpg(process.pid, signal.SIGKILL)


def run(program, model, weather, folder, options=(), environment=None, timeout=None, before=(), name_path=str):
    """Runs `program options -w weather -d folder model`, without a display unless `before` provides one.

    Creates the folder, which must not exist. EnergyPlus is killed when this process ends. name_path: how the program
    names a path.
    """
    folder = Path(folder)
    folder.mkdir(parents=True)
    command = [*before, os.path.abspath(program), *options, "-w", name_path(weather), "-d", name_path(folder.resolve()),
               name_path(Path(model).resolve())]
    variables = {key: value for key, value in os.environ.items()
                 if key != "DISPLAY" and not key.startswith("GPU_SHADING")}
    variables |= environment or {}
    began = time.monotonic()
    # A separate session, so that an X server started for the run ends with it.
    with subprocess.Popen(command, cwd=folder, env=variables, start_new_session=True, text=True,
                          errors="replace", stdin=subprocess.DEVNULL, preexec_fn=_end_with_parent,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        timed_out = False
        try:
            output, errors = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            timed_out = True
            _kill(process)
            output, errors = process.communicate()
        except BaseException:
            _kill(process)
            raise
    return Run(process.returncode, output, errors, folder, time.monotonic() - began, timed_out)


def x_server_command():
    """The command prefix that provides a virtual display, or None if it is not available."""
    if shutil.which("xvfb-run") and shutil.which("xauth"):
        return ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24"]
    return None

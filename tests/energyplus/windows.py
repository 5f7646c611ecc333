"""Runs programs for Windows by Wine."""

import os
import shutil
import subprocess

from shading_runs import energyplus


def build_folder():
    """The folder of scripts/build_windows."""
    return energyplus.REPOSITORY / os.environ.get("GPU_SHADING_WINDOWS_BUILD", "build-windows")


def official_folder():
    """The EnergyPlus for Windows of scripts/setup --windows."""
    return energyplus.REPOSITORY / ".venv" / "EnergyPlus-windows"


def why_not():
    """Why nothing can be run, or ''."""
    for program in ("wine", "xvfb-run", "xauth"):
        if not shutil.which(program):
            return f"{program} is missing: run scripts/setup --windows"
    if not (build_folder() / "energyplus_patch" / "energyplus.exe").is_file():
        return f"{build_folder()} has no library for Windows: run scripts/build_windows"
    return ""


def name_path(path):
    """As programs for Windows name it."""
    return "Z:" + str(path).replace("/", "\\")


class Wine:
    """A Windows of its own."""

    before = (*(energyplus.x_server_command() or ()), "wine")

    def __init__(self, folder):
        # Windows looks for a library beside the program first; Wine has to be told to.
        self.environment = {"WINEPREFIX": str(folder), "WINEDEBUG": "-all",
                            "WINEDLLOVERRIDES": "mscoree,mshtml=;opengl32=n,b"}

    def run(self, command, **further):
        return subprocess.run([*self.before, *command], env=os.environ | self.environment | further,
                              capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)

    def run_energyplus(self, program, model, weather, folder, options=(), **further):
        return energyplus.run(program, model, weather, folder, options, self.environment | further,
                              before=self.before, name_path=name_path)


def patch_energyplus(wine, folder):
    """The folder that patch_energyplus.cmd makes of EnergyPlus for Windows; its program."""
    unzipped = folder.parent / "unzipped"
    unzipped.mkdir()
    ours = ("opengl32.dll", "energyplus.exe", "gpu_shading.exe")
    for file in (energyplus.REPOSITORY / "scripts" / "packaging" / "windows" / "patch_energyplus.cmd",
                 *(build_folder() / "energyplus_patch" / name for name in ours)):
        shutil.copy(file, unzipped)
    done = wine.run(["cmd", "/c", name_path(unzipped / "patch_energyplus.cmd"), name_path(official_folder()),
                     name_path(folder)])
    assert "created" in done.stdout, done.stdout + done.stderr
    return folder / "energyplus.exe"


def copy_energyplus(folder, *files):
    """A copy of EnergyPlus for Windows with files of ours, and without what no run needs."""
    shutil.copytree(official_folder(), folder,
                    ignore=shutil.ignore_patterns("WeatherData", "DataSets", "PostProcess", "workflows"))
    for file in files:
        shutil.copy(file, folder)
    return folder / "energyplus.exe"

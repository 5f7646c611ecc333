"""Runs programs for Windows by Wine."""

import contextlib
import copy
import os
import shutil
import subprocess

from shading_runs import energyplus

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"


def build_folder():
    """The folder of scripts/dev/build_windows."""
    return energyplus.REPOSITORY / os.environ.get("GPU_SHADING_WINDOWS_BUILD", "build-windows")


def official_folder():
    """The EnergyPlus for Windows of scripts/setup --windows."""
    return energyplus.REPOSITORY / ".venv" / "EnergyPlus-windows"


def library():
    return build_folder() / "energyplus_patch" / "opengl32.dll"


def why_not():
    """Why nothing can be run, or ''."""
    for program in ("wine", "xvfb-run", "xauth"):
        if not shutil.which(program):
            return f"{program} is missing: run scripts/setup --windows"
    if not (build_folder() / "energyplus_patch" / "energyplus.exe").is_file():
        return f"{build_folder()} has no library for Windows: run scripts/dev/build_windows"
    return ""


def name_path(path):
    """As programs for Windows name it."""
    return "Z:" + str(path).replace("/", "\\")


class Wine:
    """A Windows of its own, whose server stays until close(). It has no display, which saves an X server."""

    def __init__(self, folder):
        self._folder = folder
        # Windows looks for a library beside the program first; Wine has to be told to. It does without some of its
        # own: the debugger, which would wait for somebody to answer it when a program has crashed, and xinput, whose
        # thread runs on for a while after GLFW has unloaded it, and then crashes.
        without = "mscoree,mshtml,winedbg.exe,xinput1_4,xinput1_3,xinput1_2,xinput1_1,xinput9_1_0="
        self.environment = {"WINEPREFIX": str(folder / "prefix"), "WINEDEBUG": "-all",
                            "WINEDLLOVERRIDES": f"{without};opengl32=n,b"}
        self.before = ("wine",)
        self._start("wine", "reg", "add", r"HKCU\Software\Wine\Drivers", "/v", "Graphics", "/d", "null", "/f")
        self.close()  # writes the registry; programs that run keep the display that they began with
        self._start("wineserver", "-p")
        self._start("wine", "wineboot")

    def _start(self, *command):
        """Runs what leaves servers behind, which would keep a pipe open."""
        subprocess.run(command, env=self._variables({}), check=False, stdin=subprocess.DEVNULL,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def _variables(self, further):
        inherited = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
        return inherited | self.environment | further

    def close(self):
        self._start("wineserver", "-k")
        self._start("wineserver", "-w")

    @contextlib.contextmanager
    def display(self):
        """The same Windows with a display."""
        prefix = self._folder / "with a display"
        prefix.mkdir()
        (prefix / "drive_c").symlink_to(self._folder / "prefix" / "drive_c")
        shutil.copytree(self._folder / "prefix" / "dosdevices", prefix / "dosdevices", symlinks=True)
        for name in ("system.reg", "user.reg", "userdef.reg"):
            text = (self._folder / "prefix" / name).read_text(encoding="utf-8", errors="surrogateescape")
            text = text.replace('"Graphics"="null"\n', "")
            (prefix / name).write_text(text, encoding="utf-8", errors="surrogateescape")
        made = copy.copy(self)
        made.environment = self.environment | {"WINEPREFIX": str(prefix)}
        made.before = (*energyplus.x_server_command(), "wine")
        try:
            yield made
        finally:
            made.close()

    def run(self, command, cwd=None, **further):
        return subprocess.run([*self.before, *command], env=self._variables(further), cwd=cwd, capture_output=True,
                              text=True, encoding="utf-8", errors="replace", stdin=subprocess.DEVNULL)

    def run_energyplus(self, program, model, weather, folder, options=(), **further):
        return energyplus.run(program, model, weather, folder, options, self.environment | further,
                              before=self.before, name_path=name_path)


def patch_energyplus(wine, official, folder):
    """The folder that patch_energyplus.cmd makes of EnergyPlus for Windows; its program."""
    unzipped = folder.parent / "unzipped"
    unzipped.mkdir()
    ours = ("opengl32.dll", "energyplus.exe", "gpu_shading.exe")
    for file in (energyplus.REPOSITORY / "scripts" / "packaging" / "windows" / "patch_energyplus.cmd",
                 *(build_folder() / "energyplus_patch" / name for name in ours)):
        shutil.copy(file, unzipped)
    done = wine.run(["cmd", "/c", name_path(unzipped / "patch_energyplus.cmd"), name_path(official),
                     name_path(folder)])
    assert "created" in done.stdout, done.stdout + done.stderr
    return folder / "energyplus.exe"


def copy_energyplus(folder, *files):
    """A copy of EnergyPlus for Windows with files of ours, and without what no run needs."""
    shutil.copytree(official_folder(), folder,
                    ignore=shutil.ignore_patterns("*.epw", "*.ddy", "*.stat", "DataSets", "PostProcess", "workflows"))
    shutil.copy(energyplus.find_weather(WEATHER), folder / "WeatherData")
    for file in files:
        shutil.copy(file, folder)
    return folder / "energyplus.exe"

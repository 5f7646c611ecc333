"""Every program of ours that reads models or writes files, each with a command that does so: C++, scripts and Python.

A command is run in a folder of its own, which has `model.idf` and what that names.
"""

import functools
import importlib.machinery
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from large_packages import TOOLS
from shading_runs import energyplus

PACKAGES = energyplus.REPOSITORY / "gpu_shading" / "python"
SCRIPTS = energyplus.REPOSITORY / "scripts"

# A day with sun, a sheet with holes, a deck of photovoltaic modules: something to do for each program.
DAY = "RunPeriod,Day,6,17,,6,17,,Sunday;\n"
PARTS = """
Shading:Building:Detailed,Deck,,4, 1,4.2,15, 1,1,15, 11,1,15, 11,4.2,15;
GPUShading:PVModules,Modules,Deck,1,1.6,,6,10,3,0,0,,,10;
GPUShading:PerforatedScreen,Mesh,Louvre 1,Round,,Staggered60,0.005,,0.008,,0.001;
"""
PLAN = 'models = "model.idf"\nweather = "{weather}"\nkeep = "nothing"\noptions = {{ error = 0.01 }}\n'


@dataclass(frozen=True)
class Program:
    """A command, in words: {model}, {weather}, {out}, {folder} are put in. The program itself is the first: a name in
    the patched folder, in scripts, or "python" for a `script` of ours that calls the package."""

    words: tuple[str, ...]
    out: str = "out"
    """The name of what it writes, a file or a folder."""
    script: str = ""
    needs: str = ""
    """A module of Python."""
    names_files: bool = True
    """Whether it chooses names in its folder that a user might choose, too; else they are digests, or given."""

    warns: bool = False
    """Where it cannot write, it goes on without what it would keep there, and warns."""

    def why_not(self):
        found = not self.needs or importlib.machinery.PathFinder.find_spec(self.needs, [*sys.path, str(TOOLS)])
        return "" if found else f"{self.needs} is missing: run scripts/setup"


# What the package raises for its user is one line, too.
_SCRIPT = """import sys
import gpu_shading as gs
model, weather, out = sys.argv[1:]
try:
    {}
except (gs.Error, OSError) as error:
    sys.exit(f"error: {{error}}")
"""


def _cpp(*words, out="out", **more):
    return Program(("gpu_shading", *words), out, **more)


def _python(script, out="out", needs="numpy", **more):
    return Program(("python", "{model}", "{weather}", "{out}"), out,
                   _SCRIPT.format(script), needs, **more)


_RUN = ("energyplus", "--gpu-shading", "-w", "{weather}", "-d", "{folder}/run", "{model}")
PROGRAMS = {
    "a run's report": Program((*_RUN, "--gpu-shading-report={out}")),
    "a run's cache": Program((*_RUN, "--gpu-shading-cache={out}"), names_files=False, warns=True),
    "check": _cpp("check", "{model}", "--json", out=""),
    "view": _cpp("view", "{model}", "--sun", "180,40", "--size", "200", "-o", "{out}", out="sun.png"),
    "view of a list": _cpp("view", "{model}", "--list", "views.txt", "--size", "200", "-o", "{out}", names_files=False),
    "screen": _cpp("screen", "{model}", "-o", "{out}"),
    "map": _cpp("map", "{model}", "-w", "{weather}", "--receivers", "*Window*", "--spacing", "0.5", "-o", "{out}"),
    "mask": _cpp("mask", "{model}", "--step", "5", "-o", "{out}"),
    "modules": _cpp("modules", "{model}", "-w", "{weather}", "-o", "{out}"),
    "sample": _cpp("sample", "{model}", "-w", "{weather}", "--mode", "coarse", "-o", "{out}"),
    "sample of the sky": _cpp("sample", "{model}", "-w", "{weather}", "--sky", "-o", "{out}"),
    "export": _cpp("export", "{model}", "-w", "{weather}", "--scheduled", "{out}"),
    "export of view factors": _cpp("export", "{model}", "--surroundings", "{out}", out="factors.idf"),
    "city": _cpp("city", "map.geojson", "--template", "{model}", "-w", "{weather}", "-o", "{out}"),
    "study": _cpp("study", "plan.toml", "--workers", "1", "-o", "{out}", needs="distributed"),
    "compare_shading": Program(("compare_shading", "{model}", "-w", "{weather}", "-o", "{out}"), needs="matplotlib"),
    "compare_sampling": Program(("compare_sampling", "{model}", "-w", "{weather}", "-o", "{out}")),
    "Python: glTF": _python("gs.Scene.from_energyplus(model).save(out)", "scene.glb"),
    "Python: VTK": _python("gs.Scene.from_energyplus(model).save(out)", "scene.vtp"),
    "Python: ParaView": _python("gs.Scene.from_energyplus(model).save(out)", "scene.pvd"),
    "Python: a picture": _python("gs.view(model, sun=(180, 40), size=200).save(out)", "sun.png"),
    "Python: a run": _python("gs.run(model, weather, out)"),
    "Python: modules": _python("gs.modules(model, weather, out)"),
    "Python: a sample": _python("gs.sample(model, weather, out, mode='coarse')", needs="xarray"),
}


@functools.cache
def _generate_model():
    sys.path.insert(0, str(energyplus.REPOSITORY / "idf_examples" / "box_with_louvres"))
    import generate

    text = generate.model(1)
    begin = text.index("RunPeriod,")
    return text[:begin] + DAY + text[text.index(";", begin) + 1:] + PARTS


def furnish(folder, weather):
    """Puts a model and what commands need besides into the folder."""
    (folder / "model.idf").write_text(_generate_model())
    (folder / "plan.toml").write_text(PLAN.format(weather=weather))
    (folder / "views.txt").write_text("a.png 180 40 South Window\nb.png 150 30\n")
    (folder / "map.geojson").write_text(
        '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"height": 9},'
        ' "geometry": {"type": "Polygon", "coordinates": [[[0, 40], [0.0001, 40], [0.0001, 40.0001], [0, 40]]]}}]}')


def environment(**more):
    kept = {key: value for key, value in os.environ.items()
            if key not in ("DISPLAY", "PYTHONSAFEPATH") and not key.startswith("GPU_SHADING")}
    return kept | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}", "PYTHONPATH": f"{PACKAGES}:{TOOLS}",
                   "GPU_SHADING_PREFIX": str(energyplus.patched_prefix()), "GPU_SHADING_DEVICE": "cpu"} | more


def call(program, folder, weather, out=None, model="model.idf", scripts=None, **variables):
    """Runs a program's command in a folder. `scripts`: where a script of Python is, by default beside the folder."""
    out = str(folder / program.out) if out is None else str(out)
    words = [word.format(model=model, weather=weather, out=out, folder=folder) for word in program.words]
    if words[0] == "python":
        place = Path(scripts or folder.parent / f"{folder.name} scripts")
        place.mkdir(exist_ok=True)
        (place / "script.py").write_text(program.script)
        words[:1] = [sys.executable, str(place / "script.py")]
    else:
        place = SCRIPTS if words[0].startswith("compare_") else energyplus.patched_prefix()
        words[0] = str(place / words[0])
    return subprocess.run(words, cwd=folder, env=environment(**variables), stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, errors="backslashreplace", timeout=120)

"""Programs, inputs, machine and devices of each run, and the time of each stage."""

import csv
import hashlib
import platform
import re
from datetime import datetime
from pathlib import Path

from shading_runs import energyplus, methods


def system():
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except OSError:
        return platform.platform()


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def folders(runs, weather, output):
    """Folders of this computer that messages and options may name, the innermost first."""
    files = [output / "report.html", output.resolve() / "report.html", weather, Path.cwd() / "model"]
    for run in runs:
        files += [run.model, run.program, run.run.folder / "eplusout.err", run.placed]
        files += [word.partition("=")[2] or word for word in run.options]
    found = {str(each.parent) for file in files if file for each in (Path(file), Path(file).resolve())
             if each.is_absolute()}
    return sorted(found - {"/"}, key=len, reverse=True)


def without_folders(text, names):
    """The text with the files in these folders named without them: the page may be sent elsewhere."""
    for name in names:
        text = text.replace(f"{name}/", "")
    return text


def described(path):
    return f"{Path(path).name}, SHA-256 {digest(path)}" if path else "none"


def rows(runs, weather, further):
    """[(title, [value in each run])]."""

    def version(run):
        found = re.search(r"^Program Version,\s*(.*?), YMD=", run.run.text("eplusout.eio"), re.MULTILINE)
        return found[1] if found else "not known"

    def rendered(run, pattern):
        found = re.search(pattern, run.run.rendering)
        return found[1] if found else "–"

    def module(run):
        library = Path(run.program).parent / "libgpu_shading_energyplus.so"
        return f"SHA-256 {digest(library)}" if run.is_ours and library.is_file() else "–"

    columns = [
        ("Program", lambda run: version(run)),
        ("Shading method", lambda run: "rendered" if run.is_ours else run.run.method or "unknown"),
        ("Rendered by", lambda run: run.run.device or "–"),
        ("Fineness", lambda run: run.run.fineness or "–"),
        ("Receivers rendered", lambda run: rendered(run, r"(\d+) receivers")),
        ("Casters", lambda run: rendered(run, r"(\d+) casters")),
        ("Sun directions", lambda run: rendered(run, r"(\d+) directions")),
        ("Shading module", module),
        ("Options", lambda run: " ".join([*run.options, *further]) or "none"),
        ("Model", lambda run: described(run.model)),
        ("Extension file", lambda run: described(run.extension_file)),
        ("Weather", lambda run: described(weather)),
        ("Machine", lambda run: f"{energyplus.processor()}; {system()}"),
    ]
    return [(title, [of(run) for run in runs]) for title, of in columns]


def written():
    return datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z")


def renderer_stages(folder):
    """[(stage, seconds)] of the rendering, from the table that the renderer writes into the run's folder."""
    table = folder / methods.STAGES
    if not table.is_file():
        return []
    with open(table, newline="", encoding="utf-8") as file:
        return [(row["stage"], float(row["seconds"])) for row in csv.DictReader(file) if row["stage"] != "EnergyPlus"]


def stages(run):
    """[(stage, seconds)], which add up to the wall-clock time of the program."""
    rendering = re.search(r"([\d.]+) s$", run.run.rendering)
    inside = float(rendering[1]) if rendering else 0.0
    parts = renderer_stages(run.run.folder) or [("rendering", inside)]
    named = [(f"rendering: {stage}", seconds) for stage, seconds in parts if seconds > 0]
    rest = inside - sum(seconds for _, seconds in named)
    if rest > 0.005:
        named.append(("rendering: other", rest))
    return [("EnergyPlus without rendering", max(0.0, run.run.seconds - inside)), *named,
            ("program start and end", max(0.0, run.run.wall - run.run.seconds))]

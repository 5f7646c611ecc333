"""The runs that compare_shading compares: how each is started, and its outcome."""

import shlex
import string
import subprocess
from pathlib import Path

from shading_runs import energyplus, input_file, results

OURS = "gpushading:"
STAGES = "stages.csv"  # time of each stage, in the run's folder
LONG, LONG_TOGETHER = 20, 45  # characters, of a title in a heading and of those of all runs


class Method:
    """One way to compute shading, and its outcome."""

    def __init__(self, key, short, title, program, shading_method=None, options=(), before=(), model=None,
                 is_ours=False):
        self.key, self.short, self.title, self.program = key, short, title, program
        self.label = title  # in headings and charts
        self.variation = ""  # the file and the options that it has beside its kind
        self.shading_method, self.options, self.before = shading_method, list(options), list(before)
        self.model = model  # the path of the model it runs
        self.is_ours = is_ours  # rendered by this software
        self.placed = None  # the copy of the model that ran
        self.run = self.results = None
        self.missing = ""  # why there are no results
        self.found = []  # differences from the reference

    def execute(self, weather, output, further, timeout):
        """Runs it in an OutputFolder."""
        own = input_file.read(self.model)
        results.instrument(own)
        if self.shading_method:
            own.set_field("ShadowCalculation", input_file.SHADOW_METHOD, self.shading_method)
        if not self.is_ours:  # EnergyPlus itself does not know our objects
            own.remove(lambda name: name.startswith(OURS))
        folder = output.path / self.key
        self.placed = input_file.place_copy(own, self.model, output.path / "inputs" / self.key,
                                            (output.path, output.target, output.failed))
        self.run = energyplus.run(self.program, self.placed, weather, folder,
                                  [*self.options, *further], timeout=timeout, before=self.before,
                                  environment={"GPU_SHADING_STAGES": str(folder / STAGES)})
        if not self.run.completed:
            self.missing = self.run.why()
            return
        if self.shading_method and self.run.method and self.run.method != self.shading_method:
            self.missing = f"EnergyPlus fell back to {self.run.method}"
            return
        self.results = results.Results(folder)

    def side_file_seen(self):
        """The file of extension objects for the gpu_shading program on the placed model; an empty one for a run of
        EnergyPlus itself, which does not know ours."""
        if self.is_ours:
            return self.extension_file
        nothing = self.placed.parent.with_name(f"{self.key}.nothing.idf")
        nothing.write_text("! EnergyPlus itself has no extension objects.\n")
        return nothing

    def draw(self, weather, *arguments):
        """What `gpu_shading view` needs to draw the placed model. Returns why it could not, or ''."""
        program = self.program.parent / energyplus.program_name("gpu_shading")
        if not program.is_file():
            return f"{program.name} is not beside {self.program}"
        side_file = self.side_file_seen()
        words = [program, "view", self.placed, "-w", weather, *map(str, arguments)]
        done = subprocess.run([*words, *([f"--gpu-shading-file={side_file}"] if side_file else [])],
                              capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
        return (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1] if done.returncode else ""

    @property
    def extension_file(self):
        """The side file of extension objects that the run reads, or None."""
        for word in self.options:
            if word.startswith("--gpu-shading-file="):
                return Path(word.partition("=")[2])
        beside = Path(self.model).with_suffix(".gpu-shading.idf")
        return beside if self.is_ours and beside.is_file() else None


def clipping(key, model):
    patched = energyplus.patched_prefix() / energyplus.program_name("energyplus")
    if patched.is_file():
        return Method(key, "clip", "PolygonClipping", patched, "PolygonClipping", ["--gpu-shading=off"], model=model)
    official = energyplus.official_prefix() / energyplus.program_name("energyplus")
    if not official.is_file():
        raise ValueError(f"{official} is not there: {energyplus.how_to_get_patched()}")
    return Method(key, "clip", "PolygonClipping", official, "PolygonClipping", model=model)


def gpu(key, model):
    patched = energyplus.patched_prefix() / energyplus.program_name("energyplus")
    made = Method(key, "gpu", "Renderer", patched, options=["--gpu-shading"], model=model, is_ours=True)
    if not patched.is_file():
        made.missing = f"{patched} is not there: {energyplus.how_to_get_patched()}"
    return made


def pixel_counting(key, model):
    before = energyplus.x_server_command()
    official = energyplus.official_prefix() / energyplus.program_name("energyplus")
    made = Method(key, "pixel", "PixelCounting", official, "PixelCounting", before=before or (), model=model)
    if not before:
        made.missing = "xvfb-run or xauth is not installed"
    return made


KINDS = {"clipping": clipping, "gpu": gpu, "pixelcounting": pixel_counting}


def holds_extensions_alone(path):
    classes = input_file.read(path).classes() - {"version"}
    return bool(classes) and all(name.startswith(OURS) for name in classes)


def parse(text, key, model):
    """The run that one of --runs names: a kind or a file, and further EnergyPlus options.

    A file with extension objects only replaces the model's own side file; any other file is a model to run instead.
    Raises ValueError or OSError.
    """
    first, *options = shlex.split(text) or [""]
    if first in KINDS:
        made = KINDS[first](key, model)
    elif not Path(first).is_file():
        raise ValueError(f"{first}: expected {', '.join(KINDS)}, a file of extension objects, or a model")
    elif holds_extensions_alone(first):
        made = gpu(key, model)
        made.options.append(f"--gpu-shading-file={Path(first).resolve()}")
        made.variation = Path(first).name
    else:
        made = gpu(key, Path(first))
        made.variation = Path(first).name
    made.options += options
    comma = ", " if made.variation else ""
    made.title = " ".join([f"{made.title}{comma}{made.variation}", *options])
    made.variation = " ".join([*filter(None, [made.variation]), *options])
    return made


def name_by_difference(variants):
    """Titles of runs that were all rendered: what each has that others have not."""
    for each in variants:
        each.title = each.variation or "the model as it is"
    if len({each.title for each in variants}) < len(variants):
        for each in variants:
            path = Path(each.model).resolve()
            each.title = f"{path.parent.name}/{path.name}" + each.title.removeprefix(path.name)
    if len({each.title for each in variants}) < len(variants):
        for each in variants:
            each.title = f"{each.title} ({each.short})"
    for each in variants:
        each.label = each.title


def choose(model, runs, with_xvfb):
    """The methods, the reference first. Methods that are not available hold the reason."""
    texts = [*runs, *(["pixelcounting"] if with_xvfb and "pixelcounting" not in runs else [])]
    letters = string.ascii_uppercase
    if not 2 <= len(texts) <= len(letters):
        raise ValueError(f"--runs: {len(texts)} of them, expected 2 to {len(letters)}")
    is_plain = all(text in KINDS for text in texts) and len(set(texts)) == len(texts)
    names = {"clipping": "stock", "gpu": "gpu", "pixelcounting": "xvfb"}
    chosen = [parse(text, names[text] if is_plain else letter.lower(), model)
              for text, letter in zip(texts, letters, strict=False)]
    if not is_plain:
        for each, letter in zip(chosen, letters, strict=False):
            each.short = letter
    ours = [each for each in chosen if each.is_ours]
    if len(ours) > 1:
        name_by_difference(ours)
    lengths = [len(each.title) for each in chosen]
    if max(lengths) > LONG or sum(lengths) > LONG_TOGETHER:
        for each in chosen:
            each.label = each.short
    return chosen

"""README.md, its namesakes and the pages of docs say what is so: every command in them is run."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from shading_runs.version import energyplus_release

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted(page for wing in ("energyplus_patch", "gpu_shading") for page in
                                     (ROOT / wing / "README.md", *(ROOT / wing / "docs").glob("*.md")))]
DICTIONARY = ROOT / "energyplus_patch" / "model" / "extensions" / "GPUShading.idd"
# What blocks may be in; those in sh are run.
LANGUAGES = {"sh", "idf", "python", "text", "cmake"}
BLOCK = re.compile(r"(?:<!-- not run: (?P<why>.*?) -->\n)?```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)


def title(page):
    return str(page.relative_to(ROOT))


def blocks(page):
    """[(its line, language, text, why it is not run or None)]"""
    text = page.read_text(encoding="utf-8")
    return [(text.count("\n", 0, match.start("text")), match["language"], match["text"], match["why"])
            for match in BLOCK.finditer(text)]


def commands(page):
    """Those that are run, a block's together."""
    return [(line, text) for line, language, text, why in blocks(page) if language == "sh" and why is None]


@pytest.fixture
def place(patched, official, weather, box, tmp_path):
    """A user's folder: an EnergyPlus in its home, a model, a weather file, the checkout's folders; and what is set."""
    links = {f"EnergyPlus-{energyplus_release().replace('.', '-')}": official.parent, "EnergyPlus-gpu": patched.parent,
             "weather.epw": weather, "scripts": ROOT / "scripts", "idf_examples": ROOT / "idf_examples",
             "gpu_shading": ROOT / "gpu_shading",
             "build": ROOT / os.environ.get("GPU_SHADING_BUILD", "build"),
             "lbnl": ROOT / ".venv" / "EnergyPlus-lbnl"}
    for name, target in links.items():
        (tmp_path / name).symlink_to(target)
    (tmp_path / "model.idf").write_text(box)
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    path = os.pathsep.join([str(patched.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    return tmp_path, {**environment, "HOME": str(tmp_path), "PATH": path,
                      "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME", str(Path.home() / ".cache"))}


@pytest.mark.parametrize("page", [page for page in PAGES if commands(page)], ids=title)
def test_every_command_can_be_run(page, place):
    """As a user would, one after another; a folder that the text makes replaces the one that is at hand."""
    folder, environment = place
    for line, text in commands(page):
        if "lbnl" in text and not (folder / "lbnl").exists():
            print(f"{title(page)}:{line}: not run: scripts/setup could not fetch pyenergyplus-lbnl")
            continue
        if "patch_energyplus " in text and (folder / "EnergyPlus-gpu").is_symlink():
            (folder / "EnergyPlus-gpu").unlink()
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=folder, env=environment,
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        said = done.stdout[-2000:] + done.stderr[-2000:]
        assert done.returncode == 0, f"{title(page)}:{line}: exit status {done.returncode}\n{text}{said}"
    for name in re.findall(r"(?<=-o )[\w.]+", " ".join(text for _, text in commands(page))):
        assert (folder / name).exists(), f"{title(page)}: {name} was not written"


def test_commands_that_are_not_run_say_why():
    listed = [(title(page), line, why, text) for page in PAGES for line, language, text, why in blocks(page)
              if language == "sh" and why is not None]
    for page, line, why, text in listed:
        print(f"{page}:{line}: not run: {why}\n{text}", end="")
        assert why.strip()
    # Every one of them is known here, so that no command slips out of being run.
    known = {"scripts/demo", "apt-get", "pip install", "cmake --build", "podman build", "build_windows", "git apply",
             "ctest"}
    assert {re.search("|".join(known), text)[0] for *_, text in listed} == known


@pytest.mark.parametrize("page", PAGES, ids=title)
def test_blocks_are_fenced_and_name_their_language(page):
    text = page.read_text(encoding="utf-8")
    assert {language for _, language, _, _ in blocks(page)} <= LANGUAGES
    rest = BLOCK.sub("", text)
    assert "```" not in rest
    # Else a command could stand in a block that is not seen here.
    assert not re.search(r"^\n {4}\S", rest, re.M), "an indented block"


def anchors(page):
    """Of its headings, as GitHub makes them."""
    found = re.findall(r"^#+ (.*)$", BLOCK.sub("", page.read_text(encoding="utf-8")), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in found}


@pytest.mark.parametrize("page", PAGES, ids=title)
def test_links_lead_somewhere(page):
    text = BLOCK.sub("", page.read_text(encoding="utf-8"))
    for target in re.findall(r"\]\(([^)]*)\)", text):
        if "://" in target:
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        assert file.exists() and ROOT in file.parents, f"{title(page)}: {target}"
        assert not anchor or anchor in anchors(file), f"{title(page)}: {target}"


def test_paths_that_are_named_are_there():
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for path in re.findall(r"`((?:scripts|tests|idf_examples|energyplus_patch|gpu_shading)/[\w./]+)`", text):
            # A program goes by its source's name.
            assert (ROOT / path).exists() or (ROOT / f"{path}.cpp").exists(), f"{title(page)}: {path}"


def test_every_page_is_in_the_index():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert all(f"]({title(page)})" in text for page in PAGES[1:])


def options_page():
    return next(page for page in PAGES if "<!-- options -->" in page.read_text(encoding="utf-8"))


def test_options_are_those_of_the_program(patched, tmp_path):
    done = subprocess.run([ROOT / "scripts" / "dev" / "option_table", patched.parent / "gpu_shading", "--check"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    # By another reading than the script's own, against the help for people.
    rows = re.findall(r"^\| `(--gpu-shading.*?)` \| `(\w+)` \|", options_page().read_text(encoding="utf-8"), re.M)
    for flag, variable in rows:
        assert variable == re.match(r"[\w-]+", flag)[0].strip("-").upper().replace("-", "_")
    shown = {}
    for name, command in {"common": [patched, "--gpu-shading", "--help"],
                          "all": [patched.parent / "gpu_shading", "help", "options", "--help-all"]}.items():
        text = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=True).stdout
        shown[name] = re.findall(r"^  (--gpu-shading\S*(?: \S+)?)(?:  .*)?$", text, re.M)
    assert shown["all"] == [flag.replace("\\", "") for flag, _ in rows]
    experts = {"--gpu-shading-lean", "--gpu-shading-method", "--gpu-shading-assets"}
    assert shown["common"] == [flag for flag in shown["all"] if flag.split()[0] not in experts]


def test_the_numbers_of_lean_input_are_those_of_the_code():
    header = (ROOT / "energyplus_patch" / "model" / "lean_input.h").read_text(encoding="utf-8")
    running = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    row = re.search(r"^\| `--gpu-shading-lean .*", options_page().read_text(encoding="utf-8"), re.M)[0]
    for name, said in (("fewest_left_out", "if there are {} or more"),
                       ("fewest_with_reflections", "{} or more with solar reflections")):
        number = re.search(rf"{name} = (\d+);", header)[1]
        assert said.format(number) in row
        assert re.search(rf"A model with fewer than .*\b{number}\b.*", running)


def test_the_reference_has_the_dictionary_s_objects_and_fields():
    done = subprocess.run([ROOT / "scripts" / "dev" / "extension_objects", "document", "--check"], capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    # By another reading than the script's own.
    page = (ROOT / "energyplus_patch" / "docs" / "extensions.md").read_text(encoding="utf-8")
    tables = {name: rows for name, rows in re.findall(
        r"^\| field of `(.*?)` \|.*\n\|---.*\n((?:\|.*\n)+)", page, re.M)}
    objects = DICTIONARY.read_text(encoding="utf-8").split("\nGPUShading:")[1:]
    assert list(tables) == [f"GPUShading:{text.split(',')[0]}" for text in objects]
    for name, text in zip(tables, objects, strict=True):
        assert re.findall(r"^\| (.*?) \|", tables[name], re.M) == re.findall(r"\\field (.*)", text), name


def test_messages_are_the_program_s():
    """What the page on trouble quotes in its tables stands in the sources, three dots for what differs."""
    text = ""
    for source in sorted((ROOT / "energyplus_patch").rglob("*.cpp")) + sorted((ROOT / "gpu_shading").rglob("*.cpp")):
        # Literals that follow one another are one.
        text += re.sub(r'"\s*"', "", source.read_text(encoding="utf-8"))
    rows = re.findall(r"^\| `(.*?)` \|", (ROOT / "energyplus_patch" / "docs" / "troubleshooting.md").read_text(), re.M)
    assert len(rows) > 8
    for message in rows:
        for part in message.split("..."):
            assert part.strip(" :") in text, message


def test_the_pictures_are_used():
    used = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    for picture in (ROOT / "energyplus_patch" / "docs" / "pictures").iterdir():
        assert picture.name in used, picture


@pytest.mark.parametrize("command", ["check", "view", "map", "export"])
def test_options_of_gpu_shading_are_there(patched, command):
    known = subprocess.run([patched.parent / "gpu_shading", command, "--help-all"], capture_output=True, text=True,
                           check=True).stdout
    named = {flag for page in PAGES for text in re.findall(rf"gpu_shading {command} [^`\n]*", page.read_text())
             for flag in re.findall(r"--[a-z-]+", text)}
    assert named and all(re.search(rf"{flag}\b", known) for flag in named), named

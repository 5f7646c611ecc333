"""README.md, its namesakes and the pages of docs say what is so: every command in them is run."""

import importlib.metadata
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from shading_runs.version import energyplus_release

ROOT = Path(__file__).resolve().parents[2]
MANUAL = ROOT / "energyplus_patch" / "docs"
PAGES = [ROOT / "README.md", *sorted(page for wing in ("energyplus_patch", "gpu_shading")
                                     for page in (ROOT / wing).rglob("*.md"))]
EXAMPLES = sorted((ROOT / "idf_examples").glob("*/README.md"))
# Those of the models that `gpu_shading example` copies.
COPIED = [page for page in EXAMPLES if any(page.parent.glob("*.idf"))]
TUTORIALS = MANUAL / "tutorials"
# What pages of tutorials tell a reader to fetch with pip, of the packages that tests have.
TOOLS = ROOT / ".venv" / "tools"
FETCHED = {"honeybee.md": ("honeybee-energy", "honeybee-radiance"), "variants.md": ("platypus-opt",)}
# Pages that are followed from top to bottom.
WALKED = [*sorted(TUTORIALS.glob("*.md")), ROOT / "README.md", MANUAL / "gallery.md"]
# The pages that a reader needs first, and all that explain how to use this software.
MAIN_PATH = [ROOT / "README.md", TUTORIALS / "south_office.md", MANUAL / "guides" / "screens.md"]
WHOLE = [ROOT / "README.md", *MANUAL.rglob("*.md")]
MAIN_PATH_WORDS, WHOLE_WORDS = 4_000, 24_000
DICTIONARY = ROOT / "energyplus_patch" / "model" / "extensions" / "GPUShading.idd"
# What blocks may be in; those in sh are run.
LANGUAGES = {"sh", "idf", "python", "text", "cmake"}
BLOCK = re.compile(r"(?:<!-- not run: (?P<why>.*?) -->\n)?```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)


def title(page):
    return str(page.relative_to(ROOT)) if page.is_relative_to(ROOT) else str(page)


def blocks(page):
    """[(its line, language, text, why it is not run or None)]"""
    text = page.read_text(encoding="utf-8")
    return [(text.count("\n", 0, match.start("text")), match["language"], match["text"], match["why"])
            for match in BLOCK.finditer(text)]


def commands(page):
    """Those that are run, a block's together."""
    return [(line, text) for line, language, text, why in blocks(page) if language == "sh" and why is None]


def install(folder):
    """A folder as README.md's own install leaves the sources: links to them, and what `scripts/setup --without-tests`
    fetches; without packages that only tests have. Returns variables in which nothing is set for it."""
    for name in ("README.md", "scripts", "idf_examples", "gpu_shading", "energyplus_patch"):
        (folder / name).symlink_to(ROOT / name)
    (folder / "build").symlink_to(ROOT / os.environ.get("GPU_SHADING_BUILD", "build"))
    (folder / ".venv").mkdir()
    for path in (ROOT / ".venv").iterdir():
        if path.name in ("bin", "include", "lib", "lib64", "pyvenv.cfg", "EnergyPlus"):
            (folder / ".venv" / path.name).symlink_to(path.resolve())
    kept = {key: value for key, value in os.environ.items()
            if key == "GPU_SHADING_BUILD" or not key.startswith(("GPU_SHADING", "PYTHON", "VIRTUAL_ENV"))}
    return {**kept, "HOME": str(folder), "PATH": os.defpath,
            "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME", str(Path.home() / ".cache"))}


def as_readme_says(folder, environment):
    """The variables that README.md's section Install sets."""
    (setting,) = re.findall(r"^export (.*)$", (ROOT / "README.md").read_text(encoding="utf-8"), re.M)
    done = subprocess.run(["bash", "-euc", f"export {setting}; env -0"], cwd=folder, env=environment, check=True,
                          capture_output=True, text=True)
    return dict(line.split("=", 1) for line in done.stdout.split("\0") if line)


def fetch(wanted, folder):
    """What `pip install` of some packages brings, from those that tests have; skips where they are missing."""
    known = {re.sub("[-_.]+", "-", found.name).lower(): found
             for found in importlib.metadata.distributions(path=[str(TOOLS)])}
    linked, left = set(), list(wanted)
    while left:
        name = re.sub("[-_.]+", "-", left.pop()).lower()
        if name not in known and name in wanted:
            pytest.skip(f"{TOOLS} has no {name}: run scripts/setup")
        if name in linked or name not in known:
            continue
        linked.add(name)
        left += [re.match(r"[\w.-]+", each)[0] for each in known[name].requires or () if "extra ==" not in each]
        for top in {file.parts[0] for file in known[name].files if file.parts[0] not in ("..", "__pycache__")}:
            if not (folder / top).exists():
                (folder / top).symlink_to(TOOLS / top)


@pytest.fixture
def place(patched, official, weather, box, tmp_path):
    """A user's folder: an EnergyPlus in its home, a model, a weather file, the checkout's folders; and what is set."""
    environment = as_readme_says(tmp_path, install(tmp_path))
    links = {f"EnergyPlus-{energyplus_release().replace('.', '-')}": official.parent, "EnergyPlus-gpu": patched.parent,
             "weather.epw": weather, "lbnl": ROOT / ".venv" / "EnergyPlus-lbnl"}
    for name, target in links.items():
        (tmp_path / name).symlink_to(target)
    (tmp_path / "model.idf").write_text(box)
    return tmp_path, environment


def missing_lines(promised, printed):
    """Lines that a page promises, with three dots for what differs, and that were not printed in this order."""
    said = iter(printed.splitlines())
    return [line for line in promised.splitlines() if not any(
        re.fullmatch(".*".join(map(re.escape, line.rstrip().split("..."))), words.rstrip()) for words in said)]


def walked(page):
    """[[line, commands, output that is promised or None]]: what a reader types who follows a page."""
    steps = []
    for line, language, text, why in blocks(page):
        if language == "sh" and why is None:
            steps.append([line, text, None])
        elif language == "text" and steps:
            steps[-1][2] = (steps[-1][2] or "") + text
    return steps


def walk(page, folder, environment):
    """Runs a page's commands in one shell, as one reader would."""
    steps = walked(page)
    mark = "step of the reader done"
    script = "".join(f"{{\n{text}\n}} 2>&1\necho; echo {mark}\n" for _, text, _ in steps)
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env=environment,
                          capture_output=True, text=True, stdin=subprocess.DEVNULL)
    outputs = done.stdout.split(mark)
    for (line, text, promised), output in zip(steps, outputs, strict=False):
        lost = missing_lines(promised or "", output)
        assert not lost, f"{title(page)}:{line}: not printed: {lost}\n{text}{output[-3000:]}"
    assert done.returncode == 0, f"{title(page)}: exit status {done.returncode}\n{outputs[-1][-3000:]}{done.stderr}"


@pytest.mark.parametrize("page", WALKED, ids=title)
def test_a_reader_sees_what_the_page_promises(page, patched, tmp_path):
    """Word by word, with nothing set but what the page sets; what README.md sets is in a block that is not run."""
    environment = {**install(tmp_path), "VARIANTS": "20"}  # a reader has time for more
    if page.parent != TUTORIALS:
        environment = as_readme_says(tmp_path, environment)
    if page.name in FETCHED:
        (tmp_path / "fetched").mkdir()
        fetch(FETCHED[page.name], tmp_path / "fetched")
        environment["PYTHONPATH"] = str(tmp_path / "fetched")
    walk(page, tmp_path, environment)


def test_packages_that_pages_fetch_are_those_of_the_tests():
    pinned = dict(re.findall(r"^([\w-]+)==([\w.]+)", (ROOT / "scripts" / "requirements-tools.txt").read_text(), re.M))
    pinned = {re.sub("[-_.]+", "-", name).lower(): version for name, version in pinned.items()}
    for name, wanted in FETCHED.items():
        told = re.findall(r"([\w-]+)==([\w.]+)", (TUTORIALS / name).read_text(encoding="utf-8"))
        assert dict(told) == {each: pinned[each] for each in wanted}


@pytest.mark.parametrize("page", COPIED, ids=title)
def test_a_copied_example_does_what_its_page_says(page, patched, tmp_path):
    environment = as_readme_says(tmp_path, install(tmp_path))
    (tmp_path / "user").mkdir()
    subprocess.run(["gpu_shading", "example", page.parent.name], cwd=tmp_path / "user", env=environment, check=True,
                   capture_output=True)
    copy = tmp_path / "user" / page.parent.name
    walk(copy / "README.md", copy, environment)
    for target in re.findall(r"\]\(<?([^)>#]*)", (copy / "README.md").read_text(encoding="utf-8")):
        assert (copy / target).exists(), target


@pytest.mark.parametrize("page", [page for page in PAGES if commands(page) and page not in WALKED], ids=title)
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
    known = {"scripts/demo", "scripts/build", "apt-get", "pip install", "cmake --build", "podman build",
             "build_windows", "git apply", "ctest", "gpu_shading city", "gpu_shading suite", "jobqueue slurm",
             "dask scheduler"}
    assert {re.search("|".join(known), text)[0] for *_, text in listed} == known


@pytest.mark.parametrize("page", [*PAGES, *COPIED], ids=title)
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


def linked_pages(page):
    text = BLOCK.sub("", page.read_text(encoding="utf-8"))
    targets = re.findall(r"\]\(([^)#]*\.md)[^)]*\)", text)
    return {(page.parent / target).resolve() for target in targets}


def test_every_page_can_be_reached_from_the_first():
    reached, new = set(), {ROOT / "README.md"}
    while new:
        reached |= new
        new = set().union(*map(linked_pages, new)) - reached
    assert set(PAGES) | set(EXAMPLES) <= reached


def test_the_manual_is_short():
    """Counted as `wc -w` counts."""
    def words(pages):
        return sum(len(page.read_text(encoding="utf-8").split()) for page in pages)

    print(f"{words(MAIN_PATH)} words on the main path, {words(WHOLE)} in all")
    assert words(MAIN_PATH) <= MAIN_PATH_WORDS
    assert words(WHOLE) <= WHOLE_WORDS


def test_each_page_begins_with_what_it_is_for():
    for page in PAGES:
        lines = page.read_text(encoding="utf-8").splitlines()
        assert lines[0].startswith("# ") and not lines[1] and re.match(r"[\[*`]?[A-Z`]", lines[2]), title(page)


def test_the_glossary_is_used_and_short():
    terms = re.findall(r"^### (.*)$", (MANUAL / "glossary.md").read_text(encoding="utf-8"), re.M)
    assert len(terms) <= 20 and terms == sorted(terms, key=str.lower)
    linked = "".join(page.read_text(encoding="utf-8") for page in WHOLE)
    assert [term for term in terms if f"glossary.md#{term.lower().replace(' ', '-')})" not in linked] == []


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
    rows = options_page().read_text(encoding="utf-8")
    for name, said in (("fewest_left_out", "if there are {} or more"),
                       ("fewest_with_reflections", "{} or more shading surfaces and solar reflections")):
        number = re.search(rf"{name} = (\d+);", header)[1]
        assert said.format(number) in rows
    for name, said in (("fewest_left_out", "A model with fewer than {} such surfaces"),
                       ("fewest_with_reflections", "With solar reflections and {} or more of them")):
        assert said.format(re.search(rf"{name} = (\d+);", header)[1]) in running


def test_the_reference_has_the_dictionary_s_objects_and_fields():
    done = subprocess.run([ROOT / "scripts" / "dev" / "extension_objects", "document", "--check"], capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    # By another reading than the script's own.
    page = (MANUAL / "reference" / "extensions.md").read_text(encoding="utf-8")
    tables = {name: rows for name, rows in re.findall(
        r"^\| field of `(.*?)` \|.*\n\|---.*\n((?:\|.*\n)+)", page, re.M)}
    objects = DICTIONARY.read_text(encoding="utf-8").split("\nGPUShading:")[1:]
    assert list(tables) == [f"GPUShading:{text.split(',')[0]}" for text in objects]
    for name, text in zip(tables, objects, strict=True):
        assert re.findall(r"^\| (.*?) \|", tables[name], re.M) == re.findall(r"\\field (.*)", text), name


def dictionary_fields():
    """{object in lower case: ([{tag: [values]} of each field], whether the last field repeats)}."""
    found = {}
    for text in DICTIONARY.read_text(encoding="utf-8").split("\nGPUShading:")[1:]:
        head, *parts = re.split(r"^ +[AN]\d+ *[,;] *(?=\\field)", text, flags=re.M)
        fields = []
        for part in parts:
            tags = {}
            for tag, value in re.findall(r"\\([\w-]+) ?(.*)", part):
                tags.setdefault(tag, []).append(value)
            fields.append(tags)
        found[f"gpushading:{text.split(',')[0].lower()}"] = (fields, "\\extensible" in head)
    return found


def wrong_value(value, tags):
    """Why a field of an example cannot have its value, or ""."""
    if not value:
        return "missing" if "required-field" in tags else ""
    if value.lower() in map(str.lower, tags.get("key", [])):
        return ""
    kind = tags.get("type", ["alpha"])[0]
    if kind == "choice":
        return f"not one of {tags['key']}"
    if kind in ("real", "integer"):
        low, high = (float(tags.get(tag, [least])[0].strip("<> ")) for tag, least in
                     (("minimum", "-inf"), ("maximum", "inf")))
        if not re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?", value) or not low <= float(value) <= high:
            return f"not a number from {low} to {high}"
    return ""


def test_objects_in_the_documents_are_those_of_the_dictionary():
    known, seen = dictionary_fields(), set()
    for page in PAGES:
        for line, language, text, _ in blocks(page):
            bare = re.sub(r"!.*", "", text if language == "idf" else
                          "".join(re.findall(r"GPUShading:[^;']*;", text) if language == "sh" else []))
            for written in filter(str.strip, bare.split(";")):
                name, *values = (value.strip() for value in written.split(","))
                if not name.lower().startswith("gpushading:"):
                    continue
                fields, repeats = known[name.lower()]
                seen.add(name.lower())
                assert len(values) <= len(fields) or repeats, f"{title(page)}:{line}: {written}"
                values += [""] * (len(fields) - len(values))
                for value, tags in zip(values, fields[:-1] if repeats else fields, strict=False):
                    why = wrong_value(value, tags)
                    assert not why, f"{title(page)}:{line}: {name}: {tags['field'][0]} {value!r}: {why}"
    assert seen == set(known)


def test_extras_of_the_wheel_are_named():
    tomllib = pytest.importorskip("tomllib")  # of Python 3.11
    project = tomllib.loads((ROOT / "scripts" / "wheel" / "pyproject.toml").read_text())["project"]
    page = (MANUAL / "guides" / "installing.md").read_text()
    assert [extra for extra in project["optional-dependencies"] if f"`{extra}`" not in page] == []


def test_messages_are_the_program_s():
    """What the page on trouble quotes in its tables stands in the sources, three dots for what differs."""
    text = ""
    for source in sorted((ROOT / "energyplus_patch").rglob("*.cpp")) + sorted((ROOT / "gpu_shading").rglob("*.cpp")):
        # Literals that follow one another are one.
        text += re.sub(r'"\s*"', "", source.read_text(encoding="utf-8"))
    rows = re.findall(r"^\| `(.*?)` \|", (MANUAL / "reference" / "messages.md").read_text(), re.M)
    assert len(rows) > 8
    for message in rows:
        for part in message.split("..."):
            assert part.strip(" :") in text, message


def test_the_pictures_are_used():
    used = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    for picture in (MANUAL / "pictures").iterdir():
        assert picture.name in used, picture


@pytest.mark.parametrize("command", ["check", "view", "map", "export"])
def test_options_of_gpu_shading_are_there(patched, command):
    known = subprocess.run([patched.parent / "gpu_shading", command, "--help-all"], capture_output=True, text=True,
                           check=True).stdout
    named = {flag for page in PAGES for text in re.findall(rf"gpu_shading {command} [^`\n]*", page.read_text())
             for flag in re.findall(r"--[a-z-]+", text)}
    assert named and all(re.search(rf"{flag}\b", known) for flag in named), named


@pytest.mark.parametrize("has_site", [True, False])
def test_docs_names_the_manual_that_is_there(has_site, patched, tmp_path):
    """The site where it is built, else the pages that it is made of, which README.md's own install has."""
    folder, share = tmp_path / "EnergyPlus", tmp_path / "sources"
    folder.mkdir()
    share.mkdir()
    environment = install(share)
    shutil.copy2(patched.parent / "gpu_shading", folder)
    (folder / "gpu_shading_share").symlink_to(share)
    site = share / "out" / "site" / "index.html"
    if has_site:
        site.parent.mkdir(parents=True)
        site.write_text("<html>")
    done = subprocess.run([folder / "gpu_shading", "docs"], env={**environment, "XDG_DATA_DIRS": str(tmp_path)},
                          capture_output=True, text=True)
    expected = site if has_site else share / "energyplus_patch" / "docs" / "README.md"
    assert done.stdout == f"{expected}\n" and done.returncode == 0, done.stderr

"""The site of the manual: complete, without a network, and an error where a link or a page is lost."""

import html.parser
import importlib.machinery
import importlib.util
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BROWSER = shutil.which("chromium-headless-shell")


@pytest.fixture(scope="module")
def build_site():
    loader = importlib.machinery.SourceFileLoader("build_site", str(ROOT / "scripts" / "dev" / "build_site"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("build_site", loader))
    loader.exec_module(module)
    if not (ROOT / module.PACKAGES).is_dir() and not importlib.util.find_spec("mkdocs"):
        pytest.skip(f"{ROOT / module.PACKAGES} is missing: run scripts/setup")
    return module


@pytest.fixture(scope="module")
def site(build_site, tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    assert build_site.build(ROOT, folder) == 0
    return folder


@pytest.fixture
def copy(build_site, tmp_path):
    """The pages, to be changed."""
    for path in build_site.copied_pages(ROOT):
        target = tmp_path / "root" / path.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)
    return tmp_path / "root"


class Loaded(html.parser.HTMLParser):
    """What a browser loads to show a page."""

    def __init__(self, text):
        super().__init__()
        self.addresses = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        if tag in ("script", "img", "iframe") or (tag == "link" and named.get("rel") in ("stylesheet", "icon")):
            self.addresses += [named[key] for key in ("src", "href") if named.get(key)]


def test_every_page_is_there_and_loads_nothing_from_elsewhere(build_site, site):
    pages = [path for path in build_site.copied_pages(ROOT) if path.suffix == ".md"]
    assert len(pages) > 40
    for page in pages:
        shown = (site / page.relative_to(ROOT)).with_suffix(".html")
        if page.name == "README.md":
            shown = shown.with_name("index.html")
        addresses = Loaded(shown.read_text(encoding="utf-8")).addresses
        assert addresses
        for address in addresses:
            assert address.startswith("data:") or (shown.parent / address).resolve().is_file(), f"{shown}: {address}"


def test_anchors_are_those_of_the_repository_s_pages(site):
    text = (site / "energyplus_patch" / "docs" / "reference" / "files.html").read_text(encoding="utf-8")
    assert 'id="check---json"' in text


def test_words_in_the_code_of_tables_are_those_of_the_page_and_may_wrap(site):
    text = (site / "energyplus_patch" / "docs" / "reference" / "options.html").read_text(encoding="utf-8")
    assert "<code>--gpu-shading-device auto|<wbr>cpu|<wbr>N</code>" in text and "\\|" not in text


def test_search_knows_every_object(site):
    entries = json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))["docs"]
    text = " ".join(entry["text"] for entry in entries)
    assert len(entries) > 200
    assert {"GPUShading:PerforatedScreen", "GPUShading:SiteContext"} <= set(re.findall(r"GPUShading:\w+", text))


@pytest.mark.skipif(BROWSER is None, reason="chromium-headless-shell is not installed")
def test_search_works_in_a_page_that_is_opened_as_a_file(site, tmp_path):
    done = subprocess.run([BROWSER, "--no-sandbox", f"--user-data-dir={tmp_path}", "--virtual-time-budget=8000",
                           "--dump-dom", f"{(site / 'index.html').as_uri()}?q=canopy"], capture_output=True, text=True)
    assert re.search(r'md-search-result__meta">\d+ matching documents<', done.stdout)


@pytest.mark.parametrize("lost", ["nowhere.md", "options.md#nowhere"])
def test_a_dead_link_is_an_error(build_site, copy, tmp_path, lost):
    page = copy / "energyplus_patch" / "docs" / "reference" / "commands.md"
    page.write_text(page.read_text(encoding="utf-8") + f"\n[lost]({lost})\n", encoding="utf-8")
    assert build_site.build(copy, tmp_path / "site") != 0


def test_a_page_that_is_not_listed_is_an_error(build_site, copy, tmp_path):
    (copy / "energyplus_patch" / "docs" / "guides" / "forgotten.md").write_text("# Forgotten\n", encoding="utf-8")
    assert build_site.build(copy, tmp_path / "site") != 0

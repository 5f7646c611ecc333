"""The packages in bare Debians, by the very commands of the page on installing: from nothing to sunlit fractions.

Needs root, debootstrap, a network, and packages that scripts/dev/build_wheel and scripts/dev/build_deb have made, the
latter on each release; what is missing is said. Each prints how long it took and what it put on the disk.
GPU_SHADING_CHROOTS names a folder in which bare Debians are kept, so that debootstrap runs only once.
"""

import os
import re
import shlex
import shutil
import subprocess
import time
from pathlib import Path

import pytest
from shading_runs import energyplus
from test_documents import missing_lines, walked

OUT = energyplus.REPOSITORY / "out"
PAGE = energyplus.REPOSITORY / "energyplus_patch" / "docs" / "guides" / "installing.md"
TUTORIAL = PAGE.parents[1] / "tutorials" / "south_office.md"
MARK = "step of the reader done"
CONTAINERFILE = energyplus.REPOSITORY / "scripts" / "packaging" / "Containerfile"
USER = 1000
PLACE = "/home/user"
MOST = 500  # MB that everything may take, EnergyPlus among it
KEPT = ("proc", "dev", "packages", "var/cache", "var/lib/apt/lists", "root/.cache", f"{PLACE[1:]}/.cache")
WHEEL, DEBIAN = "energyplus_gpu_shading-*.whl", "energyplus-gpu-shading_*.deb"


def size(folder):
    """MB in files, without what package managers keep to install again."""
    left_out = [f"--exclude={folder}/{path}" for path in KEPT]
    return int(subprocess.run(["du", "-sm", *left_out, folder], capture_output=True, text=True).stdout.split()[0])


class Bare:
    """A Debian with what debootstrap installs at least."""

    def __init__(self, root):
        self.root = root
        self.output = ""
        for name in ("resolv.conf", "hosts"):
            shutil.copy(f"/etc/{name}", root / "etc" / name)
        (root / PLACE[1:]).mkdir(parents=True)
        os.chown(root / PLACE[1:], USER, USER)

    def bring(self, *paths, place=PLACE):
        (self.root / place[1:]).mkdir(exist_ok=True)
        for path in paths:
            shutil.copy(path, self.root / place[1:])

    def run(self, command, user=0):
        """A command line in the shell, by default as root."""
        variables = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": PLACE if user else "/root", "LANG": "C.UTF-8",
                     "DEBIAN_FRONTEND": "noninteractive"}
        variables |= {key: value for key, value in os.environ.items()
                      if key.lower() in ("http_proxy", "https_proxy", "no_proxy") or key == "PIP_INDEX_URL"}
        authorities = os.environ.get("PIP_CERT")
        if authorities:
            shutil.copy(authorities, self.root / "authorities.crt")
            variables["PIP_CERT"] = "/authorities.crt"
        script = (f"mount -t proc proc {self.root}/proc && mount --rbind /dev {self.root}/dev && "
                  f"exec chroot --userspec={user}:{user} {self.root} /usr/bin/env -i "
                  f"{shlex.join(f'{key}={value}' for key, value in variables.items())} "
                  f"sh -euc {shlex.quote(f'cd {PLACE}; {command}')}")
        done = subprocess.run(["unshare", "--mount", "sh", "-c", script], capture_output=True, text=True, timeout=900)
        self.output = done.stdout + done.stderr
        assert done.returncode == 0, f"{command}\n{self.output[-3000:]}"
        return self.output


@pytest.fixture(scope="module")
def bases(tmp_path_factory):
    """Makes a bare Debian once each."""
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        pytest.skip("needs root and debootstrap")
    made, kept = {}, os.environ.get("GPU_SHADING_CHROOTS")

    def base(suite):
        if kept and (Path(kept) / suite / "etc").is_dir():
            return Path(kept) / suite
        if suite not in made:
            root = Path(kept) / suite if kept else tmp_path_factory.mktemp(suite) / "root"
            done = subprocess.run(["debootstrap", "--variant=minbase", suite, root], capture_output=True, text=True)
            if done.returncode != 0:
                shutil.rmtree(root, ignore_errors=True)
                pytest.skip(f"debootstrap {suite}: {done.stdout[-300:]}")
            made[suite] = root
        return made[suite]

    yield base
    for root in made.values() if not kept else ():
        shutil.rmtree(root, ignore_errors=True)


@pytest.fixture
def bare(bases, tmp_path):
    def copy(suite):
        root = tmp_path / suite
        subprocess.run(["cp", "-a", "--reflink=auto", bases(suite), root], check=True)
        return Bare(root)

    yield copy
    for root in tmp_path.iterdir():
        shutil.rmtree(root, ignore_errors=True)


@pytest.fixture
def model(louvres, weather, tmp_path):
    """What the page's commands read, and what the build answers."""
    folder = tmp_path / "model"
    folder.mkdir()
    (folder / "model.idf").write_text(louvres(20) + "Output:Variable,*,Surface Outside Face Sunlit Fraction,Hourly;\n")
    shutil.copy(weather, folder / "weather.epw")
    return folder


def package(folder, pattern):
    found = sorted((OUT / folder).glob(pattern))
    if not found:
        pytest.skip(f"{OUT / folder} has no {pattern}: run scripts/build_{folder.partition('/')[0]}")
    return found[-1]


def commands(section):
    """The lines of the page's blocks under a heading."""
    text = re.search(rf"^## {section}\n(.*?)(?=^## |\Z)", PAGE.read_text(encoding="utf-8"), re.M | re.S)[1]
    return [line for block in re.findall(r"```sh\n(.*?)```", text, re.S) for line in block.splitlines()]


def answers(folder):
    return (Path(folder) / "eplusout.eso").read_text().partition("End of Data Dictionary")[2]


def assert_answers_of_the_build(folder, patched, model, tmp_path):
    run = energyplus.run(patched, model / "model.idf", model / "weather.epw", tmp_path / "build", ["--gpu-shading"])
    assert run.completed, run.why()
    assert answers(folder) and answers(folder) == answers(tmp_path / "build")


def follow(place, section, until=None):
    """Runs the page's commands, to one that contains `until`: apt-get as root, everything else as a user."""
    before, began = size(place.root), time.monotonic()
    place.run("apt-get update -q")
    for line in commands(section):
        place.run(line.replace("apt-get install", "apt-get install -y"), 0 if line.startswith("apt-get") else USER)
        if until and until in line:
            break
    added = size(place.root) - before
    print(f"{section} in {place.root.name}: {time.monotonic() - began:.1f} s, {added} MB")
    assert added < MOST


@pytest.mark.parametrize("suite", ["bookworm", "trixie"])
def test_wheel(suite, bare, patched, model, tmp_path):
    wheel = package("wheel", WHEEL)
    place = bare(suite)
    place.bring(wheel, *model.iterdir())
    follow(place, "Wheel")
    scene = "gpu_shading.Scene([[[0, 0, 0], [1, 0, 0], [1, 0, 1]]])"
    assert place.run(f"shading/bin/python -c 'import gpu_shading; print({scene}.sunlit([180, 0]))'", USER) == "[1.]\n"
    assert_answers_of_the_build(place.root / PLACE[1:] / "out", patched, model, tmp_path)


def test_tutorial_from_the_wheel(bare, tmp_path):
    """The first tutorial word by word, from a bare Debian to the table by which one decides. Prints the time of each
    step of a reader who types at once."""
    place = bare("bookworm")
    place.bring(package("wheel", WHEEL))
    began = time.monotonic()
    follow(place, "Wheel", until="pip install")
    # What the page says to type instead of the export of who has the sources.
    steps = walked(TUTORIAL)
    assert steps[0][1].startswith("export PATH=") and ". shading/bin/activate" in TUTORIAL.read_text(encoding="utf-8")
    steps[0][1] = ". shading/bin/activate\n"
    text = "".join(f"{{\n{commands}\n}} 2>&1\necho; echo {MARK} $(date +%s.%N)\n" for _, commands, _ in steps)
    (place.root / PLACE[1:] / "tutorial.sh").write_text(text)
    outputs = re.split(rf"\n{MARK} ([\d.]+)\n", place.run(f"bash -eu {PLACE}/tutorial.sh", USER))
    for (line, _, promised), output, ended in zip(steps, outputs[::2], outputs[1::2], strict=False):
        assert not missing_lines(promised or "", output), f"line {line}: {output[-2000:]}"
        print(f"{time.monotonic() - began - (time.time() - float(ended)):6.1f} s: line {line}: {output.strip()[-400:]}")
    assert len(outputs) // 2 == len(steps) and "large      1610" in outputs[-3]
    manual = place.run("shading/bin/gpu_shading docs", USER).strip()
    assert "GPU shading" in (place.root / manual[1:]).read_text(encoding="utf-8")
    minutes = (time.monotonic() - began) / 60
    print(f"tutorial from the wheel: {minutes:.1f} min")
    assert minutes < 15


@pytest.mark.parametrize("suite", ["bookworm", "trixie"])
def test_debian_package(suite, bare, patched, model, tmp_path):
    installed = package(f"deb/{suite}", DEBIAN)
    place = bare(suite)
    place.bring(installed, *model.iterdir())
    follow(place, "Debian package")
    assert_answers_of_the_build(place.root / PLACE[1:] / "out", patched, model, tmp_path)
    manual = place.run("EnergyPlus-gpu/gpu_shading docs", USER).strip()
    assert "GPU shading" in (place.root / manual[1:]).read_text(encoding="utf-8")
    assert "courtyard/weather.epw" in place.run("EnergyPlus-gpu/energyplus-gpu example courtyard", USER)
    # Nothing is installed that another package would have to bring.
    assert "not found" not in place.run("ldd /usr/libexec/gpu_shading/gpu_shading /usr/libexec/gpu_shading/energyplus")
    place.run("apt-get remove -y energyplus-gpu-shading")
    left = [path for path in (place.root / "usr").rglob("*gpu*shading*") if "site-packages" not in path.parts]
    assert not left


def runs_of(stage):
    """The RUN lines of a stage of the Containerfile."""
    text = CONTAINERFILE.read_text().replace("\\\n", " ")
    lines = re.search(rf"^FROM \S+ AS {stage}\n(.*?)(?=^FROM |\Z)", text, re.M | re.S)[1].splitlines()
    return [line.removeprefix("RUN ") for line in lines if line.startswith("RUN ")]


def test_container_commands(bare, patched, model, tmp_path):
    installed = package("deb/bookworm", DEBIAN)
    place = bare("bookworm")
    place.bring(installed, place="/packages")
    place.bring(*model.iterdir())
    for stage in ("cpu", "nvidia"):
        assert runs_of(stage)
        for line in runs_of(stage):
            place.run(line)
    place.run("PATH=/opt/energyplus-gpu:$PATH energyplus --gpu-shading -w weather.epw -d out model.idf", USER)
    assert_answers_of_the_build(place.root / PLACE[1:] / "out", patched, model, tmp_path)

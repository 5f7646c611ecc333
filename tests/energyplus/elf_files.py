"""What the loader reads of programs and libraries (ELF): the libraries they need, and where these are looked for."""

import re
import subprocess

# Of every Linux, or of GCC and the C library.
SYSTEM = {"libc.so.6", "libm.so.6", "libgcc_s.so.1", "libstdc++.so.6", "ld-linux-x86-64.so.2"}


def is_loaded(path):
    """Whether a file is a program or a library with a dynamic section, and not an object file."""
    if path.is_symlink() or not path.is_file():
        return False
    with open(path, "rb") as file:
        head = file.read(18)
    return head[:4] == b"\x7fELF" and int.from_bytes(head[16:18], "little") in (2, 3)  # ET_EXEC, ET_DYN


def loaded_files(folder):
    return sorted(path for path in folder.rglob("*") if is_loaded(path))


def _dynamic(path, pattern):
    listed = subprocess.run(["readelf", "-dW", path], capture_output=True, text=True, check=True).stdout
    return re.findall(pattern, listed)


def needed(path):
    return set(_dynamic(path, r"\(NEEDED\).*\[(.*)\]"))


def search_path(path):
    """The elements of DT_RUNPATH or DT_RPATH."""
    return [element for value in _dynamic(path, r"\((?:RUNPATH|RPATH)\).*\[(.*)\]") for element in value.split(":")]


def undefined(path):
    """The symbols that other libraries than the system's have to define."""
    listed = subprocess.run(["nm", "-D", "--undefined-only", path], capture_output=True, text=True, check=True).stdout
    names = (line.split()[-1] for line in listed.splitlines() if line.split()[0] == "U")
    return {name.partition("@")[0] for name in names if not re.search("@(GLIBC|GLIBCXX|CXXABI|GCC)_", name)}

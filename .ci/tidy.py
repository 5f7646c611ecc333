#!/usr/bin/env python3
"""Runs clang-tidy over the sources and headers of a build that a change touches.

.ci/tidy.py BUILD [--all] [--record]

A source in compile_commands.json, or a header that one of them includes, is checked if it differs from the
base: by commits, in the work tree, or not yet tracked. A header is checked by itself, with the options of a
source that includes it. What a source includes is read from the build, so build first. Sources that only
include what changed are not checked: nearly all findings stand in the text that changed, and one header that
all include would take hours. The base is the commit named by
GPU_SHADING_TIDY_BASE, else the merge base with origin/main, else with main: each commit on main has
passed this check, so the files that equal the base have passed as well. If HEAD is on main itself, the
base is the commit in .ci/tidy_base, whose files are all known to have passed. With --record, a pass
writes HEAD there.

All sources are checked if there is no base in the history of HEAD, if the checks changed (.clang-tidy,
this script, or scripts/setup, which chooses clang-tidy's version), and with --all.

Changed compiler options are not seen as changes of a file: the build itself, with warnings as errors,
judges those. A file is skipped, too, if it passed in this build folder with the same content, headers,
command and checks.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RECORD = ".ci/tidy_base"
CHECKS = re.compile(r"(^|/)\.clang-tidy$|^\.ci/tidy\.py$|^scripts/setup$")


def git(*arguments):
    """Output of git in the work tree, or None if it fails."""
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else None


def find_base():
    """The commit to compare with and why, or None and why all files are checked."""
    head = git("rev-parse", "HEAD")
    named = os.environ.get("GPU_SHADING_TIDY_BASE")
    if named:
        base = git("merge-base", "HEAD", named)
        if base is None:
            sys.exit(f"tidy: GPU_SHADING_TIDY_BASE: there is no commit {named}")
        return base, named
    for name in ("origin/main", "main"):
        base = git("merge-base", "HEAD", name)
        if base is not None and base != head:
            return base, name
    recorded = (ROOT / RECORD).read_text().strip() if (ROOT / RECORD).is_file() else ""
    if recorded and git("merge-base", "--is-ancestor", recorded, "HEAD") is not None:
        return recorded, RECORD
    return None, "no earlier commit is known to have passed"


def changed_since(base):
    """Paths, from the root, that differ from `base`."""
    differing = git("diff", "--name-only", "--no-renames", base)
    untracked = git("ls-files", "-o", "--exclude-standard")
    return set(differing.splitlines()) | set(untracked.splitlines())


UNITY = re.compile(r"/Unity/unity_\w+_cxx\.cxx$")


def sources_of(file):
    """The sources that a file of CMake's unity build includes, or the file itself."""
    if not UNITY.search(str(file)):
        return [file]
    return [Path(path) for path in re.findall(r'^#include "(.+)"$', file.read_text(), re.MULTILINE)]


def read_dependencies(build):
    """By object file, the paths from the root of the sources of ours that it is compiled from."""
    listing = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True).stdout
    dependencies = {}
    current = None
    for line in listing.splitlines():
        if line.startswith(" "):
            path = Path(os.path.normpath(build / line.strip()))
            if ROOT in path.parents:
                current.add(str(path.relative_to(ROOT)))
        elif ": #deps" in line:
            current = dependencies.setdefault(line.split(": #deps")[0], set())
    return dependencies


def read_commands(build):
    """compile_commands.json with an entry for each source of ours, not for several that are compiled as one.

    Without g++'s precompiled headers, which clang-tidy cannot read, and its kinds of -Wshadow.
    """
    entries = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = Path(entry["directory"], entry["file"])
        command = re.sub(
            r" -Winvalid-pch -include \S+/cmake_pch\.hxx| -fpch-preprocess", "", entry["command"]
        ).replace("-Wshadow=local", "-Wshadow")
        for source in sources_of(file):
            own = command if source == file else command.replace(f" -c {entry['file']}", f" -c {source}")
            entries.append({**entry, "file": str(source), "command": own})
    return entries


def digest(*parts):
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


def select(build, everything):
    """What to check: by path, its compile command with the key under which a pass is remembered; and the reason."""
    base, name = find_base()
    changed = changed_since(base) if base else set()
    if everything:
        base, name = None, "as asked"
    elif any(CHECKS.search(path) for path in changed):
        base, name = None, "the checks changed"
    reason = f"what differs from {name} ({base[:9]})" if base else f"all files ({name})"

    dependencies = read_dependencies(build)
    if not dependencies:
        sys.exit(f"tidy: {build.name} is not built, so what its sources include is unknown: build it first")
    checks = b"".join((ROOT / path).read_bytes() for path in (".clang-tidy", "tests/.clang-tidy", ".ci/tidy.py"))
    entries = {Path(entry["file"]).resolve(): entry for entry in read_commands(build)}
    sources = {source for source in entries if ROOT in source.parents and build not in source.parents}
    work = {}
    for source in sorted(sources):
        entry = entries[source]
        found = re.search(r" -o (\S+)", entry["command"])
        included = {ROOT / name for name in dependencies.get(found.group(1), ()) if found} - sources
        files = [source, *(path for path in included if base and path.suffix == ".h" and path not in work)]
        for path in files:
            if base and str(path.relative_to(ROOT)) not in changed:
                continue
            contents = [name.read_bytes() for name in sorted({path, *included}) if name.is_file()]
            command = entry["command"]
            if path != source:
                command = re.sub(r" -c \S+", f" -x c++ -c {path}", command)
            key = digest(checks, command.encode(), *contents)
            work[path] = ({"directory": entry["directory"], "file": str(path), "command": command}, key)
    return work, reason


def main():
    build = (ROOT / sys.argv[1]).resolve()
    passed = build / "clang-tidy"
    passed.mkdir(exist_ok=True)
    work, reason = select(build, "--all" in sys.argv[2:])
    (passed / "compile_commands.json").write_text(json.dumps([entry for entry, _ in work.values()]))
    remembered = [path for path, (_, key) in work.items() if (passed / key).exists()]
    for path in remembered:
        del work[path]
    print(f"clang-tidy: {reason}: {len(work)} files to check, {len(remembered)} passed before", flush=True)

    def check(item):
        path, (_, key) = item
        command = ["clang-tidy", "-p", passed, "--quiet", "--extra-arg=-Wno-unknown-warning-option",
                   "--extra-arg=-Wno-pragma-once-outside-header", path]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode == 0:
            (passed / key).touch()
        return path, done

    failed = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for path, done in pool.map(check, work.items()):
            if done.returncode != 0:
                failed += 1
                print(f"{path.relative_to(ROOT)}:\n{done.stdout}{done.stderr}", flush=True)
    print(f"clang-tidy: {len(work)} files checked, {failed} with findings")
    if "--record" in sys.argv[2:] and not failed:
        if git("status", "--porcelain", "--", "*.cpp", "*.h", "*CMakeLists.txt"):
            sys.exit("tidy: not recorded: the sources differ from HEAD")
        (ROOT / RECORD).write_text(git("rev-parse", "HEAD") + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

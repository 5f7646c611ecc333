#!/usr/bin/env python3
"""Runs clang-tidy over our sources in a build's compile_commands.json, those again that may differ.

A file is skipped when nothing that its outcome depends on has changed since it passed: itself, its
command, the checks, and (all of) our headers.
"""

import hashlib
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def digest(*parts):
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


def main():
    build = (ROOT / sys.argv[1]).resolve()
    listing = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "--", "*.h", "*.clang-tidy"],
                             cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\n")
    common = digest(*((ROOT / name).read_bytes() for name in sorted(filter(None, listing)) if (ROOT / name).is_file()))
    passed = build / "clang-tidy"
    passed.mkdir(exist_ok=True)

    work = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = Path(entry["directory"], entry["file"]).resolve()
        if ROOT in source.parents and build not in source.parents:
            key = digest(common.encode(), source.read_bytes(), entry["command"].encode())
            if not (passed / key).exists():
                work[source] = key

    def check(item):
        source, key = item
        done = subprocess.run(["clang-tidy", "-p", build, "--quiet", source], capture_output=True, text=True)
        if done.returncode == 0:
            (passed / key).touch()
        return source, done

    failed = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for source, done in pool.map(check, work.items()):
            if done.returncode != 0:
                failed += 1
                print(f"{source.relative_to(ROOT)}:\n{done.stdout}{done.stderr}")
    print(f"clang-tidy: {len(work)} files checked, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

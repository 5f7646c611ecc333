#!/usr/bin/env python3
"""Checks that sources include only what stands below them.

    layers.py [FOLDER]...

A CMakeLists.txt with a list

    set(layers scene gl raster_gl raster_cpu render)

names the folders beside it, lowest first. A source in one of them includes headers of its own folder and
of folders before it, written from the list's folder ("scene/ring.h"), and public headers (include/).
Sources in example/ include public headers alone. Two more lists may stand there, their items quoted:

    set(independent_layers "raster_gl raster_cpu")            # none of these includes another
    set(restricted_headers "epoxy/ GL/ EGL/: gl raster_gl")   # only these folders include such headers

Without arguments all of the project's folders with such a list are checked.
"""

import re
import sys
from itertools import permutations
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SUFFIXES = {".c", ".cpp", ".h"}
PUBLIC = "include"
EXAMPLE = "example"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"\n]+)"|<([^>\n]+)>)', re.M)


def cmake_list(text, name):
    """The items of set(NAME ...), quoted ones whole; None if it is not set."""
    text = re.sub(r'("[^"\n]*")|#[^\n]*', lambda match: match[1] or "", text)
    found = re.search(rf"\bset\s*\(\s*{name}\b([^)]*)\)", text)
    if found is None:
        return None
    return [quoted or plain for quoted, plain in re.findall(r'"([^"]*)"|([^\s"]+)', found[1])]


class Order:
    """The declared order of one folder's layers."""

    def __init__(self, folder):
        text = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
        self.layers = cmake_list(text, "layers")
        self.independent = set()
        for group in cmake_list(text, "independent_layers") or []:
            self.independent.update(permutations(group.split(), 2))
        self.restricted = []
        for rule in cmake_list(text, "restricted_headers") or []:
            prefixes, _, users = rule.partition(":")
            self.restricted.append((tuple(prefixes.split()), users.split()))

    def unknown(self):
        """Names in the other lists that are no layers."""
        named = {layer for pair in self.independent for layer in pair}
        named.update(layer for _, users in self.restricted for layer in users)
        return sorted(named - set(self.layers))

    def refusal(self, layer, used):
        """Why a layer may not use another, or None."""
        if layer == PUBLIC:
            return f"a public header includes {used}/"
        if layer == EXAMPLE:
            return f"an example includes {used}/"
        if (layer, used) in self.independent:
            return f"{layer} and {used} are independent"
        if self.layers.index(used) > self.layers.index(layer):
            return f"{layer} stands before {used}"
        return None


def problems_of(folder):
    """One line for every include, folder and file that breaks the order."""
    order = Order(folder)
    for layer in order.layers:
        if not (folder / layer).is_dir():
            yield f"{folder.name}/CMakeLists.txt: layer {layer}: there is no such folder"
    for layer in order.unknown():
        yield f"{folder.name}/CMakeLists.txt: {layer} is not among the layers"
    for path in sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES):
        name = path.relative_to(folder)
        layer = name.parts[0] if len(name.parts) > 1 else "."
        if layer not in (PUBLIC, EXAMPLE) and layer not in order.layers:
            yield f"{folder.name}/{name}: {layer} is not among the layers"
            continue
        text = path.read_text(encoding="utf-8")
        for match in INCLUDE.finditer(text):
            header = match[1] or match[2]
            used = header.partition("/")[0]
            why = None
            if match[1] and (".." in Path(header).parts or (path.parent / header).exists()):
                why = f'write it from {folder.name}/, as in "{layer}/..."'
            elif match[1] and (folder / header).exists() and used not in order.layers:
                why = f"{used} is not among the layers"
            elif match[1] and used in order.layers:
                why = order.refusal(layer, used)
            for prefixes, users in order.restricted:
                if header.startswith(prefixes) and layer not in users:
                    why = f"only {', '.join(users)} may"
            if why:
                line = text.count("\n", 0, match.start()) + 1
                yield f"{folder.name}/{name}:{line}: {match[0].strip()}: {why}"


def layered_folders(root):
    """Folders of the project that declare an order."""
    for file in sorted(root.glob("*/CMakeLists.txt")):
        if cmake_list(file.read_text(encoding="utf-8"), "layers") is not None:
            yield file.parent


def main(arguments):
    folders = [Path(argument).resolve() for argument in arguments] or list(layered_folders(ROOT))
    problems = [problem for folder in folders for problem in problems_of(folder)]
    for problem in problems:
        print(problem)
    checked = ", ".join(folder.name for folder in folders) or "no folder"
    print(f"layers: {checked} checked, {len(problems)} problems")
    return 1 if problems or not folders else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

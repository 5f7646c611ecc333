#!/usr/bin/env python3
"""Checks that sources include only what stands below them.

    layers.py [FOLDER]...

A CMakeLists.txt with a list

    set(layers scene backends render)

names the folders beside it, lowest first. A source in one of them includes headers of its own folder and
of folders before it, written from the list's folder ("scene/ring.h"), and public headers (include/).
Sources in docs/ (examples) include public headers alone. The folders inside of a folder have an order, too:

    set(layers_in_backends interface opengl cpu .)       # of backends/; . is for its own files
    set(layers_in_backends_opengl gl raster)             # of backends/opengl/

Two more lists may stand there, their items quoted:

    set(independent_layers "backends/cpu backends/opengl")                # none of these includes another
    set(restricted_headers "epoxy/ GL/: backends/opengl")                # only these folders include such headers
"""

import re
import sys
from itertools import permutations
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SUFFIXES = {".c", ".cpp", ".h"}
PUBLIC = "include"
EXAMPLES = "docs"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"\n]+)"|<([^>\n]+)>)', re.M)


def cmake_list(text, name):
    """The items of set(NAME ...), quoted ones whole; None if it is not set."""
    text = re.sub(r'("[^"\n]*")|#[^\n]*', lambda match: match[1] or "", text)
    found = re.search(rf"\bset\s*\(\s*{name}\b([^)]*)\)", text)
    if found is None:
        return None
    return [quoted or plain for quoted, plain in re.findall(r'"([^"]*)"|([^\s"]+)', found[1])]


class Order:
    """The declared order of one folder's layers, and of those inside of them."""

    def __init__(self, folder):
        text = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
        self.name = f"{folder.name}/CMakeLists.txt"
        self.layers = {"": cmake_list(text, "layers")}
        self.stray = []
        inner = re.findall(r"^set\(layers_in_(\w+)", text, re.M)
        # Outer folders first: which part of a name is a folder's, the list around it tells.
        for name in sorted(inner, key=len):
            path = next((f"{outer}/{layer}".lstrip("/") for outer, layers in self.layers.items() for layer in layers
                         if f"{outer}/{layer}".lstrip("/").replace("/", "_") == name), None)
            if path is None:
                self.stray.append(name)
            else:
                self.layers[path] = cmake_list(text, f"layers_in_{name}")
        self.independent = set()
        for group in cmake_list(text, "independent_layers") or []:
            self.independent.update(permutations(group.split(), 2))
        self.restricted = []
        for rule in cmake_list(text, "restricted_headers") or []:
            prefixes, _, users = rule.partition(":")
            self.restricted.append((tuple(prefixes.split()), users.split()))

    def paths(self):
        """All layers, as paths."""
        return [f"{outer}/{layer}".lstrip("/") for outer, layers in self.layers.items() for layer in layers
                if layer != "."]

    def unknown(self):
        """Names in the other lists that are no layers."""
        named = {layer for pair in self.independent for layer in pair}
        named.update(layer for _, users in self.restricted for layer in users)
        return sorted(named.difference(self.paths()).union(self.stray))

    def place(self, file):
        """The layers in which a file is, outermost first: ["backends", "opengl"]; in a folder with an order, the last
        may be "." for its own files. None if one of them is not in its list."""
        place, path = [], ""
        for part in [*file.split("/")[:-1], "."]:
            layers = self.layers.get(path)
            if layers is None:
                return place
            if part not in layers:
                return None
            place.append(part)
            path = f"{path}/{part}".lstrip("/")
        return place

    def refusal(self, place, used):
        """Why sources of one place may not use headers of another, or None."""
        outer = ""
        for one, other in zip(place, used, strict=False):
            layer, below = f"{outer}/{one}".lstrip("/"), f"{outer}/{other}".lstrip("/")
            if one != other:
                if (layer, below) in self.independent:
                    return f"{layer} and {below} are independent"
                if self.layers[outer].index(other) > self.layers[outer].index(one):
                    return f"{layer} stands before {below}"
                return None
            outer = layer
        return None


def problems_of(folder):
    """One line for every include, folder and file that breaks the order."""
    order = Order(folder)
    for layer in order.paths():
        if not (folder / layer).is_dir():
            yield f"{order.name}: layer {layer}: there is no such folder"
    for layer in order.unknown():
        yield f"{order.name}: {layer} is not among the layers"
    for path in sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES):
        name = path.relative_to(folder).as_posix()
        outside = {PUBLIC: "a public header", EXAMPLES: "an example"}.get(name.split("/")[0])
        place = [] if outside else order.place(name)
        if place is None:
            yield f"{folder.name}/{name}: {Path(name).parent} is not among the layers"
            continue
        text = path.read_text(encoding="utf-8")
        for match in INCLUDE.finditer(text):
            header = match[1] or match[2]
            used = order.place(header) if header.split("/")[0] in order.layers[""] else None
            why = None
            if match[1] and (".." in Path(header).parts or (path.parent / header).exists()):
                why = f'write it from {folder.name}/, as in "{Path(name).parent}/..."'
            elif match[1] and used and outside:
                why = f"{outside} includes {used[0]}/"
            elif match[1] and used:
                why = order.refusal(place, used)
            elif match[1] and (folder / header).exists():
                why = f"{Path(header).parent} is not among the layers"
            for prefixes, users in order.restricted:
                if header.startswith(prefixes) and not any(name.startswith(f"{user}/") for user in users):
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

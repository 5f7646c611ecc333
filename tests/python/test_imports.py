"""How the package's modules depend on each other."""

import ast
import graphlib
from pathlib import Path

import gpu_shading

PACKAGE = Path(gpu_shading.__file__).parent


def imported(module):
    """Names of the package's modules that one imports, in functions and for types too."""
    for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module == "gpu_shading":
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("gpu_shading."):
            yield node.module.removeprefix("gpu_shading.")


def test_modules_import_each_other_in_one_direction():
    graph = {module.stem: set(imported(module)) for module in PACKAGE.glob("*.py")}
    assert "optics" in graph["scene"] and len(graph) > 10
    # Raises CycleError, which names the circle.
    order = list(graphlib.TopologicalSorter(graph).static_order())
    assert order.index("model") < order.index("scene") < order.index("__init__")

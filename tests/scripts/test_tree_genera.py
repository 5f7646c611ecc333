"""Densities of genera are medians of leaf area over the volume of an ellipsoid, of trees that are large enough."""

import subprocess
import sys
from math import pi
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "dev" / "tree_genera"
HEADER = "ScientificName,TreeType,CrnHt (m),AvgCdia (m),Leaf (m2)\n"


def test_medians_of_large_trees(tmp_path):
    volume = pi / 6 * 4**2 * 6
    rows = [("Tilia cordata", "BDM", 6, 4, density / 100 * volume) for density in range(40, 71)]
    rows += [("Tilia cordata", "BDM", 6, 3.9, 900), ("Tilia cordata", "BDM", -1, 4, 900)]
    rows += [("Picea pungens", "CEL", 6, 4, 0.8 * volume)] * 30
    rows += [("Larix decidua", "BDL", 6, 4, volume)] * 29 + [("Phoenix dactylifera", "PEL", 6, 4, volume)] * 40
    table = tmp_path / "trees.csv"
    table.write_text(HEADER + "".join(",".join(map(str, row)) + "\n" for row in rows))
    printed = subprocess.run([sys.executable, SCRIPT, table], capture_output=True, text=True, check=True).stdout
    assert printed == '    {"Picea", 0.80, true},\n    {"Tilia", 0.55, false},\n'

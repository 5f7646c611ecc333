"""The text of models in idf_examples that are generated."""

import subprocess
import sys

from shading_runs import energyplus


def canopy():
    """500 panes of glass above a room: a model with an extension object."""
    folder = energyplus.REPOSITORY / "idf_examples" / "canopy"
    return subprocess.run([sys.executable, folder / "generate.py"], capture_output=True, text=True, check=True).stdout

"""What adapters share: the scene of the last argument, and answers as `gpu_shading suite` expects them."""

import json
import sys
from pathlib import Path

SUITE = Path(__file__).resolve().parents[1]
REPOSITORY = SUITE.parents[1]
sys.path[:0] = [str(SUITE), str(REPOSITORY / "scripts"), str(REPOSITORY / "gpu_shading" / "python")]
sys.path.append(str(REPOSITORY / ".venv" / "tools"))

import exact  # noqa: E402


def read(path):
    """The scene's surfaces (exact.Surface), and its suns as the file has them."""
    scene = json.loads(Path(path).read_text(encoding="utf-8"))
    return exact.surfaces_of(scene), scene["suns"]


def answer(values):
    """A dictionary of fractions by receiver for each sun."""
    print(json.dumps([{name: float(value) for name, value in each.items()} for each in values]))


def not_supported(why):
    print(json.dumps({"not supported": why}))
    sys.exit(0)

import sys
from pathlib import Path

SUITE = Path(__file__).resolve().parent
sys.path[:0] = [str(SUITE), str(SUITE.parents[1] / "gpu_shading" / "python")]

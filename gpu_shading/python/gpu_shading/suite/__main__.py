"""The command `gpu_shading suite`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gpu_shading import _command
else:
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    import _command

    del sys.path[0]

_EXAMPLE = """example, in the sources:
  gpu_shading suite tests/suite/scenes -o scores \\
    --tool "this renderer=.venv/bin/python tests/suite/adapters/renderer.py" \\
    --tool "polygon clipping=.venv/bin/python tests/suite/adapters/energyplus.py"
"""


def _parse() -> argparse.Namespace:
    parser = _command.Parser(
        prog="gpu_shading suite", formatter_class=argparse.RawDescriptionHelpFormatter, epilog=_EXAMPLE,
        description="Scores shading tools on scenes with exact sunlit fractions. Writes DIR/scores.md, a table by\n"
                    "feature; DIR/scores.csv, every answer; and a picture of each scene on which a tool is off by\n"
                    "more than 0.001.")
    parser.add_argument("scenes", metavar="SCENES", help="folder of scenes, such as tests/suite/scenes")
    parser.add_argument("--tool", metavar="NAME=COMMAND", action="append", required=True,
                        help="command that gets the file of a scene as its last argument, and prints answers as JSON; "
                             "may be repeated")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder, new or empty")
    parser.add_argument("--limit", metavar="S", type=float, default=600.0,
                        help="seconds for a scene, after which a tool has no answer (default: 600)")
    arguments = parser.parse_args()
    for value, what in ((arguments.scenes, "SCENES"), (arguments.output, "-o")):
        if not value:
            parser.error(f"{what} '': expected the name of a folder")
    return arguments


def main() -> int:
    arguments = _parse()

    def work() -> int:
        from gpu_shading.suite.run import run

        print(run(Path(arguments.scenes), arguments.tool, Path(arguments.output), arguments.limit), end="")
        return 0

    return _command.run("gpu_shading suite", __file__, ("matplotlib", "numpy"), work, "interrupted")


if __name__ == "__main__":
    sys.exit(main())

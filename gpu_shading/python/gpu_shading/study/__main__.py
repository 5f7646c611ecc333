"""The command `gpu_shading study`."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gpu_shading import _command
else:
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    import _command

    del sys.path[0]


def _parse() -> argparse.Namespace:
    parser = _command.Parser(
        prog="gpu_shading study", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Runs the models, variants and weather files of a plan on the workers of Dask, and writes\n"
                    "DIR/runs.csv and DIR/runs.parquet, a row for each run. The same command resumes.")
    parser.add_argument("plan", metavar="PLAN", help="a TOML or CSV file")
    parser.add_argument("-o", "--output", metavar="DIR", required=True,
                        help="folder for the table and for what is kept")
    parser.add_argument("--dry-run", action="store_true", help="count runs and distinct scenes, and estimate the time")
    parser.add_argument("--workers", type=int, metavar="N", help="processes on this machine (default: all cores)")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="Dask scheduler to use instead, as in tcp://host:8786")
    parser.add_argument("--jobqueue", metavar="KIND",
                        help="slurm, pbs or lsf: workers started by the queue, with the resources of [jobqueue]")
    parser.add_argument("--keep", metavar="WHAT",
                        help="what stays of each run: tables, sql, all or nothing, with commas (default: tables)")
    parser.add_argument("--limit", type=float, metavar="S", help="seconds after which a run is stopped (default: none)")
    parser.add_argument("--tries", type=int, metavar="N", help="how often a run that fails is tried (default: 2)")
    arguments = parser.parse_args()
    if not arguments.output:
        parser.error("-o '': expected the name of a folder")
    return arguments


def main() -> int:
    arguments = _parse()
    os.environ["PYTHONSAFEPATH"] = "1"  # no Python that this starts imports modules of the current folder

    def work() -> int:
        from gpu_shading._text import escaped
        from gpu_shading.study.study import Study

        study = Study(arguments.plan, arguments.output, workers=arguments.workers, scheduler=arguments.scheduler,
                      jobqueue={"kind": arguments.jobqueue} if arguments.jobqueue else None,
                      keep=arguments.keep.split(",") if arguments.keep else None, limit=arguments.limit,
                      tries=arguments.tries)
        if arguments.dry_run:
            lines, failed = study.estimate()
            print("\n".join(lines))
        else:
            failed = any(row["status"] == "failed" for row in study.run())
            print(escaped(str(Path(arguments.output) / "runs.csv")))
        return 1 if failed else 0

    return _command.run("gpu_shading study", __file__, ("distributed", "numpy"), work,
                        "interrupted; the same command resumes")


if __name__ == "__main__":
    sys.exit(main())

"""The command `gpu_shading study`."""

from __future__ import annotations

import argparse
import importlib.util
import os
import sys
from pathlib import Path

_PACKAGES = Path(__file__).resolve().parents[2]
# Run by path, by a Python that need not know the package; its folder must not hide modules of others.
sys.path = [str(_PACKAGES), *(path for path in sys.path if Path(path or ".").resolve() != Path(__file__).parent)]


def _parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
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
    for name in ("workers", "limit", "tries"):
        value = getattr(arguments, name)
        if value is not None and value < 1:
            parser.error(f"--{name} {value:g}: expected 1 or more")
    return arguments


def _use_python_of_sources() -> None:
    """scripts/setup puts Dask into .venv."""
    if importlib.util.find_spec("distributed") and importlib.util.find_spec("numpy"):
        return
    own = _PACKAGES.parents[1] / ".venv" / "bin" / "python"
    if own.is_file() and Path(sys.prefix) != own.parents[1]:
        os.execv(own, [str(own), __file__, *sys.argv[1:]])


def main() -> int:
    arguments = _parse()
    _use_python_of_sources()
    try:
        from gpu_shading.errors import Error
        from gpu_shading.study.study import Study
    except ImportError as error:
        print(f"gpu_shading study: {error}", file=sys.stderr)
        return 1
    try:
        study = Study(arguments.plan, arguments.output, workers=arguments.workers, scheduler=arguments.scheduler,
                      jobqueue={"kind": arguments.jobqueue} if arguments.jobqueue else None,
                      keep=arguments.keep.split(",") if arguments.keep else None, limit=arguments.limit,
                      tries=arguments.tries)
        if arguments.dry_run:
            print(study.dry_run())
            return 0
        rows = study.run()
    except (Error, ImportError, OSError) as error:
        print(f"gpu_shading study: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("gpu_shading study: interrupted; the same command resumes", file=sys.stderr)
        return 130
    print(Path(arguments.output) / "runs.csv")
    return 1 if any(row["status"] == "failed" for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())

"""The command `gpu_shading study`."""

from __future__ import annotations

import argparse
import importlib.util
import os
import signal
import sys
from pathlib import Path
from typing import NoReturn

_PACKAGES = Path(__file__).resolve().parents[2]
# Run by path, by a Python that need not know the package; its folder must not hide modules of others.
sys.path = [str(_PACKAGES), *(path for path in sys.path if Path(path or ".").resolve() != Path(__file__).parent)]


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        _fail(f"{message} (see gpu_shading study --help)")
        sys.exit(1)


def _fail(message: str, status: int = 1) -> int:
    # By hand, because this must work where the package cannot be imported.
    line = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in " ".join(message.split()))
    if len(line) > 2200:
        line = f"{line[:1200]} ... {line[-800:]}"
    print(f"gpu_shading study: {line}", file=sys.stderr)
    return status


def _parse() -> argparse.Namespace:
    parser = _Parser(
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


def _use_python_of_sources() -> None:
    """scripts/setup puts Dask into .venv."""
    if importlib.util.find_spec("distributed") and importlib.util.find_spec("numpy"):
        return
    own = _PACKAGES.parents[1] / ".venv" / "bin" / "python"
    if own.is_file() and Path(sys.prefix) != own.parents[1]:
        os.execv(own, [str(own), __file__, *sys.argv[1:]])


def _interrupt(number: int, _: object) -> NoReturn:
    raise KeyboardInterrupt(number)


def main() -> int:
    arguments = _parse()
    _use_python_of_sources()
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_DFL:  # nohup ignores one
            signal.signal(number, _interrupt)
    os.environ["PYTHONSAFEPATH"] = "1"  # no Python that this starts imports modules of the current folder
    try:
        from gpu_shading._text import escaped, of_error
        from gpu_shading.errors import Error
        from gpu_shading.study.study import Study
    except ImportError as error:
        return _fail(str(error))
    try:
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
    except (Error, ImportError, OSError) as error:
        return _fail(of_error(error))
    except KeyboardInterrupt as error:
        return _fail("interrupted; the same command resumes", 128 + (error.args[0] if error.args else signal.SIGINT))
    except Exception as error:  # a fault of ours: still one line
        return _fail(f"{type(error).__name__}: {of_error(error)}; please report this")


if __name__ == "__main__":
    sys.exit(main())

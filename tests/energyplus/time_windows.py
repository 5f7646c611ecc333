#!/usr/bin/env python3
"""Times a year of a box behind 1, 20, 200 and 1,000 louvres in Windows: by polygon clipping, with opengl32.dll alone,
and with --gpu-shading. Prints the seconds that EnergyPlus reports, and ratios, as the table in docs/guides/windows.md.

    tests/energyplus/time_windows.py [--repeat 2] [--louvres 1 20 200 1000] [--days 365]

Each is run as often as --repeat says, in turn, and the shortest counts. What takes longer than --limit is stopped.
"""

import argparse
import sys
import tempfile
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPOSITORY / "scripts"), str(REPOSITORY / "idf_examples" / "box_with_louvres")]

import generate  # noqa: E402
import windows  # noqa: E402
from shading_runs import energyplus, input_file  # noqa: E402


def write(count, method, days, path):
    model = input_file.Idf(generate.model(count))
    model.set_field("ShadowCalculation", input_file.SHADOW_METHOD, method)
    if days < 365:
        model.remove(lambda name: name == "runperiod")
        model.add("RunPeriod", ["Days", 1, 1, 2017, 1, days, 2017])
    model.write(path)
    return path


def time_once(wine, program, model, options, limit):
    with tempfile.TemporaryDirectory() as folder:
        run = energyplus.run(program, model, energyplus.find_weather(windows.WEATHER), Path(folder) / "out", options,
                             wine.environment, limit, wine.before, windows.name_path)
        if run.timed_out:
            return None
        if not run.completed:
            raise SystemExit(run.why())
        return run.seconds


def shown(seconds, limit):
    return f"more than {limit:.0f} s" if seconds is None else f"{seconds:.1f} s"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=2)
    parser.add_argument("--louvres", type=int, nargs="+", default=[1, 20, 200, 1000])
    parser.add_argument("--days", type=int, default=365)
    parser.add_argument("--limit", type=float, default=300.0, help="seconds")
    chosen = parser.parse_args()
    if why := windows.why_not():
        raise SystemExit(why)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "wine").mkdir()
        wine = windows.Wine(folder / "wine")
        try:
            official = windows.copy_energyplus(folder / "official")
            alone = windows.copy_energyplus(folder / "alone", windows.library())
            patched = windows.patch_energyplus(wine, official.parent, folder / "patched")
            ways = ((official, "PolygonClipping", ()), (alone, "PixelCounting", ()),
                    (patched, "PolygonClipping", ("--gpu-shading",)))
            print(energyplus.processor())
            print("| louvres | polygon clipping | with `opengl32.dll` alone | with `--gpu-shading` |")
            print("|---|---|---|---|")
            for count in chosen.louvres:
                best = [None] * len(ways)
                for _ in range(chosen.repeat):
                    for i, (program, method, options) in enumerate(ways):
                        model = write(count, method, chosen.days, folder / "model.idf")
                        seconds = time_once(wine, program, model, options, chosen.limit)
                        best[i] = min((each for each in (best[i], seconds) if each is not None), default=None)
                cells = [shown(seconds, chosen.limit) for seconds in best]
                if best[0]:
                    cells[1:] = [f"{cell} ({seconds / best[0]:.2f})" if seconds else cell
                                 for cell, seconds in zip(cells[1:], best[1:], strict=True)]
                print(f"| {count:,} | {' | '.join(cells)} |", flush=True)
        finally:
            wine.close()


if __name__ == "__main__":
    main()

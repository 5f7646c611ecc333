#!/usr/bin/env python3
"""CPU seconds of a year with --gpu-shading-sky perez-patches over those of the year without it.

    tests/bench/perez_patches.py [REPEAT]     3 when left out; the median

The example of moving louvres, level, with a transmittance by hour and by season, and turning; and the courtyard. Both
runs of a pair shade at every timestep, and follow each other.
"""

import importlib.util
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

from processor_time import spent_by_children  # noqa: E402
from shading_runs import energyplus  # noqa: E402

EXAMPLES = energyplus.REPOSITORY / "idf_examples"
WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"
HOURS = "".join(f"Until: {hour}:00,{0.4 + 0.02 * (hour % 24):.2f}," for hour in range(1, 24))
SCHEDULE = ("\nSchedule:Compact,Hours,,"
            + "".join(f"Through: {end},For: AllDays,{HOURS}Until: 24:00,{last}," for end, last in
                      (("4/30", 0.3), ("9/30", 0.5), ("12/31", 0.3))).rstrip(",") + ";\n")


def models():
    spec = importlib.util.spec_from_file_location("moving", EXAMPLES / "moving_louvres" / "generate.py")
    moving = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(moving)
    level = moving.model(control="none")
    names = [f"Louvre {number}" for number in range(1, moving.ROWS + 2)]
    scheduled = level
    for name in names:
        scheduled = scheduled.replace(f"  {name},,4,", f"  {name},Hours,4,")
    return {"level louvres": level, "with a transmittance by hour": scheduled + SCHEDULE,
            "BlockBeam": moving.model(control="block"), "TrackSun": moving.model(control="track"),
            "courtyard": (EXAMPLES / "courtyard" / "courtyard.idf").read_text(encoding="utf-8")}


def seconds(path, folder, *options):
    """Of the processors, by EnergyPlus and what it starts."""
    before = spent_by_children()
    done = energyplus.run(energyplus.patched_prefix() / "energyplus", path, energyplus.find_weather(WEATHER), folder,
                          ["--gpu-shading", "--gpu-shading-update=timestep", "--gpu-shading-device=cpu", *options])
    if not done.completed:
        raise SystemExit(f"perez_patches: {path.stem}: {done.why()}")
    return spent_by_children() - before


def main():
    repeat = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    with tempfile.TemporaryDirectory() as name:
        for words, text in models().items():
            path = Path(name) / f"{words.replace(' ', '_')}.idf"
            path.write_text(text, encoding="utf-8")
            pairs = []
            for i in range(repeat):
                plain, patches = (seconds(path, path.with_suffix(f".{i}{suffix}"), *options) for suffix, options in
                                  (("a", []), ("b", ["--gpu-shading-sky=perez-patches"])))
                pairs.append((plain, patches))
            ratio = statistics.median(patches / plain for plain, patches in pairs)
            plain, patches = (statistics.median(column) for column in zip(*pairs, strict=True))
            print(f"{words}: {plain:.1f} s, by patch {patches:.1f} s, {ratio:.2f} times", flush=True)


if __name__ == "__main__":
    main()

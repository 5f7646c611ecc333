#!/usr/bin/env python3
"""Reflected light by this module and by Radiance: scenes of tests/energyplus/reflecting_scenes.py by 20 suns each.

    reflected_light.py [--suns N] [--points N] [--reflectances R,R,...] [SCENE ...]

A line for each scene and reflectance of its shades. A clear year stands for the sky's beam and diffuse light at each
sun. "reflected": the year's light by way of reflections, this module's divided by Radiance's. "hours": the
root-mean-square error of the suns, of reflected light alone, by energy. "all": the same of all light, as the .eio file
states it ("stated"). "all, year": the error of its sum. "sky": of a uniform sky alone.
"""

import argparse
import math
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("scripts", "tests/energyplus", "idf_examples/box_with_louvres")]

import generate  # noqa: E402
import radiance  # noqa: E402
import reflecting_scenes as scenes  # noqa: E402
import windows  # noqa: E402
from shading_runs import energyplus  # noqa: E402

MONTHS = (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12)
FLOOR = 0.1  # of the unshaded light, to which errors are relative


def clear(altitude):
    """Beam and diffuse irradiance, W/m2, as energyplus_patch/calculation/reflected_irradiance.cpp has them."""
    height = math.sin(math.radians(altitude))
    return 0.5 * 1353 * 0.7 ** (height ** -0.678), 200 * height


def compare(found, count, points):
    suns = radiance.spread(list(found.ours), count)
    their_sky = found.their_sky(points)
    sums = {"ours": 0.0, "theirs": 0.0, "all": 0.0, "off": 0.0}
    of_reflected = of_all = 0.0
    for sun in suns:
        beam, sky = clear(sun[1])
        theirs = beam * found.theirs(sun, points) + sky * their_sky
        ours = beam * found.ours[sun] + sky * found.our_sky
        facing = max(0.0, radiance.dot(radiance.towards(sun), found.normal))
        total = max(theirs + beam * found.direct[sun] + sky * found.sky_direct,
                    FLOOR * (beam * facing + sky * 0.5 * (1 + found.normal[2])))
        sums["ours"] += ours
        sums["theirs"] += theirs
        sums["all"] += total
        of_reflected += (ours - theirs) ** 2 / theirs
        of_all += (ours - theirs) ** 2 / total
    off = sums["ours"] - sums["theirs"]
    return (sums["ours"] / sums["theirs"], math.sqrt(of_reflected / sums["theirs"]), math.sqrt(of_all / sums["all"]),
            off / sums["all"], found.our_sky / their_sky)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suns", type=int, default=20)
    parser.add_argument("--points", type=int, default=400)
    parser.add_argument("--reflectances", default="0.2,0.5,0.8")
    parser.add_argument("scenes", nargs="*", default=[*scenes.SCENES])
    arguments = parser.parse_args()
    if radiance.is_missing():
        sys.exit(f"{radiance.FOLDER} is missing: scripts/setup could not fetch pyradiance")
    patched = energyplus.patched_prefix() / "energyplus"
    weather = energyplus.find_weather(windows.WEATHER)
    print(f"{'scene':22} refl.  reflected  hours %  all %  stated %  all, year %    sky")
    for name in arguments.scenes:
        for reflectance in map(float, arguments.reflectances.split(",")):
            with tempfile.TemporaryDirectory() as folder:
                found = scenes.Comparison(patched, weather, Path(folder), generate.model(1), name, reflectance, MONTHS)
                year, hours, of_all, all_year, sky = compare(found, arguments.suns, arguments.points)
            print(f"{name:22} {reflectance:5.2f}  {year:9.4f}  {100 * hours:7.2f}  {100 * of_all:5.2f}  "
                  f"{found.stated:8.2f}  {100 * all_year:+11.2f}  {sky:.4f}", flush=True)


if __name__ == "__main__":
    main()

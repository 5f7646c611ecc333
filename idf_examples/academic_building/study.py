#!/usr/bin/env python3
"""Runs the building for a year with each of its screens and prints the solar radiation inside as Markdown.

    study.py [--small] [--device NAME] [-w EPW] [--timeout SECONDS] [-o DIR]
    study.py --samples fine medium coarse ...          # time of sampling, instead of years
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import generate  # noqa: E402
from common import case_study  # noqa: E402

SIDES = ["South", "East", "North", "West"]


def side_of(window):
    """The group of a window, from the name of its wall, which may be followed by a number."""
    words = window.title().split(" ")
    return next((word for word in reversed(words) if word in SIDES), "Roof")


def size(is_small):
    return generate.SMALL if is_small else generate.FULL


def write_files(screen, is_small, folder):
    if screen == "gradient":
        generate.write_image(folder / generate.IMAGE, size(is_small))


STUDY = case_study.CaseStudy(
    name="academic_building",
    weather="USA_IL_Chicago-OHare.Intl.AP.725300_TMY3.epw",
    variants={"holes of 6.35 mm": "small", "holes of 25.4 mm": "large", "gradient": "gradient"},
    groups=[*SIDES, "Roof"],
    group_of=side_of,
    model_of=lambda screen, is_small: generate.model(screen, size(is_small)),
    write_files=write_files,
)

if __name__ == "__main__":
    case_study.main(STUDY)

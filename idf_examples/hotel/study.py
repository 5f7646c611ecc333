#!/usr/bin/env python3
"""Runs the hotel for a year with each of its shells and prints the solar radiation inside as Markdown.

    study.py [--small] [--device NAME] [-w EPW] [--timeout SECONDS] [-o DIR]
    study.py --samples fine medium coarse ...          # time of sampling, instead of years
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import generate  # noqa: E402
from common import case_study  # noqa: E402


def part_of(window):
    """The group of rooms, from the name of the zone."""
    for part, word in (("podium", "PODIUM"), ("lounges", "LOUNGE"), ("ends", " END ")):
        if word in window:
            return part
    return "south rooms" if "SOUTH ROOMS" in window else "north rooms"


STUDY = case_study.CaseStudy(
    name="hotel",
    weather="USA_FL_Tampa.Intl.AP.722110_TMY3.epw",
    variants={
        "single glass, panes turned 20 degrees": ("single", 20.0),
        "single glass, panes turned 90 degrees": ("single", 90.0),
        "triple glass, panes turned 20 degrees": ("triple", 20.0),
    },
    groups=["south rooms", "north rooms", "ends", "lounges", "podium"],
    group_of=part_of,
    model_of=lambda variant, is_small: generate.model(*variant, generate.SMALL if is_small else generate.FULL),
)

if __name__ == "__main__":
    case_study.main(STUDY)

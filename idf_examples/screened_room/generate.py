#!/usr/bin/env python3
"""Writes the model of one room behind a perforated screen.

    generate.py [--facing south|east|west] [--screen ...] [--image gradient.png] > screened_room.idf

The screen is in front of a window of 4 x 1.8 m and extends beyond it to the sides and above, so that sun comes in
around it only at 76 degrees of incidence or more.
"""

import argparse
import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]

import random_holes  # noqa: E402
from common import idf  # noqa: E402
from shading_runs import output_folder  # noqa: E402
from shading_runs.errors import in_words  # noqa: E402

# Drawn with the window facing south, in metres, and then turned.
ROOM = (6.0, 6.0, 3.0)
WINDOW = (1.0, 0.6, 5.0, 2.4)  # x, z, x, z
SCREEN = (-0.6, 0.0, 6.6, 4.0)
DISTANCE = 0.4
POINTS = ((3.0, 1.5, 0.8), (3.0, 4.5, 0.8))  # where daylight dims the lights
AZIMUTHS = {"south": 180.0, "east": 90.0, "west": 270.0}

THICKNESS = 0.00635
OPEN = 0.5
HOLES = {"small holes": 0.00635, "large holes": 0.0254}  # diameters
IMAGE = "gradient.png"
TEXEL = 0.002

SCREENS = {
    "none": "",
    "schedule": f"Schedule:Constant,Open Share,Any,{OPEN};\n",
    "small holes": "",
    "large holes": "",
    "gradient": ("! Holes of 6 to 30 mm at random, more of them towards the top; once over the whole screen.\n"
                 "GPUShading:PerforatedScreen,Sheet,Screen,\n"
                 f"  Texture,{IMAGE},,,,,,\n  {THICKNESS};                 !- Thickness {{m}}\n"),
}

HEAD = """\
! One room behind a perforated screen: {screen}, facing {facing}.
! Written by generate.py --facing {facing} --screen "{screen}".
! Weather: USA_CO_Golden-NREL.724666_TMY3.epw, which comes with EnergyPlus.

""" + idf.preamble("Screened Room", idf.GOLDEN, idf.GOLDEN_DAY) + """
Material,Insulation,Rough,0.1,0.04,30,1400;
Material,Board,Smooth,0.02,0.2,800,1000;
WindowMaterial:SimpleGlazingSystem,Glazing,1.4,0.6;
Construction,Outer Wall,Insulation,Board;
Construction,Glass,Glazing;
Zone,Room;

ScheduleTypeLimits,Any;
Schedule:Constant,Heating Setpoint,Any,20;
Schedule:Constant,Cooling Setpoint,Any,26;
Schedule:Constant,Control Type,Any,4;
ThermostatSetpoint:DualSetpoint,Setpoints,Heating Setpoint,Cooling Setpoint;
ZoneControl:Thermostat,Thermostat,Room,Control Type,ThermostatSetpoint:DualSetpoint,Setpoints;
ZoneHVAC:EquipmentConnections,Room,Equipment,Inlet,,Room Air,Return;
ZoneHVAC:EquipmentList,Equipment,SequentialLoad,ZoneHVAC:IdealLoadsAirSystem,Ideal Loads,1,1;
ZoneHVAC:IdealLoadsAirSystem,Ideal Loads,,Inlet;

! Lights of 10 W/m2 in working hours, dimmed by daylight at two points of the work plane.
Schedule:Compact,Working Hours,Any,Through: 12/31,For: Weekdays,Until: 8:00,0,Until: 18:00,1,Until: 24:00,0,
  For: AllOtherDays,Until: 24:00,0;
Lights,Lamps,Room,Working Hours,Watts/Area,,10,,0,0.4,0.1,1.0;

Output:Variable,*,Zone Lights Electricity Energy,Monthly;
Output:Variable,*,Zone Air System Sensible Heating Energy,Monthly;
Output:Variable,*,Zone Air System Sensible Cooling Energy,Monthly;
""" + idf.SOLAR_OUTPUTS


def pitch(diameter):
    """The pitch of round holes, staggered by 60 degrees, with an open fraction of OPEN."""
    return diameter * math.sqrt(math.pi / (2 * math.sqrt(3)) / OPEN)


def round_holes(diameter):
    return (f"GPUShading:PerforatedScreen,Sheet,Screen,\n  Round,,Staggered60,\n  {diameter},"
            f"                 !- Hole Size {{m}}\n  ,\n  {pitch(diameter):.7f},               !- Pitch {{m}}\n  ,\n"
            f"  {THICKNESS};                 !- Thickness {{m}}\n")  # fmt: skip


def vertices(corners, facing):
    turn = math.radians(AZIMUTHS[facing] - 180)  # clockwise, seen from above
    c, s = math.cos(turn), math.sin(turn)
    return ",\n".join(f"  {x * c + y * s:.6f},{y * c - x * s:.6f},{z:.6f}" for x, y, z in corners) + ";\n"


def upright(x1, z1, x2, z2, y=0.0):
    """A rectangle that faces the same way as the window."""
    return [(x1, y, z2), (x1, y, z1), (x2, y, z1), (x2, y, z2)]


def room(facing):
    w, d, h = ROOM
    parts = {
        "Front": ("Wall", "Outdoors", upright(0, 0, w, h)),
        "Right": ("Wall", "Adiabatic", [(w, 0, h), (w, 0, 0), (w, d, 0), (w, d, h)]),
        "Back": ("Wall", "Adiabatic", [(w, d, h), (w, d, 0), (0, d, 0), (0, d, h)]),
        "Left": ("Wall", "Adiabatic", [(0, d, h), (0, d, 0), (0, 0, 0), (0, 0, h)]),
        "Roof": ("Roof", "Adiabatic", [(0, d, h), (0, 0, h), (w, 0, h), (w, d, h)]),
        "Floor": ("Floor", "Adiabatic", [(w, d, 0), (w, 0, 0), (0, 0, 0), (0, d, 0)]),
    }
    for name, (kind, boundary, corners) in parts.items():
        sun = "SunExposed,WindExposed" if boundary == "Outdoors" else "NoSun,NoWind"
        yield (f"\nBuildingSurface:Detailed,\n  {name},{kind},Outer Wall,Room,,{boundary},,{sun},,4,\n"
               + vertices(corners, facing))  # fmt: skip
    yield ("\nFenestrationSurface:Detailed,\n  Window,Window,Glass,Front,,,,1,4,\n"
           + vertices(upright(*WINDOW), facing))  # fmt: skip


def daylighting(facing):
    """Dims half of the lights by the light near the window, and half by that at the back of the room."""
    points = ("Front Point", "Back Point")
    yield ("\nDaylighting:Controls,Dimming,Room,SplitFlux,,Continuous,0.2,0.1,,,,,,,"
           + ",".join(f"\n  {name},0.5,500" for name in points) + ";\n")  # fmt: skip
    for name, place in zip(points, POINTS, strict=True):
        yield f"Daylighting:ReferencePoint,{name},Room,\n" + vertices([place], facing)


def model(facing="south", screen="small holes"):
    yield HEAD.format(screen=screen, facing=facing)
    yield from room(facing)
    yield from daylighting(facing)
    if screen == "none":
        return
    schedule = "Open Share" if screen == "schedule" else ""
    yield (f"\nShading:Building:Detailed,\n  Screen,{schedule},4,\n"
           + vertices(upright(*SCREEN, -DISTANCE), facing) + "\n")  # fmt: skip
    yield round_holes(HOLES[screen]) if screen in HOLES else SCREENS[screen]


def write_image(path):
    x1, z1, x2, z2 = SCREEN
    output_folder.write_file(path, random_holes.png(random_holes.opacity(x2 - x1, z2 - z1, TEXEL)))


def main():
    parser = argparse.ArgumentParser(description="Writes the model of one room behind a perforated screen.")
    parser.add_argument("--facing", choices=AZIMUTHS, default="south",
                        help="orientation of the window (default: south)")
    parser.add_argument("--screen", choices=SCREENS, default="small holes",
                        help="what the screen is (default: small holes)")
    parser.add_argument("--image", metavar="FILE", help=f"write the gradient's image too; the model reads {IMAGE}")
    arguments = parser.parse_args()
    if arguments.image:
        try:
            write_image(arguments.image)
        except (OSError, output_folder.NotOurs) as error:
            sys.exit(f"screened_room: {in_words(error)}")
    sys.stdout.writelines(model(arguments.facing, arguments.screen))


if __name__ == "__main__":
    main()

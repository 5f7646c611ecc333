"""The example of a room behind a screen, and what passes its sheet in closed form."""

import importlib.util
import math
import sqlite3
import sys

from shading_runs import energyplus

FOLDER = energyplus.REPOSITORY / "idf_examples" / "screened_room"


def _example():
    # Not by its name, which other examples' generators have too.
    sys.path.append(str(FOLDER))
    spec = importlib.util.spec_from_file_location("screened_room_generate", FOLDER / "generate.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


generate = _example()

# By what an output is called here.
OUTPUTS = {
    "azimuth": "*,Site Solar Azimuth Angle",
    "altitude": "*,Site Solar Altitude Angle",
    "beam": "Window,Surface Window Transmitted Beam Solar Radiation Energy",
    "all": "Window,Surface Window Transmitted Solar Radiation Energy",
    "floor": "Floor,Surface Inside Face Exterior Windows Incident Beam Solar Radiation Rate",
}


def model(facing="south", screen="none", objects="", shadow="PixelCounting,Timestep", solar="FullExterior"):
    """The room's input with the outputs above at each timestep and more objects."""
    text = "".join(generate.model(facing, screen)) + objects
    text = text.replace("PixelCounting,Periodic,20", shadow).replace("FullExterior", solar)
    return text + "".join(f"Output:Variable,{output},Timestep;\n" for output in OUTPUTS.values())


def rectangle(name, y, x1=-5.0, z1=0.0, x2=11.0, z2=9.0, facing="south"):
    """A shade that faces as the window does."""
    corners = generate.vertices(generate.upright(x1, z1, x2, z2, y), facing)
    return f"Shading:Building:Detailed,{name},,4,\n" + corners


def ledge(name, y1, y2, z=2.5):
    """A level shade from y1 to y2, wider than the window."""
    corners = generate.vertices([(-5, y2, z), (-5, y1, z), (11, y1, z), (11, y2, z)], "south")
    return f"Shading:Building:Detailed,{name},,4,\n" + corners


def timesteps(run):
    """{name of an output: its value at each timestep}."""
    query = """SELECT r.Value FROM ReportData r JOIN ReportDataDictionary d USING (ReportDataDictionaryIndex)
               WHERE d.Name = ? AND d.ReportingFrequency = 'Zone Timestep' ORDER BY r.TimeIndex"""
    with sqlite3.connect(run.folder / "eplusout.sql") as data:
        found = {name: [value for (value,) in data.execute(query, (output.split(",")[1],))]
                 for name, output in OUTPUTS.items()}
    data.close()
    return found


def slant(facing, azimuth, altitude):
    """How far a ray goes to the right, as seen from outside, and up on its way of 1 m out, or None."""
    from_normal, up = math.radians(azimuth - generate.AZIMUTHS[facing]), math.radians(altitude)
    out = math.cos(up) * math.cos(from_normal)
    if altitude <= 0 or out < 1e-3:
        return None
    # To the right is where the azimuth falls.
    return -math.cos(up) * math.sin(from_normal) / out, math.sin(up) / out


def seen_through(opening, right, rise):
    """Share of the window that rays of a slant meet through a rectangle (x, z, x, z) of the screen's plane."""
    x, z = generate.DISTANCE * right, generate.DISTANCE * rise
    (x1, z1, x2, z2), (left, bottom, end, top) = generate.WINDOW, opening
    wide, high = min(x2 + x, end) - max(x1 + x, left), min(z2 + z, top) - max(z1 + z, bottom)
    return max(0, wide) * max(0, high) / ((x2 - x1) * (z2 - z1))


def passing(facing, diameter, azimuth, altitude):
    """(share of the window that is behind the screen, transmittance of round holes); angles in degrees.

    A ray at theta to the normal leaves the sheet beside where it came in by t tan(theta): it passes where
    the two circles overlap. Behind is (0, 0) where the sun is not before the window.
    """
    way = slant(facing, azimuth, altitude)
    if way is None:
        return 0.0, 0.0
    apart = min(1.0, generate.THICKNESS * math.hypot(*way) / diameter)
    lens = 2 / math.pi * (math.acos(apart) - apart * math.sqrt(1 - apart**2))
    return seen_through(generate.SCREEN, *way), generate.OPEN * lens

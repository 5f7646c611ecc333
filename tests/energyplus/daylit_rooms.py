"""Rooms with louvres and each way of EnergyPlus to light a room by day: texts to add to the box with louvres."""

import re

CONTROL = """
Daylighting:Controls,{zone} Light,{zone},SplitFlux,,Continuous,0.3,0.2,,,,,,,{zone} Point,1.0,500;
Daylighting:ReferencePoint,{zone} Point,{zone},{x},{y},0.8;
Lights,{zone} Lamps,{zone},Always,LightingLevel,400,,,,,,1.0;
"""
OUTPUTS = """
Output:DaylightFactors,SizingDays;
Output:SQLite,Simple;
Output:Variable,*,Daylighting Reference Point 1 Illuminance,Timestep;
Output:Variable,*,Zone Lights Electricity Rate,Timestep;
Schedule:Constant,Always,,1.0;
"""


def control(zone="Box", x=3.0, y=3.0):
    return CONTROL.format(zone=zone, x=x, y=y)


def rectangle(points):
    return ",".join(f"{value:g}" for point in points for value in point) + ";\n"


def window(name, wall, points, kind="Window", boundary=""):
    return f"FenestrationSurface:Detailed,{name},{kind},Window,{wall},{boundary},,,,4,{rectangle(points)}"


def wall(name, zone, kind, boundary, points):
    inside = boundary != "Outdoors"
    exposure = "NoSun,NoWind" if inside else "SunExposed,WindExposed"
    other = f"Surface,{boundary}" if inside and boundary != "Adiabatic" else f"{boundary},"
    return f"BuildingSurface:Detailed,{name},{kind},Outer Wall,{zone},,{other},{exposure},,4,{rectangle(points)}"


def plain(text):
    return text + control() + OUTPUTS


def several_windows_and_a_map(text):
    """A second window to the south, one to the west, and points on a grid."""
    return plain(text) + (
        window("High Window", "South", [(0.3, 0, 2.9), (0.3, 0, 2.0), (1.2, 0, 2.0), (1.2, 0, 2.9)])
        + window("West Window", "West", [(0, 5, 2.5), (0, 5, 1.0), (0, 2, 1.0), (0, 2, 2.5)])
        + "Output:IlluminanceMap,Map,Box,0.8,0.3,5.7,6,0.3,5.7,6;\nOutputControl:IlluminanceMap:Style,Comma;\n")


def interior_window(text):
    """A room behind the box, lit through a window in the wall between them."""
    text, count = re.subn(r"(North,Wall,Outer Wall,Box,,)Outdoors,,SunExposed,WindExposed",
                          r"\1Surface,Behind,NoSun,NoWind", text)
    assert count == 1
    glass = [(4.5, 6, 2.5), (4.5, 6, 0.9), (1.5, 6, 0.9), (1.5, 6, 2.5)]
    return plain(text) + "Zone,Back;\n" + control("Back", 3.0, 7.5) + (
        wall("Behind", "Back", "Wall", "North", [(0, 6, 3), (0, 6, 0), (6, 6, 0), (6, 6, 3)])
        + wall("Back East", "Back", "Wall", "Outdoors", [(6, 6, 3), (6, 6, 0), (6, 9, 0), (6, 9, 3)])
        + wall("Back North", "Back", "Wall", "Outdoors", [(6, 9, 3), (6, 9, 0), (0, 9, 0), (0, 9, 3)])
        + wall("Back West", "Back", "Wall", "Outdoors", [(0, 9, 3), (0, 9, 0), (0, 6, 0), (0, 6, 3)])
        + wall("Back Roof", "Back", "Roof", "Outdoors", [(0, 9, 3), (0, 6, 3), (6, 6, 3), (6, 9, 3)])
        + wall("Back Floor", "Back", "Floor", "Adiabatic", [(0, 6, 0), (0, 9, 0), (6, 9, 0), (6, 6, 0)])
        + window("Out of Box", "North", glass, boundary="Into Back")
        + window("Into Back", "Behind", list(reversed(glass)), boundary="Out of Box"))


def shelf(text):
    ledge = [(1.5, -0.6, 1.0), (4.5, -0.6, 1.0), (4.5, 0, 1.0), (1.5, 0, 1.0)]
    return plain(text) + ("DaylightingDevice:Shelf,Shelf,South Window,,Ledge,Outer Wall,0.4;\n"
                          f"Shading:Zone:Detailed,Ledge,South,,4,{rectangle(ledge)}")


def light_well(text):
    skylight = [(2, 4, 3), (2, 2, 3), (4, 2, 3), (4, 4, 3)]
    over = [(1.5, 4.5, 3.4), (1.5, 3, 3.4), (4.5, 3, 3.4), (4.5, 4.5, 3.4)]
    return plain(text) + (window("Skylight", "Roof", skylight)
                          + "DaylightingDevice:LightWell,Skylight,1.2,8,4,0.7;\n"
                          + f"Shading:Building:Detailed,Over Skylight,,4,{rectangle(over)}")


def tubular_device(text):
    side = 0.3
    place = [(3, 3 + side, 3), (3, 3, 3), (3 + side, 3, 3), (3 + side, 3 + side, 3)]
    over = [(2.5, 4, 3.6), (2.5, 3.1, 3.6), (4, 3.1, 3.6), (4, 4, 3.6)]
    diameter = 2 * side / 3.14159265**0.5
    return plain(text) + (
        window("Dome", "Roof", place, "TubularDaylightDome")
        + window("Diffuser", "Roof", [(x + 1, y + 1, z) for x, y, z in place], "TubularDaylightDiffuser")
        + "Construction,Pipe,Mirror;\nMaterial,Mirror,Smooth,0.01,50,2700,900,0.9,0.05,0.05;\n"
        + f"DaylightingDevice:Tubular,Tube,Dome,Diffuser,Pipe,{diameter:.6f},0.8,0.28;\n"
        + f"Shading:Building:Detailed,Over Dome,,4,{rectangle(over)}")


def delight(text):
    return plain(text).replace(",SplitFlux,", ",DElight,")


def some_kept(text):
    """EnergyPlus keeps more than 100 surfaces, so it looks for them in its octree."""
    return plain(text) + "Output:Variable,louvre 1.*,Surface Outside Face Sunlit Area,Hourly;\n"

"""The case of ASHRAE 1052-RP: a 3 x 3 m window in a box, an overhang, a fin on each side, or both.

Written so that the closed form holds: the overhang reaches far beyond the window's sides where there are
no fins, and the fins far above its head.
"""

import math

from shading_runs.version import input_version

SIZE = 3.0  # of the window, m
OVERHANG = 0.6  # depth, m
FIN = 1.0  # depth, m
FAR = 30.0  # m
AZIMUTHS = {"south": 180.0, "west": 270.0}

HEAD = f"Version,{input_version()};\n" + """\
SimulationControl,No,No,No,Yes,No;
Building,Box,0,Country,0.04,0.4,FullExterior,25,6;
Timestep,6;
ShadowCalculation,PolygonClipping,Timestep;
Site:Location,Atlanta,33.65,-84.42,-5,315;
SizingPeriod:DesignDay,21 August,8,21,SummerDesignDay,32,10,DefaultMultipliers,,WetBulb,22,,,,,97600,3,230,
  No,No,No,ASHRAEClearSky,,,,,1.0;
GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;
Material:NoMass,Insulation,Rough,3,0.9,0.7,0.7;
WindowMaterial:SimpleGlazingSystem,Glazing,5,0.8;
Construction,Outer Wall,Insulation;
Construction,Window,Glazing;
Zone,Box;
Output:SQLite,Simple;
Output:Variable,*,Site Solar Azimuth Angle,Timestep;
Output:Variable,*,Site Solar Altitude Angle,Timestep;
Output:Variable,Window,Surface Outside Face Sunlit Area,Timestep;
Output:Variable,Window,Surface Outside Face Sunlit Fraction,Timestep;
"""


def model(orientation, with_overhang, with_fins):
    """The input file as text."""
    turn = math.radians(AZIMUTHS[orientation] - 180.0)  # clockwise, seen from above

    def place(points):
        # Drawn with the window to the south, centred over the origin; then turned.
        for x, y, z in points:
            yield (x * math.cos(turn) + y * math.sin(turn), y * math.cos(turn) - x * math.sin(turn), z)

    def vertices(points):
        return ",\n".join(f"  {x:.9f},{y:.9f},{z:.9f}" for x, y, z in place(points)) + ";\n"

    def wall(name, kind, points):
        return (f"BuildingSurface:Detailed,{name},{kind},Outer Wall,Box,,Outdoors,,SunExposed,WindExposed,,4,\n"
                + vertices(points))

    def shade(name, points):
        return f"Shading:Building:Detailed,{name},,4,\n" + vertices(points)

    half, low, high = SIZE / 2, 1.0, 1.0 + SIZE
    w, d, h = 4.0, 6.0, 5.0
    parts = [
        HEAD,
        wall("Front", "Wall", [(-w, 0, h), (-w, 0, 0), (w, 0, 0), (w, 0, h)]),
        wall("Right", "Wall", [(w, 0, h), (w, 0, 0), (w, d, 0), (w, d, h)]),
        wall("Back", "Wall", [(w, d, h), (w, d, 0), (-w, d, 0), (-w, d, h)]),
        wall("Left", "Wall", [(-w, d, h), (-w, d, 0), (-w, 0, 0), (-w, 0, h)]),
        wall("Roof", "Roof", [(-w, d, h), (-w, 0, h), (w, 0, h), (w, d, h)]),
        wall("Base", "Floor", [(-w, 0, 0), (-w, d, 0), (w, d, 0), (w, 0, 0)]),
        "FenestrationSurface:Detailed,Window,Window,Window,Front,,,,,4,\n",
        vertices([(-half, 0, high), (-half, 0, low), (half, 0, low), (half, 0, high)]),
    ]
    if with_overhang:
        reach = half if with_fins else FAR
        parts.append(shade("Overhang", [(-reach, 0, high), (-reach, -OVERHANG, high),
                                        (reach, -OVERHANG, high), (reach, 0, high)]))
    if with_fins:
        for name, x in (("Left Fin", -half), ("Right Fin", half)):
            parts.append(shade(name, [(x, 0, FAR), (x, 0, low), (x, -FIN, low), (x, -FIN, FAR)]))
    return "".join(parts)


def sunlit_area(orientation, with_overhang, with_fins, azimuth, altitude):
    """Sunlit area of the window in m2; angles in degrees, the azimuth clockwise from north.

    A = (W - d_fin |tan g|) (H - d_oh tan W'), g the azimuth from the window's normal and tan W' =
    tan(altitude) / cos(g) the profile angle: ASHRAE 1052-RP, RP-1052 analytical verification test suite.
    """
    g = math.radians(azimuth - AZIMUTHS[orientation])
    if altitude <= 0 or math.cos(g) <= 0:
        return 0.0
    profile = math.tan(math.radians(altitude)) / math.cos(g)
    width = SIZE - (FIN * abs(math.tan(g)) if with_fins else 0.0)
    height = SIZE - (OVERHANG * profile if with_overhang else 0.0)
    return max(0.0, width) * max(0.0, height)

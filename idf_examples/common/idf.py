"""Text of EnergyPlus objects. Metres, x east, y north, z up; outlines counter-clockwise seen from outside."""

GOLDEN = "Golden,39.74,-105.18,-7,1829"
GOLDEN_DAY = "25,12,DefaultMultipliers,,WetBulb,12,,,,,81000"


def preamble(building, location, design_day, terrain="Suburbs"):
    """The objects of a run over a year, before those of the building.

    location: the fields of Site:Location. design_day: those of SizingPeriod:DesignDay from the maximum temperature to
    the pressure.
    """
    return f"""Version,25.2;
SimulationControl,No,No,No,No,Yes;
Building,{building},0,{terrain},0.04,0.2,FullExterior,30,6;
ShadowCalculation,PixelCounting,Periodic,20;
Timestep,4;
Site:Location,{location};
RunPeriod,Year,1,1,,12,31,,Sunday;
SizingPeriod:DesignDay,Clear Autumn Day,10,21,SummerDesignDay,{design_day},2,180,
  No,No,No,ASHRAEClearSky,,,,,1.0;
GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;
"""


SOLAR_OUTPUTS = """Output:Variable,*,Surface Window Transmitted Solar Radiation Energy,Monthly;
Output:Variable,*,Surface Window Transmitted Beam Solar Radiation Energy,Monthly;
Output:SQLite,Simple;
"""

WALLS_AND_GLAZING = """Material,Insulation,Rough,0.1,0.04,30,1400;
Material,Block,Rough,0.1,0.5,1400,1000;
WindowMaterial:SimpleGlazingSystem,Glazing,1.4,0.6;
Construction,Outer Wall,Insulation,Block;
Construction,Window,Glazing;
"""


def points(corners):
    return ",\n".join("  " + ",".join(f"{value:.5f}" for value in corner) for corner in corners) + ";\n"


def surface(name, kind, construction, zone, boundary, corners, other=""):
    """boundary: Outdoors, Ground, Adiabatic, or Surface with the name of the other side."""
    sun = "SunExposed,WindExposed" if boundary == "Outdoors" else "NoSun,NoWind"
    return (f"\nBuildingSurface:Detailed,\n  {name},{kind},{construction},{zone},,{boundary},{other},{sun},,"
            f"{len(corners)},\n" + points(corners))  # fmt: skip


def opening(name, kind, construction, wall, corners):
    """kind: Window, Door or GlassDoor."""
    return (f"\nFenestrationSurface:Detailed,\n  {name},{kind},{construction},{wall},,,,1,{len(corners)},\n"
            + points(corners))  # fmt: skip


def shade(name, corners, kind="Building"):
    """kind: Site, Building."""
    return f"\nShading:{kind}:Detailed,\n  {name},,{len(corners)},\n" + points(corners)

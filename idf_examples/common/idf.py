"""Text of EnergyPlus objects. Metres, x east, y north, z up; outlines counter-clockwise seen from outside."""


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

#!/usr/bin/env python3
"""Writes an office in a small town at the foot of hills, with the map of the town, the terrain and a sail.

    generate.py [-o DIR] [--without town,hills,sail] [--triangles N]

DIR (out/site_context) gets office.idf; town.geojson, 35 blocks in longitude and latitude, the office's own
among them; hills.asc, an ESRI ASCII grid in UTM zone 13; sail.obj, N triangles of fabric over the terrace.
All of it is invented except the location in Golden.
"""

import argparse
import json
import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]

from common import idf  # noqa: E402
from shading_runs import output_folder  # noqa: E402
from shading_runs.errors import in_words  # noqa: E402

LATITUDE, LONGITUDE = 39.74, -105.18
EASTING, NORTHING = 484577.134, 4398915.899  # the same point in UTM zone 13, by GeoConvert -u

# The town: blocks in rows along true north, the office's in the middle. Metres.
COLUMNS, ROWS = 7, 5
STREET_X, STREET_Y = 45.0, 40.0
BLOCK = (28.0, 24.0)
COURT = (12.0, 8.0)

# The hills: nodes per side and their distance in m.
NODES, STEP = 161, 100.0
GROUND = 1750.0

OFFICE = (16.0, 12.0, 10.0)
WINDOW = 0.8  # from the edges of a wall
SAIL = (-9.0, -17.0, 9.0, -7.0)  # x, y, x, y
SAIL_HEIGHT = 6.0

HEAD = """\
! An office in a small town at the foot of hills. Written by generate.py.
! Weather: USA_CO_Golden-NREL.724666_TMY3.epw, which comes with EnergyPlus.

""" + idf.preamble("Office", idf.GOLDEN, idf.GOLDEN_DAY) + "\n" + idf.WALLS_AND_GLAZING + """Zone,Office;

""" + idf.SOLAR_OUTPUTS

# The office stands on the terrain, and its own block is left out.
CONTEXT = """
GPUShading:SiteContext,
  Town,                    !- Name
  {town},            !- Buildings File Name
  ,                        !- Buildings Coordinates
  ,                        !- Height Property
  ,                        !- Levels Property
  3.2,                     !- Storey Height {{m}}
  ,                        !- Default Height {{m}}
  {hills},               !- Terrain File Name
  {zone},                 !- Terrain Coordinates
  ,                        !- Terrain Clear Distance {{m}}
  ,                        !- Origin Latitude {{deg}}
  ,                        !- Origin Longitude {{deg}}
  {elevation},                 !- Origin Elevation {{m}}
  ,                        !- Radius {{m}}
  ,                        !- Horizon Radius {{m}}
  Office;                  !- Left Out Name 1
"""
MESH = """
GPUShading:Geometry,Sail,sail.obj,m,Z;
GPUShading:TransparentShade,Fabric,Sail:Fabric:*,Constant,0.25;
"""


def degrees(x, y):
    """Longitude and latitude on WGS84 of a point x m east and y m north of the office."""
    s = math.sin(math.radians(LATITUDE))
    a, e2 = 6378137.0, 0.00669437999014
    meridian = a * (1 - e2) / (1 - e2 * s * s) ** 1.5
    vertical = a / math.sqrt(1 - e2 * s * s)
    return [round(LONGITUDE + math.degrees(x / (vertical * math.cos(math.radians(LATITUDE)))), 8),
            round(LATITUDE + math.degrees(y / meridian), 8)]


def rectangle(x, y, size):
    w, d = size[0] / 2, size[1] / 2
    ring = [degrees(x + u * w, y + v * d) for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return ring + ring[:1]


def town():
    """The blocks as GeoJSON: some have a height, some levels, every third a courtyard."""
    features = []
    for column in range(COLUMNS):
        for row in range(ROWS):
            x, y = (column - COLUMNS // 2) * STREET_X, (row - ROWS // 2) * STREET_Y
            number = column * ROWS + row
            own = x == y == 0
            levels = 2 + (5 * column + 3 * row) % 6
            properties = {"height": f"{3.2 * levels + 1.5:.1f} m"} if number % 2 else {"building:levels": levels}
            rings = [rectangle(x, y, OFFICE if own else BLOCK)]
            if number % 3 == 0 and not own:
                rings.append(rectangle(x, y, COURT)[::-1])
            features.append({"type": "Feature", "id": "Office" if own else f"Block {number + 1}",
                             "properties": properties, "geometry": {"type": "Polygon", "coordinates": rings}})
    return json.dumps({"type": "FeatureCollection", "features": features}, indent=1) + "\n"


def smooth(value):
    value = min(1.0, max(0.0, value))
    return value * value * (3 - 2 * value)


def elevation(east, north):
    """Level at the town, hills of 600 m from 1.5 km to the west, and a mesa of 180 m to the east."""
    hills = 600 * smooth((-1500 - east) / 3000) * (1 + 0.15 * math.sin(north / 700) + 0.1 * math.sin(east / 300))
    mesa = 180 * smooth((1500 - math.hypot(east - 2800, north - 600)) / 400)
    return GROUND + hills + mesa


def hills():
    half = (NODES - 1) / 2 * STEP
    yield (f"ncols {NODES}\nnrows {NODES}\nxllcenter {EASTING - half:.3f}\nyllcenter {NORTHING - half:.3f}\n"
           f"cellsize {STEP:g}\nNODATA_value -9999\n")
    for row in range(NODES):
        yield " ".join(f"{elevation(column * STEP - half, half - row * STEP):.1f}" for column in range(NODES)) + "\n"


def sail(triangles):
    """A wavy sheet with about the given number of triangles."""
    side = max(1, math.isqrt(triangles // 2))
    west, south, east, north = SAIL
    yield "o Sail\nusemtl Fabric\n"
    for row in range(side + 1):
        for column in range(side + 1):
            x, y = west + (east - west) * column / side, south + (north - south) * row / side
            yield f"v {x:.5f} {y:.5f} {SAIL_HEIGHT + 0.8 * math.sin(x / 2) * math.cos(y / 3):.5f}\n"
    for row in range(side):
        for column in range(side):
            a = row * (side + 1) + column + 1
            b, c, d = a + 1, a + side + 2, a + side + 1
            yield f"f {a} {b} {c}\nf {a} {c} {d}\n"


def surface(name, kind, corners, boundary="Outdoors"):
    return idf.surface(name, kind, "Outer Wall", "Office", boundary, corners)


def office():
    w, d, h = OFFICE
    x, y, e = w / 2, d / 2, WINDOW
    sides = {"South": ((-x, -y), (x, -y)), "East": ((x, -y), (x, y)), "North": ((x, y), (-x, y)),
             "West": ((-x, y), (-x, -y))}  # fmt: skip
    for side, (a, b) in sides.items():
        length = math.dist(a, b)
        yield surface(side, "Wall", [(*a, h), (*a, 0), (*b, 0), (*b, h)])
        along = [(q - p) / length for p, q in zip(a, b, strict=True)]
        c, f = ([p + s * t for p, t in zip(a, along, strict=True)] for s in (e, length - e))
        yield idf.opening(f"{side} Window", "Window", "Window", side,
                          [(*c, h - e), (*c, e), (*f, e), (*f, h - e)])  # fmt: skip
    yield surface("Roof", "Roof", [(-x, y, h), (-x, -y, h), (x, -y, h), (x, y, h)])
    yield surface("Floor", "Floor", [(x, y, 0), (x, -y, 0), (-x, -y, 0), (-x, y, 0)], "Adiabatic")


def context(parts):
    if not {"town", "hills"} & set(parts):
        return ""
    text = CONTEXT.format(town="town.geojson" if "town" in parts else "", hills="hills.asc" if "hills" in parts else "",
                          zone="UTM 13N" if "hills" in parts else "",
                          elevation="Terrain" if "hills" in parts else "")
    return text if "town" in parts else text.replace("  3.2, ", "  ,    ")


def write(folder, parts=("town", "hills", "sail"), triangles=800):
    """Writes the model and the files beside it. Returns the model's path."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "town.geojson").write_text(town())
    with open(folder / "hills.asc", "w") as file:
        file.writelines(hills())
    with open(folder / "sail.obj", "w") as file:
        file.writelines(sail(triangles))
    path = folder / "office.idf"
    path.write_text(HEAD + "".join(office()) + context(parts) + (MESH if "sail" in parts else ""))
    return path


def main():
    parser = argparse.ArgumentParser(description="Writes an office in a town at the foot of hills.")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/site_context"), metavar="DIR",
                        help="folder for the model and its files (default: out/site_context)")
    parser.add_argument("--without", default="", metavar="PARTS", help="leave out some of town,hills,sail")
    parser.add_argument("--triangles", type=int, default=800, metavar="N", help="number of triangles of the sail")
    arguments = parser.parse_args()
    parts = {"town", "hills", "sail"} - set(arguments.without.split(","))
    try:
        with output_folder.replacing(arguments.output, "site_context") as output:
            path = write(output.path, parts, arguments.triangles)
    except (OSError, output_folder.NotOurs) as error:
        sys.exit(f"site_context: {in_words(error)}")
    print(output.said(path))


if __name__ == "__main__":
    main()

"""A model in Radiance: direct irradiance of each receiver, from rtrace at random points on it.

Radiance has the same polygons as EnergyPlus. A perforated strip is a mixture of nothing and a black sheet by a function
of place and direction: a ray passes if it enters and leaves the sheet's thickness in the same hole.
"""

import csv
import math
import os
import re
import subprocess
from array import array
from random import Random

from shading_runs import energyplus

FOLDER = energyplus.REPOSITORY / ".venv" / "radiance" / "pyradiance"
HEIGHT_ABOVE = 1e-4  # of points above their surface, m
SUN_DIAMETER = 0.001  # degrees; EnergyPlus's sun is a point

HOLES = """\
{ A ray through a sheet with round holes, staggered by 60 degrees; x and y in its plane, one hole at (0, 0).
  A1: pitch, A2: diameter, A3: thickness. 1 if it passes. }
near(x,w) : w*floor(x/w+.5);
row = A1*sqrt(3);
u1 = Px-A3/2*Dx/Dz;  v1 = Py-A3/2*Dy/Dz;
u2 = Px+A3/2*Dx/Dz;  v2 = Py+A3/2*Dy/Dz;
in(u,v,cu,cv) : if(A2*A2/4-(u-cu)*(u-cu)-(v-cv)*(v-cv), 1, 0);
both(cu,cv) : in(u1,v1,cu,cv)*in(u2,v2,cu,cv);
passes = both(near(u1,A1),near(v1,row)) + both(near(u1-A1/2,A1)+A1/2,near(v1-row/2,row)+row/2);
"""
DESIGN_DAY = """
SizingPeriod:DesignDay,Day {month}-{day},{month},{day},SummerDesignDay,20,10,DefaultMultipliers,,WetBulb,
  10,,,,,98000,2,180,No,No,No,ASHRAEClearSky,,,,,1.0;
"""


def with_days(model, days):
    """A model's text with clear days, (month, day), instead of its own."""
    model = re.sub(r"SizingPeriod:DesignDay,.*?;\n", "", model, flags=re.S)
    return model + "".join(DESIGN_DAY.format(month=month, day=day) for month, day in days)


def surfaces(gpu_shading, path):
    """{name: (vertices, receives, casts)} as gpu_shading check tells them."""
    def printed(*words):
        return subprocess.run([gpu_shading, "check", *words, path], capture_output=True, text=True, check=True).stdout

    vertices = {}
    for row in csv.DictReader(printed("--vertices").splitlines()):
        vertices.setdefault(row["surface"], []).append(tuple(float(row[f"{axis} [m]"]) for axis in "xyz"))
    roles = {}
    for line in printed().splitlines():
        # Columns are two or more blanks apart.
        words = re.split(r"\s{2,}", line.strip())
        if len(words) == 5 and words[0] in vertices:
            roles[words[0]] = (words[3] == "yes", words[4])
    return {name: (points, *roles[name]) for name, points in vertices.items() if name in roles}


def is_sky_patch(azimuth, altitude):
    return azimuth % 15.0 == 0.0 and altitude % 15.0 == 7.5


def fractions(report):
    """{(azimuth, altitude) in degrees: {receiver: sunlit fraction}} of a report's table, without patches of the sky."""
    found = {}
    with open(report / "sunlit.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            sun = (float(row["sun azimuth [deg]"]), float(row["sun altitude [deg]"]))
            if not is_sky_patch(*sun):
                found.setdefault(sun, {})[row["receiver"].upper()] = float(row["sunlit fraction"])
    return found


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b, strict=True))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def normal_of(points):
    (ax, ay, az), (bx, by, bz) = minus(points[1], points[0]), minus(points[2], points[0])
    across = (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)
    return tuple(x / math.hypot(*across) for x in across)


def towards(sun):
    azimuth, altitude = map(math.radians, sun)
    return (math.sin(azimuth) * math.cos(altitude), math.cos(azimuth) * math.cos(altitude), math.sin(altitude))


def polygon(modifier, name, points):
    flat = " ".join(f"{value:.9g}" for point in points for value in point)
    return f"{modifier} polygon {name}\n0\n0\n{3 * len(points)} {flat}\n"


def scene(casters, screen):
    """Radiance's text; casters: [(vertices, is perforated)]. screen: pitch, diameter and thickness."""
    parts = ["void plastic black\n0\n0\n5 0 0 0 0 0\n"]
    for number, (points, is_perforated) in enumerate(casters):
        material = "black"
        if is_perforated:
            # u along the lower edge, v upwards, outside as seen with u to the right.
            (x, y, z), right = points[1], points[2]
            turn = math.degrees(math.atan2(right[1] - y, right[0] - x))
            words = f"void black passes holes.cal -rx 90 -rz {turn:.12g} -t {x:.12g} {y:.12g} {z:.12g}"
            material = f"sheet_{number}"
            parts.append(f"void mixfunc {material}\n{len(words.split())} {words}\n0\n"
                         f"3 {screen[0]:.12g} {screen[1]:.12g} {screen[2]:.12g}\n")
        parts.append(polygon(material, f"caster_{number}", points))
    return "".join(parts)


def sample_points(rectangle, openings, count, random):
    """Points on a rectangle outside of its openings, one at random in each of about `count` cells."""
    origin, u, v = rectangle[1], minus(rectangle[2], rectangle[1]), minus(rectangle[0], rectangle[1])
    normal = normal_of(rectangle)
    columns = max(1, round(math.sqrt(count * math.hypot(*u) / math.hypot(*v))))
    rows = max(1, round(count / columns))
    holes = []
    for opening in openings:
        along = [dot(minus(point, origin), u) / dot(u, u) for point in opening]
        up = [dot(minus(point, origin), v) / dot(v, v) for point in opening]
        holes.append((min(along), max(along), min(up), max(up)))
    for column in range(columns):
        for row in range(rows):
            s, t = (column + random.random()) / columns, (row + random.random()) / rows
            if any(a < s < b and c < t < d for a, b, c, d in holes):
                continue
            yield tuple(o + s * a + t * b + HEIGHT_ABOVE * n
                        for o, a, b, n in zip(origin, u, v, normal, strict=True)), normal


def is_on(opening, wall):
    """Whether an opening lies in a wall's plane and within it."""
    normal = normal_of(wall)
    if dot(normal, normal_of(opening)) < 0.999 or abs(dot(minus(opening[0], wall[0]), normal)) > 1e-6:
        return False
    return all(min(p[i] for p in wall) - 1e-6 <= x <= max(p[i] for p in wall) + 1e-6
               for point in opening for i, x in enumerate(point))


def is_missing():
    return not (FOLDER / "bin" / "rtrace").is_file()


def _call(program, words, folder, **options):
    environment = {**os.environ, "RAYPATH": f"{folder}:{FOLDER / 'lib'}"}
    return subprocess.run([FOLDER / "bin" / program, *words], cwd=folder, env=environment, check=True,
                          stdout=subprocess.PIPE, **options).stdout


def trace(folder, scene, rays, *options):
    """What rtrace says, a line for each of some lines with a place and a direction; `scene`: a file in the folder."""
    (folder / "scene.oct").write_bytes(_call("oconv", [scene], folder))
    return _call("rtrace", ["-h", *options, "scene.oct"], folder, input=rays.encode()).decode()


class Building:
    """Receivers with points on them, and what shades them."""

    def __init__(self, everything, screen, folder, points, seed=1):
        self.folder, self.openings = folder, {}
        casters = [(vertices, casts.startswith("perforated")) for vertices, _, casts in everything.values()
                   if casts != "not"]  # fmt: skip
        (folder / "holes.cal").write_text(HOLES)
        (folder / "casters.rad").write_text(scene(casters, screen))
        (folder / "casters.oct").write_bytes(_call("oconv", ["casters.rad"], folder))
        receivers = {name: vertices for name, (vertices, receives, casts) in everything.items()
                     if receives and len(vertices) == 4}
        random = Random(seed)
        self.points, self.normals = {}, {}
        for name, vertices in receivers.items():
            openings = [each for other, each in receivers.items() if other != name and is_on(each, vertices)]
            self.points[name] = list(sample_points(vertices, openings, points, random))
            self.normals[name] = normal_of(vertices)

    def irradiance(self, sun):
        """{receiver that faces the sun: its direct irradiance by that normal to the beam}."""
        direction = towards(sun)
        facing = [name for name, normal in self.normals.items() if dot(normal, direction) > 0.02]
        (self.folder / "sun.rad").write_text(
            "void light sun\n0\n0\n3 1e9 1e9 1e9\n"
            f"sun source disc\n0\n0\n4 {' '.join(f'{x:.12g}' for x in direction)} {SUN_DIAMETER}\n")
        (self.folder / "sun.oct").write_bytes(_call("oconv", ["-i", "casters.oct", "sun.rad"], self.folder))
        rays = array("f", (value for name in facing for pair in self.points[name] for part in pair for value in part))
        # Outside of everything, normal to the beam.
        rays.extend((0.0, 0.0, 5000.0, *direction))
        words = ["-h", "-I", "-fff", "-ab", "0", "-dt", "0", "-dj", "0", "-dc", "1", "-ds", "0", "-st", "0", "sun.oct"]
        answers = array("f")
        answers.frombytes(_call("rtrace", words, self.folder, input=rays.tobytes()))
        values = answers[::3]
        found, begin = {}, 0
        for name in facing:
            count = len(self.points[name])
            found[name] = sum(values[begin:begin + count]) / count / values[-1]
            begin += count
        return found


def differences(building, sun, fractions_of):
    """{receiver: sunlit fraction times cosine minus Radiance's direct irradiance by that normal to the beam}."""
    found = {}
    for name, irradiance in building.irradiance(sun).items():
        if name in fractions_of:
            found[name] = fractions_of[name] * dot(building.normals[name], towards(sun)) - irradiance
    return found


def spread(suns, count):
    """So many of the sun positions at which the sun is 5 degrees high or more."""
    high = [sun for sun in suns if sun[1] > 5.0]
    return [high[round((number + 0.5) * len(high) / count - 0.5)] for number in range(count)]

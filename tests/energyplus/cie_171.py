"""Sky components through openings and past obstructions, of the kind of CIE 171:2006's test cases 5.9 to 5.14.

A black room of 4 x 4 x 3 m: an opening in its roof (5.9), or in its south wall (5.11), without obstruction, below a
level mask along the wall (5.13), and before an upright mask parallel to the wall (5.14), both masks without end; with
glass in 5.10 and 5.12. The report was not at hand: all sizes and the points on the floor are ours. The sky is uniform,
or CIE's overcast sky with (1 + 2 sine of the altitude) / 3 of the zenith's luminance. A sky component is a point's
illuminance by the sky that it sees, divided by that of level ground under the whole sky.

Closed forms: the illuminance of a level element is the integral over the solid angle of sine (uniform) and of
(sine + 2 sine^2) / 3 (overcast). Of a rectangle, both integrals are elementary; a mask without end moves the upper or
lower edge of the rectangle. What the opening itself receives from outside is a mean over the sky's profile angles.
"""

import csv
import math
import subprocess
from dataclasses import dataclass

import numpy as np
from shading_runs import energyplus
from shading_runs.version import input_version
from test_daylighting import PANE, pane_transmittance

ROOM, HEIGHT = 4.0, 3.0
FAR = 2e3  # half the length of a mask without end
SKIES = ("uniform", "overcast")
PATCHES = ("EnergyPlus 144", "Tregenza 145", "Reinhart 577")
GROUND = {"uniform": math.pi, "overcast": math.pi * 7 / 9}  # illuminance of level ground
LEDGE = 1.0  # depth of the level mask, which is at the opening's head
FACADE, FACADE_TOP = 6.0, 3.0  # distance of the upright mask and its height above the floor
NO_PANE = (0.9999, 0.00005)  # the nearest to none that EnergyPlus takes


@dataclass(frozen=True)
class Case:
    """roof: side of a square opening in the middle of the roof. wall: x1, x2, z1, z2 of one in the south wall, x from
    the room's middle. Points of the floor: x from the middle, distance from the south wall."""

    title: str
    points: tuple
    roof: float = 0.0
    wall: tuple = ()
    mask: str = ""


OF_ROOF = ((0.0, 2.0), (1.0, 2.0), (1.5, 3.5))
OF_WALL = ((0.0, 0.5), (0.0, 1.0), (0.0, 2.0), (0.0, 3.5), (1.5, 2.0))
# The roof and the wall keep a rim, without which EnergyPlus takes no window.
SMALL, WHOLE = (-1.0, 1.0, 1.0, 2.0), (-1.99, 1.99, 0.01, 2.99)
CASES = (
    Case("5.9, roof, 1 x 1 m", OF_ROOF, roof=1.0),
    Case("5.9, roof, 3.9 x 3.9 m", OF_ROOF, roof=3.9),
    Case("5.11, wall, 2 x 1 m", OF_WALL, wall=SMALL),
    Case("5.11, wall, 3.98 x 2.98 m", OF_WALL, wall=WHOLE),
    Case("5.13, level mask, 2 x 1 m", OF_WALL[2:], wall=SMALL, mask="level"),
    Case("5.13, level mask, 3.98 x 2.98 m", OF_WALL, wall=WHOLE, mask="level"),
    Case("5.14, upright mask, 2 x 1 m", OF_WALL, wall=SMALL, mask="upright"),
    Case("5.14, upright mask, 3.98 x 2.98 m", OF_WALL, wall=WHOLE, mask="upright"),
)


def combined(sky, sine, sine_squared):
    """A sky component of a level element, from its two integrals."""
    total = sine if sky == "uniform" else (sine + 2.0 * sine_squared) / 3.0
    return total / GROUND[sky]


def overhead(x, y, h):
    """Integrals of sine and sine^2 over a level rectangle of x by y at a height h, one corner above the element."""
    r = math.sqrt(x * x + y * y + h * h)
    a, b = math.hypot(x, h), math.hypot(y, h)
    sine = 0.5 * (x / a * math.atan(y / a) + y / b * math.atan(x / b))
    return sine, (math.atan(x * y / (h * r)) + h * x * y * (r * r + h * h) / (r * a * a * b * b)) / 3.0


def ahead(w, h, d):
    """The same over an upright rectangle w wide and h high at a distance d, its lower corner level with the element."""
    r, s = math.sqrt(w * w + h * h + d * d), math.hypot(d, h)
    sine = 0.5 * (math.atan(w / d) - d / s * math.atan(w / s))
    return sine, (math.atan(w * h / (d * r)) - d * h * w / (s * s * r)) / 3.0


def of_rectangle(corner, x1, x2, y1, y2):
    """By the corners: each term is odd in both lengths."""
    def signed(x, y):
        return np.copysign(1.0, x) * np.copysign(1.0, y) * np.array(corner(abs(x), abs(y)))

    return signed(x2, y2) - signed(x1, y2) - signed(x2, y1) + signed(x1, y1)


def exact(case, point, sky):
    """The sky component of a point in closed form, without glass."""
    x, y = point
    if case.roof:
        half, middle = case.roof / 2, y - ROOM / 2
        integrals = of_rectangle(lambda a, b: overhead(a, b, HEIGHT), -half - x, half - x, -half - middle,
                                 half - middle)
    else:
        x1, x2, z1, z2 = case.wall
        if case.mask == "level":
            z2 = max(z1, z2 * y / (y + LEDGE))
        if case.mask == "upright":
            z1 = max(z1, FACADE_TOP * y / (y + FACADE))
        integrals = of_rectangle(lambda a, b: ahead(a, b, y), x1 - x, x2 - x, z1, z2)
    return combined(sky, *integrals)


def on_wall(case, sky):
    """What an opening in the wall receives of the sky from outside, as a sky component, in closed form."""
    z1, z2 = case.wall[2:]
    sine, sine_squared = 1.0, 1.0
    if case.mask:
        # Means of the sine of the profile angle of the mask's edge, and of its square.
        edge, distance = (z2, LEDGE) if case.mask == "level" else (FACADE_TOP, FACADE)
        low, high = edge - z2, edge - z1
        sine = (math.hypot(high, distance) - math.hypot(low, distance)) / (high - low)
        sine_squared = 1.0 - distance * (math.atan(high / distance) - math.atan(low / distance)) / (high - low)
        if case.mask == "upright":
            sine, sine_squared = 1.0 - sine, 1.0 - sine_squared
    return combined(sky, math.pi / 2 * sine, 2.0 / 3.0 * sine_squared)


def on_wall_by_patches(folder, patches, sky):
    """The same of sky.csv and sky_view.csv that gpu_shading sample --sky wrote."""
    def rows(name):
        with open(folder / name, newline="", encoding="utf-8") as file:
            return [row for row in csv.DictReader(file) if (row["sky"], row["receiver"]) == (patches, "OPENING")]

    if sky == "uniform":
        return float(rows("sky_view.csv")[0]["shaded view factor"])
    total = 0.0
    for row in rows("sky.csv"):
        light = float(row["solid_angle"]) * float(row["cosine"]) * float(row["sunlit_fraction"])
        total += light * (1.0 + 2.0 * math.sin(math.radians(float(row["altitude"])))) / 3.0
    return total / GROUND[sky]


def over_parts(case, point, sky, columns, rows, glass=False):
    """The sky component as a sum over parts of the opening, each with one ray through its middle."""
    x1, x2, z1, z2 = case.wall or (-case.roof / 2, case.roof / 2, -case.roof / 2, case.roof / 2)
    along, up = np.meshgrid(x1 + (x2 - x1) * (np.arange(columns) + 0.5) / columns,
                            z1 + (z2 - z1) * (np.arange(rows) + 0.5) / rows)
    x, y = point
    if case.wall:
        ray = np.stack([along - x, np.full_like(along, -y), up], axis=-1)
    else:
        ray = np.stack([along - x, up - (y - ROOM / 2), np.full_like(along, HEIGHT)], axis=-1)
    distance = np.linalg.norm(ray, axis=-1)
    cosine, sine = (y if case.wall else HEIGHT) / distance, ray[..., 2] / distance
    seen = np.ones_like(sine)
    if case.mask == "level":
        seen = np.where(up / y < z2 / (y + LEDGE), 1.0, 0.0)
    if case.mask == "upright":
        seen = np.where(up / y > FACADE_TOP / (y + FACADE), 1.0, 0.0)
    light = seen * cosine / distance**2 * (x2 - x1) * (z2 - z1) / (columns * rows)
    if glass:
        light = light * pane_transmittance(cosine)
    return combined(sky, (light * sine).sum(), (light * sine**2).sum())


def energyplus_parts(case, point):
    """Columns and rows in which EnergyPlus divides a window, by its distance from the point (DaylightingManager)."""
    x1, x2, z1, z2 = case.wall or (0.0, case.roof, 0.0, case.roof)
    distance = point[1] if case.wall else HEIGHT
    return [min(40, int(4 * length / distance) + 1) for length in (x2 - x1, z2 - z1)]


def rectangle(x1, y1, z1, x2, y2, z2):
    """Corners of a level rectangle, or of an upright one whose plane is x or y."""
    if z1 == z2:
        return [(x1, y1, z1), (x2, y1, z1), (x2, y2, z1), (x1, y2, z1)]
    return [(x1, y1, z2), (x1, y1, z1), (x2, y2, z1), (x2, y2, z2)]


def upright_opening(opening):
    x1, x2, z1, z2 = opening
    return rectangle(x1, 0.0, z1, x2, 0.0, z2)


def roof_opening(side):
    return rectangle(-side / 2, ROOM / 2 - side / 2, HEIGHT, side / 2, ROOM / 2 + side / 2, HEIGHT)


def opening_of(case):
    return roof_opening(case.roof) if case.roof else upright_opening(case.wall)


def mask_of(case):
    if case.mask == "level":
        return rectangle(-FAR, -LEDGE, case.wall[3], FAR, 0.0, case.wall[3])
    return rectangle(-FAR, -FACADE, 0.0, FAR, -FACADE, FACADE_TOP)


def scene_of(gpu_shading, case, glass):
    """The room as casters of gpu_shading.Scene, with clear glass in its opening or none."""
    half, opening = ROOM / 2, opening_of(case)
    scene = gpu_shading.Scene()
    scene.add(rectangle(-half, 0.0, HEIGHT, half, ROOM, HEIGHT), holes=[opening] if case.roof else [])
    scene.add(rectangle(-half, 0.0, 0.0, half, 0.0, HEIGHT), holes=[opening] if case.wall else [])
    scene.add(rectangle(half, 0.0, 0.0, half, ROOM, HEIGHT))
    scene.add(rectangle(half, ROOM, 0.0, -half, ROOM, HEIGHT))
    scene.add(rectangle(-half, ROOM, 0.0, -half, 0.0, HEIGHT))
    if glass:
        scene.add(opening, transmittance=gpu_shading.Transmittance.glazing([[*PANE, PANE[1]]]))
    if case.mask:
        scene.add(mask_of(case))
    return scene


def hemisphere(count):
    """Directions spread evenly over the sky, along a Fibonacci spiral."""
    number = np.arange(count) + 0.5
    sine, azimuth = number / count, math.pi * (1 + math.sqrt(5)) * number
    cosine = np.sqrt(1 - sine**2)
    return np.stack([cosine * np.sin(azimuth), cosine * np.cos(azimuth), sine], axis=-1)


def by_rays(scene, point, count=200_000):
    """{sky: sky component of a point}, over rays of the library to the sky."""
    directions = hemisphere(count)
    passed = scene.rays().transmittance(np.broadcast_to((*point, 0.0), directions.shape), directions)
    sine = directions[:, 2]
    integrals = [(passed * power).sum() * 2 * math.pi / count for power in (sine, sine**2)]
    return {sky: combined(sky, *integrals) for sky in SKIES}


MODEL = f"Version,{input_version()};\n" + """\
Timestep,1;
Building,Room,0,Country,0.04,0.4,FullExterior,,1;
SimulationControl,No,No,No,Yes,No;
ShadowCalculation,PolygonClipping,Periodic,20;
Site:Location,Lyon,45.7,5.0,1,200;
SizingPeriod:DesignDay,Equinox,3,21,SummerDesignDay,20,10,DefaultMultipliers,,WetBulb,10,,,,,98000,2,180,No,No,No,
  ASHRAEClearSky,,,,,1.0;
GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World,World;
Material,Black,Rough,0.1,0.5,1400,1000,0.9,1,1;
Construction,Black,Black;
WindowMaterial:Glazing,Pane,SpectralAverage,,0.003,{pane},0,0.84,0.84,0.9;
Construction,Glass,Pane;
Zone,Room;
Output:DaylightFactors,SizingDays;
Output:SQLite,Simple;
Output:Variable,Opening,Debug Surface Solar Shading Model DifShdgRatioIsoSky,Daily;
Schedule:Constant,On,,1;
Lights,Lamps,Room,On,LightingLevel,100,,,,,,1;
"""


def text_of(kind, name, fields, corners):
    values = ",".join(f"{value:g}" for corner in corners for value in corner)
    return f"{kind}:Detailed,{name},{fields},{len(corners)},{values};\n"


def model_of(case, pane=NO_PANE):
    """The room as EnergyPlus's input, with a pane (transmittance, reflectance) in its opening."""
    half = ROOM / 2
    surfaces = {
        "South": ("Wall", rectangle(-half, 0.0, 0.0, half, 0.0, HEIGHT)),
        "East": ("Wall", rectangle(half, 0.0, 0.0, half, ROOM, HEIGHT)),
        "North": ("Wall", rectangle(half, ROOM, 0.0, -half, ROOM, HEIGHT)),
        "West": ("Wall", rectangle(-half, ROOM, 0.0, -half, 0.0, HEIGHT)),
        "Top": ("Roof", rectangle(-half, 0.0, HEIGHT, half, ROOM, HEIGHT)),
        "Floor": ("Floor", rectangle(-half, 0.0, 0.0, half, ROOM, 0.0)[::-1]),
    }
    t, r = pane
    parts = [MODEL.format(pane=f"{t},{r},{r},{t},{r},{r}")]
    for name, (kind, corners) in surfaces.items():
        parts.append(text_of("BuildingSurface", name, f"{kind},Black,Room,,Outdoors,,SunExposed,WindExposed,", corners))
    parts.append(text_of("FenestrationSurface", "Opening", f"Window,Glass,{'Top' if case.roof else 'South'},,,,",
                         opening_of(case)))  # fmt: skip
    if case.mask:
        parts.append(text_of("Shading:Building", "Mask", "", mask_of(case)))
    share = 1.0 / len(case.points)
    listed = "".join(f",Point {i},{share:.6f},500" for i in range(len(case.points)))
    parts.append(f"Daylighting:Controls,Light,Room,SplitFlux,,Continuous,0.3,0.2,,,,,,{listed};\n")
    parts += [f"Daylighting:ReferencePoint,Point {i},Room,{x},{y},0;\n" for i, (x, y) in enumerate(case.points)]
    return "".join(parts)


def daylight(case, program, weather, folder, options=(), pane=NO_PANE):
    """The run of the design day."""
    folder.mkdir()
    (folder / "room.idf").write_text(model_of(case, pane))
    done = energyplus.run(program, folder / "room.idf", weather, folder / "out", ["-D", *options])
    if not done.completed:
        raise RuntimeError(f"{case.title}: {done.why()}")
    return done


def sample_sky(program, case, folder):
    """The folder with the tables of gpu_shading sample --sky, which stands beside EnergyPlus's program."""
    folder.mkdir(exist_ok=True)
    (folder / "room.idf").write_text(model_of(case))
    command = [program.parent / "gpu_shading", "sample", "--sky", folder / "room.idf", "-o", folder / "sky"]
    subprocess.run(command, check=True, capture_output=True)
    return folder / "sky"


def daylight_factors(done):
    """Of each point under the overcast sky, at noon of the design day."""
    rows = [line.split(",") for line in done.text("eplusout.dfs").splitlines()]
    return [float(row[5]) for row in rows if len(row) == 6 and row[0].strip() == "12"]

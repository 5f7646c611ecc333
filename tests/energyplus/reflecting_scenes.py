"""Scenes before a box with a south window, for reflected light by this module and by Radiance."""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

import radiance
import radiance_reflections
import test_site
from output_files import values_of
from shading_runs import energyplus

BY_GROUND = "GPU Shading Solar Radiation Reflected by Ground Rate per Area"
BY_SHADES = "GPU Shading Solar Radiation Reflected by Shades Rate per Area"
INCIDENT = "Surface Outside Face Incident {}Solar Radiation Rate per Area"
PARTS = ("Beam ", "Sky Diffuse ", "Ground Diffuse ")
OUTPUTS = "".join(f"Output:Variable,*,{name},Timestep;\n" for name in (
    BY_GROUND, BY_SHADES, INCIDENT.format(""), *(INCIDENT.format(part) for part in PARTS),
    "Site Solar Azimuth Angle", "Site Solar Altitude Angle")) + "Output:SQLite,Simple;\n"
# A day whose beam and diffuse irradiance are given, W/m2.
DAY = """
Schedule:Day:Hourly,Beam of {name},,{beam};
Schedule:Day:Hourly,Sky of {name},,{sky};
SizingPeriod:DesignDay,{name},{month},21,SummerDesignDay,20,0,DefaultMultipliers,,WetBulb,
  10,,,,,98000,2,180,No,No,No,Schedule,Beam of {name},Sky of {name},,,;
"""

WINDOW = "SOUTH WINDOW"
GLASS = 0.30517  # of it, in EnergyPlus's .eio file
BOX = ("SOUTH", "EAST", "NORTH", "WEST", "ROOF", "FLOOR")
WALLS = 0.3  # of the box: EnergyPlus's default absorptance is 0.7


def day(month, beam, sky):
    return DAY.format(name=f"Day {month} {beam} {sky}", month=month, beam=",".join([str(beam)] * 24),
                      sky=",".join([str(sky)] * 24))


def with_days(model, months, beam, sky):
    """A model's text with days of constant irradiance instead of its own, and the outputs above."""
    model = re.sub(r"SizingPeriod:DesignDay,.*?;[^\n]*\n|Output:Variable,[^;]*;[^\n]*\n", "", model, flags=re.S)
    model = re.sub(r"Timestep,\d+;", "Timestep,1;", model)
    return model + OUTPUTS + "".join(day(month, beam, sky) for month in months)


def bare(box):
    """The box without its louvre."""
    return re.sub(r"Shading:Building:Detailed,[^;]*;[^\n]*\n", "", box)


def shade(name, corners, reflectance):
    return (test_site.shade(name, corners)
            + f"ShadingProperty:Reflectance,{name},{reflectance},{reflectance},0;\n")


def louvres(reflectance):
    """21 blades before the window, a little tilted."""
    text = ""
    for i in range(21):
        z = 0.8 + 0.1 * i
        text += shade(f"Blade {i}", [(1.2, -0.06, z), (1.2, -0.16, z - 0.04), (4.8, -0.16, z - 0.04), (4.8, -0.06, z)],
                      reflectance)
    return text


def egg_crate(reflectance):
    text = ""
    for i in range(11):
        z = 0.8 + 0.2 * i
        text += shade(f"Shelf {i}", [(1.5, -0.01, z), (1.5, -0.21, z), (4.5, -0.21, z), (4.5, -0.01, z)], reflectance)
    for i in range(16):
        x = 1.5 + 0.2 * i
        text += shade(f"Fin {i}", [(x, -0.01, 2.8), (x, -0.01, 0.8), (x, -0.21, 0.8), (x, -0.21, 2.8)], reflectance)
    return text


def street(reflectance):
    """A house across the street, and one beside it."""
    return (shade("Opposite", [(20, -8, 9), (20, -8, 0), (-14, -8, 0), (-14, -8, 9)], reflectance)
            + shade("Beside", [(-4, 0, 6), (-4, -5, 6), (-4, -5, 0), (-4, 0, 0)], reflectance))


def awning(reflectance):
    """Below the window, so that it reflects the sun to it."""
    return shade("Awning", [(0, 0, 0.7), (0, -1.5, 0.6), (6, -1.5, 0.6), (6, 0, 0.7)], reflectance)


def thin_sheet(reflectance):
    """Before the window, half open."""
    return (shade("Sheet", [(0, -0.3, 3), (0, -0.3, 0.5), (6, -0.3, 0.5), (6, -0.3, 3)], reflectance)
            + "GPUShading:PerforatedScreen,Holes,Sheet,Round,,Staggered60,0.005,,0.0067339,,1e-5;\n")


def slotted_sheet(reflectance):
    """Close to the window, half open."""
    return (shade("Sheet", [(0, -0.1, 3), (0, -0.1, 0.5), (6, -0.1, 0.5), (6, -0.1, 3)], reflectance)
            + "GPUShading:PerforatedScreen,Holes,Sheet,Slotted,,Straight,0.01,0.06,0.07,0.0165297,1e-5;\n")


def glazed_street(reflectance):
    """Behind the box, a facade all of glass faces south."""
    return (test_site.shade("Facade", [(-14, 12, 9), (-14, 12, 0), (20, 12, 0), (20, 12, 9)])
            + "ShadingProperty:Reflectance,Facade,0,0,1,Coated Glass;\nConstruction,Coated Glass,Coated Pane;\n"
            + f"WindowMaterial:Glazing,Coated Pane,SpectralAverage,,0.006,0.1,{reflectance},{reflectance},"
            + "0.1,0.2,0.2,0,0.84,0.84,1;\n")


def courtyard(reflectance):
    """Walls 9 m high all around a court of 12 x 9 m, one of them above the window."""
    return (shade("Far", [(9, -9, 9), (9, -9, 0), (-3, -9, 0), (-3, -9, 9)], reflectance)
            + shade("Left", [(-3, -9, 9), (-3, -9, 0), (-3, 0, 0), (-3, 0, 9)], reflectance)
            + shade("Right", [(9, 0, 9), (9, 0, 0), (9, -9, 0), (9, -9, 9)], reflectance)
            + shade("Above", [(-3, 0, 9), (-3, 0, 3.01), (9, 0, 3.01), (9, 0, 9)], reflectance)
            + shade("Beside left", [(-3, 0, 3), (-3, 0, 0), (0, 0, 0), (0, 0, 3)], reflectance)
            + shade("Beside right", [(6, 0, 3), (6, 0, 0), (9, 0, 0), (9, 0, 3)], reflectance))


CROWNS = ((0.5, -3.0), (5.5, -4.0), (3.0, -6.0))  # middles of crowns 4 m wide, 2 to 6 m high
DENSITY = 0.8  # of their leaves, m2/m3


def trees(reflectance):
    """The street with three trees."""
    return street(reflectance) + "".join(
        f"GPUShading:Tree,Lime {i},{x},{y},0,6,4,2,Ellipsoid,0,Evergreen,,{DENSITY},0;\n"
        for i, (x, y) in enumerate(CROWNS))


def crowns(_):
    """The same for Radiance: spheres that only attenuate, as leaves of random directions do."""
    return "".join(f"void mist crown_{i}\n0\n0\n7 {DENSITY / 2} {DENSITY / 2} {DENSITY / 2} 0 0 0 0\n"
                   f"crown_{i} sphere leaves_{i}\n0\n0\n4 {x} {y} 4 2\n" for i, (x, y) in enumerate(CROWNS))


def folds():
    """Triangles of a facade of folded plates across the street, 4 m from the window, facing it."""
    def point(column, row):
        return (-2.0 + column, -4.0 - (0.5 if (column + row) % 2 else 0.0), 1.0 * row)

    for column in range(10):
        for row in range(4):
            a, b, c, d = (point(column + i, row + k) for i, k in ((0, 0), (1, 0), (1, 1), (0, 1)))
            yield from ((a, c, b), (a, d, c))


def mesh_file():
    corners = "".join(f"v {x} {y} {z}\n" for triangle in folds() for x, y, z in triangle)
    return "o Folds\n" + corners + "".join(f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}\n" for i in range(len([*folds()])))


def mesh(reflectance):
    return f"GPUShading:Geometry,Facade,facade.obj,m,Z;\n{awning(reflectance)}"


def mesh_triangles(_):
    return radiance_reflections.plastic("folded", 0.2) + "".join(
        radiance.polygon("folded", f"fold_{i}", triangle) for i, triangle in enumerate(folds()))


TURN = 35  # degrees, of blades that move by steps of 10
HEIGHTS = [0.9 + 0.16 * i for i in range(12)]  # of the blades


def turned_blades(reflectance):
    """12 blades as wide as their distance, turned by so much."""
    c, s = 0.08 * math.cos(math.radians(TURN)), 0.08 * math.sin(math.radians(TURN))
    return "".join(
        shade(f"Blade {i}", [(1.2, -0.15 + c, z + s), (1.2, -0.15 - c, z - s), (4.8, -0.15 - c, z - s),
                             (4.8, -0.15 + c, z + s)], reflectance) for i, z in enumerate(HEIGHTS))


def moving_blades(reflectance):
    """The same, drawn level."""
    level = "".join(
        shade(f"Blade {i}", [(1.2, -0.07, z), (1.2, -0.23, z), (4.8, -0.23, z), (4.8, -0.07, z)], reflectance)
        for i, z in enumerate(HEIGHTS))
    return (level + f"Schedule:Constant,Turn,,{TURN};\n"
            + "GPUShading:MovingShade,Blades,Blade *,Rotate,CentreLine,,,,,,,0,90,10,0,Schedule,Turn;\n")


@dataclass(frozen=True)
class Scene:
    objects: Callable[[float], str]  # the model's, by the reflectance of shades
    receiver: str = WINDOW
    drawn: Callable[[float], str] | None = None  # where they stand, if the model draws them elsewhere
    added: Callable[[float], str] | None = None  # Radiance's text of what check does not list the corners of
    files: Callable[[], dict[str, str]] = dict  # beside the model


SCENES = {"louvres": Scene(louvres), "egg crate": Scene(egg_crate), "street": Scene(street), "awning": Scene(awning),
          "thin sheet": Scene(thin_sheet), "slotted sheet": Scene(slotted_sheet),
          "glazed street": Scene(glazed_street, "NORTH"),
          "courtyard": Scene(courtyard), "street with trees": Scene(trees, added=crowns),
          "mesh facade": Scene(mesh, added=mesh_triangles, files=lambda: {"facade.obj": mesh_file()}),
          "blades between steps": Scene(moving_blades, drawn=turned_blades)}


def reflectances(of_shades):
    """Of each surface by its name, as Radiance takes them."""
    def of(name):
        if name.upper() == WINDOW:
            return 0.0
        return WALLS if name.upper() in BOX else of_shades

    return of


def run_days(patched, weather, folder, text, *options):
    """The model's file, and its run by `all` on its design days."""
    model = folder / "model.idf"
    model.write_text(text)
    out = folder / f"out{len(list(folder.glob('out*')))}"
    run = energyplus.run(patched, model, weather, out,
                         ["-D", "--gpu-shading", "--gpu-shading-reflections=all", *options])
    assert run.completed, run.why()
    return model, run


def suns_of(run):
    """[(azimuth, altitude)] of each timestep."""
    azimuths, altitudes = (next(iter(values_of(run, f"Site Solar {angle} Angle").values()))
                           for angle in ("Azimuth", "Altitude"))
    return list(zip(azimuths, altitudes, strict=True))


def reflected_of(run, receiver=WINDOW):
    """W/m2 at each timestep."""
    return [sum(parts) for parts in zip(*(values_of(run, name)[receiver] for name in (BY_GROUND, BY_SHADES)),
                                        strict=True)]


class Comparison:
    """Light reflected to a scene's receiver, of a light of 1 W/m2, by this module and by Radiance."""

    def __init__(self, patched, weather, folder, box, name, reflectance, months):
        scene = SCENES[name]
        self.scene, self.reflectance, self.folder = scene, reflectance, folder
        for file, text in scene.files().items():
            (folder / file).write_text(text)
        text = with_days(bare(box) + scene.objects(reflectance), months, 1000, 0) + day(6, 0, 100)
        model, run = run_days(patched, weather, folder, text)
        suns = suns_of(run)

        def by_sun(values):
            return {sun: value / 1000.0 for sun, value in zip(suns[:-24], values[:-24], strict=True) if sun[1] > 5}

        light = reflected_of(run, scene.receiver)
        direct, sky_direct = (values_of(run, INCIDENT.format(part))[scene.receiver] for part in PARTS[:2])
        self.ours, self.our_sky = by_sun(light), light[-12] / 100.0
        self.direct, self.sky_direct = by_sun(direct), sky_direct[-12] / 100.0
        # The error of hours that the run states, %.
        self.stated = max(float(line.split(",")[4]) for line in run.text("eplusout.eio").splitlines()
                          if line.startswith("GPU Shading Reflected Light,") and f",{scene.receiver}," in line)
        if scene.drawn:
            model.write_text(bare(box) + scene.drawn(reflectance))
        self.surfaces = radiance.surfaces(patched.parent / "gpu_shading", model)
        self.normal = radiance.normal_of(self.surfaces[scene.receiver][0])

    def _by_radiance(self, light, points):
        return radiance_reflections.reflected(
            self.surfaces, self.scene.receiver, light, self.folder, reflectances(self.reflectance),
            {WINDOW: GLASS, "FACADE": self.reflectance}, points=points,
            added=self.scene.added(self.reflectance) if self.scene.added else "")

    def theirs(self, sun, points=400):
        return self._by_radiance(radiance_reflections.sun(radiance.towards(sun)), points)

    def their_sky(self, points=400):
        return self._by_radiance(radiance_reflections.SKY, points)

"""Light that surfaces and the ground reflect, by Radiance's rtrace: of every number of reflections."""

import math
import re
import subprocess
from random import Random

import radiance

GROUND_SIZE = 2000.0  # m from the middle: beyond, a receiver sees less than a thousandth of the ground
BOUNCES = 12
LIFT = radiance.HEIGHT_ABOVE / 2
OPEN = 0.5  # of a sheet, at any angle
RAYS = 96  # from each place at which light is reflected


def plastic(name, reflectance):
    return f"void plastic {name}\n0\n0\n5 {reflectance:.9g} {reflectance:.9g} {reflectance:.9g} 0 0\n"


def _mirror(name, at_normal):
    """Of a reflectance that rises with the angle of incidence as by Schlick."""
    return (f"void brightfunc by_angle_{name}\n2 schlick schlick.cal\n0\n1 {at_normal:.9g}\n"
            f"by_angle_{name} mirror {name}\n0\n0\n3 1 1 1\n")


def _scene(surfaces, reflectance_of, mirrors, ground, black, added):
    parts = [plastic("black", 0.0), plastic("ground", 0.0 if black else ground)]
    size = GROUND_SIZE
    parts.append(radiance.polygon("ground", "earth", [(-size, -size, 0.0), (size, -size, 0.0),
                                                      (size, size, 0.0), (-size, size, 0.0)]))
    for number, (name, (vertices, receives, casts)) in enumerate(surfaces.items()):
        if casts == "not":
            if not receives:
                continue
            # A window, which reflects nothing diffusely, before its wall.
            normal = radiance.normal_of(vertices)
            vertices = [tuple(x + LIFT * n for x, n in zip(point, normal, strict=True)) for point in vertices]
        material = f"of_{number}"
        if name in mirrors and not black:
            parts.append(_mirror(material, mirrors[name]))
        else:
            parts.append(plastic(material, 0.0 if black or casts == "not" else reflectance_of(name)))
        if casts.startswith("perforated"):
            solid, material = material, f"sheet_{number}"
            parts.append(f"void mixfunc {material}\n4 {solid} void solid solid.cal\n0\n1 {1 - OPEN:.9g}\n")
        parts.append(radiance.polygon(material, f"surface_{number}", vertices))
    if black:
        added = re.sub(r"(void plastic \S+\n0\n0\n5) \S+ \S+ \S+", r"\1 0 0 0", added)
    return "".join(parts) + added


def sun(direction):
    """A source of unit irradiance, normal to the beam."""
    half = math.radians(radiance.SUN_DIAMETER / 2)
    bright = 1.0 / (math.pi * math.sin(half) ** 2)
    place = " ".join(f"{x:.12g}" for x in direction)
    return (f"void light sun\n0\n0\n3 {bright:.12g} {bright:.12g} {bright:.12g}\n"
            f"sun source disc\n0\n0\n4 {place} {radiance.SUN_DIAMETER}\n")


# A uniform sky of unit irradiance on level ground.
SKY = (f"void glow sky\n0\n0\n4 {1 / math.pi} {1 / math.pi} {1 / math.pi} 0\n"
       "sky source dome\n0\n0\n4 0 0 1 180\n")


def perez_sky(sun, beam, diffuse):
    """The sky alone, by gendaylit. `sun`: azimuth and altitude, degrees; irradiance in W/m2."""
    words = ["-ang", sun[1], sun[0] - 180, "-W", beam, diffuse, "-O", 1, "-g", 0]
    told = subprocess.run([radiance.FOLDER / "bin" / "gendaylit", *map(str, words)], capture_output=True, text=True,
                          check=True).stdout
    return (told[told.index("void brightfunc skyfunc"):]
            + "\nskyfunc glow sky\n0\n0\n4 1 1 1 0\nsky source dome\n0\n0\n4 0 0 1 180\n")


def reflected(surfaces, receiver, light, folder, reflectance_of, mirrors=None, ground=0.2, points=400, seed=1,
              added=""):
    """Irradiance of a rectangle by way of reflections, for a light of 1 W/m2.

    surfaces: as radiance.surfaces() has them; the ground is at z = 0. mirrors: reflectances at normal incidence by
    name; the sun is seen in one mirror at most. added: more of the scene, as Radiance's text.
    """
    random = Random(seed)
    (folder / "solid.cal").write_text("solid = A1;\n")
    (folder / "schlick.cal").write_text("schlick = A1 + (1 - A1) * (1 - abs(Rdot))^5;\n")
    places = list(radiance.sample_points(surfaces[receiver][0], [], points, random))
    rays = "".join(" ".join(f"{value:.9g}" for part in pair for value in part) + "\n" for pair in places)
    means = []
    straight = 1 if " glow " in light else 0  # only light sources are found without a bounce
    for black, bounces in ((False, BOUNCES), (True, straight)):
        (folder / "scene.rad").write_text(_scene(surfaces, reflectance_of, mirrors or {}, ground, black, added) + light)
        words = f"-I -ab {bounces} -ad {RAYS} -as 0 -aa 0 -lw 1e-7 -lr -20 -ss 0 -st 0 -dt 0 -dj 0 -dc 1 -ds 0 -dr 1"
        answers = radiance.trace(folder, "scene.rad", rays, *words.split())
        means.append(sum(float(line.split()[0]) for line in answers.splitlines() if line) / len(places))
    return means[0] - means[1]

#!/usr/bin/env python3
"""Sun hours by gpu_shading map, Embree and Ladybug (Radiance): the hours of each cell, and the time of each program.

    sun_hours.py [--model FILE] [--weather FILE] [--spacing M] [--from MM-DD] [--to MM-DD] [--receivers PATTERN]

Embree and Ladybug send one ray from the middle of each cell to each position of the sun, gpu_shading map one from a
point that changes with time. Only models of opaque, convex surfaces, and only cells that are not cut. Embree is called
by embreex, and Ladybug's DirectSunStudy calls Radiance's rcontrib; what cannot be imported is left out
(pip install embreex ladybug-radiance pyradiance).
"""

import argparse
import math
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "energyplus"), str(ROOT / ".venv" / "tools")]

import numpy  # noqa: E402
import test_map  # noqa: E402
from shading_runs import energyplus  # noqa: E402


def cells_of(folder):
    """[(centre, u, v, hours)] of the whole cells of all receivers, u and v from edge to edge."""
    found = []
    for row in test_map.rows_of(folder / "maps.csv"):
        width, height = float(row["cell width [m]"]), float(row["cell height [m]"])
        azimuth = math.radians(float(row["azimuth [deg]"]))
        u = width * numpy.array([-math.cos(azimuth), math.sin(azimuth), 0.0])
        v = numpy.array([0.0, 0.0, height])
        for cell in test_map.rows_of(folder / f"{row['files']}.csv"):
            if float(cell["area [m2]"]) > 0.9999 * width * height:
                centre = numpy.array([float(cell[f"{axis} [m]"]) for axis in "xyz"])
                found.append((centre, u, v, float(cell["sunlit [h]"])))
    return found


def vectors(suns):
    return numpy.array([[math.sin(a) * math.cos(h), math.cos(a) * math.cos(h), math.sin(h)] for a, h, _ in suns])


def by_embree(outlines, cells, suns):
    import embreex.mesh_construction
    import embreex.rtcore_scene

    began = time.monotonic()
    corners = [[ring[0], ring[i], ring[i + 1]] for ring in outlines for i in range(1, len(ring) - 1)]
    scene = embreex.rtcore_scene.EmbreeScene()
    embreex.mesh_construction.TriangleMesh(scene, numpy.array(corners, dtype=numpy.float32))
    normals = numpy.array([numpy.cross(u, v) / numpy.linalg.norm(numpy.cross(u, v)) for _, u, v, _ in cells])
    origins = (numpy.array([cell[0] for cell in cells]) + 1e-3 * normals).astype(numpy.float32)
    hours = numpy.zeros(len(cells))
    for sun in vectors(suns):
        front = normals @ sun > 1e-5
        ways = numpy.tile(sun.astype(numpy.float32), (front.sum(), 1))
        hours[front] += (scene.run(numpy.ascontiguousarray(origins[front]), ways) < 0) / 4
    return hours, time.monotonic() - began


def by_ladybug(outlines, cells, suns):
    import pyradiance
    from ladybug_geometry.geometry3d import Face3D, Mesh3D, Point3D, Vector3D
    from ladybug_radiance.config import folders
    from ladybug_radiance.study.directsun import DirectSunStudy

    folders.radiance_path = str(Path(pyradiance.__file__).parent)
    import ladybug_radiance.intersection as intersection

    intersection.OCONV_EXE, intersection.RCONTRIB_EXE = (f"{folders.radbin_path}/{name}"
                                                         for name in ("oconv", "rcontrib"))
    began = time.monotonic()
    corners, faces = [], []
    for centre, u, v, _ in cells:
        faces.append(tuple(range(len(corners), len(corners) + 4)))
        corners += [Point3D(*(centre + a * u / 2 + b * v / 2)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    context = [Face3D([Point3D(*point) for point in ring]) for ring in outlines]
    # Vectors from the sun.
    study = DirectSunStudy([Vector3D(*-sun) for sun in vectors(suns)], Mesh3D(corners, faces), context, 4, 1e-3)
    study.compute()
    return numpy.array(study.direct_sun_hours), time.monotonic() - began


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--model", type=Path, default=ROOT / "idf_examples" / "courtyard" / "courtyard.idf")
    parser.add_argument("--weather", default="USA_CO_Golden-NREL.724666_TMY3.epw")
    parser.add_argument("--spacing", type=float, default=0.25)
    parser.add_argument("--from", dest="first", default="03-15")
    parser.add_argument("--to", dest="last", default="03-15")
    parser.add_argument("--receivers", default="* Court *")
    arguments = parser.parse_args()
    weather = energyplus.find_weather(arguments.weather)
    days = [tuple(map(int, day.split("-"))) for day in (arguments.first, arguments.last)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        model = test_map.of_period(arguments.model, *days)
        for variable in test_map.SITE:
            model.add_output_variable(variable, "Timestep")
        model.write(folder / "model.idf")
        run = energyplus.run(energyplus.official_prefix() / "energyplus", folder / "model.idf", weather, folder / "run")
        suns = test_map.suns_of(run)
        outlines = [ring for surface, ring in test_map.outlines_of(arguments.model).items()
                    if not surface.endswith("ROOF")]
        for rays in (1, 16):
            began = time.monotonic()
            maps = test_map.draw(folder / "model.idf", weather, folder / f"maps{rays}", "--from", arguments.first,
                                 "--to", arguments.last, "--spacing", str(arguments.spacing), "--rays", str(rays),
                                 "--receivers", arguments.receivers)
            print(f"gpu_shading map, {rays:2} rays: {time.monotonic() - began:6.2f} s with two runs of EnergyPlus")
        cells = cells_of(maps)
        ours = numpy.array([hours for *_, hours in cells])
        print(f"{len(cells)} cells, {len(suns)} positions of the sun, {ours.mean():.3f} h in the mean")
        for name, compute in (("Embree", by_embree), ("Ladybug", by_ladybug)):
            try:
                theirs, seconds = compute(outlines, cells, suns)
            except ImportError as error:
                print(f"{name}: left out: {error}")
                continue
            errors = numpy.abs(theirs - ours)
            print(f"{name}, 1 ray: {seconds:6.2f} s, {theirs.mean():.3f} h in the mean, cells differ by "
                  f"{errors.mean():.4f} h, at most {errors.max():.3f} h")


if __name__ == "__main__":
    main()

"""Hours in which the sun shines on the reference points of daylighting, by single rays through the scene of a run."""

import os
import sys

import numpy as np
from shading_runs import energyplus, results

# W/m2 of beam at the point. In ten monitored offices, all occupants lowered their blinds against more direct sunlight
# (Reinhart and Voss, Lighting Research & Technology 35, 2003, pp. 243-260); Daysim's gen_directsunlight takes the same.
THRESHOLD = 50.0
OUTSIDE = 1e-3  # m, where rays begin in front of a window
PLACES = 2  # decimals of schedules, by which timesteps are taken together


def _scene(run, weather):
    """The scene that a run has seen."""
    os.environ["GPU_SHADING_PREFIX"] = str(run.program.parent)
    sys.path += [str(folder) for folder in energyplus.python_packages() if str(folder) not in sys.path]
    from gpu_shading import Scene

    return Scene.from_energyplus(run.placed, weather, run.side_file_seen())


def _inside(position, vertices, normal):
    """Whether positions on the plane of a polygon are in it, by the odd-even rule."""
    dropped = int(np.argmax(np.abs(normal)))
    x, y = np.delete(position, dropped, axis=1).T
    corners = np.delete(vertices, dropped, axis=1)
    inside = np.zeros(len(position), bool)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if ay != by:
            inside ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) / (by - ay) * (bx - ax))
    return inside


def _rows(steps, names):
    """Of each timestep, rounded values of schedules; those that a run does not report are 1."""
    return np.array([[min(1.0, max(0.0, round(step.schedules.get(name.upper(), 1.0), PLACES))) for name in names]
                     for step in steps]).reshape(len(steps), len(names))


def _beam_at(point, window, scene, rays, suns, tables):
    """The share of the beam that reaches a point through one window, without its glass, at each timestep."""
    vertices, normal = scene.surfaces[window].vertices, scene.normals[window]
    slopes = suns @ normal
    reached = slopes > results.FACING
    distance = np.where(reached, normal @ (vertices[0] - point) / np.where(reached, slopes, 1.0), -1.0)
    entered = point + distance[:, None] * suns
    reached &= distance > 0.0
    reached &= _inside(entered, vertices, normal)
    passed = np.zeros(len(suns))
    factors, deployments = tables
    chosen = np.flatnonzero(reached)
    both = np.hstack([factors, deployments])[chosen]
    for row in np.unique(both, axis=0):
        now = chosen[(both == row).all(axis=1)]
        passed[now] = rays.transmittance(entered[now] + OUTSIDE * normal, suns[now], receiver=window,
                                         factors=row[:factors.shape[1]], deployments=row[factors.shape[1]:])
    return passed


def hours(run, weather, points):
    """{(point, environment): hours with direct sun above THRESHOLD}, or {} where the run's scene cannot be had.

    points: as Objects.daylighting_points gives them.
    """
    steps = [step for step in run.results.steps if step.beam >= THRESHOLD]
    if not points or not (run.program.parent / energyplus.program_name("gpu_shading")).is_file():
        return {}
    try:
        scene = _scene(run, weather)
    except ImportError as error:  # on Windows, which has no Python package
        print(f"compare_shading: no hours of glare risk: {error}", file=sys.stderr)
        return {}
    rays = scene.rays()
    azimuths, altitudes, beams = (np.array([getattr(step, name) for step in steps])
                                  for name in ("azimuth", "altitude", "beam"))
    azimuths, altitudes = np.radians(azimuths), np.radians(altitudes)
    suns = np.stack([np.sin(azimuths) * np.cos(altitudes), np.cos(azimuths) * np.cos(altitudes), np.sin(altitudes)],
                    axis=1)
    tables = _rows(steps, scene.schedules), _rows(steps, scene.deployments)
    windows = {name: run.results.receivers[name].zone.upper() for name in run.results.values[results.SOLAR]}
    found = {}
    for name, (zone, position) in points.items():
        most = np.zeros(len(steps))
        for index in scene.receivers:
            if windows.get(scene.names[index]) == zone:
                most = np.maximum(most, beams * _beam_at(np.array(position), index, scene, rays, suns, tables))
        for environment in {step.environment for step in run.results.steps}:
            found[name, environment] = sum(step.hours for step, beam in zip(steps, most, strict=True)
                                           if step.environment == environment and beam >= THRESHOLD)
    return found

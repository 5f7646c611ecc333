"""What helps to choose between variants: a picture of each, its energy, peaks, light and glare, and its inputs."""

from dataclasses import dataclass
from math import cos, radians

import numpy as np
from shading_runs import methods, objects, results

from shading_report import facts, glare, pictures

BESIDE, ALTITUDE = 35.0, 25.0  # degrees, of the camera from the facade and from the horizon
LOW, HIGH = 15.0, 60.0  # degrees, of a sun that shows shadows
SIZE = 640  # pixels
OF_METHOD = ("--gpu-shading", "--gpu-shading-file")  # options that titles tell
SHOWN = 3  # names of objects, and changes of a class


@dataclass
class Look:
    """Pictures of all variants with the same sun and camera; data URIs, None with the reason in `missing`."""

    caption: str
    pictures: list
    missing: list


def _facade(run_results):
    """The azimuth of the windows with the largest area, or of the walls where there are no windows."""
    receivers = [each for each in run_results.receivers.values() if 45.0 < each.tilt < 135.0]
    windows = [each for each in receivers if each.name in run_results.values[results.SOLAR]]
    areas = {}
    for each in windows or receivers:
        azimuth = 10 * round(each.azimuth / 10) % 360
        areas[azimuth] = areas.get(azimuth, 0.0) + each.area
    return float(max(areas, key=areas.get)) if areas else 180.0


def _sun(run_results, azimuth):
    """(time, (azimuth, altitude)) of the hour in which the sun faces a facade best without being high or low."""
    def slope(item):
        (_, _, _, _), (of_sun, altitude) = item
        return (LOW <= altitude <= HIGH, cos(radians(of_sun - azimuth)) * cos(radians(altitude)))

    lit = [item for item in run_results.sun.items() if item[1]]
    return max(lit, key=slope) if lit else None


def look(runs, weather, folder):
    azimuth = _facade(runs[0].results)
    found = _sun(runs[0].results, azimuth)
    if not found:
        return Look("", [None] * len(runs), ["the sun does not rise"] * len(runs))
    (_, month, day, hour), sun = found
    folder.mkdir(parents=True)
    made = Look(f"Seen from azimuth {(azimuth + BESIDE) % 360:.0f}°, altitude {ALTITUDE:.0f}°, on {day} "
                f"{facts.month_name(month)}, {hour - 1:02d}–{hour:02d} h: sun at azimuth {sun[0]:.1f}°, altitude "
                f"{sun[1]:.1f}°.", [], [])
    for run in runs:
        picture = folder / f"{run.key}.png"
        why = run.draw(weather, "--camera", f"{(azimuth + BESIDE) % 360:g},{ALTITUDE:g}", "--sun",
                       f"{sun[0]:.4f},{sun[1]:.4f}", "--size", SIZE, "-o", picture)
        made.missing.append(why)
        made.pictures.append(None if why else pictures.data_uri(picture))
    return made


@dataclass
class Quantity:
    """One of what variants are chosen by."""

    title: str
    unit: str
    values: list

    def share(self, i):
        """Of the largest, 0 to 1."""
        most = max((value for value in self.values if value is not None), default=0.0)
        return self.values[i] / most if most > 0.0 and self.values[i] is not None else 0.0


def _environments(runs, calendar):
    """Run periods, or design days where there are none."""
    weather = [name for name in calendar.environments if name in runs[0].results.weather_periods]
    return weather or calendar.environments


def quantities(runs, calendar, shone):
    """[(environment, [Quantity])]. shone: what glare.hours gives for each run."""
    hourly = {variable: [facts.building(run.results, variable) for run in runs]
              for variable in (results.SOLAR, results.HEATING, results.COOLING, results.LIGHTS)}
    found = []
    for environment in _environments(runs, calendar):
        at = np.array([i for i in calendar.positions if calendar.times[i][0] == environment])
        sums = {variable: [float(values[at].sum()) for values in series] for variable, series in hourly.items()}
        peaks = {variable: [float(values[at].max()) for values in series] for variable, series in hourly.items()}
        points = [name for name in runs[0].results.illuminance
                  if all(name in run.results.illuminance for run in runs)]
        rows = [Quantity("Heating", "kWh", sums[results.HEATING]), Quantity("Cooling", "kWh", sums[results.COOLING]),
                Quantity("Lighting", "kWh", sums[results.LIGHTS]),
                Quantity("Sun through windows", "kWh", sums[results.SOLAR]),
                Quantity("Heating peak", "kW", peaks[results.HEATING]),
                Quantity("Cooling peak", "kW", peaks[results.COOLING])]
        if points:
            series = np.array([[np.asarray(run.results.illuminance[name])[at] for name in points] for run in runs])
            lit = series.max(axis=(0, 1)) > 0.0
            if lit.any():
                rows.append(Quantity("Mean daylight", "lx", series[:, :, lit].mean(axis=(1, 2)).tolist()))
        rows = [row for row in rows if any(row.values)]
        if any(shone):
            rows.append(Quantity("Glare risk", "h", [
                max((hours for (_, when), hours in of_run.items() if when == environment), default=None)
                for of_run in shone]))
        found.append((environment, rows))
    return found


def glare_rows(runs, calendar, shone):
    """[(environment, point, hours of each run)]"""
    points = dict.fromkeys(point for of_run in shone for point, _ in of_run)
    return [(environment, point, [of_run.get((point, environment)) for of_run in shone])
            for environment in _environments(runs, calendar) for point in points]


def _read(run):
    side_file = run.extension_file
    found = objects.Objects([run.model, *([side_file] if side_file else [])], run.program.parent)
    # A file of extension objects replaces the model's own.
    if not run.is_ours:
        for type_ in [name for name in found.classes if name.startswith(methods.OURS)]:
            del found.classes[type_]
    return found


def _some(texts):
    more = len(texts) - SHOWN
    return ", ".join(texts[:SHOWN]) + (f" and {more} more" if more > 0 else "")


def _described(changes):
    """Of one class."""
    said = []
    for word, there in (("added", lambda each: each.after), ("removed", lambda each: each.before)):
        names = [each.name or each.type for each in changes if not each.field and there(each) == "there"]
        if names:
            said.append(f"{len(names)} {word}: {_some(names)}")
    fields = [f"{each.name + ', ' if each.name else ''}{each.field}: {each.before} → {each.after}" for each in changes
              if each.field]
    if fields:
        said.append(_some(fields))
    return "; ".join(said)


def inputs(runs):
    """(what was read of each run, [(title, [what differs from the reference in each other run])])."""
    read = [_read(run) for run in runs]
    rows = {}
    for number, other in enumerate(read[1:]):
        by_class = {}
        for change in objects.differences(read[0], other):
            by_class.setdefault(change.type, []).append(change)
        for type_, changes in by_class.items():
            rows.setdefault(type_, [""] * (len(runs) - 1))[number] = _described(changes)
    options = [" ".join(word for word in run.options if word.partition("=")[0] not in OF_METHOD) for run in runs]
    if len(set(options)) > 1:
        rows["Options"] = [f"{options[0] or 'none'} → {each or 'none'}" if each != options[0] else ""
                           for each in options[1:]]
    return read, list(rows.items())


def compare(runs, weather, calendar, folder):
    """What the first part of the page is made of."""
    read, changed = inputs(runs)
    shone = [glare.hours(run, weather, found.daylighting_points()) for run, found in zip(runs, read, strict=True)]
    return {"look": look(runs, weather, folder), "chosen_by": quantities(runs, calendar, shone),
            "glare": glare_rows(runs, calendar, shone), "threshold": glare.THRESHOLD, "changed": changed}

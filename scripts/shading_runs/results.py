"""Reads sunlit fractions and solar radiation from eplusout.sql, and compares runs."""

import sqlite3
from array import array
from dataclasses import dataclass, field
from math import atan2, cos, degrees, hypot, radians, sin
from pathlib import Path

SUNLIT = "Surface Outside Face Sunlit Fraction"
COSINE = "Surface Outside Face Beam Solar Incident Angle Cosine Value"
SOLAR = "Surface Window Transmitted Solar Radiation Energy"
BEAM = "Surface Window Transmitted Beam Solar Radiation Energy"
HEATING = "Zone Air System Sensible Heating Energy"
COOLING = "Zone Air System Sensible Cooling Energy"
# Including latent heat and outdoor air, for zones with ideal loads.
IDEAL_HEATING = "Zone Ideal Loads Zone Total Heating Energy"
IDEAL_COOLING = "Zone Ideal Loads Zone Total Cooling Energy"
LIGHTS = "Zone Lights Electricity Energy"
VARIABLES = (SUNLIT, COSINE, SOLAR, BEAM, HEATING, COOLING, LIGHTS)
# On surfaces, W/m2: all, and what is not reflected.
INCIDENT = tuple(f"Surface Outside Face Incident {part}Solar Radiation Rate per Area"
                 for part in ("", "Beam ", "Sky Diffuse "))
# The part of what is reflected that no ground reflects, of runs in which this module traces it; W/m2.
BY_SHADES = "GPU Shading Solar Radiation Reflected by Shades Rate per Area"
# Made of these: energies on windows.
LIGHT = ("Sky's light on windows", "Reflected light on windows", "of that without the ground")
OF_ZONES = (HEATING, COOLING, LIGHTS)
# With the number of a reference point; the key is the Daylighting:Controls.
POINT = "Daylighting Reference Point {} Illuminance"
AZIMUTH, ALTITUDE = "Site Solar Azimuth Angle", "Site Solar Altitude Angle"
DIRECT = "Site Direct Solar Radiation Rate per Area"  # W/m2, normal to the sun
OF_SUN = (AZIMUTH, ALTITUDE, DIRECT)
SCHEDULE = "Schedule Value"
J_PER_KWH = 3.6e6

# Sunlit fractions are compared only while the sun is higher than this above the receiver's plane: below it, an
# hourly mean mixes timesteps in front of and behind the plane.
FACING = 1e-3

# The mean cosine of an hour during which the sun goes behind a plane and comes back is below that: at its lowest it is
# behind, and within an hour, 15 degrees, of there the cosine rises by at most this.
RETURNING = 1.0 - cos(radians(15.0))

# A wall is not compared if its windows leave less than this fraction of it: the sunlit fraction of a few square
# millimetres is noise with every method, and has no effect.
SLIVER = 1e-3

WEATHER_PERIOD = 3  # EnvironmentType of a run period with a weather file


def instrument(model, frequency="Hourly"):
    """Adds to an input file the outputs that Results reads."""
    model.add_unique("Output:SQLite", ["Simple"], ["option_type"])
    model.remove(lambda name: name == "outputcontrol:files")
    points = model.max_daylighting_points()
    for variable in VARIABLES:
        if variable != LIGHTS or points:
            model.add_output_variable(variable, frequency)
    for variable in (*INCIDENT, BY_SHADES):
        model.add_output_variable(variable, frequency)
    for number in range(1, points + 1):
        model.add_output_variable(POINT.format(number), frequency)
    # At every timestep: an hourly mean of the azimuth is wrong where the sun passes north.
    for variable in OF_SUN[:3 if points else 2]:
        model.add_output_variable(variable, "Timestep")
    for schedule in model.schedules_of_shades() if points else ():
        model.add_output_variable(SCHEDULE, "Timestep", schedule)


@dataclass
class Step:
    """A timestep with the sun above the horizon: its environment, length in hours, the sun in degrees, the beam in
    W/m2 normal to the sun, and values of schedules of shades by their names in upper case."""

    environment: str
    hours: float
    azimuth: float = 0.0
    altitude: float = 0.0
    beam: float = 0.0
    schedules: dict = field(default_factory=dict)


@dataclass
class Receiver:
    """An exterior surface of the building; azimuth and tilt in degrees, area in m2, and its zone."""

    name: str
    kind: str
    area: float
    azimuth: float
    tilt: float
    zone: str = ""


def mean_direction(directions):
    """(azimuth, altitude) of the mean of the directions above the horizon, in degrees, or None."""
    x = y = z = 0.0
    for azimuth, altitude in directions:
        if altitude > 0.0:
            azimuth, altitude = radians(azimuth), radians(altitude)
            x += sin(azimuth) * cos(altitude)
            y += cos(azimuth) * cos(altitude)
            z += sin(altitude)
    if z == 0.0:
        return None
    return degrees(atan2(x, y)) % 360.0, degrees(atan2(z, hypot(x, y)))


class Results:
    """All values of one run: values[variable][receiver or zone name] is an array over times, and so is
    illuminance["CONTROLS, point 1"], in lux. The variables of LIGHT are in J.

    times are (environment, month, day, hour 1 .. 24, minute) at the end of the hour; multipliers are those of zones;
    steps are those with the sun above the horizon.
    """

    def __init__(self, folder, frequency="Hourly"):
        path = Path(folder) / "eplusout.sql"
        if not path.is_file():
            raise FileNotFoundError(f"{path} was not written")
        with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as data:
            self._read(data, frequency)
        data.close()

    def _read(self, data, frequency):
        self.receivers = {
            name: Receiver(name, kind, area, azimuth, tilt, zone or "")
            for name, kind, area, azimuth, tilt, zone in data.execute(
                "SELECT SurfaceName, ClassName, Surfaces.Area, Azimuth, Tilt, ZoneName FROM Surfaces "
                "LEFT JOIN Zones USING (ZoneIndex) WHERE ExtSolar = 1 AND HeatTransferSurf = 1 "
                "AND Surfaces.Area > ? * GrossArea ORDER BY SurfaceIndex",
                (SLIVER,),
            )
        }
        self.multipliers = {name: multiplier * of_list for name, multiplier, of_list in data.execute(
            "SELECT ZoneName, Multiplier, ListMultiplier FROM Zones ORDER BY ZoneIndex")}
        names = (*VARIABLES, *INCIDENT, BY_SHADES)
        column = {}  # data dictionary index -> (variable, receiver or zone)
        for index, variable, key in data.execute(
            "SELECT ReportDataDictionaryIndex, Name, KeyValue FROM ReportDataDictionary "
            f"WHERE ReportingFrequency = ? AND Name IN ({','.join('?' * len(names))}) "
            "ORDER BY ReportDataDictionaryIndex DESC",
            (frequency, *names),
        ):
            column[index] = (variable, key)
        windows = {key for variable, key in column.values() if variable == SOLAR}
        self.values = {variable: {} for variable in names}
        target = {}
        for index, (variable, key) in column.items():
            known = self.multipliers if variable in OF_ZONES else self.receivers if variable in VARIABLES else windows
            if key in known:
                # A model that asks for the same output itself has it twice; the later entry replaces the earlier.
                target[index] = self.values[variable][key] = array("d")
        self.illuminance = {}
        for index, variable, key in data.execute(
            "SELECT ReportDataDictionaryIndex, Name, KeyValue FROM ReportDataDictionary "
            "WHERE ReportingFrequency = ? AND Name LIKE ? ORDER BY KeyValue, Name, ReportDataDictionaryIndex DESC",
            (frequency, POINT.format("%")),
        ):
            number = variable.removeprefix(POINT.split("{}")[0]).split()[0]
            target[index] = self.illuminance[f"{key}, point {number}"] = array("d")
        of_sun = {index: OF_SUN.index(variable) for index, variable in data.execute(
            "SELECT ReportDataDictionaryIndex, Name FROM ReportDataDictionary "
            "WHERE ReportingFrequency = 'Zone Timestep' AND Name IN (?, ?, ?)", OF_SUN)}
        schedules = dict(data.execute(
            "SELECT ReportDataDictionaryIndex, KeyValue FROM ReportDataDictionary "
            "WHERE ReportingFrequency = 'Zone Timestep' AND Name = ?", (SCHEDULE,)))
        time_indices, suns, values = {}, {}, {}
        for time_index, index, value in data.execute(
            "SELECT TimeIndex, ReportDataDictionaryIndex, Value FROM ReportData ORDER BY ReportDataIndex"
        ):
            if index in target:
                target[index].append(value)
                time_indices[time_index] = None
            elif index in of_sun:
                suns.setdefault(time_index, [0.0] * len(OF_SUN))[of_sun[index]] = value
            elif index in schedules:
                values.setdefault(time_index, {})[schedules[index].upper()] = value
        environments = {index: (name, kind) for index, name, kind in data.execute(
            "SELECT EnvironmentPeriodIndex, EnvironmentName, EnvironmentType FROM EnvironmentPeriods")}
        rows = {row[0]: row[1:] for row in data.execute(
            "SELECT TimeIndex, EnvironmentPeriodIndex, Month, Day, Hour, Minute, WarmupFlag, Interval FROM Time")}
        # The warm-up flag is only set with Output:Diagnostics, ReportDuringWarmup.
        self.times = [(environments.get(rows[i][0], ("?",))[0], *rows[i][1:5]) for i in time_indices]
        self.is_warmup = [bool(rows[i][5]) for i in time_indices]
        self.weather_periods = {name for name, kind in environments.values() if kind == WEATHER_PERIOD}
        self.steps, directions = [], {}
        for time_index, (azimuth, altitude, beam) in suns.items():
            environment, month, day, hour, minute, is_warmup, interval = rows[time_index]
            if is_warmup:
                continue
            name = environments.get(environment, ("?",))[0]
            directions.setdefault((name, month, day, hour + (minute > 0)), []).append((azimuth, altitude))
            if altitude > 0.0:
                self.steps.append(Step(name, interval / 60.0, azimuth, altitude, beam, values.get(time_index, {})))
        self._add_light([60.0 * rows[i][6] for i in time_indices])
        self.sun = {when: mean_direction(found) for when, found in directions.items()}

    def _add_light(self, seconds):
        """Puts the variables of LIGHT in the place of those that they are made of."""
        total, beam, sky, by_shades = (self.values.pop(name) for name in (*INCIDENT, BY_SHADES))
        all_reflected = {key: [a - b - c for a, b, c in zip(total[key], beam[key], sky[key], strict=True)]
                         for key in total if key in beam and key in sky}
        for kind, rates in zip(LIGHT, (sky, all_reflected, by_shades), strict=True):
            self.values[kind] = {
                key: array("d", (self.receivers[key].area * rate * length
                                 for rate, length in zip(of_window, seconds, strict=True)))
                for key, of_window in rates.items()}

    def sun_up(self, receiver):
        """Indices of the times when the sun faces the receiver."""
        cosines = self.values[COSINE].get(receiver, ())
        return [i for i, cosine in enumerate(cosines) if cosine > FACING and not self.is_warmup[i]]

    def faced_throughout(self, receiver):
        """Indices of the hours during all of which the sun faces the receiver.

        EnergyPlus's hourly sunlit fraction counts timesteps with the sun behind the plane as 0: that of an unshaded
        receiver is 1 in these hours alone. The sun faces it before and after each of them, so that the first and the
        last hour of a day that it faces the receiver are left out.
        """
        facing = set(self.sun_up(receiver))
        cosines = self.values[COSINE].get(receiver, ())
        return [i for i in sorted(facing) if {i - 1, i + 1} <= facing and cosines[i] >= RETURNING
                and self.times[i - 1][0] == self.times[i][0] == self.times[i + 1][0]]

    def mean_sunlit(self, receiver):
        """The mean of the sunlit fraction over the hours during all of which the sun faces the receiver, or None."""
        fractions = self.values[SUNLIT].get(receiver, ())
        hours = self.faced_throughout(receiver) if len(fractions) else []
        return sum(fractions[i] for i in hours) / len(hours) if hours else None

    def sun_at(self, position):
        """(azimuth, altitude) in degrees of the hour's mean direction while the sun is up, or None."""
        return self.sun.get(self.times[position][:4])

    def multiplier(self, variable, key):
        """The multiplier of the zone, or of the surface's zone."""
        return self.multipliers.get(key if variable in OF_ZONES else self.receivers[key].zone, 1.0)

    def total(self, variable, receiver=None):
        """The sum of an energy over the run in kWh, for one window or, with multipliers, for the building."""
        columns = self.values[variable]
        if receiver is not None:
            return sum(columns.get(receiver, ())) / J_PER_KWH
        return sum(self.multiplier(variable, key) * sum(values) for key, values in columns.items()) / J_PER_KWH


def energies(folder, variable, frequency="Monthly"):
    """{name of the surface, zone or other key: sum of an energy over the run in kWh}."""
    with sqlite3.connect(f"file:{Path(folder) / 'eplusout.sql'}?mode=ro", uri=True) as data:
        rows = data.execute(
            "SELECT KeyValue, SUM(Value) FROM ReportData JOIN ReportDataDictionary USING (ReportDataDictionaryIndex) "
            "WHERE Name = ? AND ReportingFrequency = ? GROUP BY KeyValue",
            (variable, frequency),
        ).fetchall()
    data.close()
    return {key: value / J_PER_KWH for key, value in rows}


@dataclass
class Difference:
    """Sunlit fraction of a run minus that of the reference, for one receiver, while the sun faces it."""

    receiver: Receiver
    times: list = field(default_factory=list)
    values: list = field(default_factory=list)
    reference: list = field(default_factory=list)

    @property
    def mean(self):
        return sum(map(abs, self.values)) / len(self.values) if self.values else 0.0

    @property
    def largest(self):
        return max(map(abs, self.values), default=0.0)


def differences(reference, other):
    """A Difference for every receiver that the sun faces at some time."""
    if reference.times != other.times:
        raise ValueError(f"the runs do not cover the same times ({len(reference.times)}, {len(other.times)})")
    found = []
    for name, receiver in reference.receivers.items():
        before, after = reference.values[SUNLIT].get(name), other.values[SUNLIT].get(name)
        if before is None or after is None:
            continue
        times = reference.sun_up(name)
        if times:
            found.append(Difference(receiver, times, [after[i] - before[i] for i in times],
                                    [before[i] for i in times]))
    return found


def percentile(values, share):
    """The percentile of the values by the nearest-rank method."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, max(0, round(share * len(ordered)) - 1))] if ordered else 0.0


def summary(found):
    """(mean, 99th percentile, max) of |difference| over all receivers and hours."""
    values = [abs(value) for difference in found for value in difference.values]
    if not values:
        return 0.0, 0.0, 0.0
    return sum(values) / len(values), percentile(values, 0.99), max(values)

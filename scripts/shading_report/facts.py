"""The numbers of a report, grouped as the page shows them. Energies in kWh, powers in kW."""

import calendar as gregorian
from dataclasses import dataclass

import numpy as np
from shading_runs import results

QUANTITIES = (
    ("Transmitted solar radiation", results.SOLAR),
    ("beam alone", results.BEAM),
    ("Heating", results.HEATING),
    ("Cooling", results.COOLING),
    ("Lighting", results.LIGHTS),
    *((kind, kind) for kind in results.LIGHT),
)
PARTS = (QUANTITIES[1][0], results.LIGHT[-1])  # of the quantity before
HOURS = 24
SAME = 9  # decimals in which the sunlit fractions of equal hours agree


def month_name(month):
    return gregorian.month_abbr[month]


class Calendar:
    """The days and hours of a run as columns and rows."""

    def __init__(self, run_results):
        self.positions = np.array([i for i, is_warmup in enumerate(run_results.is_warmup) if not is_warmup], int)
        self.times = run_results.times
        number = {}
        for position in self.positions:
            number.setdefault(self.times[position][:3], len(number))
        self.days = list(number)  # (environment, month, day)
        self.column = np.zeros(len(self.times), int)
        self.row = np.zeros(len(self.times), int)
        for position in self.positions:
            self.column[position] = number[self.times[position][:3]]
            self.row[position] = min(max(self.times[position][3], 1), HOURS) - 1

    @property
    def environments(self):
        return list(dict.fromkeys(environment for environment, _, _ in self.days))

    def grid(self, values, positions):
        """The values at these times as an array of hours x days, nan elsewhere."""
        found = np.full((HOURS, len(self.days)), np.nan)
        found[self.row[positions], self.column[positions]] = values
        return found

    def name(self, position):
        """An hour as text, with its environment if there are several."""
        environment, month, day, hour, _ = self.times[position]
        text = f"{day} {month_name(month)}, {hour - 1:02d}–{hour:02d} h"
        return f"{environment}: {text}" if len(self.environments) > 1 else text


def building(run_results, variable):
    """The hourly sum over zones or windows in kWh, with multipliers applied."""
    total = np.zeros(len(run_results.times))
    for key, values in run_results.values[variable].items():
        total += run_results.multiplier(variable, key) * np.asarray(values)
    return total / results.J_PER_KWH


@dataclass
class Amount:
    """One quantity in each run, the reference first; None if a run does not have it."""

    title: str
    values: list

    def change(self, i):
        return None if None in (self.values[0], self.values[i]) else self.values[i] - self.values[0]

    def percent(self, i):
        change = self.change(i)
        return 100 * change / self.values[0] if change is not None and self.values[0] else None


def energies(runs, calendar):
    """[(environment, [Amount of each quantity])] and, for run periods, [(month, ...)] and [(hour of the day, ...)]."""
    hourly = {title: [building(run.results, variable) if run.results.values[variable] else None for run in runs]
              for title, variable in QUANTITIES}

    def amounts(positions):
        return [Amount(title, [None if values is None else float(values[positions].sum()) for values in of_runs])
                for title, of_runs in hourly.items() if any(values is not None for values in of_runs)]

    by_environment, by_month, by_hour = {}, {}, {}
    for position in calendar.positions:
        environment, month = calendar.times[position][:2]
        by_environment.setdefault(environment, []).append(position)
        if environment in runs[0].results.weather_periods:
            by_month.setdefault((environment, month), []).append(position)
            by_hour.setdefault(calendar.row[position], []).append(position)
    several = len({environment for environment, _ in by_month}) > 1
    names = [f"{environment}: {month_name(month)}" if several else month_name(month) for environment, month in by_month]
    return ([(environment, amounts(positions)) for environment, positions in by_environment.items()],
            [(name, amounts(positions)) for name, positions in zip(names, by_month.values(), strict=True)],
            [(f"{hour:02d}–{hour + 1:02d} h", amounts(by_hour[hour])) for hour in sorted(by_hour)])


@dataclass
class Daylight:
    """A reference point of daylighting: mean lux in each run over the hours with light there in any of them, and the
    largest hourly |change| of each run but the first."""

    point: str
    hours: int
    values: list
    largest: list

    change, percent = Amount.change, Amount.percent


def daylight(runs, calendar):
    found = []
    for point in runs[0].results.illuminance:
        if not all(point in run.results.illuminance for run in runs):
            continue
        series = np.array([np.asarray(run.results.illuminance[point])[calendar.positions] for run in runs])
        lit = series.max(axis=0) > 0.0
        if lit.any():
            found.append(Daylight(point, int(lit.sum()), series[:, lit].mean(axis=1).tolist(),
                                  np.abs(series[1:] - series[0]).max(axis=1).tolist()))
    return found


@dataclass
class Peak:
    """The peak hour of a load in each run: kW, and its time."""

    title: str
    load: str
    values: list
    times: list

    change, percent = Amount.change, Amount.percent


def peaks(runs, calendar):
    """Peaks of the building, and of each zone by itself."""
    found = []
    for load, variable in (("Heating", results.HEATING), ("Cooling", results.COOLING)):
        keys = list(runs[0].results.values[variable])
        columns = [("Building", [building(run.results, variable) for run in runs])] if keys else []
        for key in keys:
            if all(key in run.results.values[variable] for run in runs):
                columns.append((key, [np.asarray(run.results.values[variable][key]) / results.J_PER_KWH
                                      for run in runs]))
        for title, series in columns:
            largest = [int(calendar.positions[np.argmax(values[calendar.positions])]) for values in series]
            peak = Peak(title, load, [float(values[i]) for values, i in zip(series, largest, strict=True)], [])
            peak.times = [calendar.name(i) if value > 0 else "" for i, value in zip(largest, peak.values, strict=True)]
            if any(peak.values):
                found.append(peak)
    return sorted(found, key=lambda peak: peak.title != "Building")


@dataclass
class WorstHour:
    """An hour with a large difference; days: number of days from this one with the same difference at that hour."""

    position: int
    change: float
    days: int = 1


def worst_hours(difference, calendar, count=10):
    """The largest non-zero |differences|, largest first.

    If shading is calculated for periods of several days, only the first day of each period is listed.
    """
    values, reference = np.asarray(difference.values), np.asarray(difference.reference)
    found = {}
    for i in np.argsort(-np.abs(values), kind="stable"):
        if values[i] == 0.0:
            break
        position = difference.times[i]
        alike = (calendar.row[position], round(reference[i], SAME), round(values[i], SAME))
        if alike in found:
            found[alike].days += 1
        elif len(found) < count:
            found[alike] = WorstHour(position, float(values[i]))
        elif abs(values[i]) < abs(min(found.values(), key=lambda each: abs(each.change)).change):
            break
    return list(found.values())


def messages(runs):
    """[(kind, text, [count in each run])], those that differ between runs first."""
    counts = {}
    for number, run in enumerate(runs):
        for message in run.run.messages:
            counts.setdefault(message, [0] * len(runs))[number] += 1
    order = ("Fatal", "Severe", "Warning")
    rows = [(kind, text, each) for (kind, text), each in counts.items()]
    return sorted(rows, key=lambda row: (len(set(row[2])) == 1, order.index(row[0])))

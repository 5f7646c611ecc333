"""Every number of the page as a row of report.csv, with all its digits."""

import csv

from shading_runs import results, verdict

HEADER = ("section", "row", "quantity", "run", "value")


def _amounts(section, row, amounts, runs, unit):
    """Rows of facts.Amount and its like."""
    for title, amount in amounts:
        for run, value in zip(runs, amount.values, strict=True):
            yield section, row, f"{title} {unit}", run.label, value
        for i, run in enumerate(runs[1:], start=1):
            yield section, row, f"{title}, change {unit}", run.label, amount.change(i)
            yield section, row, f"{title}, change %", run.label, amount.percent(i)


def _summaries(runs, limit):
    yield "summary", "", "limit of |d|", "", limit
    for run in runs[1:]:
        for title, value in zip(("mean |d|", "99th percentile of |d|", "largest |d|"), results.summary(run.found),
                                strict=True):
            yield "summary", "", title, run.label, value
        yield "summary", "", "hours with |d| beyond the limit %", run.label, 100 * verdict.share_beyond(run, limit)
        for variable, title in verdict.NAMES.items():
            before, after = (each.results.total(variable) for each in (runs[0], run))
            if before > 0.0:
                yield "summary", title, "change %", run.label, 100 * (after / before - 1)


def _choice(runs, page):
    for environment, quantities in page["chosen_by"]:
        for quantity in quantities:
            for run, value in zip(runs, quantity.values, strict=True):
                yield "variant", environment, f"{quantity.title} {quantity.unit}", run.label, value
    yield "variant", "", "picture", "", page["look"].caption
    yield "glare", "", "threshold W/m2", "", page["threshold"]
    for environment, point, hours in page["glare"]:
        for run, value in zip(runs, hours, strict=True):
            yield "glare", f"{environment}, {point}", "hours", run.label, value
    for title, cells in page["changed"]:
        for run, cell in zip(runs[1:], cells, strict=True):
            yield "input", title, "difference", run.label, cell


def _receivers(runs, lines, numbered):
    yield "summary", "", "receivers", "", len(lines)
    yield "summary", "", "receivers hour by hour", "", sum(bool(line.anchor) for line in lines)
    yield "summary", "", "receivers drawn", "", len(numbered)
    for number, line in enumerate(numbered, start=1):
        yield "receiver", line.receiver.name, "number", "", number
    for line in lines:
        name = line.receiver.name
        for title, value in (("area m2", line.receiver.area), ("azimuth deg", line.receiver.azimuth),
                             ("tilt deg", line.receiver.tilt), ("hours", line.hours)):
            yield "receiver", name, title, "", value
        for run, sunlit, solar in zip(runs, line.sunlit, line.solar, strict=True):
            yield "receiver", name, "mean sunlit fraction", run.label, sunlit
            yield "receiver", name, "solar kWh", run.label, solar
        for run, found in zip(runs[1:], line.differences, strict=True):
            yield "receiver", name, "mean |d|", run.label, found.mean if found else None
            yield "receiver", name, "max |d|", run.label, found.largest if found else None


def _hours(runs, details):
    """Of the hours with the largest differences."""
    for detail in details:
        for hour in detail.hours:
            row = f"{detail.receiver.name}, {hour.when}"
            for run, value in zip(runs, hour.fractions, strict=True):
                yield "hour", row, "sunlit fraction", run.label, value
            yield "hour", row, "d", runs[1].label, hour.change
            yield "hour", row, "days", "", hour.days
            for title, value in zip(("sun azimuth deg", "sun altitude deg"), hour.sun or (), strict=False):
                yield "hour", row, title, "", value


def _rows(page):
    """page: what the template is rendered with."""
    runs = page["runs"]
    yield from _choice(runs, page)
    yield from _summaries(runs, page["limit"])
    for section, periods in (("energy", "environments"), ("month", "months"), ("hour of the day", "hours")):
        for period, amounts in page[periods]:
            yield from _amounts(section, period, [(amount.title, amount) for amount in amounts], runs, "kWh")
    for peak in page["peaks"]:
        yield from _amounts("peak", peak.title, [(peak.load, peak)], runs, "kW")
        for run, when in zip(runs, peak.times, strict=True):
            yield "peak", peak.title, f"{peak.load}, when", run.label, when
    for point in page["daylight"]:
        yield "daylight", point.point, "hours", "", point.hours
        yield from _amounts("daylight", point.point, [("mean", point)], runs, "lx")
        for run, value in zip(runs[1:], point.largest, strict=True):
            yield "daylight", point.point, "max |change| lx", run.label, value
    yield from _receivers(runs, page["lines"], page["numbered"])
    yield from _hours(runs, page["details"])
    for kind, text, counts in page["messages"]:
        for run, count in zip(runs, counts, strict=True):
            yield "message", f"{kind}: {text}", "count", run.label, count
    for run, (title, parts) in zip(runs, page["stages"], strict=True):
        for stage, seconds in [*parts, ("whole program", run.run.wall)]:
            yield "time", stage, "s", title, seconds
    yield "origin", "Written", "", "", page["written"]
    for title, values in page["origin"]:
        for run, value in zip(runs, values, strict=True):
            yield "origin", title, "", run.label, value


def write(path, page, shown):
    """shown: what is written of a text."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(HEADER)
        for row in _rows(page):
            writer.writerow(["" if cell is None else shown(cell) if isinstance(cell, str) else cell for cell in row])

"""Fills the page with numbers, charts and pictures."""

import html
from dataclasses import dataclass, field
from pathlib import Path

import jinja2
import numpy as np
from shading_runs import results, verdict

from shading_report import building, charts, facts, origin, pictures, tables, variants

HERE = Path(__file__).resolve().parent


@dataclass
class Hour:
    """One of a receiver's worst hours: sunlit fractions of each run, and pictures from runs that can draw."""

    when: str
    sun: tuple
    fractions: list
    change: float
    days: int  # days with the same difference, including this one
    pictures: list = field(default_factory=list)  # (run, data URI)


@dataclass
class Detail:
    """The charts and hours of one receiver."""

    anchor: str
    receiver: results.Receiver
    maps: list
    charts: list
    hours: list


@dataclass
class Line:
    """A row of the table of receivers."""

    anchor: str
    receiver: results.Receiver
    hours: int  # in which the sun faces the receiver
    sunlit: list  # mean of each run over the hours during all of which it does; None: there are none
    differences: list  # of each except the first: results.Difference
    solar: list  # kWh of each run, None if it is not a window


def _number(value, form=",.2f"):
    if value is None:
        return "–"
    text = format(value, form)
    if not text.strip("+-0.,"):  # no sign before 0
        text = text.lstrip("+-")
    return text.replace("-", "\u2212")


def _fraction(value):
    return _number(value, ".4f")


def _difference(value):
    return "–" if value is None else charts.difference(value)


def _signed_difference(value):
    return "+" * (value > 0) + charts.difference(value)


def _largest(name, runs):
    return max((found.largest for run in runs[1:] for found in run.found if found.receiver.name == name), default=0.0)


def _lines(runs, shown):
    by_name = [{found.receiver.name: found for found in run.found} for run in runs[1:]]
    reference = runs[0].results
    lines = []
    for name, receiver in reference.receivers.items():
        found = [names.get(name) for names in by_name]
        positions = next((each.times for each in found if each), ())
        sunlit = [run.results.mean_sunlit(name) for run in runs]
        solar = [run.results.total(results.SOLAR, name) if name in run.results.values[results.SOLAR] else None
                 for run in runs]
        lines.append(Line(shown.get(name, ""), receiver, len(positions), sunlit, found, solar))
    return lines


def _maps(name, runs, calendar):
    sunlit = [np.asarray(run.results.values[results.SUNLIT][name]) for run in runs]
    positions = np.array(runs[0].results.sun_up(name))
    found = [charts.heat_map(calendar.grid(values[positions], positions), calendar, f"{run.label}: sunlit fraction",
                             f"Sunlit fraction of {name} by hour and day, {run.label}")
             for run, values in zip(runs, sunlit, strict=True)]
    for run, values in zip(runs[1:], sunlit[1:], strict=True):
        change = values[positions] - sunlit[0][positions]
        limit = float(np.abs(change).max(initial=0.0)) or 1e-9
        found.append(charts.heat_map(calendar.grid(change, positions), calendar, f"{run.label} − {runs[0].label}",
                                     f"Difference of the sunlit fraction of {name} by hour and day", limit))
    return found


def _detail(anchor, name, runs, calendar):
    of_runs = [(run.label, next(found for found in run.found if found.receiver.name == name)) for run in runs[1:]]
    reference = of_runs[0][1].reference
    parts = [
        charts.scatter(reference, [(title, np.add(found.reference, found.values)) for title, found in of_runs],
                       f"Sunlit fraction of {name} in each run compared with the reference"),
        charts.histogram([(title, np.asarray(found.values)) for title, found in of_runs],
                         f"Histogram of the differences at {name}"),
    ]
    hours = []
    for worst in facts.worst_hours(of_runs[0][1], calendar):
        fractions = [run.results.values[results.SUNLIT][name][worst.position] for run in runs]
        hours.append(Hour(calendar.name(worst.position), runs[0].results.sun_at(worst.position), fractions,
                          worst.change, worst.days))
    return Detail(anchor, runs[0].results.receivers[name], _maps(name, runs, calendar), parts, hours)


def _draw(details, runs, weather, output):
    """Adds the pictures of all hours. Returns why there are none, or ''."""
    reason = "none of these runs was rendered by this software"
    for run in runs:
        if not run.is_ours:
            continue
        wanted = [(detail.receiver.name, hour) for detail in details for hour in detail.hours if hour.sun]
        drawn, reason = pictures.draw(run, weather, [(name, hour.sun) for name, hour in wanted],
                                      output / "pictures" / run.key)
        for (_, hour), picture in zip(wanted, drawn, strict=True):
            hour.pictures.append((run, picture))
    return reason


def _overall(runs):
    found = []
    for run in runs[1:]:
        reference = np.concatenate([each.reference for each in run.found] or [[]])
        change = np.concatenate([each.values for each in run.found] or [[]])
        if not len(change):
            continue
        found.append(charts.density(reference, reference + change, run.label,
                                    f"Sunlit fractions of all receivers, {run.label} compared with the reference"))
        found.append(charts.histogram([(run.label, change)], f"Histogram of the differences of {run.label}"))
    return found


def _bars(runs, periods, kind):
    """A chart of each quantity. periods: [(name, [Amount ...])]; kind: month or hour."""
    found = []
    for number, amount in enumerate(periods[0][1] if periods else ()):
        if amount.title in facts.PARTS:
            continue
        series = [(run.label, [amounts[number].values[i] or 0.0 for _, amounts in periods])
                  for i, run in enumerate(runs)]
        found.append(charts.bars([name for name, _ in periods], series, amount.title,
                                 f"{amount.title} by {kind} in each run, kWh"))
    return found


def _numbered(lines, shown):
    """The receivers to number, those that the sun faces, with those that differ most first: [line]."""
    lines = [line for line in lines if line.hours]
    first = [line for line in lines if line.anchor]
    first.sort(key=lambda line: list(shown.values()).index(line.anchor))
    return (first + [line for line in lines if not line.anchor])[:building.MAX_NUMBERS]


def _gather(output, everything, weather, most, further):
    """What the page and its table are made of; draws the pictures into the output folder."""
    runs = [run for run in everything if run.results]
    calendar = facts.Calendar(runs[0].results)
    names = [found.receiver.name for found in runs[1].found
             if all(any(each.receiver.name == found.receiver.name for each in run.found) for run in runs[1:])]
    limit = verdict.allowed(runs)
    worth_seeing = [name for name in names if _largest(name, runs) > limit]
    chosen = sorted(worth_seeing, key=lambda name: -_largest(name, runs))[:most]
    shown = {name: f"receiver-{number}" for number, name in enumerate(chosen, start=1)}
    details = [_detail(anchor, name, runs, calendar) for name, anchor in shown.items()]
    without_pictures = _draw(details, runs, weather, output) if details else ""
    lines = _lines(runs, shown)
    numbered = _numbered(lines, shown)
    buildings, without_building = building.draw(
        runs, weather, {line.receiver.name: (number, line.sunlit[0])
                        for number, line in enumerate(numbered, start=1)})
    by_environment, by_month, by_hour = facts.energies(runs, calendar)
    timed = [(run.label, origin.stages(run)) for run in runs]
    return dict(
        model=runs[0].model.name,
        weather=weather.name,
        written=origin.written(),
        runs=runs,
        colour=charts.run_colour,
        missing=[run for run in everything if not run.results],
        verdicts=[(run.title, verdict.energy(runs[0], run)) for run in runs[1:]],
        agreements=[(run.title, verdict.agreement(run, limit)) for run in runs[1:]],
        unseen=verdict.unseen(runs),
        **variants.compare(runs, weather, calendar, output / "looks"),
        limit=limit,
        summaries=[results.summary(run.found) for run in runs[1:]],
        environments=by_environment,
        parts=facts.PARTS,
        months=by_month,
        month_charts=_bars(runs, by_month, "month"),
        hours=by_hour,
        hour_charts=_bars(runs, by_hour, "hour of the day"),
        peaks=facts.peaks(runs, calendar),
        daylight=facts.daylight(runs, calendar),
        lines=lines,
        faced=sum(line.hours > 0 for line in lines),
        numbered=numbered,
        buildings=buildings,
        without_building=without_building,
        overall=_overall(runs),
        details=details,
        without_pictures=without_pictures,
        messages=facts.messages(runs),
        stages=timed,
        stage_chart=charts.stages(timed, "Seconds of each run by stage"),
        origin=origin.rows(runs, weather, further),
    )


def write(output, everything, weather, most, further):
    """Writes DIR/report.html about the runs that have results, the reference first, and DIR/report.csv with the page's
    numbers. Returns the page's path.

    most: number of receivers shown hour by hour, those that differ most.
    """
    page = _gather(output, everything, weather, most, further)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters |= {"number": _number, "fraction": _fraction, "difference": _difference,
                            "signed_difference": _signed_difference}
    text = environment.get_template("page.html").render(
        style=(HERE / "page.css").read_text(encoding="utf-8"),
        script=(HERE / "page.js").read_text(encoding="utf-8"),
        **page,
    )
    names = origin.folders([run for run in everything if run.run], weather, output)
    tables.write(output / "report.csv", page, lambda cell: origin.without_folders(cell, names))
    path = output / "report.html"
    path.write_text(origin.without_folders(text, [html.escape(name) for name in names]), encoding="utf-8")
    return path

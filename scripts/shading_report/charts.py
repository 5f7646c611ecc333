"""Charts as SVG text, drawn by matplotlib: they need no script and are sharp in print.

Colours suit colour-blind readers and grey print: Okabe and Ito's for runs, cividis for amounts, ColorBrewer's PuOr
for differences. Runs also differ in hatch and marker.
"""

import html
import io
import itertools
import re

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

RUN_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#F0E442", "#666666")
HATCHES = ("", "///", "...", "xxx", "\\\\\\", "---", "|||", "+++")
MARKS = ("o", "x", "+", "s", "^", "d", "v", "*")
MOST_TICKS = 12
IN_ROW = 6  # labels of runs below a chart, at most
NOT_FACING = "#e4e4e4"
GRID = {"color": "#d0d0d0", "linewidth": 0.6}

mpl.rcParams.update({
    "svg.fonttype": "none",
    "font.family": "sans-serif",
    "font.size": 9,
    "axes.edgecolor": "#444444",
    "axes.axisbelow": True,
    "hatch.linewidth": 0.6,
})

_numbers = itertools.count()


def run_colour(number):
    return RUN_COLOURS[number % len(RUN_COLOURS)]


def _hatch(number):
    """Another one where colours begin again."""
    return HATCHES[(number + number // len(HATCHES)) % len(HATCHES)]


def _svg(figure, description):
    """The figure as an SVG element, with ids that are unique in the page."""
    file = io.StringIO()
    figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None}, dpi=150)
    text = file.getvalue()
    text = re.sub(r"<metadata>.*?</metadata>\s*", "", text[text.index("<svg"):], flags=re.DOTALL)
    text = re.sub(r"\s*<!--.*?-->", "", text, flags=re.DOTALL)
    used = set(re.findall(r'(?:url\(|href=")#([^")]+)', text))
    prefix = f"chart{next(_numbers)}-"
    text = re.sub(r' id="([^"]*)"', lambda found: f' id="{prefix}{found[1]}"' if found[1] in used else "", text)
    text = re.sub(r'(url\(|href=")#', rf"\1#{prefix}", text)
    size = re.search(r'viewBox="0 0 ([\d.]+) ', text)[1]
    label = html.escape(description, quote=True)
    text = re.sub(r'^<svg[^>]*?viewBox="([^"]*)"[^>]*>',
                  rf'<svg class="chart" role="img" aria-label="{label}" viewBox="\1" style="max-width:{size}pt" '
                  r'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">', text)
    return text.strip()


def _figure(width, height, left=0.6, right=0.15, bottom=0.45, top=0.25):
    """A figure and its axes; all lengths in inches. Margins are fixed: computing them is slower than drawing."""
    figure = Figure(figsize=(width, height))
    return figure, figure.add_axes((left / width, bottom / height, 1 - (left + right) / width,
                                    1 - (bottom + top) / height))


def _colour_bar(figure, axes, image, gap=0.1, width=0.12, **options):
    """Adds a colour bar to the right of the axes, at their height; gap and width in inches."""
    position = axes.get_position()
    whole = figure.get_figwidth()
    bar = figure.add_axes((position.x1 + gap / whole, position.y0, width / whole, position.height))
    return figure.colorbar(image, cax=bar, **options)


def difference(value):
    """A sunlit fraction in few characters: 0.35, 1.2e-05."""
    form = ".1e" if 0 < abs(value) < 1e-3 else ".2g"
    return format(value, form).replace("-", "\u2212")


def _plain(value, _=None):
    return f"{value:,.10g}".replace("-", "\u2212")


def _days(axes, calendar):
    """Sets ticks below the days: at months for a year, otherwise at each day."""
    starts = [i for i, day in enumerate(calendar.days)
              if i == 0 or calendar.days[i - 1][:2] != day[:2]]
    if len(calendar.days) > 31:
        axes.set_xticks([start - 0.5 for start in starts],
                        ["JFMAMJJASOND"[calendar.days[i][1] - 1] for i in starts], ha="left")
    else:
        step = -(-len(calendar.days) // 8)
        chosen = range(0, len(calendar.days), step)
        axes.set_xticks(list(chosen), [f"{calendar.days[i][2]}.{calendar.days[i][1]}." for i in chosen])
        axes.set_xlabel("day.month.")
    axes.set_yticks([0, 6, 12, 18, 24], ["0", "6", "12", "18", "24"])
    axes.set_ylabel("hour of day")


def heat_map(grid, calendar, title, description, limit=None):
    """A map of hours over days: amounts of 0 to 1 or, with a limit, differences of at most that."""
    figure, axes = _figure(5.3, 2.0, left=0.5, right=0.95, bottom=0.4)
    colours = mpl.colormaps["cividis" if limit is None else "PuOr"].with_extremes(bad=NOT_FACING)
    low, high = (0.0, 1.0) if limit is None else (-limit, limit)
    image = axes.imshow(grid, aspect="auto", origin="lower", interpolation="none", cmap=colours, vmin=low, vmax=high,
                        extent=(-0.5, grid.shape[1] - 0.5, 0, grid.shape[0]))
    _days(axes, calendar)
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold")
    bar = _colour_bar(figure, axes, image)
    if limit is not None:
        bar.set_ticks([-limit, 0.0, limit], labels=[difference(-limit), "0", difference(limit)])
    return _svg(figure, description)


def scatter(reference, others, description):
    """A scatter plot of the times when the receiver faces the sun. others: [(label, values)]."""
    figure, axes = _figure(3.1, 3.0, left=0.5, bottom=0.45, right=0.1, top=0.1)
    axes.plot([0, 1], [0, 1], color="#444444", linewidth=0.8)
    for number, (label, values) in enumerate(others, start=1):
        axes.plot(reference, values, MARKS[(number - 1) % len(MARKS)], color=run_colour(number), markersize=2.5,
                  markeredgewidth=0.6, alpha=0.6, rasterized=True, label=label)
    axes.set(xlim=(-0.03, 1.03), ylim=(-0.03, 1.03), aspect="equal")
    axes.grid(**GRID)
    if len(others) > 1:
        axes.legend(frameon=False, loc="upper left")
    return _labelled(figure, axes, description)


def _labelled(figure, axes, description):
    axes.set_xlabel("sunlit fraction, reference")
    axes.set_ylabel("sunlit fraction")
    return _svg(figure, description)


def density(reference, values, label, description):
    """A density plot of hours, for all receivers together, which would be too many for markers."""
    figure, axes = _figure(3.7, 3.0, left=0.5, right=0.8)
    _, _, _, image = axes.hist2d(reference, values, bins=60, range=((0, 1), (0, 1)), cmap="cividis_r",
                                 norm=LogNorm(), rasterized=True)
    axes.plot([0, 1], [0, 1], color="#D55E00", linewidth=0.7)
    axes.set_title(label, loc="left", fontsize=9, fontweight="bold")
    _colour_bar(figure, axes, image, label="receiver hours", format=_plain)
    return _labelled(figure, axes, description)


def histogram(others, description):
    """A histogram with counts on a logarithmic axis. others: [(label, differences)]."""
    figure, axes = _figure(3.6, 3.0, left=0.75, top=0.1)
    largest = max((np.abs(values).max(initial=0.0) for _, values in others), default=0.0) or 1e-9
    edges = np.linspace(-largest, largest, 42)
    for number, (label, values) in enumerate(others, start=1):
        axes.hist(values, bins=edges, color=run_colour(number), histtype="stepfilled", alpha=0.75, label=label)
    axes.set_yscale("log")
    axes.set_ylim(bottom=0.5)
    axes.axvline(0.0, color="#444444", linewidth=0.8)
    axes.set_xticks([-largest, 0.0, largest], [difference(-largest), "0", difference(largest)])
    axes.yaxis.set_major_formatter(_plain)
    axes.yaxis.set_minor_locator(NullLocator())
    axes.grid(axis="y", **GRID)
    axes.set_xlabel("difference of the sunlit fraction")
    axes.set_ylabel("hours")
    if len(others) > 1:
        axes.legend(frameon=False)
    return _svg(figure, description)


def bars(names, runs, title, description):
    """Bars of each period, side by side. runs: [(label, kWh by period)]."""
    rows = -(-len(runs) // IN_ROW)
    figure, axes = _figure(4.6, 2.3 + 0.2 * rows, left=0.7, right=0.1, bottom=0.35 + 0.2 * rows)
    width = 0.8 / len(runs)
    for number, (label, values) in enumerate(runs):
        positions = np.arange(len(names)) + (number - (len(runs) - 1) / 2) * width
        axes.bar(positions, values, width, color=run_colour(number), hatch=_hatch(number), edgecolor="white",
                 linewidth=0.4, label=label)
    apart = -(-len(names) // MOST_TICKS)
    labels = names if apart == 1 else [str(position) for position in range(1, len(names) + 1)]
    axes.set_xticks(range(0, len(names), apart), labels[::apart], fontsize=8)
    axes.yaxis.set_major_formatter(_plain)
    axes.set_ylabel("kWh")
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold")
    axes.grid(axis="y", **GRID)
    figure.legend(frameon=False, ncols=min(len(runs), IN_ROW), loc="lower center", borderaxespad=0.1)
    return _svg(figure, description)


def stages(runs, description):
    """A bar for each run with its stages end to end. runs: [(label, [(stage, seconds)])]."""
    names = list(dict.fromkeys(stage for _, parts in runs for stage, _ in parts))
    figure, axes = _figure(6.0, 0.6 + 0.35 * len(runs) + 0.2 * len(names), left=1.4, top=0.1 + 0.2 * len(names))
    shades = mpl.colormaps["cividis"](np.linspace(0.1, 0.95, max(2, len(names))))
    for position, (_, parts) in enumerate(runs):
        left = 0.0
        for stage, seconds in parts:
            axes.barh(position, seconds, left=left, color=shades[names.index(stage)], edgecolor="#444444",
                      linewidth=0.5, label=stage)
            left += seconds
    axes.set_yticks(range(len(runs)), [label for label, _ in runs])
    axes.invert_yaxis()
    axes.set_xlabel("seconds")
    axes.grid(axis="x", **GRID)
    handles = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    figure.legend(handles.values(), handles.keys(), frameon=False, loc="upper left", fontsize=8, borderaxespad=0.1,
                  labelspacing=0.25)
    return _svg(figure, description)

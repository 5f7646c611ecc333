"""Charts of timings as SVG files, drawn by matplotlib, and the exponent of a curve."""

import math

import matplotlib as mpl
from matplotlib.figure import Figure

# Okabe and Ito's colours; markers differ too, for grey print.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000")
MARKS = ("o", "s", "^", "D", "x")

mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "curves", "font.family": "sans-serif", "font.size": 9})


def exponent(points):
    """p in y ~ x^p, by least squares on the logarithms of the upper half of the points."""
    upper = [(math.log(x), math.log(y)) for x, y in sorted(points)[len(points) // 2 - 1:]]
    mean_x = sum(x for x, _ in upper) / len(upper)
    mean_y = sum(y for _, y in upper) / len(upper)
    return (sum((x - mean_x) * (y - mean_y) for x, y in upper)
            / sum((x - mean_x) ** 2 for x, _ in upper))


def draw(path, panels, ylabel):
    """Writes an SVG of panels side by side, {title: (xlabel, {curve: [(x, y), ...]})}, with logarithmic axes."""
    figure = Figure(figsize=(4.2 * len(panels), 3.4), layout="constrained")
    for position, (title, (xlabel, curves)) in enumerate(panels.items()):
        axes = figure.add_subplot(1, len(panels), position + 1)
        for number, (name, points) in enumerate(curves.items()):
            xs, ys = zip(*sorted(points), strict=True)
            axes.loglog(xs, ys, label=name, color=COLOURS[number % len(COLOURS)], linewidth=1.4, markersize=4,
                        marker=MARKS[number % len(MARKS)])
        values = [y for points in curves.values() for _, y in points]
        axes.set_ylim(10.0 ** math.floor(math.log10(min(values))), 10.0 ** math.ceil(math.log10(max(values)) + 1e-9))
        axes.set_title(title, fontsize=10)
        axes.set_xlabel(xlabel)
        axes.set_ylabel(ylabel)
        axes.grid(True, which="major", color="#d0d0d0", linewidth=0.6)
        if len(curves) > 1:
            axes.legend(frameon=False)
    figure.savefig(path, metadata={"Date": None, "Creator": None})

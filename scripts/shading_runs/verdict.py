"""What a comparison found, in sentences with few numbers."""

from decimal import ROUND_CEILING, Context

from shading_runs import input_file, methods, results

DEFAULT_ERROR = 1e-3  # of --gpu-shading-error
NAMES = {results.SOLAR: "transmitted solar radiation", results.HEATING: "heating", results.COOLING: "cooling",
         results.LIGHTS: "lighting"}
# What EnergyPlus itself does where our objects are left out.
IN_STOCK = (
    (("PerforatedScreen", "TransparentShade"),
     "takes shading surfaces with {} as opaque, or by their transmittance schedule"),
    (("MovingShade",), "leaves surfaces with {} as they are drawn"),
    (("Geometry", "SiteContext", "Tree"), "has nothing of {}"),
)
SAME = 5e-6  # relative, beyond the digits that are said


def allowed(runs):
    """The difference of a sunlit fraction that one in a hundred may exceed: the largest error asked for."""
    errors = [DEFAULT_ERROR]
    for run in runs:
        words = [*run.options, ""]
        for word, after in zip(words, words[1:], strict=False):
            name, _, value = word.partition("=")
            if name == "--gpu-shading-error":
                errors.append(float(value or after))
    return max(errors)


def _classes(run):
    """The classes of the model of a run and of its side file."""
    paths = [run.model, *([run.extension_file] if run.extension_file else [])]
    return set().union(*(input_file.read(path).classes() for path in paths))


def unseen(runs):
    """What runs of EnergyPlus itself make of our objects in the others' models, a sentence for each."""
    found = []
    for run in (each for each in runs if not each.is_ours):
        classes = set().union(*(_classes(each) for each in runs if each.is_ours or each is run))
        said = []
        for names, what in IN_STOCK:
            there = [f"GPUShading:{name}" for name in names if f"{methods.OURS}{name.lower()}" in classes]
            if there:
                said.append(what.format(" and ".join(there)))
        if said:
            found.append(f"{run.title} {'; '.join(said)}.")
    return found


def share_beyond(other, limit):
    """The share of the hours with |d| beyond a limit, 0 to 1."""
    values = [value for found in other.found for value in found.values]
    return sum(abs(value) > limit for value in values) / max(1, len(values))


def rounded_up(value):
    """To one digit, and never below the value that the digits of its double tell: 0.0002 for 1.5e-4."""
    return float(Context(prec=1, rounding=ROUND_CEILING).create_decimal(repr(value)))


def _percent(value):
    """Two digits, and all of those before the decimal point: 0.0061, 12, 120."""
    return f"{value:,.0f}" if value >= 10.0 else f"{value:.2g}"


def agreement(other, limit):
    """Of sunlit fractions with those of the reference."""
    values = [abs(value) for found in other.found for value in found.values]
    if not values:
        return "The sun faces no receiver at any hour that both runs have."
    if not any(values):
        return "Sunlit fractions are the same."
    within = results.percentile(values, 0.99)
    if within <= limit:
        return f"Sunlit fractions agree: 99 % of the hours are within {rounded_up(max(within, 1e-9)):g}."
    share, mean = 100 * share_beyond(other, limit), sum(values) / len(values)
    return f"Sunlit fractions differ: {share:.0f} % of the hours by more than {limit:g}, and by {mean:.2g} in the mean."


def energy(reference, other):
    """What changes from the reference."""
    changed, same = [], []
    for variable, name in NAMES.items():
        before, after = (run.results.total(variable) for run in (reference, other))
        if before <= 0.0 and after <= 0.0:
            continue
        if abs(after - before) <= SAME * max(before, after):
            same.append(name)
        elif before <= 0.0:
            changed.append(f"{after:,.3g} kWh of {name}, instead of none")
        else:
            change = 100 * (after / before - 1)
            changed.append(f"{_percent(abs(change))} % {'more' if change > 0 else 'less'} {name}")
    if not changed:
        return "Energies are the same." if same else ""
    rest = f"; the same {', '.join(same)}" if same else ""
    return f"Compared with {reference.title}: {', '.join(changed)}{rest}."


def sentences(runs, other):
    """What `other` has found beside the first of the runs."""
    return [text for text in (agreement(other, allowed(runs)), energy(runs[0], other)) if text]

"""Copies an example model of the package, with its weather, so that commands of the manual can be tried on it."""

import shutil
from pathlib import Path

# Of EnergyPlus; the models that are not generated are for this place.
WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"


def names(examples):
    """Of those that need not be generated."""
    return sorted({model.parent.name for model in examples.glob("*/*.idf")})


def copy(name, examples, energyplus, target=None):
    """The new folder, by default of the example's name; raises SystemExit, with a line that says what is wrong."""
    if name not in names(examples):
        raise SystemExit(f"energyplus-gpu: example {name}: expected one of {', '.join(names(examples))}")
    target = Path(target or name)
    if target.exists():
        raise SystemExit(f"energyplus-gpu: example {name}: {target} exists already: move it away")
    shutil.copytree(examples / name, target)
    shutil.copyfile(energyplus / "WeatherData" / WEATHER, target / "weather.epw")
    return target

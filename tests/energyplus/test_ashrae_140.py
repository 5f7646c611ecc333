"""The shading cases of ASHRAE Standard 140 in the ranges of its reference programs, and against polygon clipping.

Those of low mass, of the editions of 2007 and 2020; scripts/dev/benchmark --bestest runs the others too.
"""

import bestest
import pytest

CASES = [(year, case) for year in bestest.EDITIONS for case in (600, 610, 620, 630)]
SHADED = [(year, case) for year, case in CASES if case in bestest.SHADED]


@pytest.fixture(scope="module")
def runs(official, patched, tmp_path_factory):
    """Runs a case of an edition once with a shading method, "stock" or "ours", and keeps it."""
    folder = tmp_path_factory.mktemp("bestest")
    kept = {}

    def call(year, case, method):
        if (year, case, method) not in kept:
            program, options = (patched, ["--gpu-shading"]) if method == "ours" else (official, [])
            name = f"{year}_{case}_{method}"
            try:
                done = bestest.run(bestest.EDITIONS[year], case, program, options, folder / name)
            except FileNotFoundError as error:
                pytest.skip(f"{error}: GPU_SHADING_MODELS names the folder of models")
            assert done.severe == []
            kept[year, case, method] = done
        return kept[year, case, method]

    return call


@pytest.mark.parametrize("year, case", CASES)
def test_loads_are_in_the_range_of_the_reference_programs(runs, year, case):
    edition, ours = bestest.EDITIONS[year], bestest.quantities(runs(year, case, "ours"))
    for name, bounds in edition.ranges[case].items():
        print(f"{case}, {name}: {ours[name]:.3f}, range {bounds[0]:.3f} to {bounds[1]:.3f}")
        assert bestest.is_within(ours[name], bounds) != ((case, name) in edition.outside), name
    for name, bounds in edition.limits.get(case, {}).items():
        assert bestest.is_within(ours[name], bounds), name


@pytest.mark.parametrize("year, case", SHADED)
def test_shades_change_loads_as_in_the_reference_programs(runs, year, case):
    edition = bestest.EDITIONS[year]
    shaded, plain = (bestest.quantities(runs(year, each, "ours")) for each in (case, bestest.SHADED[case]))
    changed = bestest.change(shaded, plain)
    for name, bounds in edition.changes[case].items():
        print(f"{case} - {bestest.SHADED[case]}, {name}: {changed[name]:+.3f}, "
              f"range {bounds[0]:+.3f} to {bounds[1]:+.3f}")
        assert bestest.is_within(changed[name], bounds) != ((case, name) in edition.changes_outside), name


@pytest.mark.parametrize("year, case", SHADED)
def test_loads_are_those_of_polygon_clipping(runs, year, case):
    ours, stock = runs(year, case, "ours"), runs(year, case, "stock")
    assert ours.method == "PixelCounting"
    expected = bestest.quantities(stock)
    for name, value in bestest.quantities(ours).items():
        print(f"{case}, {name}: {value:.5f}, polygon clipping {expected[name]:.5f}, "
              f"{100 * (value / expected[name] - 1):+.4f} %")
        assert value == pytest.approx(expected[name], rel=1e-4), name
    assert bestest.beam(ours) == pytest.approx(bestest.beam(stock), rel=1e-4)


@pytest.mark.parametrize("case", [600, 610, 620, 630])
def test_the_model_is_that_of_energyplus_developers(runs, case):
    """They submitted results of EnergyPlus 9.0.1 to the edition of 2020, in whose ranges they therefore are."""
    found = bestest.quantities(runs(2020, case, "ours"))
    for name, submitted in bestest.PUBLISHED_2020["EnergyPlus"][case].items():
        print(f"{case}, {name}: {found[name]:.3f}, EnergyPlus 9.0.1 {submitted:.3f}")
        assert found[name] == pytest.approx(submitted, rel=3e-3), name

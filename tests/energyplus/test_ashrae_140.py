"""The shading cases of ASHRAE Standard 140 in the ranges of its reference programs, and against polygon clipping.

Those of low mass; scripts/benchmark --bestest runs the others too.
"""

import bestest
import pytest

CASES = (600, 610, 620, 630)
SHADED = {case: plain for case, plain in bestest.SHADED.items() if case in CASES}


@pytest.fixture(scope="module")
def runs(official, patched, tmp_path_factory):
    """Runs a case once with a shading method, "stock" or "ours", and keeps it."""
    folder = tmp_path_factory.mktemp("bestest")
    kept = {}

    def call(case, method):
        if (case, method) not in kept:
            program, options = (patched, ["--gpu-shading"]) if method == "ours" else (official, [])
            try:
                kept[case, method] = bestest.run(case, program, options, folder / f"{case}_{method}")
            except FileNotFoundError as error:
                pytest.skip(f"{error}: GPU_SHADING_MODELS names the folder of models")
            assert kept[case, method].severe == []
        return kept[case, method]

    return call


@pytest.mark.parametrize("case", CASES)
def test_loads_are_in_the_range_of_the_reference_programs(runs, case):
    ours = bestest.quantities(runs(case, "ours"))
    for name, value, bounds in zip(bestest.QUANTITIES, ours, bestest.RANGES[case], strict=True):
        print(f"{case}, {name}: {value:.3f}, range {bounds[0]:.3f} to {bounds[1]:.3f}")
        assert bestest.is_within(value, bounds) != ((case, name) in bestest.STOCK_OUTSIDE), name


@pytest.mark.parametrize("case", SHADED)
def test_shades_change_loads_as_in_the_reference_programs(runs, case):
    shaded, plain = (bestest.quantities(runs(each, "ours")) for each in (case, SHADED[case]))
    for name, with_shades, without, bounds in zip(bestest.QUANTITIES, shaded, plain, bestest.DIFFERENCES[case],
                                                  strict=True):
        print(f"{case} - {SHADED[case]}, {name}: {with_shades - without:+.3f}, "
              f"range {bounds[0]:+.3f} to {bounds[1]:+.3f}")
        assert bestest.is_within(with_shades - without, bounds), name


@pytest.mark.parametrize("case", SHADED)
def test_loads_are_those_of_polygon_clipping(runs, case):
    ours, stock = runs(case, "ours"), runs(case, "stock")
    assert ours.method == "PixelCounting"
    for name, value, expected in zip(bestest.QUANTITIES, bestest.quantities(ours), bestest.quantities(stock),
                                     strict=True):
        print(f"{case}, {name}: {value:.5f}, polygon clipping {expected:.5f}, {100 * (value / expected - 1):+.4f} %")
        assert value == pytest.approx(expected, rel=1e-4), name
    assert bestest.beam(ours) == pytest.approx(bestest.beam(stock), rel=1e-4)

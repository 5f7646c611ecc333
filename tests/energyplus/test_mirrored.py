"""Sunlit fractions of shading surfaces' backs, the copies "Mir-...", where an output names them."""

import re

import pytest
from output_files import values_of
from shading_runs import energyplus

SUNLIT = "Surface Outside Face Sunlit Fraction"
# Before the south wall, one before the other: the sun lights their fronts, and their backs early and late in summer.
FINS = "".join(f"Shading:Building:Detailed,Fin {number},,4,{x},-{y},3,{x},-{y},0,{x + 0.3},-{y + 2},0,"
               f"{x + 0.3},-{y + 2},3;\n" for number, (x, y) in enumerate([(1.0, 1.0), (2.0, 1.5), (3.0, 1.2)], 1))


@pytest.fixture
def run_both(patched, weather, box, tmp_path):
    """{key: values at every timestep} with polygon clipping and with ours."""

    def call(outputs, *options):
        text = re.sub(r"Output:Variable,[^;]*;[^\n]*\n", "", box) + FINS + outputs + "Output:SQLite,Simple;\n"
        path = tmp_path / "model.idf"
        path.write_text(text)
        found = []
        for name, flags in (("clipped", []), ("ours", ["--gpu-shading", *options])):
            run = energyplus.run(patched, path, weather, tmp_path / name, [*flags, "-D"])
            assert run.completed, run.why()
            found.append(values_of(run, SUNLIT))
        return found

    return call


@pytest.mark.parametrize("key", ["Mir-Fin 2", "(Mir-)?Fin .*"])
@pytest.mark.parametrize("lean", ["off", "on"])
def test_named_backs_have_their_own_fraction(run_both, key, lean):
    clipped, ours = run_both(f"Output:Variable,{key},{SUNLIT},Timestep;\n", f"--gpu-shading-lean={lean}")
    assert "Mir-FIN 2" in clipped and clipped.keys() == ours.keys()
    for name in clipped:
        assert max(abs(a - b) for a, b in zip(clipped[name], ours[name], strict=True)) < 2e-3, name
    # Shaded in part by its neighbours, not 0 and not 1 all day.
    assert any(0.05 < value < 0.95 for value in clipped["Mir-FIN 2"])


def test_outputs_of_all_surfaces_have_those_of_shading_surfaces_too(run_both):
    clipped, ours = run_both(f"Output:Variable,*,{SUNLIT},Timestep;\n")
    assert {"FIN 2", "Mir-FIN 2", "SOUTH"} < clipped.keys() == ours.keys()
    for name in clipped:
        assert max(abs(a - b) for a, b in zip(clipped[name], ours[name], strict=True)) < 2e-3, name
    assert any(0.05 < value < 0.95 for value in clipped["Mir-FIN 2"])


SKY = "Surface Outside Face Incident Sky Diffuse Solar Radiation Rate per Area"


@pytest.mark.parametrize("distribution", ["FullInteriorAndExterior", "FullInteriorAndExteriorWithReflections"])
def test_so_has_the_sky_that_they_see(patched, weather, box, tmp_path, distribution):
    text = re.sub(r"Output:Variable,[^;]*;[^\n]*\n", "", box).replace("FullInteriorAndExterior,", f"{distribution},")
    path = tmp_path / "model.idf"
    path.write_text(text + FINS + f"Output:Variable,*,{SKY},Hourly;\nOutput:SQLite,Simple;\n")
    sums = []
    for name, flags in (("clipped", []), ("ours", ["--gpu-shading"])):
        run = energyplus.run(patched, path, weather, tmp_path / name, [*flags, "-D"])
        assert run.completed, run.why()
        sums.append({key: sum(values) for key, values in values_of(run, SKY).items()})
    assert sums[0].keys() == sums[1].keys() and {"FIN 2", "Mir-FIN 2"} < sums[0].keys()
    for name, clipped in sums[0].items():
        assert sums[1][name] == pytest.approx(clipped, rel=2e-3, abs=1.0), name

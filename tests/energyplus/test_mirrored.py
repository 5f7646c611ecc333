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


def test_backs_that_no_output_names_are_unshaded(run_both):
    clipped, ours = run_both(f"Output:Variable,*,{SUNLIT},Timestep;\n")
    for name in ("FIN 2", "Mir-FIN 2"):
        lit = [b for a, b in zip(clipped[name], ours[name], strict=True) if a > 0.0]
        assert lit and min(lit) > 0.999, name

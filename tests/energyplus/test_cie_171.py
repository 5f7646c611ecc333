"""Light of the sky through openings and past obstructions against closed forms, of the kind of CIE 171:2006's cases."""

import sys

import cie_171
import numpy as np
import pytest
from output_files import values_of
from shading_runs import energyplus

OF_WALL = [case for case in cie_171.CASES if case.wall]
TOLERANCES = {"EnergyPlus 144": 0.017, "Tregenza 145": 0.004, "Reinhart 577": 0.0025}  # of the ground's illuminance
TITLES = [case.title for case in cie_171.CASES]


@pytest.fixture(scope="module")
def package():
    sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
    return pytest.importorskip("gpu_shading", reason="scripts/build makes the library of the Python package")


@pytest.mark.parametrize("case", cie_171.CASES, ids=TITLES)
def test_closed_forms_are_the_sums_over_many_parts(case):
    for point in case.points:
        for sky in cie_171.SKIES:
            # Rows that an edge cuts are half of 1/1500 off at most.
            assert cie_171.over_parts(case, point, sky, 100, 1500) == pytest.approx(
                cie_171.exact(case, point, sky), abs=2e-4)


@pytest.mark.parametrize("glass", [False, True], ids=["open", "glass"])
@pytest.mark.parametrize("case", cie_171.CASES, ids=TITLES)
def test_rays_of_the_library(package, case, glass):
    scene = cie_171.scene_of(package, case, glass)
    for point in case.points:
        found = cie_171.by_rays(scene, point)
        for sky in cie_171.SKIES:
            expected = (cie_171.over_parts(case, point, sky, 100, 1500, glass=True) if glass
                        else cie_171.exact(case, point, sky))  # fmt: skip
            print(f"{case.title}, {point}, {sky}: {found[sky]:.5f}, expected {expected:.5f}")
            assert found[sky] == pytest.approx(expected, abs=2e-4)


@pytest.mark.parametrize("case", OF_WALL, ids=[case.title for case in OF_WALL])
def test_patches_of_the_sky(patched, case, tmp_path):
    folder = cie_171.sample_sky(patched, case, tmp_path)
    for patches in cie_171.PATCHES:
        for sky in cie_171.SKIES:
            found, expected = cie_171.on_wall_by_patches(folder, patches, sky), cie_171.on_wall(case, sky)
            print(f"{case.title}, {patches}, {sky}: {found:.4f}, closed form {expected:.4f}")
            assert found == pytest.approx(expected, abs=TOLERANCES[patches])


@pytest.mark.parametrize("case", cie_171.CASES, ids=TITLES)
def test_daylight_factors(official, patched, weather, case, tmp_path):
    """EnergyPlus sends one ray through each part of a window, and ours meets the mask, which is hidden from it."""
    stock, ours = (cie_171.daylight(case, program, weather, tmp_path / name, options)
                   for name, program, options in (
                       ("stock", official, ()), ("ours", patched, ("--gpu-shading", "--gpu-shading-lean=on"))))
    if case.mask:
        assert any("1 shading surface hidden" in line for line in ours.our_lines)
    assert ours.text("eplusout.dfs") == stock.text("eplusout.dfs")
    found = np.array(cie_171.daylight_factors(ours))
    parts = np.array([cie_171.over_parts(case, point, "overcast", *cie_171.energyplus_parts(case, point))
                      for point in case.points])
    exact = np.array([cie_171.exact(case, point, "overcast") for point in case.points])
    print(f"{case.title}: {found}, by EnergyPlus's parts {parts}, closed form {exact}")
    assert found == pytest.approx(parts, rel=0.01)
    assert found == pytest.approx(exact, rel=0.12 if case.mask else 0.01)
    if case.wall:
        # The share of the sky's diffuse radiation in the same run.
        (ratio,) = values_of(ours, "Debug Surface Solar Shading Model DifShdgRatioIsoSky")["OPENING"]
        print(f"diffuse solar: {ratio / 2:.4f}, closed form {cie_171.on_wall(case, 'uniform'):.4f}")
        assert ratio / 2 == pytest.approx(cie_171.on_wall(case, "uniform"), abs=TOLERANCES["EnergyPlus 144"])

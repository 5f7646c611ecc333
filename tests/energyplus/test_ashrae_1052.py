"""A window under an overhang and between fins against the closed form of ASHRAE 1052-RP."""

import sqlite3

import pytest
import window_with_shades as case
from shading_runs import energyplus

# Of the window's area. The closed form is exact; 512 pixels over 3 m are 6 mm a pixel, an edge is found
# to a third of that in the mean.
BOUND = 3e-3
SHADES = {"overhang": (True, False), "fins": (False, True), "both": (True, True)}


def timesteps(folder):
    """(azimuth, altitude, sunlit area) at each timestep of the day."""
    query = """SELECT d.Name, r.TimeIndex, r.Value FROM ReportData r JOIN ReportDataDictionary d
               USING (ReportDataDictionaryIndex) WHERE d.Name = ? ORDER BY r.TimeIndex"""
    with sqlite3.connect(folder / "eplusout.sql") as data:
        columns = [
            [value for _, _, value in data.execute(query, (name,))]
            for name in ("Site Solar Azimuth Angle", "Site Solar Altitude Angle", "Surface Outside Face Sunlit Area")
        ]
    data.close()
    return list(zip(*columns, strict=True))


def compare(program, options, weather, folder, orientation, shades):
    path = folder / "window.idf"
    path.write_text(case.model(orientation, *SHADES[shades]))
    run = energyplus.run(program, path, weather, folder / "out", ["-D", *options])
    assert run.completed, run.why()
    assert run.severe == []
    rows = timesteps(run.folder)
    lit = [(azimuth, altitude, area, case.sunlit_area(orientation, *SHADES[shades], azimuth, altitude))
           for azimuth, altitude, area in rows if altitude > 1]
    assert sum(expected > 0 for *_, expected in lit) > 20
    worst = max(lit, key=lambda row: abs(row[2] - row[3]))
    assert abs(worst[2] - worst[3]) < BOUND * case.SIZE**2, "azimuth, altitude, sunlit area, closed form"
    return run


@pytest.mark.parametrize("orientation", case.AZIMUTHS)
@pytest.mark.parametrize("shades", SHADES)
def test_sunlit_area_is_the_closed_form(patched, weather, tmp_path, orientation, shades):
    run = compare(patched, ["--gpu-shading"], weather, tmp_path, orientation, shades)
    assert run.method == "PixelCounting"


@pytest.mark.parametrize("orientation", case.AZIMUTHS)
def test_polygon_clipping_meets_it_too(official, weather, tmp_path, orientation):
    """Tells an error in the case from one in the renderer."""
    compare(official, [], weather, tmp_path, orientation, "both")

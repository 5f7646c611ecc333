"""Direct irradiance behind a perforated screen, against Radiance; scripts/dev/benchmark --radiance has a building."""

import pytest
import radiance
import screened_room
from shading_runs import energyplus

POINTS = 30_000  # on each receiver; their standard deviation is 3e-3 where half is sunlit, if they were not spread


@pytest.mark.parametrize("facing", ["south", "west"])
def test_irradiance_behind_a_screen_is_radiance_s(patched, weather, tmp_path, facing):
    if radiance.is_missing():
        pytest.skip(f"{radiance.FOLDER} is missing: scripts/setup could not fetch pyradiance")
    text = "".join(screened_room.generate.model(facing, "large holes"))
    model = tmp_path / "model.idf"
    model.write_text(radiance.with_days(text.replace("Timestep,4", "Timestep,1"), [(10, 21)]))
    report = tmp_path / "report"
    run = energyplus.run(patched, model, weather, tmp_path / "out",
                         ["-D", "--gpu-shading", f"--gpu-shading-report={report}"])
    assert run.completed, run.why()
    diameter = screened_room.generate.HOLES["large holes"]
    screen = (screened_room.generate.pitch(diameter), diameter, screened_room.generate.THICKNESS)
    building = radiance.Building(radiance.surfaces(patched.parent / "gpu_shading", model), screen, tmp_path, POINTS)
    ours = radiance.fractions(report)
    found = {(sun, name): difference for sun in radiance.spread(ours, 4)
             for name, difference in radiance.differences(building, sun, ours[sun]).items()}
    print("\n".join(f"{sun}, {name}: {difference:+.1e}" for (sun, name), difference in found.items()))
    assert len(found) >= 4
    assert max(map(abs, found.values())) < 5e-3

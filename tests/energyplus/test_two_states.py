"""Two EnergyPlus states at the same time in one process, each shaded with its own model."""

import subprocess
from pathlib import Path

import pytest
from shading_runs import energyplus, input_file, results

SOURCE = Path(__file__).resolve().parent / "hosts" / "two_states.c"

# EnergyPlus alone, without us: of 750 such pairs of runs, some 1 % differ in cooling energy, by up to 6e-9 of it, and
# in nothing else.
COOLING = "Zone Air System Sensible Cooling Energy"
OWN_SPREAD = 1e-7


def test_states_at_the_same_time_answer_as_runs_of_their_own(patched, courtyard, box, weather, tmp_path):
    program = tmp_path / "two_states"
    subprocess.run(["cc", "-Wall", "-Wextra", "-Werror", "-o", program, SOURCE, "-ldl", "-lpthread"], check=True)
    models = []
    for name, model in (("courtyard", input_file.read(courtyard)), ("box", input_file.Idf(box))):
        results.instrument(model)
        path = tmp_path / f"{name}.idf"
        model.write(path)
        (tmp_path / name).mkdir()
        models += [path, tmp_path / name]
    variables = {key: value for key, value in energyplus.os.environ.items() if not key.startswith("GPU_SHADING")}
    done = subprocess.run([program, patched.parent, "--gpu-shading=auto", weather, *models], cwd=tmp_path,
                          env=variables, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for path, folder in (models[:2], models[2:]):
        alone = energyplus.run(patched, path, weather, tmp_path / f"{path.stem}_alone", ["--gpu-shading", "-D"])
        assert alone.completed, alone.why()
        together, expected = (results.Results(place).values for place in (folder, alone.folder))
        cooling, expected_cooling = together.pop(COOLING), expected.pop(COOLING)
        assert together == expected
        assert cooling.keys() == expected_cooling.keys()
        for zone, values in cooling.items():
            assert values == pytest.approx(expected_cooling[zone], rel=OWN_SPREAD)

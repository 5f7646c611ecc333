"""gpu_shading sample --sky: against EnergyPlus's own ratios of sky diffuse shading, and a street's view factors."""

import csv
import math
import os
import subprocess

import pytest
import screened_room
from output_files import values_of
from shading_runs import energyplus
from test_map import of_period

SKIES = {"EnergyPlus 144": 144, "Tregenza 145": 145, "Reinhart 577": 577}
RATIO = "Debug Surface Solar Shading Model DifShdgRatio"


def call(*arguments, folder=None):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    command = [energyplus.patched_prefix() / "gpu_shading", "sample", "--sky", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder)


def tables(folder):
    for name in ("sky.csv", "sky_view.csv"):
        with open(folder / name, newline="", encoding="utf-8") as file:
            yield list(csv.DictReader(file))


@pytest.fixture(scope="session")
def courtyard_sky(patched, courtyard, tmp_path_factory):
    folder = tmp_path_factory.mktemp("sky") / "out"
    done = call(courtyard, "-o", folder)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [str(folder / "sky.csv"), str(folder / "sky_view.csv")]
    return list(tables(folder))


def test_ratios_are_those_of_energyplus(official, courtyard, courtyard_sky, weather, tmp_path):
    """With polygon clipping. It warns that it is inaccurate for the roofs, which are not convex."""
    model = of_period(courtyard, (6, 21), (6, 21))
    for sky in ("IsoSky", "Horiz"):
        model.add_output_variable(RATIO + sky, "Daily")
    model.write(tmp_path / "model.idf")
    run = energyplus.run(official, tmp_path / "model.idf", weather, tmp_path / "run")
    assert run.completed, run.why()
    theirs = [values_of(run, RATIO + sky) for sky in ("IsoSky", "Horiz")]
    ours = {row["receiver"]: row for row in courtyard_sky[1] if row["sky"] == "EnergyPlus 144"}
    assert len(ours) == 18
    errors = {True: [], False: []}
    for name, row in ours.items():
        errors[name.endswith("ROOF")] += [abs(float(row["ratio"]) - theirs[0][name][0]),
                                         abs(float(row["horizon ratio"]) - theirs[1][name][0])]
    print({roof: max(found) for roof, found in errors.items()})
    assert max(errors[False]) < 1e-4
    assert max(errors[True]) < 0.02


def test_view_factors_are_sums_over_patches(courtyard_sky):
    patches, views = courtyard_sky
    assert list(patches[0]) == ["sky", "patch", "azimuth", "altitude", "solid_angle", "receiver", "cosine",
                                "sunlit_fraction"]
    for view in views:
        rows = [row for row in patches if (row["sky"], row["receiver"]) == (view["sky"], view["receiver"])]
        weights = [float(row["cosine"]) * float(row["solid_angle"]) for row in rows]
        shaded = sum(weight * float(row["sunlit_fraction"]) for weight, row in zip(weights, rows, strict=True))
        assert shaded / sum(weights) == pytest.approx(float(view["ratio"]), abs=2e-6)
        # A plane of any tilt sees the sky in closed form, and patches by their centres nearly as much.
        unshaded = (1 + math.cos(math.radians(float(view["tilt [deg]"])))) / 2
        assert float(view["unshaded view factor"]) == pytest.approx(unshaded, abs=2e-6)
        assert float(view["shaded view factor"]) == pytest.approx(unshaded * float(view["ratio"]), abs=2e-6)
        assert sum(weights) / math.pi == pytest.approx(unshaded, rel=0.009)
    assert {name: max(int(row["patch"]) for row in patches if row["sky"] == name) for name in SKIES} == SKIES


def test_a_street_in_closed_form(patched, tmp_path):
    """A wall of 3 m across a street of 4 m from another: (H + W - sqrt(H^2 + W^2)) / 2 H (Hottel's crossed strings)."""
    path = tmp_path / "street.idf"
    path.write_text(screened_room.model(objects=screened_room.rectangle("Opposite", -4.0, -2000.0, 0.0, 2000.0, 3.0)))
    done = call(path, "-o", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    _, views = tables(tmp_path / "out")
    exact = (3 + 4 - math.hypot(3, 4)) / 6
    for sky in SKIES:
        rows = {row["receiver"]: row for row in views if row["sky"] == sky}
        areas, factors = ([float(rows[name][column]) for name in ("FRONT", "WINDOW")]
                          for column in ("area [m2]", "shaded view factor"))
        assert sum(areas) == pytest.approx(18.0, abs=1e-3)
        seen = sum(area * factor for area, factor in zip(areas, factors, strict=True)) / sum(areas)
        print(f"{sky}: {seen:.4f}, exact {exact:.4f}")
        assert seen == pytest.approx(exact, abs=0.01 if sky == "EnergyPlus 144" else 0.005)


@pytest.mark.parametrize("arguments", [("--mode", "fine"), ("--shard", "1/2"), ("--merge", "2")])
def test_sky_stands_alone(patched, box, tmp_path, arguments):
    (tmp_path / "box.idf").write_text(box)
    done = call("box.idf", "-o", "out", *arguments, folder=tmp_path)
    assert done.returncode == 1 and not (tmp_path / "out").exists()
    assert done.stderr.count("\n") == 1 and f"{arguments[0]} excludes --sky" in done.stderr

"""A study of a town: a run for each building of its map, shaded by its neighbours."""

import csv
import importlib.util
import json
import math
import subprocess

import pytest

# Golden, Colorado, as the box's weather.
LATITUDE, LONGITUDE = 39.74, -105.18
METRES = 111_320.0
DAY = "RunPeriod,Day,12,21,,12,21,,Sunday;\n"


def footprint(east, north, side=8.0):
    """A square around a place, in metres from the town's middle."""
    def point(x, y):
        return [LONGITUDE + (east + x) / METRES / math.cos(math.radians(LATITUDE)), LATITUDE + (north + y) / METRES]

    half = side / 2
    return [[point(x, y) for x, y in ((-half, -half), (half, -half), (half, half), (-half, half), (-half, -half))]]


@pytest.fixture(scope="module")
def town(tmp_path_factory, louvres):
    """A tower 20 m south of a house, and a farm 500 m away."""
    folder = tmp_path_factory.mktemp("town")
    places = {"house": (0, 0, 3), "tower": (0, -20, 60), "farm": (500, 0, 3)}
    features = [{"type": "Feature", "id": name, "properties": {"height": height},
                 "geometry": {"type": "Polygon", "coordinates": footprint(east, north)}}
                for name, (east, north, height) in places.items()]
    (folder / "town.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    text = louvres(0)
    begin = text.index("RunPeriod,")
    (folder / "box.idf").write_text(text[:begin] + DAY + text[text.index(";", begin) + 1:])
    return folder


def call(patched, *arguments, cwd):
    return subprocess.run([patched.parent / "gpu_shading", *map(str, arguments)], cwd=cwd, capture_output=True,
                          text=True)


def test_each_building_is_shaded_by_its_neighbours(patched, town, weather):
    if not importlib.util.find_spec("distributed"):
        pytest.skip("Dask is missing: run scripts/setup")
    made = call(patched, "city", "town.geojson", "--template", "box.idf", "-w", weather, "--radius", 100, "-o", "plan",
                cwd=town)
    assert (made.returncode, made.stdout) == (0, "plan/plan.csv\n"), made.stderr
    done = call(patched, "study", "plan/plan.csv", "-o", "out", "--workers", 1, "--keep", "nothing", cwd=town)
    assert done.returncode == 0, done.stderr
    with open(town / "out" / "runs.csv", newline="", encoding="utf-8") as lines:
        rows = {row["variant"]: row for row in csv.DictReader(lines)}
    assert set(rows) == {"house", "tower", "farm"} and {row["status"] for row in rows.values()} == {"done"}
    solar = {name: float(row["Transmitted Solar [kWh]"]) for name, row in rows.items()}
    # The farm's neighbours are out of reach. The house's shade the tower's north side alone, which has no window; the
    # tower stands in the low sun of December.
    assert solar["tower"] == pytest.approx(solar["farm"], rel=0.02)
    assert solar["house"] < 0.8 * solar["farm"]


def test_neighbours_are_those_within_the_radius(patched, town, weather):
    made = call(patched, "city", "town.geojson", "--template", "box.idf", "-w", weather, "--radius", 100, "-o", "near",
                cwd=town)
    assert made.returncode == 0, made.stderr
    with open(town / "near" / "plan.csv", newline="", encoding="utf-8") as lines:
        plan = list(csv.DictReader(lines))
    for row, buildings in zip(plan, (1, 1, 0), strict=True):
        told = call(patched, "check", "box.idf", f"--gpu-shading-file={town / 'near' / row['extensions']}", cwd=town)
        assert f": {buildings} building{'s' * (buildings != 1)} within 100 m" in told.stdout, told.stdout + told.stderr


def test_models_have_places_in_a_table(patched, town, weather):
    (town / "models" / "a").mkdir(parents=True)
    (town / "models" / "a" / "in.idf").write_text((town / "box.idf").read_text())
    (town / "places.csv").write_text(f"model,latitude,longitude\na/in.idf,{LATITUDE},{LONGITUDE}\n")
    options = ("city", "town.geojson", "--models", "models", "-w", weather)
    made = call(patched, *options, "--places", "places.csv", "-o", "placed", cwd=town)
    assert made.returncode == 0, made.stderr
    text = (town / "placed" / "context" / "0000001.idf").read_text()
    assert text.endswith(",house;\n") and f"{LATITUDE:.9f},{LONGITUDE:.9f}" in text
    again = call(patched, *options, "-o", "placed", cwd=town)
    assert again.returncode != 0 and "placed: exists and is not empty" in again.stderr
    (town / "places.csv").write_text("model,latitude,longitude\nb/in.idf,91,0\n")
    wrong = call(patched, *options, "--places", "places.csv", "-o", "other", cwd=town)
    assert 'places.csv: line 2: latitude is "91", expected -90 to 90' in wrong.stderr
    assert not (town / "other").exists()

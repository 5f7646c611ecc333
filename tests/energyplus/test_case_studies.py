"""The two large examples: their counts and geometry at full size, and runs of the small ones of the same kind."""

import importlib.util
import itertools
import math
import os
import re
import subprocess
import sys

import pytest
from shading_runs import energyplus, input_file, results

EXAMPLES = energyplus.REPOSITORY / "idf_examples"


def load(folder):
    # Not by its name, which other examples' generators have too.
    spec = importlib.util.spec_from_file_location(f"{folder}_generate", EXAMPLES / folder / "generate.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # for its dataclasses
    spec.loader.exec_module(module)
    return module


academic, hotel = load("academic_building"), load("hotel")

# Zones, receivers and shading surfaces.
COUNTS = {
    "academic": (34, 149, 32709),
    "hotel": (130, 2385, 94997),
    "small academic": (16, 77, 2437),
    "small hotel": (20, 133, 3719),
}
FULL = {"academic": academic, "hotel": hotel}


@pytest.fixture(scope="module", params=FULL)
def full(request, tmp_path_factory):
    """(name, generator, path of the model)."""
    generator = FULL[request.param]
    path = tmp_path_factory.mktemp("full") / "model.idf"
    path.write_text("".join(generator.model()))
    return request.param, generator, path


class Outside:
    """What a model's text has outside: zones, opaque surfaces, openings and the surfaces they are in, shading."""

    def __init__(self, text):
        rooms = without_shading(text)
        kinds = [kind for kind, _, _, _ in rooms.objects]
        self.zones = kinds.count("zone")
        self.openings = kinds.count("fenestrationsurface:detailed")
        self.opaque = sum(kind == "buildingsurface:detailed" and rooms.text[slice(*fields[7])] == "SunExposed"
                          for kind, fields, _, _ in rooms.objects)  # fmt: skip
        self.with_openings = len({rooms.text[slice(*fields[3])] for kind, fields, _, _ in rooms.objects
                                  if kind == "fenestrationsurface:detailed"})  # fmt: skip
        self.shading = len(re.findall(r"^Shading:(?:Site|Building|Zone):Detailed,", text, re.MULTILINE))

    @property
    def counts(self):
        return self.zones, self.opaque + self.openings, self.shading


def without_shading(text):
    """The model but for shading surfaces and what follows them, which takes a while to read."""
    return input_file.Idf(text.split("\nShading:")[0])


def test_full_size_is_what_it_is_said_to_be(full, patched):
    name, _, path = full
    assert Outside(path.read_text()).counts == COUNTS[name]
    done = subprocess.run([patched.parent / "gpu_shading", "check", path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    first, *rows = done.stdout.splitlines()
    assert first.startswith(f"lean input: {COUNTS[name][2]} shading surfaces hidden")
    assert sum("  Shading:Site:Detailed  " in row for row in rows) == COUNTS[name][2]
    assert not any("no area" in row for row in rows)


def newell(corners):
    """Twice a polygon's area along its normal."""
    total = (0.0, 0.0, 0.0)
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        total = (total[0] + (a[1] - b[1]) * (a[2] + b[2]), total[1] + (a[2] - b[2]) * (a[0] + b[0]),
                 total[2] + (a[0] - b[0]) * (a[1] + b[1]))  # fmt: skip
    return total


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def middle(corners):
    return tuple(sum(values) / len(corners) for values in zip(*corners, strict=True))


def test_every_caster_is_a_plane_polygon_outside_the_rooms(full):
    _, generator, _ = full
    boxes = [(room.low, room.high) for room in generator.building()]
    low = tuple(map(min, *(box[0] for box in boxes)))
    high = tuple(map(max, *(box[1] for box in boxes)))

    def inside(point, box, by=1e-6):
        return all(a + by < value < b - by for a, value, b in zip(box[0], point, box[1], strict=True))

    names = set()
    for name, corners in itertools.chain(*generator.casting().values()):
        names.add(name.upper())
        normal = newell(corners)
        double_area = math.hypot(*normal)
        assert double_area > 2e-3, name
        for corner in corners:
            assert abs(dot(normal, corner) - dot(normal, corners[0])) < 1e-6 * double_area, name
        for point in (*corners, middle(corners)):
            assert not inside(point, (low, high)) or not any(inside(point, box) for box in boxes), name
    assert len(names) == sum(1 for _ in itertools.chain(*generator.casting().values()))


def vertices(model, fields, before):
    values = [float(model.text[slice(*place)]) for place in fields[before:]]
    return list(zip(values[::3], values[1::3], values[2::3], strict=True))


def test_outside_surfaces_face_outward_and_openings_lie_in_them(full):
    _, generator, path = full
    model = without_shading(path.read_text())
    rooms = {room.name: middle([room.low, room.high]) for room in generator.building()}
    walls, covered = {}, {}
    for kind, fields, _, _ in model.objects:
        name = model.text[slice(*fields[0])] if fields else ""
        if kind == "buildingsurface:detailed":
            corners = vertices(model, fields, 11)
            centre = rooms[model.text[slice(*fields[3])]]
            outward = [a - b for a, b in zip(corners[0], centre, strict=True)]
            assert dot(newell(corners), outward) > 0, name
            walls[name] = corners
        elif kind == "fenestrationsurface:detailed":
            wall = model.text[slice(*fields[3])]
            corners = vertices(model, fields, 9)
            assert dot(newell(corners), newell(walls[wall])) > 0, name
            for axis in range(3):
                bounds = [corner[axis] for corner in walls[wall]]
                assert all(min(bounds) - 1e-6 <= corner[axis] <= max(bounds) + 1e-6 for corner in corners), name
            covered.setdefault(wall, []).append(corners)
    for wall, openings in covered.items():
        for one, other in itertools.combinations(openings, 2):
            overlaps = [min(max(c[i] for c in one), max(c[i] for c in other))
                        - max(min(c[i] for c in one), min(c[i] for c in other)) for i in range(3)]
            assert min(value for value in overlaps if abs(value) > 0) < 0 or overlaps.count(0.0) > 1, wall
    # Every side of every room has a surface: closed boxes.
    assert len(walls) >= 6 * len(rooms)


@pytest.fixture(scope="module")
def ran(patched, tmp_path_factory):
    """Runs a small model for two days, each variant only once: (the run, the model's text)."""
    known = {}

    def call(name, *variant):
        if (name, variant) not in known:
            folder = tmp_path_factory.mktemp(name.replace(" ", "_"))
            path = folder / "model.idf"
            generator = FULL[name.removeprefix("small ")]
            text = "".join(generator.model(*variant, size=generator.SMALL))
            text = text.replace("RunPeriod,Year,1,1,,12,31,", "RunPeriod,Days,12,20,,12,21,")
            path.write_text(text)
            if variant == ("gradient",):
                generator.write_image(folder / generator.IMAGE, generator.SMALL)
            weather = {"small academic": "USA_IL_Chicago-OHare.Intl.AP.725300_TMY3.epw",
                       "small hotel": "USA_FL_Tampa.Intl.AP.722110_TMY3.epw"}[name]  # fmt: skip
            run = energyplus.run(patched, path, energyplus.find_weather(weather), folder / "run",
                                 ["--gpu-shading", "--gpu-shading-resolution=64"])  # fmt: skip
            assert run.completed, run.why()
            known[name, variant] = run, text
        return known[name, variant]

    return call


SCREENS = [("small",), ("large",), ("gradient",)]
SHELLS = [("single", 20.0), ("single", 90.0), ("triple", 20.0)]
RUNS = [*(("small academic", *screen) for screen in SCREENS), *(("small hotel", *shell) for shell in SHELLS)]


@pytest.mark.parametrize("variant", RUNS, ids=lambda variant: " ".join(map(str, variant)))
def test_small_model_runs_and_counts(variant, ran):
    run, text = ran(*variant)
    assert run.severe == []
    outside = Outside(text)
    assert outside.counts == COUNTS[variant[0]]
    # Of walls that have openings the scene holds two, with them and without.
    casters = outside.shading + outside.opaque + outside.with_openings
    assert f"{outside.counts[1]} receivers, {casters} casters" in run.rendering
    for variable in (results.IDEAL_HEATING, results.IDEAL_COOLING):
        assert len(results.energies(run.folder, variable)) == outside.zones
    assert sum(results.energies(run.folder, results.IDEAL_COOLING).values()) > 0


def beam(run, words):
    """Through all windows whose name has the words."""
    return sum(energy for window, energy in results.energies(run.folder, results.BEAM).items() if words in window)


def test_larger_holes_of_the_same_share_admit_more(ran):
    (small, _), (large, _), (gradient, _) = (ran("small academic", *screen) for screen in SCREENS)
    # Behind the screen; by how much is in the example's README.
    for run in (large, gradient):
        assert beam(run, "LEVEL 2 SOUTH") > 1.5 * beam(small, "LEVEL 2 SOUTH") > 0
        # The roof has next to none before it: the screen reaches 0.9 m above its edge.
        assert beam(run, "SKYLIGHT") == pytest.approx(beam(small, "SKYLIGHT"), rel=1e-3)


def test_triple_glass_admits_less(ran):
    (single, _), (upright, _), (triple, _) = (ran("small hotel", *shell) for shell in SHELLS)
    for rooms in ("SOUTH ROOMS", "LOUNGE", "END"):
        assert 0 < beam(triple, rooms) < 0.95 * beam(single, rooms)
        # No sheet of three lets through less than a third of what one does before the sun stands along it.
        assert beam(triple, rooms) > 0.3 * beam(single, rooms)
        assert beam(upright, rooms) != pytest.approx(beam(single, rooms), rel=1e-3)


def test_study_times_samples_of_every_variant(tmp_path, patched):
    command = [sys.executable, EXAMPLES / "academic_building" / "study.py", "--small", "--samples", "coarse",
               "--device", "cpu", "-o", tmp_path]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=300,
                          env=os.environ | {"GPU_SHADING_ERROR": "0.02"})
    assert done.returncode == 0, done.stderr
    rows = re.findall(r"^\| (.+) \| ([\d.]+) \((\d+)\) \|$", done.stdout, re.MULTILINE)
    assert [name for name, *_ in rows] == ["holes of 6.35 mm", "holes of 25.4 mm", "gradient"]
    for number, (_, seconds, directions) in enumerate(rows):
        assert float(seconds) > 0
        samples = (tmp_path / str(number) / "coarse" / "samples.csv").read_text().splitlines()[1:]
        assert len({tuple(line.split(",")[1:3]) for line in samples}) <= int(directions)
        assert samples

"""Whole runs with perforated screens: what passes against closed forms, schedules and one another."""

import math
import struct
import subprocess
import zlib

import pytest
import screened_room as room
from shading_runs import energyplus, input_file, results

generate = room.generate
SMALL, LARGE = generate.HOLES["small holes"], generate.HOLES["large holes"]
DETAILED_SKY = "PixelCounting,Timestep,,15000,,512,DetailedSkyDiffuseModeling"


def screen_surface(facing="south"):
    return room.rectangle("Screen", -generate.DISTANCE, *generate.SCREEN, facing)


SCREEN = screen_surface()


def holes(diameter, detail="Auto", thickness=generate.THICKNESS, surface="Screen", schedule=""):
    return (f"GPUShading:PerforatedScreen,{surface} Sheet,{surface},Round,,Staggered60,{diameter},,"
            f"{generate.pitch(diameter)},,{thickness},,,,,,,,,,,{schedule},{detail};\n")


@pytest.fixture(scope="module")
def ran(patched, weather, tmp_path_factory):
    """Runs a model's design day, each only once, and gives its timesteps."""
    known = {}

    def call(text, options=("-D",), pixels=128, image=None):
        key = text, options, pixels, image
        if key not in known:
            folder = tmp_path_factory.mktemp("room")
            (folder / "model.idf").write_text(text)
            if image:
                (folder / "tile.png").write_bytes(image)
            run = energyplus.run(patched, folder / "model.idf", weather, folder / "run",
                                 ["--gpu-shading", f"--gpu-shading-resolution={pixels}", *options])
            assert run.completed, run.why()
            assert run.severe == []
            known[key] = room.timesteps(run)
        return known[key]

    return call


def lit(steps):
    """Timesteps at which the sun comes in, enough of it to compare."""
    most = max(steps["beam"])
    return [i for i, value in enumerate(steps["beam"]) if value > 0.02 * most]


def transmittances(bare, facing, diameter):
    """{timestep: closed form}, of those at which the window is wholly behind the screen."""
    found = {}
    for i in lit(bare):
        behind, share = room.passing(facing, diameter, bare["azimuth"][i], bare["altitude"][i])
        if behind > 0.9999:
            found[i] = share
    assert len(found) > 12
    return found


def diffuse(steps):
    return sum(steps["all"]) - sum(steps["beam"])


@pytest.mark.parametrize("sky", ["SimpleSkyDiffuseModeling", "DetailedSkyDiffuseModeling"])
def test_sheet_without_thickness_is_a_constant_schedule(sky, ran, official, weather, tmp_path):
    shadow = f"PolygonClipping,Timestep,,15000,,512,{sky}"
    path = tmp_path / "model.idf"
    path.write_text(room.model(screen="schedule", shadow=shadow))
    run = energyplus.run(official, path, weather, tmp_path / "run", ["-D"])
    assert run.completed, run.why()
    clip = room.timesteps(run)
    answer = ran(room.model(objects=SCREEN + holes(SMALL, thickness=0), shadow=shadow),
                 options=("-D", "--gpu-shading-reflections=energyplus"))
    for i in lit(clip):
        assert answer["beam"][i] == pytest.approx(clip["beam"][i], rel=3e-3)
    assert sum(answer["beam"]) == pytest.approx(sum(clip["beam"]), rel=1e-3)
    assert diffuse(answer) == pytest.approx(diffuse(clip), rel=3e-3)


@pytest.mark.parametrize("facing, diameter, detail, pixels, most", [
    ("south", SMALL, "Effective", 64, 1e-4),
    ("south", SMALL, "Auto", 128, 1e-4),
    ("south", LARGE, "Auto", 512, 2e-3),
    ("south", LARGE, "Holes", 512, 3e-3),
    ("east", LARGE, "Effective", 64, 1e-4),
    ("west", SMALL, "Effective", 64, 1e-4),
])
def test_thick_sheet_passes_what_its_round_holes_do(facing, diameter, detail, pixels, most, ran):
    bare = ran(room.model(facing), pixels=64)
    answer = ran(room.model(facing, objects=screen_surface(facing) + holes(diameter, detail)), pixels=pixels)
    errors = [answer["beam"][i] / bare["beam"][i] - share
              for i, share in transmittances(bare, facing, diameter).items()]
    print(f"most {max(map(abs, errors)):.1e}, mean {sum(errors) / len(errors):+.1e}, {len(errors)} timesteps")
    assert max(map(abs, errors)) < most


@pytest.mark.parametrize("facing, screen", [("west", "small holes")])
def test_year_behind_a_screen_is_the_closed_form(facing, screen, ran):
    bare = ran(room.model(facing), options=(), pixels=64)
    answer = ran(room.model(facing, screen), options=(), pixels=64)
    expected = 0.0
    for azimuth, altitude, beam in zip(bare["azimuth"], bare["altitude"], bare["beam"], strict=True):
        behind, share = room.passing(facing, generate.HOLES[screen], azimuth, altitude)
        expected += beam * (1 - behind * (1 - share))
    assert expected > 0.05 * sum(bare["beam"])
    assert sum(answer["beam"]) == pytest.approx(expected, rel=0.01)


def png(columns, rows, kind, lines):
    """8 bits a channel; of a kind of PNG's: 0 grey, 6 red, green, blue and alpha."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", columns, rows, 8, kind, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + line for line in lines))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def tile_image(diameter, columns, rows):
    """A tile of staggered holes as a PNG of black whose alpha is the sheet."""
    pitch = generate.pitch(diameter)
    width, height = pitch, pitch * math.sqrt(3)
    centres = [(0, 0), (width, 0), (0, height), (width, height), (width / 2, height / 2)]

    def opacity(column, row):
        parts = [(k + 0.5) / 4 for k in range(4)]
        points = [((column + a) / columns * width, (rows - row - b) / rows * height) for a in parts for b in parts]
        solid = sum(all(math.dist(point, centre) > diameter / 2 for centre in centres) for point in points)
        return round(255 * solid / len(points))

    return png(columns, rows, 6, [b"".join(bytes((0, 0, 0, opacity(column, row))) for column in range(columns))
                                  for row in range(rows)])


def test_texture_of_the_pattern_passes_what_the_pattern_does(ran):
    pitch = generate.pitch(LARGE)
    texture = ("GPUShading:PerforatedScreen,Image,Screen,Texture,tile.png,,,,,,"
               f"{generate.THICKNESS},,,,,,{pitch},{pitch * math.sqrt(3)};\n")
    pattern = ran(room.model(screen="large holes"))
    image = ran(room.model(objects=SCREEN + texture), image=tile_image(LARGE, 96, 166))
    largest = max(pattern["beam"])
    for i in lit(pattern):
        assert image["beam"][i] == pytest.approx(pattern["beam"][i], rel=0.01, abs=2e-3 * largest)
    assert sum(image["beam"]) == pytest.approx(sum(pattern["beam"]), rel=0.01)
    assert diffuse(image) == pytest.approx(diffuse(pattern), rel=0.01)


@pytest.mark.parametrize("facing", generate.AZIMUTHS)
def test_image_lies_upright_and_is_not_mirrored(facing, ran):
    # Open in its lower left quarter, as seen from outside.
    image = png(72, 40, 0, [b"\xff" * 72] * 20 + [b"\0" * 36 + b"\xff" * 36] * 20)
    left, bottom, right, top = generate.SCREEN
    quarter = left, bottom, (left + right) / 2, (bottom + top) / 2
    bare = ran(room.model(facing), pixels=64)
    sheet = "GPUShading:PerforatedScreen,Image,Screen,Texture,tile.png,,,,,,0;\n"
    answer = ran(room.model(facing, objects=screen_surface(facing) + sheet), pixels=256, image=image)
    found = set()
    for i in transmittances(bare, facing, SMALL):
        expected = room.seen_through(quarter, *room.slant(facing, bare["azimuth"][i], bare["altitude"][i]))
        assert answer["beam"][i] / bare["beam"][i] == pytest.approx(expected, abs=3e-3)
        found.add(round(expected, 1))
    assert len(found) > 3


def test_ways_to_calculate_agree(ran):
    first = ran(room.model(screen="large holes"))
    periodic = ran(room.model(screen="large holes", shadow="PixelCounting,Periodic,20"))
    detailed = ran(room.model(screen="large holes", shadow=DETAILED_SKY))
    inside = ran(room.model(screen="large holes", solar="FullInteriorAndExterior"))
    for other in (periodic, detailed, inside):
        assert sum(other["beam"]) == pytest.approx(sum(first["beam"]), rel=1e-3)
        assert diffuse(other) == pytest.approx(diffuse(first), rel=1e-3)


def test_beam_falls_on_the_floor_by_what_passes(ran):
    bare = ran(room.model(solar="FullInteriorAndExterior"))
    # By the effect of the holes: a few of them over the floor's share of the window are no mean.
    answer = ran(room.model(objects=SCREEN + holes(LARGE, detail="Effective"), solar="FullInteriorAndExterior"))
    compared = 0
    for i in lit(bare):
        if bare["floor"][i] > 0:
            expected = bare["floor"][i] * answer["beam"][i] / bare["beam"][i]
            # At the first and last step, the floor has less than 1e-5 of the beam.
            assert answer["floor"][i] == pytest.approx(expected, rel=2e-3, abs=1e-6 * answer["beam"][i])
            compared += 1
    assert compared > 12


def test_lean_input_keeps_screens(ran):
    sails = "Schedule:Compact,Sails,,Through: 12/31,For: AllDays,Until: 12:00,0.25,Until: 24:00,1;\n"
    text = room.model(objects=SCREEN + sails + holes(LARGE, schedule="Sails"))
    full, lean = (ran(text, options=("-D", f"--gpu-shading-lean={choice}")) for choice in ("off", "on"))
    assert max(full["beam"]) > 0
    assert lean["beam"] == full["beam"]
    # Receivers have other rays for reflected light.
    assert diffuse(lean) == pytest.approx(diffuse(full), rel=5e-3)


def test_screen_is_away_when_its_schedule_says(ran):
    sails = "Schedule:Compact,Sails,,Through: 12/31,For: AllDays,Until: 11:00,0,Until: 14:00,1,Until: 24:00,0.25;\n"
    bare, whole = ran(room.model()), ran(room.model(screen="large holes"))
    answer = ran(room.model(objects=SCREEN + sails + holes(LARGE, schedule="Sails")))
    seen = set()
    for i in lit(bare):
        share = 0 if i < 44 else 1 if i < 56 else 0.25  # timesteps are a quarter of an hour
        expected = share * whole["beam"][i] + (1 - share) * bare["beam"][i]
        assert answer["beam"][i] == pytest.approx(expected, rel=1e-3)
        seen.add(share)
    assert len(seen) == 3


GLASS = "GPUShading:TransparentShade,Pane,Other,Constant,0.6;\n"
OTHERS = {
    "overhang": (room.ledge("Other", -0.05, -0.35), room.ledge("Other", -0.6, -1.2, 2.9)),
    "glass": (room.rectangle("Other", -0.2, x2=3) + GLASS, room.rectangle("Other", -1, x2=3) + GLASS),
    "screen": tuple(room.rectangle("Other", y) + holes(LARGE, "Effective", surface="Other") for y in (-0.2, -1)),
}


@pytest.mark.parametrize("place", [0, 1], ids=["behind the screen", "before it"])
@pytest.mark.parametrize("other", OTHERS)
def test_screen_and_another_shade_multiply(other, place, ran):
    bare = ran(room.model())
    alone = ran(room.model(objects=OTHERS[other][place]))
    both = ran(room.model(objects=OTHERS[other][place] + SCREEN + holes(SMALL)))
    assert sum(alone["beam"]) < 0.97 * sum(bare["beam"])
    for i, share in transmittances(bare, "south", SMALL).items():
        expected = share * alone["beam"][i] / bare["beam"][i]
        assert both["beam"][i] / bare["beam"][i] == pytest.approx(expected, abs=2e-3)


def test_epjson_answers_as_idf_does(patched, official, weather, tmp_path):
    text = input_file.Idf(room.model(objects=SCREEN))
    results.instrument(text)
    plain = tmp_path / "plain.idf"
    text.write(plain)
    subprocess.run([official.parent / "ConvertInputFormat", plain], cwd=tmp_path, check=True, capture_output=True)
    converted = input_file.read(tmp_path / "plain.epJSON")
    converted.data["GPUShading:PerforatedScreen"] = {"Sheet": {
        "surface_name": "Screen", "hole_shape": "Round", "hole_size": LARGE, "pitch": generate.pitch(LARGE),
        "thickness": generate.THICKNESS}}
    converted.write(tmp_path / "model.epJSON")
    (tmp_path / "model.idf").write_text(text.text + "\n" + holes(LARGE))
    found = []
    for ending in ("idf", "epJSON"):
        run = energyplus.run(patched, tmp_path / f"model.{ending}", weather, tmp_path / ending,
                             ["--gpu-shading", "--gpu-shading-resolution=128", "-D"])
        assert run.completed, run.why()
        assert "perforated (round holes 25.4 mm" in run.text("eplusout.eio")
        found.append(results.Results(run.folder).values)
    for variable in (results.SUNLIT, results.BEAM, results.SOLAR):
        for name, values in found[0][variable].items():
            assert found[1][variable][name] == pytest.approx(values, rel=1e-6, abs=1e-6)

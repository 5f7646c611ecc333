"""Perforated screens as input: what is refused, what is listed, and where a tile lies on a surface."""

import re
import struct
import subprocess
import zlib

import pytest
from shading_runs import energyplus
from shading_runs.version import input_version

CORNERS = ("UpperLeftCorner", "LowerLeftCorner", "LowerRightCorner", "UpperRightCorner")
PATTERN = "GPUShading:PerforatedScreen,Mesh,{surfaces},Round,,,0.005,,0.008,,0.003;\n"
TEXTURE = "GPUShading:PerforatedScreen,Leaves,{surfaces},Texture,{file},,,,,,0.003;\n"

HEAD = f"Version,{input_version()};\n" + """\
SimulationControl,No,No,No,Yes,No;
Building,Box,0,Country,0.04,0.4,FullExterior,25,6;
Timestep,4;
ShadowCalculation,PolygonClipping,Timestep;
Site:Location,Atlanta,33.65,-84.42,-5,315;
SizingPeriod:DesignDay,21 August,8,21,SummerDesignDay,32,10,DefaultMultipliers,,WetBulb,22,,,,,97600,3,230,
  No,No,No,ASHRAEClearSky,,,,,1.0;
GlobalGeometryRules,{corner},{turn},World;
Material:NoMass,Insulation,Rough,3,0.9,0.7,0.7;
WindowMaterial:SimpleGlazingSystem,Glazing,5,0.8;
Construction,Outer Wall,Insulation;
Construction,Glass,Glazing;
Zone,Box;
"""


def model(corner="UpperLeftCorner", turn="Counterclockwise"):
    """A box with shades before its south wall, written in the order that the rules name.

    Rectangles are given here counterclockwise from the lower left corner, as seen from outside.
    """

    def vertices(rectangle):
        low_left, low_right, up_right, up_left = rectangle
        names = [*CORNERS]
        ring = [up_left, low_left, low_right, up_right]
        if turn == "Clockwise":
            names[1:], ring[1:] = names[:0:-1], ring[:0:-1]
        first = names.index(corner)
        return ",".join(f"{c:g}" for point in ring[first:] + ring[:first] for c in point) + ";\n"

    def wall(name, kind, *rectangle):
        return (f"BuildingSurface:Detailed,{name},{kind},Outer Wall,Box,,Outdoors,,SunExposed,WindExposed,,4,"
                + vertices(rectangle))

    def south(y, low, high):
        return [(1, y, low), (3, y, low), (3, y, high), (1, y, high)]

    return "".join([
        HEAD.format(corner=corner, turn=turn),
        wall("Front", "Wall", (0, 0, 0), (4, 0, 0), (4, 0, 3), (0, 0, 3)),
        wall("Right", "Wall", (4, 0, 0), (4, 6, 0), (4, 6, 3), (4, 0, 3)),
        wall("Back", "Wall", (4, 6, 0), (0, 6, 0), (0, 6, 3), (4, 6, 3)),
        wall("Left", "Wall", (0, 6, 0), (0, 0, 0), (0, 0, 3), (0, 6, 3)),
        wall("Top", "Roof", (0, 0, 3), (4, 0, 3), (4, 6, 3), (0, 6, 3)),
        wall("Base", "Floor", (0, 6, 0), (4, 6, 0), (4, 0, 0), (0, 0, 0)),
        "FenestrationSurface:Detailed,Window,Window,Glass,Front,,,,,4," + vertices(south(0, 1, 2)),
        "Shading:Building:Detailed,Building Panel,,4," + vertices(south(-1, 0.5, 2.5)),
        "Shading:Site:Detailed,Site Panel,,4," + vertices(south(-2, 0.5, 2.5)),
        "Shading:Zone:Detailed,Zone Panel,Front,,4," + vertices(south(-3, 0.5, 2.5)),
        "Shading:Site,Plain Panel,180,90,10,-1,0,2,1;\n",
        "Shading:Overhang,Hood,Window,0.1,90,0,0,0.6;\n",
        "Shading:Fin,Blade,Window,0,0,0,90,0.5,0,0,0,90,0.5;\n",
    ])


def write_grey_image(path, rows):
    """An 8-bit PNG of one channel."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b""))


@pytest.fixture
def check(patched, tmp_path):
    """{surface: its line and the line below} of `gpu_shading check`."""
    def call(text):
        path = tmp_path / "model.idf"
        path.write_text(text)
        done = subprocess.run([patched.parent / "gpu_shading", "check", path], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        lines = done.stdout.splitlines()
        return {line.split("  ")[0]: (line, below) for line, below in zip(lines, [*lines[1:], ""], strict=True)}

    return call


def tile(row):
    """The tile's (0, 0), u and v."""
    below = row[1]
    assert below.startswith("    tile from (")
    return [tuple(map(float, numbers.split(","))) for numbers in re.findall(r"\(([^)]*)\)", below)]


def assert_refused(run, message):
    assert run.status == 1
    ours = [line for line in run.errors.splitlines() if line.startswith("gpu_shading: ")]
    assert ours == [f"gpu_shading: error: {message}"]
    assert message.partition("\n")[0] in run.text("eplusout.err")
    assert not run.text("eplusout.eio")


@pytest.mark.parametrize("screen, message", [
    (PATTERN.format(surfaces="tree *"),
     'GPUShading:PerforatedScreen Mesh: Surface Name is "tree *", which no shading surface of the model matches'),
    (PATTERN.format(surfaces="*").replace("0.008", "0.004"),
     "GPUShading:PerforatedScreen Mesh: Hole Size is 0.005 m, expected less than the pitch, 0.004 m"),
    (PATTERN.format(surfaces="*").replace("Round", "Oval"),
     'GPUShading:PerforatedScreen Mesh: Hole Shape is "Oval", expected Texture, Round, Square, Slotted or Hexagonal'),
    # A comma left out: the first field with a wrong value is named, not the last.
    (PATTERN.format(surfaces="*").replace("Round,,", "Round,"),
     'GPUShading:PerforatedScreen Mesh: Arrangement is "0.005", expected Straight, Staggered45 or Staggered60'),
    (PATTERN.format(surfaces="*").replace("Round,,,", "Round,Straight,,"),
     'GPUShading:PerforatedScreen Mesh: Texture File Name is "Straight", expected blank with Hole Shape Round'),
    (PATTERN.format(surfaces="hood") + "GPUShading:TransparentShade,Glass,*,Constant,0.5;\n",
     'GPUShading:PerforatedScreen Mesh: Surface Name "hood": HOOD is named by GPUShading:TransparentShade Glass '
     "already"),
    (TEXTURE.format(surfaces="hood", file="none.png"),
     "GPUShading:PerforatedScreen Leaves: Texture File Name: {folder}/none.png: no such file"),
    (TEXTURE.format(surfaces="hood", file="huge.tga"),
     "GPUShading:PerforatedScreen Leaves: Texture File Name: {folder}/huge.tga: is 20000 x 20000 texels, expected at "
     "most 16384 per side"),
], ids=["surface", "hole", "shape", "comma", "texture", "named twice", "no file", "huge"])
def test_bad_screen_stops_before_energyplus_starts(screen, message, patched, weather, tmp_path):
    (tmp_path / "huge.tga").write_bytes(b"\0\0\x02" + bytes(9) + b"\x20\x4e\x20\x4e\x18\0")
    path = tmp_path / "model.idf"
    path.write_text(model() + screen)
    run = energyplus.run(patched, path, weather, tmp_path / "run", ["--gpu-shading", "-D"])
    assert_refused(run, f"{path}: {message.format(folder=tmp_path)}")


def test_missing_schedule_is_said_with_its_field(patched, tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(model() + PATTERN.format(surfaces="hood").replace("0.003;", "0.003,,,,,,,,,,,Nowhere;"))
    done = subprocess.run([patched.parent / "gpu_shading", "check", path], capture_output=True, text=True)
    assert done.returncode == 1
    assert ('GPUShading:PerforatedScreen Mesh: Deployment Schedule Name: EnergyPlus has no schedule "NOWHERE"'
            in done.stderr)


def test_check_lists_screens_and_their_tiles(check, tmp_path):
    write_grey_image(tmp_path / "leaves.png", [[255, 0, 0, 0], [255, 255, 0, 0]])
    rows = check(model() + PATTERN.format(surfaces="*Panel") + TEXTURE.format(surfaces="Hood", file="leaves.png"))
    assert ("perforated (round holes 5 mm, 60 degrees staggered, pitch 8 mm, 35.4 % open, 3 mm thick)"
            in rows["SITE PANEL"][0])
    assert "perforated (texture leaves.png 4 x 2, 62.5 % open over 2 x 0.6 m tiles, 3 mm thick)" in rows["HOOD"][0]
    assert rows["BLADE Left"][0].endswith("opaque")
    assert "tile" not in rows["BLADE Left"][1]


@pytest.mark.parametrize("turn", ["Counterclockwise", "Clockwise"])
@pytest.mark.parametrize("corner", CORNERS)
def test_tile_begins_at_the_lower_left_corner(corner, turn, check):
    rows = check(model(corner, turn) + PATTERN.format(surfaces="*"))
    right, up = (1, 0, 0), (0, 0, 1)
    assert tile(rows["BUILDING PANEL"]) == [(1, -1, 0.5), right, up]
    assert tile(rows["SITE PANEL"]) == [(1, -2, 0.5), right, up]
    assert tile(rows["ZONE PANEL"]) == [(1, -3, 0.5), right, up]
    assert tile(rows["PLAIN PANEL"]) == [(10, -1, 0), right, up]
    # An overhang faces down; both fins face to the left.
    assert tile(rows["HOOD"]) == [(1, 0, 2.1), right, (0, -1, 0)]
    assert tile(rows["BLADE Left"]) == [(1, 0, 1), (0, -1, 0), up]
    assert tile(rows["BLADE Right"]) == [(3, 0, 1), (0, -1, 0), up]


# Counterclockwise from outside, by what the model calls its first vertex.
POLYGON = ((5, -1, 2), (5, -1, 0), (6, -1, 0), (6, -1, 2), (5.5, -1, 3))


@pytest.mark.parametrize("corner, place", [("UpperLeftCorner", 1), ("LowerLeftCorner", 0), ("LowerRightCorner", -1),
                                           ("UpperRightCorner", -2)])
@pytest.mark.parametrize("turn", ["Counterclockwise", "Clockwise"])
def test_lower_left_corner_of_a_polygon_is_what_the_rules_say(corner, place, turn, check):
    given = POLYGON if turn == "Counterclockwise" else (POLYGON[0], *POLYGON[:0:-1])
    points = ",".join(f"{c}" for point in given for c in point)
    rows = check(model(corner, turn) + f"Shading:Site:Detailed,Penta,,5,{points};\n" + PATTERN.format(surfaces="penta"))
    origin, u, _ = tile(rows["PENTA"])
    assert origin == POLYGON[place]
    along = [b - a for a, b in zip(POLYGON[place], POLYGON[(place + 1) % 5], strict=True)]
    length = sum(c * c for c in along) ** 0.5
    assert u == pytest.approx([c / length for c in along], abs=1e-4)


def test_preprocessing_and_the_side_file_find_the_texture(patched, weather, tmp_path):
    folder = tmp_path / "input"
    (folder / "images").mkdir(parents=True)
    write_grey_image(folder / "images" / "leaves.png", [[255, 0]])
    path = folder / "model.idf"
    path.write_text(model() + "HVACTemplate:Thermostat,Unused,,20,,26;\n")
    screen = TEXTURE.format(surfaces="*Panel", file="images/leaves.png")
    (folder / "model.gpu-shading.idf").write_text(screen)
    run = energyplus.run(patched, path, weather, tmp_path / "run", ["--gpu-shading", "-D", "-x"])
    assert run.completed, run.why()
    lines = [line for line in run.text("eplusout.eio").splitlines() if line.startswith("GPU Shading Surface,")]
    assert len(lines) == 4
    assert all("perforated (texture images/leaves.png 2 x 1; 50.0 % open over 2 x " in line for line in lines)
    assert all(line.count(",") == 2 for line in lines)


def test_deployed_screens_run(patched, weather, tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(
        model() + PATTERN.format(surfaces="*Panel").replace("0.003;", "0.003,,,,,,,,,,,Sails;")
        + "Schedule:Compact,Sails,,Through: 12/31,For: AllDays,Until: 12:00,1,Until: 24:00,0.25;\n")
    report = tmp_path / "report"
    run = energyplus.run(patched, path, weather, tmp_path / "run",
                         ["--gpu-shading", "-D", f"--gpu-shading-report={report}"])
    assert run.completed, run.why()
    header, *rows = (report / "sunlit.csv").read_text().splitlines()
    assert header.endswith('"share by SAILS"')
    assert {row.rsplit(",", 1)[1] for row in rows} == {"1", "0.25"}


def test_shading_that_is_off_warns_of_screens(patched, weather, tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(model() + PATTERN.format(surfaces="*Panel"))
    run = energyplus.run(patched, path, weather, tmp_path / "run", ["--gpu-shading=off", "-D"])
    assert run.completed, run.why()
    assert run.text("eplusout.err").count("except for transmittance schedules: BUILDING PANEL and 3 more") == 1

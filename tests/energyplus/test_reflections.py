"""Solar reflections meet what only this module knows: surfaces hidden from EnergyPlus, shades, screens, meshes.

What each surface receives by reflection on a design day, part by part, is held against EnergyPlus's own functions with
all surfaces in its input, and against closed forms.
"""

import math
import re

import pytest
import test_models
from output_files import values_of
from shading_runs import energyplus
from test_site import feature, obj, shade, tower, write_geojson

RATE = "Surface Outside Face Incident {} Reflected Solar Radiation Rate per Area"
MIRRORED = RATE.format("Beam To Beam Surface")
BEAM_BY_SURFACES = RATE.format("Beam To Diffuse Surface")
SKY_BY_SURFACES = RATE.format("Sky Diffuse Surface")
BEAM_BY_GROUND = RATE.format("Beam To Diffuse Ground")
SKY_BY_GROUND = RATE.format("Sky Diffuse Ground")
PARTS = (MIRRORED, BEAM_BY_SURFACES, SKY_BY_SURFACES, BEAM_BY_GROUND, SKY_BY_GROUND)
OUTPUTS = "".join(f"Output:Variable,*,{part},Hourly;\n" for part in PARTS) + "Output:SQLite,Simple;\n"
RECEIVERS = ("SOUTH", "SOUTH WINDOW", "EAST", "NORTH", "WEST", "ROOF")

# A neighbour's glass front, turned so that the sun comes back from it.
GLASS_FRONT = shade("Glass Front", [(-7, -8, 6), (-7, -8, 0), (-4, 7, 0), (-4, 7, 6)]) + (
    "ShadingProperty:Reflectance,Glass Front,0.1,0.1,0.8,Window;\n")
# Its upper side towards the sun, below the window. It reaches far beyond all rays that meet the ground before it.
AWNING = [(-1.013, -4.021, 0.31), (7.017, -4.021, 0.31), (7.017, -0.011, 0.31), (-1.013, -0.011, 0.31)]
# Above all, so that the sun and the sky shine through it on all that reflects.
CANOPY = [(-1e5, -1e5, 50.0), (1e5, -1e5, 50.0), (1e5, 1e5, 50.0), (-1e5, 1e5, 50.0)]


def bare(text):
    """The box alone, with reflections."""
    text = re.sub(r"Shading:Building:Detailed,[^;]*;|Output:Variable,[^;]*;[^\n]*\n", "", text)
    text, count = re.subn(r"FullInteriorAndExterior,", "FullInteriorAndExteriorWithReflections,", text)
    assert count == 1
    return text + OUTPUTS


@pytest.fixture
def room(box):
    return bare(box)


@pytest.fixture
def louvred(louvres, room):
    """The box with a number of louvres. They stand a little aside, so that no ray runs along an edge."""

    def call(count):
        def move(match):
            *head, = match.group(1).split(",")
            numbers = [float(value) for value in head[-12:]]
            moved = [value + (0.0137, 0.0, 0.00713)[i % 3] for i, value in enumerate(numbers)]
            return "Shading:Building:Detailed," + ",".join(head[:-12]) + "".join(f",{v:.9g}" for v in moved) + ";"

        return room + re.sub(r"Shading:Building:Detailed,([^;]*);", move,
                             "".join(re.findall(r"Shading:Building:Detailed,[^;]*;", louvres(count))))

    return call


@pytest.fixture
def run(official, patched, weather, tmp_path):
    """Runs a text's design day; without options, in stock EnergyPlus."""

    def call(text, name, *options, environment=None):
        path = tmp_path / f"{name}.idf"
        path.write_text(text)
        done = energyplus.run(patched if options else official, path, weather, tmp_path / name, ["-D", *options],
                              environment)
        assert done.completed, done.why()
        return done

    return call


def ours(run, text, name, *options, **more):
    return run(text, name, "--gpu-shading", *options, **more)


def received(done, part):
    """{receiver: W/m2 by hour}"""
    values = values_of(done, part)
    return {name: values[name] for name in RECEIVERS}


def assert_close(answer, expected, part, relative, least=0.05, parts=RECEIVERS):
    """`least`: W/m2 that some hour must exceed somewhere, so that there is something to compare."""
    mine, theirs = received(answer, part), received(expected, part)
    largest = max(max(theirs[name]) for name in parts)
    assert largest > least, part
    for name in parts:
        for hour, (a, b) in enumerate(zip(mine[name], theirs[name], strict=True)):
            assert a == pytest.approx(b, rel=relative, abs=relative * largest), (part, name, hour)


def messages(done):
    return (done.folder / "eplusout.err").read_text()


def ray_warnings(done):
    return re.findall(r"\*\* Warning \*\* gpu_shading: rays of .*", messages(done))


# Hidden surfaces reflect as much from the sky as EnergyPlus computes within this, by points on them.
SKY_TOLERANCE = 6e-3


@pytest.mark.parametrize("beside, frequency", [("", "Periodic"), (GLASS_FRONT, "Periodic"), (GLASS_FRONT, "Timestep")],
                         ids=["louvres", "glass front", "every timestep"])
def test_hidden_louvres_reflect_as_those_of_energyplus(beside, frequency, louvred, run):
    text = louvred(19).replace("  Periodic, ", f"  {frequency}, ") + beside
    assert frequency in text
    kept = ours(run, text, "kept", "--gpu-shading-lean=off")
    hidden = ours(run, text, "hidden", "--gpu-shading-lean=on")
    assert "19 shading surfaces hidden" in messages(hidden)
    for part in (BEAM_BY_SURFACES, BEAM_BY_GROUND, SKY_BY_GROUND) + ((MIRRORED,) if beside else ()):
        assert_close(hidden, kept, part, 1e-6)
    assert_close(hidden, kept, SKY_BY_SURFACES, SKY_TOLERANCE)
    # Of placeholders, nothing.
    assert "may be inaccurate" not in messages(hidden)


def test_stock_agrees_where_its_clipping_is_exact(louvred, run):
    # Without slats that shade slats in many layers.
    text = louvred(2)
    stock = run(text, "stock")
    hidden = ours(run, text, "hidden", "--gpu-shading-lean=on")
    for part in (BEAM_BY_SURFACES, BEAM_BY_GROUND, SKY_BY_GROUND):
        assert_close(hidden, stock, part, 1e-6)
    assert_close(hidden, stock, SKY_BY_SURFACES, SKY_TOLERANCE, least=0.04)


MODELS = ("ReflectiveAdjacentBuilding.idf", "SolarShadingTest.idf", "DaylightingDeviceShelf.idf")


@pytest.mark.parametrize("name", MODELS)
def test_models_of_others_reflect_as_in_stock(name, official, patched, tmp_path):
    source = test_models.MODELS / name
    if not source.is_file():
        pytest.skip(f"{source} is missing")
    text = re.sub(r"(?i)(Full(?:InteriorAnd)?Exterior)(?:WithReflections)?\s*([,;])", r"\1WithReflections\2",
                  source.read_text(errors="replace")) + OUTPUTS
    path = tmp_path / name
    path.write_text(text)
    weather = sorted(test_models.MODELS.glob("weather/*Colorado*.epw"))[0]
    runs = []
    for folder, program, options in (("stock", official, []), ("ours", patched, ["--gpu-shading"])):
        done = energyplus.run(program, path, weather, tmp_path / folder, ["-D", *options])
        assert done.completed, done.why()
        runs.append([values_of(done, part) for part in PARTS])
    compared = 0
    for part, stock, mine in zip(PARTS, *runs, strict=True):
        # The sky's share depends on sunlit fractions, by clipping here and by rendering there.
        relative = SKY_TOLERANCE if part == SKY_BY_SURFACES else 1e-6
        largest = max(map(max, stock.values()))
        for surface, values in stock.items():
            compared += any(values)
            assert mine[surface] == pytest.approx(values, rel=relative, abs=relative * largest), (part, surface)
    assert compared > 10


TINT = "GPUShading:TransparentShade,Tint,Canopy,{};\n"


def ground_seen_by_a_wall():
    """The share of the ground in what a wall sees, as the sum over EnergyPlus's rays: 10 altitudes, 9 azimuths."""
    step, turn = math.pi / 10, math.pi / 9
    return sum(math.cos(altitude) ** 2 * math.cos(azimuth) * step * turn / math.pi
               for altitude in ((i + 0.5) * step - math.pi / 2 for i in range(5))
               for azimuth in ((j + 0.5) * turn - math.pi / 2 for j in range(9)))


def test_a_canopy_dims_what_the_ground_reflects(room, run):
    plain = ours(run, room, "plain")
    tau = 0.35
    dimmed = ours(run, room + shade("Canopy", CANOPY) + TINT.format(f"Constant,{tau}"), "dimmed")
    assert ray_warnings(dimmed) == []
    # EnergyPlus limits the sum to what a wall sees of an unobstructed ground. With the canopy, it is below that.
    rounding = ground_seen_by_a_wall() / 0.5
    assert 1.0 < rounding < 1.01
    before, after = received(plain, BEAM_BY_GROUND), received(dimmed, BEAM_BY_GROUND)
    noon = 11
    assert before["SOUTH"][noon] > 10.0
    assert after["SOUTH"][noon] == pytest.approx(tau * rounding * before["SOUTH"][noon], rel=1e-9)
    for name in RECEIVERS:
        for a, b in zip(before[name], after[name], strict=True):
            assert tau * a - 1e-9 <= b <= tau * rounding * a + 1e-9, name
    before, after = received(plain, SKY_BY_GROUND), received(dimmed, SKY_BY_GROUND)
    for name in RECEIVERS:
        assert after[name] == pytest.approx([tau * value for value in before[name]], rel=1e-9), name


def rays_of_the_north_wall():
    """(point, direction, weight) of EnergyPlus's downward rays."""
    step, turn = math.pi / 10, math.pi / 9
    points = [(x, 6.0, z) for x in (1.5, 4.5) for z in (0.75, 2.25)]
    for point in points:
        for altitude in ((i + 0.5) * step - math.pi / 2 for i in range(5)):
            for azimuth in ((j + 0.5) * turn for j in range(9)):
                flat = math.cos(altitude)
                direction = flat * math.cos(azimuth), flat * math.sin(azimuth), math.sin(altitude)
                yield point, direction, flat * direction[1]


def meets_box(point, direction):
    """Whether a ray from outside meets the box's walls."""
    enters, leaves = 0.0, math.inf
    for start, way, low, high in zip(point, direction, (0, 0, 0), (6, 6, 3), strict=True):
        if abs(way) < 1e-12:
            if not low < start < high:
                return False
            continue
        near, far = sorted(((low - start) / way, (high - start) / way))
        enters, leaves = max(enters, near), min(leaves, far)
    return enters < leaves


def sky_by_the_ground(transmittance):
    """What the ground below a canopy reflects to the north wall, up to a constant, from 5 x 18 parts of the sky."""
    step, turn = math.pi / 10, math.pi / 9
    total = 0.0
    for point, ray, weight in rays_of_the_north_wall():
        far = -point[2] / ray[2]
        ground = tuple(start + far * way for start, way in zip(point, ray, strict=True))
        for altitude in ((i + 0.5) * step for i in range(5)):
            for azimuth in ((j + 0.5) * turn for j in range(18)):
                flat, up = math.cos(altitude), math.sin(altitude)
                if not meets_box(ground, (flat * math.cos(azimuth), flat * math.sin(azimuth), up)):
                    total += weight * up * flat * transmittance(up)
    return total


def hourly(text):
    """With one timestep an hour: otherwise EnergyPlus takes means of this hour's and the last hour's reflections."""
    return text.replace("Timestep,4;", "Timestep,1;")


def test_a_canopy_transmits_by_the_angle_of_the_sun(room, run):
    cosine = "Surface Outside Face Beam Solar Incident Angle Cosine Value"
    text = hourly(room) + f"Output:Variable,Roof,{cosine},Timestep;\n"
    plain = ours(run, text, "plain")
    # tau = cosine of the angle of incidence, which is the sine of the sun's altitude.
    dimmed = ours(run, text + shade("Canopy", CANOPY) + TINT.format("PolynomialInCosine,0,1"), "dimmed")
    before, after = received(plain, BEAM_BY_GROUND)["EAST"], received(dimmed, BEAM_BY_GROUND)["EAST"]
    cosines = values_of(dimmed, cosine)["ROOF"]
    shares = [(b / a, expected) for a, b, expected in zip(before, after, cosines, strict=True) if a > 1.0]
    assert len(shares) > 6
    for share, expected in shares:
        assert expected * (1 - 1e-6) <= share <= expected * ground_seen_by_a_wall() / 0.5 * (1 + 1e-6)
    before, after = received(plain, SKY_BY_GROUND), received(dimmed, SKY_BY_GROUND)
    expected = sky_by_the_ground(lambda sine: sine) / sky_by_the_ground(lambda sine: 1.0)
    assert 0.6 < expected < 0.8
    assert after["NORTH"] == pytest.approx([expected * value for value in before["NORTH"]], rel=1e-6)


HOLES = "GPUShading:PerforatedScreen,Sheet,{name},Round,,Staggered60,0.004,,0.008,,0;\n"
OPEN = 3.14159265358979 / (2 * 3**0.5) * (0.004 / 0.008) ** 2


def test_a_perforated_sheet_reflects_with_its_solid_area(room, run):
    sheet = shade("Sheet", AWNING) + "ShadingProperty:Reflectance,Sheet,0.6,0.6,0,;\n"
    opaque = ours(run, room + sheet, "opaque", "--gpu-shading-lean=on")
    perforated = ours(run, room + sheet + HOLES.format(name="Sheet"), "perforated")
    plain = ours(run, room, "plain")
    assert ray_warnings(perforated) == []
    for part in (BEAM_BY_SURFACES, SKY_BY_SURFACES):
        solid, pierced = received(opaque, part)["SOUTH"], received(perforated, part)["SOUTH"]
        assert max(solid) > 0.3
        assert pierced == pytest.approx([(1 - OPEN) * value for value in solid], rel=1e-6, abs=1e-9)
    # The sun passes twice on its way to the ground below the sheet and back, if both ways go through it.
    all_ground, beyond, through = (received(done, BEAM_BY_GROUND)["SOUTH"] for done in (plain, opaque, perforated))
    for a, b, c in zip(all_ground, beyond, through, strict=True):
        assert b - 1e-9 <= c <= b + OPEN * (a - b) + 1e-9
    noon = 11
    assert through[noon] > beyond[noon] + 0.9 * OPEN**2 * (all_ground[noon] - beyond[noon]) > 0


def test_schedules_and_deployment_count_hour_by_hour(room, run):
    day = "Until: 9:00,1.0,Until: 11:00,0.25,Until: 24:00,0.5"
    schedule = (f"Schedule:Compact,Leaves,Fraction,Through: 12/31,For: AllDays,{day};\n"
                "ScheduleTypeLimits,Fraction,0,1,Continuous;\n")
    room = hourly(room)
    plain = received(ours(run, room, "plain"), BEAM_BY_GROUND)["EAST"]
    corners = ",".join(f"{v:.9g}" for point in CANOPY for v in point)
    leaves = room + schedule + f"Shading:Site:Detailed,Canopy,Leaves,4,{corners};\n" + TINT.format("Constant,0.8")
    moved = room + schedule + shade("Canopy", CANOPY) + (
        "GPUShading:PerforatedScreen,Sheet,Canopy,Round,,Staggered60,0.004,,0.008,,0,,,,,,,,,,,Leaves;\n")
    scheduled = received(ours(run, leaves, "scheduled"), BEAM_BY_GROUND)["EAST"]
    deployed = received(ours(run, moved, "deployed"), BEAM_BY_GROUND)["EAST"]
    for hour, before in enumerate(plain):
        value = 1.0 if hour < 9 else 0.25 if hour < 11 else 0.5
        # What EnergyPlus takes off an unobstructed ground (see above) is nothing, or half a percent.
        for answer, share in ((scheduled, 0.8 * value), (deployed, 1 - value * (1 - OPEN))):
            assert share * before * (1 - 1e-6) <= answer[hour] <= share * before * 1.006 + 1e-9, hour


def test_what_a_mirror_reflects_is_dimmed(room, run):
    # Between the glass front and the box.
    side = shade("Pane", [(-2.0, -40, 40), (-2.0, -40, -40), (-2.0, 40, -40), (-2.0, 40, 40)])
    tint = "GPUShading:TransparentShade,Tint,Pane,Constant,0.6;\nShadingProperty:Reflectance,Pane,0,0,0,;\n"
    before = received(ours(run, room + GLASS_FRONT, "plain"), MIRRORED)["SOUTH"]
    after = received(ours(run, room + GLASS_FRONT + side + tint, "dimmed"), MIRRORED)["SOUTH"]
    assert max(before) > 5.0
    shares = {round(b / a, 6) for a, b in zip(before, after, strict=True) if a > 0.1}
    # Once through the pane on the way to the box; twice while the sun is behind it.
    assert shares <= {0.6, 0.36} and 0.6 in shares or 0.36 in shares


BUILDING = [(-4.03, -12.0), (-4.03, -20.0), (4.53, -20.0), (4.53, -12.0)]


def test_meshes_and_neighbours_reflect_as_surfaces_would(room, run, tmp_path):
    surfaces = ours(run, room + tower("House", BUILDING, 0.0, 9.0), "surfaces", "--gpu-shading-lean=off")
    obj(tmp_path / "house.obj", BUILDING, 0.0, 9.0, 1.0)
    mesh = ours(run, room + "GPUShading:Geometry,House,house.obj,m,Z;\n", "mesh")
    write_geojson(tmp_path / "town.geojson", [feature([BUILDING], {"height": 9.0})])
    town = ours(run, room + "GPUShading:SiteContext,Town,town.geojson;\n", "town")
    for answer, tolerance in ((mesh, 1e-6), (town, 5e-3)):
        assert ray_warnings(answer) == []
        for part in (BEAM_BY_GROUND, SKY_BY_GROUND):
            assert_close(answer, surfaces, part, tolerance)
        assert_close(answer, surfaces, SKY_BY_SURFACES, 2 * SKY_TOLERANCE)


def test_what_stays_in_the_input_is_warned_about(room, run):
    sheet = shade("Canopy", CANOPY) + TINT.format("Constant,0.5")
    named = ours(run, room + sheet + "Output:Variable,Canopy,Surface Outside Face Sunlit Area,Hourly;\n", "named")
    (warning,) = ray_warnings(named)
    assert "CANOPY" in warning and "stay in EnergyPlus's input" in warning
    glazed = ours(run, room + GLASS_FRONT + "GPUShading:TransparentShade,Tint,Glass Front,Constant,0.5;\n", "glazed")
    (warning,) = ray_warnings(glazed)
    assert "GLASS FRONT" in warning


def test_where_energyplus_is_not_as_expected_its_own_functions_remain(louvred, room, run):
    library = energyplus.build_folder() / "tests" / "faults" / "libno_size.so"
    if not library.is_file():
        pytest.skip(f"{library} is missing: run scripts/build")
    answer = ours(run, louvred(19), "answer", "--gpu-shading-lean=on", environment={"LD_PRELOAD": str(library)})
    assert messages(answer).count("EnergyPlus's solar reflections have an unexpected layout in memory") == 1
    bare_box = ours(run, room, "bare")
    for part in (BEAM_BY_GROUND, SKY_BY_GROUND):
        assert_close(answer, bare_box, part, 1e-9)

"""Rays of EnergyPlus's daylighting meet what only this module knows: shades, screens, meshes, neighbours.

The daylight factors of the design day (eplusout.dfs) are held against stock EnergyPlus, closed forms, and integrals
over the sky. Where a closed form needs the direct component alone, the room is black.
"""

import math
import re

import daylit_rooms
import numpy as np
import pytest
import test_models
from output_files import values_of
from shading_runs import energyplus, input_file
from test_site import feature, obj, shade, tower, write_geojson

WINDOW = (1.5, 0.8, 4.5, 2.8)  # x, z, x, z of the box's south window
FACTORS = """
Daylighting:Controls,Light,Box,SplitFlux,,Continuous,0.3,0.2,,,,,,,Point,1.0,500;
Daylighting:ReferencePoint,Point,Box,3,3,0.8;
Output:DaylightFactors,SizingDays;
Output:SQLite,Simple;
Output:Variable,*,Daylighting Reference Point 1 Illuminance,Timestep;
Output:Variable,*,Site Solar Azimuth Angle,Timestep;
Output:Variable,*,Site Solar Altitude Angle,Timestep;
"""
MAP = """
Output:IlluminanceMap,Map,Box,0.8,0.3,5.7,8,0.3,5.7,8;
OutputControl:IlluminanceMap:Style,Comma;
"""
# Wide enough to hide the sky and the ground from the window but for rays within 0.01 degrees of the wall.
WALL = [(-2e3, -0.5, 2e3), (-2e3, -0.5, -2e3), (2e3, -0.5, -2e3), (2e3, -0.5, 2e3)]
SKIES = ("clear", "clear turbid", "intermediate", "overcast")


def blacken(text):
    """Surfaces that reflect no light."""
    for material in ("Insulation,Rough,0.1,0.04,30,1400", "Block,Rough,0.1,0.5,1400,1000"):
        assert f"Material,{material};" in text
        text = text.replace(f"Material,{material};", f"Material,{material},0.9,0.7,1.0;")
    return text


def without_louvres(text):
    return re.sub(r"Shading:Building:Detailed,[^;]*;", "", text)


@pytest.fixture
def room(box):
    return blacken(without_louvres(box)) + FACTORS


@pytest.fixture
def run(official, patched, weather, tmp_path):
    """Runs a text's design day; without options, in stock EnergyPlus."""

    def call(text, name, *options):
        path = tmp_path / f"{name}.idf"
        path.write_text(text)
        program = patched if options else official
        done = energyplus.run(program, path, weather, tmp_path / name, ["-D", *options])
        assert done.completed, done.why()
        return done

    return call


def factors(done):
    """Daylight factors by hour and sky."""
    rows = [line.split(",") for line in done.text("eplusout.dfs").splitlines()]
    values = {int(row[0]): [float(value) for value in row[2:]] for row in rows if len(row) == 6 and row[0].isdigit()}
    assert len(values) == 24
    return np.array([values[hour] for hour in sorted(values)])


def lux_of(done):
    return {key: np.array(values)
            for key, values in values_of(done, "Daylighting Reference Point 1 Illuminance").items()}


def lux(done):
    (values,) = lux_of(done).values()
    return values


def ray_warnings(done):
    return [line for line in done.text("eplusout.err").splitlines() if "rays of daylighting" in line]


def hidden(done):
    return next(line for line in done.our_lines if "hidden from EnergyPlus" in line)


def assert_equal_to_stock(stock, answer):
    assert answer.text("eplusout.dfs") == stock.text("eplusout.dfs")


def share_of_sky(shaded, open_sky):
    """What is left of the daylight factors where there were any."""
    before, after = factors(open_sky), factors(shaded)
    lit = before[:, 3] > 0.0
    assert lit.sum() >= 8
    return after[lit] / before[lit]


# (room, louvres, those that EnergyPlus keeps; None: lean input is off)
ROOMS = {
    "few louvres": (daylit_rooms.plain, 12, 0),
    "octree": (daylit_rooms.plain, 200, 0),
    "octree with some hidden": (daylit_rooms.some_kept, 200, 111),
    "several windows and a map": (daylit_rooms.several_windows_and_a_map, 60, 0),
    "interior window": (daylit_rooms.interior_window, 20, 0),
    "shelf": (daylit_rooms.shelf, 20, 1),
    "light well": (daylit_rooms.light_well, 20, 0),
    "tubular device": (daylit_rooms.tubular_device, 20, 0),
    "DElight": (daylit_rooms.delight, 20, None),
}


@pytest.mark.parametrize("make, count, kept", ROOMS.values(), ids=ROOMS.keys())
def test_opaque_models_give_stock_results(make, count, kept, louvres, run):
    text = make(louvres(count))
    stock = run(text, "stock")
    lean, full = (run(text, f"lean {value}", "--gpu-shading", f"--gpu-shading-lean={value}") for value in ("on", "off"))
    if kept is None:
        assert any("lean input is off" in line for line in lean.our_lines)
    else:
        surfaces = len(re.findall(r"^ *Shading:", text, re.MULTILINE)) - kept
        assert f"{surfaces} shading surfaces hidden" in hidden(lean)
    for answer in (lean, full):
        assert_equal_to_stock(stock, answer)
        assert ray_warnings(answer) == []
    for variable in ("Zone Lights Electricity Rate", "Daylighting Reference Point 1 Illuminance"):
        values = [np.array([*values_of(answer, variable).values()]) for answer in (stock, lean, full)]
        if make is daylit_rooms.delight and "Illuminance" in variable:
            continue
        assert len(np.unique(values[0])) > 4
        assert values[1] == pytest.approx(values[2], rel=1e-9)
        # Stock clips polygons, so that its sun through the windows differs from ours.
        assert values[1] == pytest.approx(values[0], rel=3e-3, abs=0.1)
    for name in ("eplusmap.csv",) if "IlluminanceMap" in text else ():
        assert lean.text(name) == full.text(name)


@pytest.mark.parametrize("row", test_models.index(("DaylightingDeviceShelf.idf", "GeometryTest.idf")))
def test_models_of_others_give_stock_results(row, official, patched, tmp_path):
    name, weather = row[:2]
    text = input_file.read(test_models.MODELS / name).text + "\nOutput:DaylightFactors,SizingDays;\n"
    path = tmp_path / name
    path.write_text(text)
    runs = [energyplus.run(program, path, energyplus.find_weather(weather), tmp_path / folder, ["-D", *options])
            for program, folder, options in (
                (official, "stock", ()), (patched, "lean", ("--gpu-shading", "--gpu-shading-lean=on")))]
    for each in runs:
        assert each.completed, each.why()
    assert runs[0].text("eplusout.dfs").count("\n") > 40
    assert_equal_to_stock(*runs)


@pytest.mark.parametrize("ours", [True, False])
def test_reflections_are_energyplus_s_or_none(ours, louvres, run):
    """Where this module computes reflected sunlight, daylighting has none from outdoor surfaces."""
    plain = daylit_rooms.plain(louvres(20))
    text = plain.replace("FullInteriorAndExterior,", "FullInteriorAndExteriorWithReflections,")
    answer = run(text, "answer", "--gpu-shading", *([] if ours else ["--gpu-shading-reflections=energyplus"]))
    warning = "daylighting has no reflections from outdoor surfaces"
    assert (warning in answer.text("eplusout.err")) == ours
    stock = {name: factors(run(each, name)) for name, each in (("plain", plain), ("reflecting", text))}
    assert stock["plain"] != pytest.approx(stock["reflecting"], rel=1e-3)
    # What surfaces reflect of the sky depends on sunlit fractions, by clipping here and by rendering there.
    assert factors(answer) == pytest.approx(stock["plain" if ours else "reflecting"], rel=5e-5, abs=1e-7)


@pytest.mark.parametrize("make", [daylit_rooms.several_windows_and_a_map, daylit_rooms.interior_window,
                                  daylit_rooms.shelf, daylit_rooms.tubular_device])
def test_what_is_kept_from_timestep_to_timestep_gives_stock_results(make, louvres, run):
    """With shadows renewed at every timestep, rays, skies and what is dark are not computed again."""
    text, count = re.subn(r"Periodic,(.*\n\s*)20;", r"Timestep,\g<1>20;", make(louvres(20)))
    assert count == 1
    text = text.replace("Timestep,4;", "Timestep,2;")
    stock, lean = (run(text, name, *options) for name, options in (
        ("stock", ()), ("lean", ("--gpu-shading", "--gpu-shading-lean=on"))))
    assert_equal_to_stock(stock, lean)
    values = [np.array([*lux_of(each).values()]) for each in (stock, lean)]
    assert len(np.unique(values[0])) > 4
    # Stock clips polygons, so that its sun through the windows differs from ours.
    assert values[1] == pytest.approx(values[0], rel=3e-3, abs=0.1)
    if "IlluminanceMap" in text:
        rows = [re.findall(r"[\d.]+", each.text("eplusmap.csv")) for each in (stock, lean)]
        assert len(rows[0]) > 36 * 8
        assert np.array(rows[1], float) == pytest.approx(np.array(rows[0], float), rel=1e-2, abs=1.0)


def test_constant_transmittance_dims_all_daylight(room, run):
    bare = run(room, "bare", "--gpu-shading")
    sheet = shade("Sheet", WALL) + "GPUShading:TransparentShade,Tint,Sheet,Constant,0.35;\n"
    dim = run(room + sheet, "dim", "--gpu-shading")
    assert "1 shading surface hidden" in hidden(dim)
    assert ray_warnings(dim) == []
    assert share_of_sky(dim, bare) == pytest.approx(0.35, rel=3e-5)
    assert lux(dim)[lux(bare) > 1.0] == pytest.approx(0.35 * lux(bare)[lux(bare) > 1.0], rel=1e-4)


def sky_luminance(sky, ray, sun):
    """CIE's overcast and clear sky, in proportion."""
    sine = ray[..., 2]
    if sky == "overcast":
        return (1.0 + 2.0 * sine) / 3.0
    cosine = np.clip(ray @ sun, -1.0, 1.0)
    angle = np.arccos(cosine)
    return (1.0 - np.exp(-0.32 / sine)) * (0.91 + 10.0 * np.exp(-3.0 * angle) + 0.45 * cosine**2)


NEAR = (3.0, 0.6, 0.8)
ELEMENTS = (21, 14)  # of the window, as EnergyPlus divides it for this point
PANE = (0.9, 0.08)  # visible transmittance and reflectance of the pane in the window


def pane_transmittance(cosine):
    """A slab of one index of refraction and absorptance, by Fresnel's equations, from its values at normal incidence:
    Arasteh, Reilly & Rubin 1989, as in the Engineering Reference (Window Calculation Module)."""
    t, r = PANE
    beta = t * t - r * r + 2 * r + 1
    rho = (beta - math.sqrt(beta * beta - 4 * (2 - r) * r)) / (2 * (2 - r))
    index = (1 + math.sqrt(rho)) / (1 - math.sqrt(rho))
    depth = -math.log((r - rho) / (rho * t))
    inner = np.sqrt(1 - (1 - cosine**2) / index**2)
    passed = np.exp(-depth / inner)
    total = 0.0
    for once in (((index * cosine - inner) / (index * cosine + inner)) ** 2,
                 ((index * inner - cosine) / (index * inner + cosine)) ** 2):
        total = total + (1 - once) ** 2 * passed / (1 - once**2 * passed**2) / 2
    return total


def direct_share(sky, sun, transmittance, columns, rows):
    """The mean of a transmittance over the sky that a point near the window sees, each part by the light that it
    gives: luminance, cosine on the window, solid angle, sine on the work plane, and a clear pane in the window."""
    x0, z0, x1, z1 = WINDOW
    x, z = np.meshgrid(x0 + (x1 - x0) * (np.arange(columns) + 0.5) / columns,
                       z0 + (z1 - z0) * (np.arange(rows) + 0.5) / rows)
    ray = np.stack([x - NEAR[0], np.zeros_like(x) - NEAR[1], z - NEAR[2]], axis=-1)
    distance = np.linalg.norm(ray, axis=-1, keepdims=True)
    ray /= distance
    cosine = -ray[..., 1]
    weight = sky_luminance(sky, ray, sun) * pane_transmittance(cosine) * cosine / distance[..., 0] ** 2 * ray[..., 2]
    return float((weight * transmittance(cosine)).sum() / weight.sum())


FILM = "GPUShading:TransparentShade,Film,Sheet,PolynomialInCosine,0.0,0.1,0.8;\n"
# Half of the solar radiation passes, but light as through the window's pane.
GLASS = ("WindowMaterial:Glazing,Tinted,SpectralAverage,,0.006,0.5,0.05,0.05,{},{},{},0,0.84,0.84,0.9;\n"
         "Construction,Canopy,Tinted;\nGPUShading:TransparentShade,Glass,Sheet,Construction,Canopy;\n")
SHADES = {
    "film": (FILM, lambda cosine: 0.1 * cosine + 0.8 * cosine**2, 1e-4),
    "glass": (GLASS.format(PANE[0], PANE[1], PANE[1]), pane_transmittance, 2e-4),
}


@pytest.mark.parametrize("shade_text, transmittance, tolerance", SHADES.values(), ids=SHADES.keys())
@pytest.mark.parametrize("sky", ["overcast", "clear"])
def test_angular_transmittance_is_the_integral_over_the_sky(sky, shade_text, transmittance, tolerance, room, run):
    room = room.replace("Timestep,4;", "Timestep,60;").replace("Point,Box,3,3,0.8;", "Point,Box,3,0.6,0.8;")
    room = room.replace("WindowMaterial:SimpleGlazingSystem,Glazing,1.4,0.6;",
                        f"WindowMaterial:Glazing,Glazing,SpectralAverage,,0.003,0.84,0.075,0.075,{PANE[0]},{PANE[1]},{PANE[1]},0,0.84,0.84,0.9;"
                        )
    bare = run(room, "bare", "--gpu-shading")
    dim = run(room + shade("Sheet", WALL) + shade_text, "dim", "--gpu-shading")
    hour = 11
    (azimuth,), (altitude,) = ([values[60 * hour - 1 : 60 * hour] for values in values_of(bare, name).values()]
                               for name in ("Site Solar Azimuth Angle", "Site Solar Altitude Angle"))
    a, h = math.radians(azimuth[0]), math.radians(altitude[0])
    sun = np.array([math.sin(a) * math.cos(h), math.cos(a) * math.cos(h), math.sin(h)])
    integral, elements = (direct_share(sky, sun, transmittance, *counts)
                          for counts in ((400, 400), ELEMENTS))
    column = SKIES.index(sky)
    found = factors(dim)[hour - 1, column] / factors(bare)[hour - 1, column]
    print(f"{sky}: {found:.5f}, integral {integral:.5f}, its sum over EnergyPlus's elements {elements:.5f}")
    assert found == pytest.approx(elements, rel=tolerance)
    assert found == pytest.approx(integral, rel=5e-3)


OPEN_SHARE = math.pi / (2 * math.sqrt(3)) * 0.5**2  # round holes of half their pitch, staggered by 60 degrees


def test_perforated_sheet_passes_its_open_share(room, run):
    """Without thickness, the effective transmittance is the open share at every angle."""
    bare = run(room, "bare", "--gpu-shading")
    sheet = shade("Sheet", WALL) + "GPUShading:PerforatedScreen,Veil,Sheet,Round,,,0.004,,0.008,,0.0;\n"
    dim = run(room + sheet, "dim", "--gpu-shading")
    assert ray_warnings(dim) == []
    assert share_of_sky(dim, bare) == pytest.approx(OPEN_SHARE, rel=3e-4)


def test_deployment_counts_hour_by_hour_for_the_sun_and_once_for_the_sky(room, run):
    """EnergyPlus asks for the sky's rays once a period, at its first hour."""
    bare = run(room, "bare", "--gpu-shading")
    schedule = "Schedule:Constant,Down,,0.25;\n"
    sheet = (shade("Sheet", WALL) + schedule
             + "GPUShading:PerforatedScreen,Veil,Sheet,Round,,,0.004,,0.008,,0.0,,,,,,,,,,,Down;\n")
    dim = run(room + sheet, "dim", "--gpu-shading")
    share = OPEN_SHARE
    assert share_of_sky(dim, bare) == pytest.approx(1.0 - 0.25 * (1.0 - share), rel=3e-4)


@pytest.mark.parametrize("frequency", ["Periodic", "Timestep"])
def test_schedule_is_read_as_by_stock(frequency, room, run):
    room = re.sub(r"Periodic,( *!-[^\n]*\n)?\s*20;", f"{frequency},20;", room)
    assert frequency in room
    sheet = ("Schedule:Compact,Leaves,,Through: 12/31,For: AllDays,Until: 10:00,0.2,Until: 14:00,0.7,"
             "Until: 24:00,0.4;\n") + shade("Sheet", WALL).replace("Sheet,,", "Sheet,Leaves,")
    stock = run(room + sheet, "stock")
    lean = run(room + sheet, "lean", "--gpu-shading", "--gpu-shading-lean=on")
    assert "1 shading surface hidden" in hidden(lean)
    assert_equal_to_stock(stock, lean)
    assert lux(lean) == pytest.approx(lux(stock), rel=1e-4, abs=1e-3)


BUILDING = [(-4.0, -12.0), (-4.0, -20.0), (4.5, -20.0), (4.5, -12.0)]


def test_neighbours_and_meshes_stand_where_surfaces_would(room, run, tmp_path):
    stock = run(room + tower("House", BUILDING, 0.0, 9.0), "stock")
    bare = run(room, "bare")
    assert factors(stock)[11, 3] < 0.8 * factors(bare)[11, 3]
    obj(tmp_path / "house.obj", BUILDING, 0.0, 9.0, 1.0)
    mesh = run(room + "GPUShading:Geometry,House,house.obj,m,Z;\n", "mesh", "--gpu-shading")
    assert_equal_to_stock(stock, mesh)
    write_geojson(tmp_path / "town.geojson", [feature([BUILDING], {"height": 9.0})])
    town = run(room + "GPUShading:SiteContext,Town,town.geojson;\n", "town", "--gpu-shading")
    assert factors(town) == pytest.approx(factors(stock), rel=1e-3, abs=1e-5)
    for answer in (mesh, town):
        assert ray_warnings(answer) == []


PARTITION = [(1.0, 1.5, 1.6), (1.0, 1.5, 0.0), (5.0, 1.5, 0.0), (5.0, 1.5, 1.6)]


def test_a_partition_in_the_room_hides_the_window(room, run):
    inside = shade("Partition", PARTITION)
    stock = run(room + inside, "stock")
    lean = run(room + inside, "lean", "--gpu-shading", "--gpu-shading-lean=on")
    bare = run(room, "bare")
    assert factors(stock)[11, 3] < 0.9 * factors(bare)[11, 3]
    assert_equal_to_stock(stock, lean)
    tint = "GPUShading:TransparentShade,Pane,Partition,Constant,0.5;\n"
    pane = run(room + inside + tint, "pane", "--gpu-shading")
    # Half of what the opaque one takes.
    assert factors(pane) == pytest.approx((factors(bare) + factors(stock)) / 2, rel=1e-4, abs=2e-6)


def test_what_stays_in_the_input_is_warned_about(room, run):
    sheet = shade("Sheet", WALL) + "GPUShading:TransparentShade,Tint,Sheet,Constant,0.35;\n"
    named = run(room + sheet + "Output:Variable,Sheet,Surface Outside Face Sunlit Area,Hourly;\n", "named",
                "--gpu-shading")
    (warning,) = ray_warnings(named)
    assert "SHEET" in warning and "stay in EnergyPlus's input" in warning
    delight = run((room + sheet).replace(",SplitFlux,", ",DElight,"), "delight", "--gpu-shading")
    (warning,) = ray_warnings(delight)
    assert "Tint as opaque" in warning

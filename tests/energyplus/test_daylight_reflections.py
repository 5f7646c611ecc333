"""Daylighting in models with solar reflections: what is hidden from EnergyPlus dims and reflects light, too.

Daylight factors of the design day (eplusout.dfs) and illuminance are held against stock EnergyPlus with all surfaces in
its input, and against closed forms.
"""

import re

import daylit_rooms
import numpy as np
import pytest
import test_models
from shading_runs import energyplus, input_file
from test_daylighting import (
    OPEN_SHARE,
    WALL,
    assert_equal_to_stock,
    blacken,
    factors,
    hidden,
    lux,
    lux_of,
    ray_warnings,
    run,
    share_of_sky,
    without_louvres,
)
from test_reflections import CANOPY, GLASS_FRONT
from test_site import feature, obj, shade, tower, write_geojson

__all__ = ["run"]  # a fixture

# Of what hidden surfaces reflect from the sky, 0.6 %, as the light that a room receives from them.
TOLERANCE = 5e-5


def reflecting(text):
    text, count = re.subn("FullInteriorAndExterior,", "FullInteriorAndExteriorWithReflections,", text)
    assert count == 1
    return text


def reflectance(name, visible):
    """That for solar radiation differs."""
    return f"ShadingProperty:Reflectance,{name},{0.9 - visible:g},{visible:g},0,;\n"


def black_shading(text):
    names = re.findall(r"^ *Shading:(?:Building|Zone|Site):Detailed,\s*([^,]*),", text, re.MULTILINE)
    return text + "".join(reflectance(name, 0) for name in names)


def lean(run, text, name="lean", *options, **more):
    done = run(text, name, "--gpu-shading", "--gpu-shading-lean=on", *options, **more)
    assert ray_warnings(done) == []
    return done


def assert_near_stock(stock, answer):
    assert factors(answer) == pytest.approx(factors(stock), rel=TOLERANCE, abs=1e-7)
    # Stock clips polygons, so that its sun through the windows differs from ours.
    for key, values in lux_of(stock).items():
        assert lux_of(answer)[key] == pytest.approx(values, rel=3e-4, abs=0.1), key


# (room, louvres, those hidden)
ROOMS = {
    "louvres": (daylit_rooms.plain, 19, 19),
    "several windows and a map": (daylit_rooms.several_windows_and_a_map, 12, 12),
    "interior window": (daylit_rooms.interior_window, 12, 12),
    "shelf": (daylit_rooms.shelf, 12, 12),
    "light well": (daylit_rooms.light_well, 12, 13),
    "tubular device": (daylit_rooms.tubular_device, 12, 13),
}


@pytest.mark.parametrize("make, count, left_out", ROOMS.values(), ids=ROOMS.keys())
def test_opaque_models_give_stock_results(make, count, left_out, louvres, run):
    text = reflecting(make(louvres(count)))
    answer = lean(run, text)
    assert f"{left_out} shading surfaces hidden" in hidden(answer)
    assert_near_stock(run(text, "stock"), answer)


@pytest.mark.parametrize("frequency", ["Periodic", "Timestep"])
def test_only_the_sky_on_reflecting_surfaces_differs_from_stock(frequency, louvres, run):
    """Which is rendered here, and clipped there."""
    text, count = re.subn(r"Periodic,( *!-[^\n]*\n)?\s*20;", f"{frequency},20;",
                          black_shading(reflecting(daylit_rooms.plain(louvres(12)))))
    assert count == 1
    stock = run(text, "stock")
    assert_equal_to_stock(stock, lean(run, text))


@pytest.mark.parametrize("row", test_models.index(("DaylightingDeviceShelf.idf",)))
def test_models_of_others_give_stock_results(row, official, patched, tmp_path):
    name, weather = row[:2]
    text = re.sub(r"(?i)(Full(?:InteriorAnd)?Exterior)\s*,", r"\1WithReflections,",
                  input_file.read(test_models.MODELS / name).text) + "\nOutput:DaylightFactors,SizingDays;\n"
    assert "WithReflections" in text
    path = tmp_path / name
    path.write_text(text)
    runs = [energyplus.run(program, path, energyplus.find_weather(weather), tmp_path / folder, ["-D", *options])
            for program, folder, options in (
                (official, "stock", ()), (patched, "lean", ("--gpu-shading", "--gpu-shading-lean=on")))]
    for each in runs:
        assert each.completed, each.why()
    values = [np.array([float(value) for line in each.text("eplusout.dfs").splitlines()
                        for value in line.split(",")[2:] if re.match(r"\d+,", line)]) for each in runs]
    assert len(values[0]) > 100
    assert values[1] == pytest.approx(values[0], rel=TOLERANCE, abs=1e-7)


@pytest.fixture
def room(box):
    return reflecting(daylit_rooms.plain(without_louvres(box)))


# A wall that EnergyPlus knows, because an output names it.
OPPOSITE = (shade("Opposite", [(-7, -8, 6), (-7, -8, 0), (13, -8, 0), (13, -8, 6)]) + reflectance("Opposite", 0.6)
            + "Output:Variable,Opposite,Surface Outside Face Sunlit Area,Hourly;\n")


def test_a_canopy_dims_the_sky_and_all_that_it_lights(room, run):
    """Once, on the way down, by its transmittance and its schedule."""
    plain = run(room + OPPOSITE, "plain", "--gpu-shading")
    canopy = (shade("Canopy", CANOPY).replace("Canopy,,", "Canopy,Leaves,") + reflectance("Canopy", 0)
              + "Schedule:Constant,Leaves,,0.7;\nGPUShading:TransparentShade,Tint,Canopy,Constant,0.5;\n")
    dim = lean(run, room + OPPOSITE + canopy)
    assert "1 shading surface hidden" in hidden(dim)
    assert share_of_sky(dim, plain) == pytest.approx(0.35, rel=5e-6)
    # EnergyPlus lets the sun reach all of the ground but at the first hour of daylight.
    up = np.flatnonzero(lux(plain) > 1.0)
    shares = lux(dim)[up] / lux(plain)[up]
    assert shares[:3] == pytest.approx(0.35, rel=1e-5)
    assert shares == pytest.approx(0.35, rel=0.1)


def test_a_sheet_dims_light_on_the_way_to_what_reflects_it_and_back(room, run):
    """Factors are the sum of what passes it once and of what passes it twice."""

    def with_sheet(tau):
        sheet = (shade("Sheet", WALL) + reflectance("Sheet", 0)
                 + f"GPUShading:TransparentShade,Tint,Sheet,Constant,{tau};\n")
        return factors(lean(run, room + OPPOSITE + sheet, f"tau {tau}"))

    plain = factors(run(room + OPPOSITE, "plain", "--gpu-shading"))
    quarter, half, most = (with_sheet(tau) for tau in (0.25, 0.5, 0.75))
    twice = (half / 0.5 - quarter / 0.25) / 0.25
    once = half / 0.5 - 0.5 * twice
    assert (twice / np.maximum(plain, 1e-9)).max() > 0.2
    assert once + twice == pytest.approx(plain, rel=4e-5, abs=1e-7)
    assert 0.75 * once + 0.75**2 * twice == pytest.approx(most, rel=4e-5, abs=1e-7)


# Its upper side towards the sun, below the window.
AWNING = [(-1.013, -4.021, 0.31), (7.017, -4.021, 0.31), (7.017, -0.011, 0.31), (-1.013, -0.011, 0.31)]


def test_a_hidden_surface_reflects_light_by_its_visible_reflectance(room, run):
    awning = room + shade("Awning", AWNING)
    dark, bright = (lean(run, awning + reflectance("Awning", visible), f"{visible}") for visible in (0.1, 0.8))
    stock = run(awning + reflectance("Awning", 0.8), "stock")
    assert_near_stock(stock, bright)
    assert factors(bright).max() > 1.01 * factors(dark).max()
    assert lux(bright).max() > 1.05 * lux(dark).max()


def test_a_perforated_sheet_reflects_light_with_its_solid_area(room, run):
    deployed, visible = 0.6, 0.7
    solid = deployed * (1 - OPEN_SHARE)
    sheet = room + shade("Sheet", WALL)
    pierced = lean(run, sheet + reflectance("Sheet", visible) + f"Schedule:Constant,Down,,{deployed};\n"
                   "GPUShading:PerforatedScreen,Veil,Sheet,Round,,,0.004,,0.008,,0.0,,,,,,,,,,,Down;\n", "pierced")
    tint = f"GPUShading:TransparentShade,Tint,Sheet,Constant,{1 - solid};\n"
    tinted = lean(run, sheet + reflectance("Sheet", solid * visible) + tint, "tinted")
    assert factors(pierced) == pytest.approx(factors(tinted), rel=3e-4, abs=1e-7)


def map_values(done):
    lines = [line.split(",")[1:7] for line in done.text("eplusmap.csv").splitlines() if line.startswith("(")]
    assert len(lines) > 20
    return np.array([[float(value) for value in line] for line in lines])


def test_the_sun_in_a_mirror_is_dimmed_there_and_back(room, run):
    """Between a neighbour's glass front and the box stands a pane. The sun comes over the box, so that its light passes
    the pane twice."""
    room = blacken(room).replace("Output:SQLite", "Output:IlluminanceMap,Map,Box,0.8,0.3,5.7,6,0.3,5.7,6;\n"
                                 "OutputControl:IlluminanceMap:Style,Comma;\nOutput:SQLite")
    room += daylit_rooms.window("West Window", "West", [(0, 5, 2.5), (0, 5, 1.0), (0, 2, 1.0), (0, 2, 2.5)])
    pane = (shade("Pane", [(-2.0, -40, 40), (-2.0, -40, -40), (-2.0, 40, -40), (-2.0, 40, 40)])
            + reflectance("Pane", 0))
    tint = "GPUShading:TransparentShade,Tint,Pane,Constant,0.6;\n"
    no_mirror = GLASS_FRONT.replace("0.8,Window", "0,")
    bare, tinted = (
        map_values(run(room + GLASS_FRONT + between, f"{name}", "--gpu-shading"))
        - map_values(run(room + no_mirror + between, f"{name}, no mirror", "--gpu-shading"))
        for name, between in (("bare", ""), ("tinted", pane + tint)))
    seen = bare > 500.0
    assert seen.sum() >= 10
    assert tinted[seen] / bare[seen] == pytest.approx(0.6**2, rel=4e-3)  # the map has whole lux
    stock, opaque = (map_values(run(room + GLASS_FRONT + pane, name, *options))
                     for name, options in (("stock", ()), ("opaque", ("--gpu-shading", "--gpu-shading-lean=on"))))
    assert opaque == pytest.approx(stock, abs=1.5)
    assert opaque[seen] == pytest.approx(stock[seen])


BUILDING = [(-4.03, -12.0), (-4.03, -20.0), (4.53, -20.0), (4.53, -12.0)]


def test_meshes_and_neighbours_reflect_as_surfaces_would(room, run, tmp_path):
    stock = run(room + tower("House", BUILDING, 0.0, 9.0), "stock")
    obj(tmp_path / "house.obj", BUILDING, 0.0, 9.0, 1.0)
    mesh = lean(run, room + "GPUShading:Geometry,House,house.obj,m,Z;\n", "mesh")
    # Each triangle sees a sky of its own.
    assert factors(mesh) == pytest.approx(factors(stock), rel=3e-4, abs=1e-7)
    write_geojson(tmp_path / "town.geojson", [feature([BUILDING], {"height": 9.0})])
    town = lean(run, room + "GPUShading:SiteContext,Town,town.geojson;\n", "town")
    assert factors(town) == pytest.approx(factors(stock), rel=1e-3, abs=1e-6)


def test_where_energyplus_is_not_as_expected_light_is_only_dimmed(room, run):
    library = energyplus.build_folder() / "tests" / "faults" / "libno_size.so"
    if not library.is_file():
        pytest.skip(f"{library} is missing: run scripts/build")
    awning = room + shade("Awning", AWNING) + reflectance("Awning", 0.8)
    answer = run(awning, "answer", "--gpu-shading", "--gpu-shading-lean=on", environment={"LD_PRELOAD": str(library)})
    warnings = re.findall(r"gpu_shading: EnergyPlus's (\S+) [a-z ]*unexpected layout", answer.text("eplusout.err"))
    assert warnings == ["solar", "daylighting"]
    found, bare = factors(answer), factors(run(room, "bare"))
    assert (found <= bare).all() and (found < bare).any()

"""Site context and meshes shade like the same things given as shading surfaces of the model."""

import base64
import json
import math
import sqlite3
import struct
import subprocess

import numpy as np
import pytest
from html_page import content_of
from PIL import Image, TiffImagePlugin, TiffTags
from shading_runs import energyplus, input_file, results
from test_screens import write_grey_image

# The same casters but for the curvature over a few hundred metres and the rounding of degrees.
PIXELS = 5e-4

# WGS84, and Golden as the box's Site:Location has it.
A, E2 = 6378137.0, 0.00669437999014
LATITUDE, LONGITUDE, ELEVATION = 39.74, -105.18, 1829.0


def degrees(x, y):
    """Longitude and latitude of a place x m east and y m north of the box: by the radii of curvature."""
    s = math.sin(math.radians(LATITUDE))
    meridian = A * (1 - E2) / (1 - E2 * s * s) ** 1.5 + ELEVATION
    vertical = A / math.sqrt(1 - E2 * s * s) + ELEVATION
    return [LONGITUDE + math.degrees(x / (vertical * math.cos(math.radians(LATITUDE)))),
            LATITUDE + math.degrees(y / meridian)]


def shade(name, points):
    return f"Shading:Site:Detailed,{name},,{len(points)},{','.join(f'{v:.9g}' for p in points for v in p)};\n"


def tower(name, outline, base, top):
    """A house of walls and a roof as shading surfaces."""
    sides = zip(outline, outline[1:] + outline[:1], strict=True)
    text = shade(f"{name} roof", [(x, y, top) for x, y in outline])
    for number, (a, b) in enumerate(sides):
        text += shade(f"{name} {number}", [(*a, top), (*a, base), (*b, base), (*b, top)])
    return text


def feature(rings, properties, **members):
    closed = [[degrees(*corner) for corner in ring + ring[:1]] for ring in rings]
    return {"type": "Feature", "properties": properties,
            "geometry": {"type": "Polygon", "coordinates": closed}, **members}


def write_geojson(path, features):
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))


@pytest.fixture
def run(patched, weather, tmp_path):
    """Runs a model's design day in a folder of the test's files."""

    def call(text, name, options=(), environment=None):
        model = input_file.Idf(text)
        results.instrument(model)
        path = tmp_path / f"{name}.idf"
        model.write(path)
        done = energyplus.run(patched, path, weather, tmp_path / name,
                              ["--gpu-shading", "-D", *options], environment)
        assert done.completed, done.why()
        return done

    return call


@pytest.fixture
def bare(box):
    """The box with its window, no louvre before it."""
    model = input_file.Idf(box)
    model.remove(lambda name: name.startswith("shading:"))
    return model.text


def assert_alike(reference, answer, shaded):
    """Sunlit fractions of every receiver, of which `shaded` are shaded at some hour."""
    reference, answer = results.Results(reference.folder), results.Results(answer.folder)
    found = results.differences(reference, answer)
    names = {each.receiver.name for each in found if min(each.reference) < 0.98}
    assert names >= set(shaded)
    largest = max(each.largest for each in found)
    print(f"largest difference {largest:.1e}, shaded: {', '.join(sorted(names))}")
    assert largest < PIXELS


SOUTH = [(-5.0, -20.0), (11.0, -20.0), (11.0, -12.0), (-5.0, -12.0)]
EAST = [(14.0, -2.0), (20.0, -2.0), (20.0, 10.0), (14.0, 10.0)]


@pytest.mark.parametrize("north_axis", [0, 30])
def test_buildings_shade_like_surfaces_where_the_model_has_none(run, bare, tmp_path, north_axis):
    """The model may be turned: the map and EnergyPlus's site shading stay."""
    model = input_file.Idf(bare)
    model.set_field("Building", (1, "north_axis"), str(north_axis))
    model.set_field("GlobalGeometryRules", (2, "coordinate_system"), "Relative")
    reference = run(model.text + tower("South", SOUTH, 0, 9) + tower("East", EAST, 3, 8), "surfaces")
    write_geojson(tmp_path / "town.geojson", [
        feature([SOUTH], {"building": "yes", "height": "9 m"}, id="way/1"),
        feature([EAST[::-1]], {"building:levels": 4, "height": None, "min_height": 3}),
        {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": degrees(3, -9)}},
    ])
    answer = run(model.text + "GPUShading:SiteContext,Town,town.geojson,,,,2;\n", "context")
    assert_alike(reference, answer, ["SOUTH", "EAST"])
    lines = [line for line in answer.our_lines if "SiteContext" in line]
    assert len(lines) == 1, lines
    assert "2 buildings (10 walls and roofs, 1 features without area)" in lines[0]
    assert "x -5.0 to 20.0, y -20.0 to 10.0, z 0.0 to 9.0 m" in lines[0]
    assert "39.740000 N 105.180000 W 1829.0 m (Site:Location)" in lines[0]


def test_terrain_shades_like_a_slope(run, bare, tmp_path):
    """In a side file. The hillside is one plane, 12 m high 32 m to the south and level with the box at 8 m."""
    plane = [(-60, -32, 12), (-60, -8, 0), (60, -8, 0), (60, -32, 12)]
    reference = run(bare + shade("Hillside", plane), "surfaces")
    (west, south), (east, north) = degrees(-60, -32), degrees(60, -8)
    (tmp_path / "hill.asc").write_text(
        f"ncols 3\nnrows 2\nxllcenter {west:.12f}\nyllcenter {south:.12f}\n"
        f"dx {(east - west) / 2:.12f}\ndy {north - south:.12f}\n"
        f"{ELEVATION} {ELEVATION} {ELEVATION}\n{ELEVATION + 12} {ELEVATION + 12} {ELEVATION + 12}\n")
    (tmp_path / "context.gpu-shading.idf").write_text("GPUShading:SiteContext,Hill,,,,,,,hill.asc;\n")
    answer = run(bare, "context", [f"--gpu-shading-report={tmp_path / 'report'}"])
    assert_alike(reference, answer, ["SOUTH"])
    terrain = content_of(tmp_path / "report" / "index.html")["terrain"]
    nodes, codes = terrain["nodes"], np.frombuffer(base64.b64decode(terrain["heights"]), "<u2")
    x, y = (terrain["low"][axis] + terrain["step"][axis] * np.arange(nodes) for axis in (0, 1))
    x, y = np.meshgrid(x, y)
    inside = (abs(x) < 59.9) & (y > -31.9) & (y < -8.1)
    outside = (abs(x) > 60.1) | (y < -32.1) | (y > -7.9)
    codes = codes.reshape(nodes, nodes)
    assert inside.sum() > 1000 and (codes[outside] == terrain["none"]).all()
    heights = terrain["low"][2] + terrain["rise"] * codes[inside]
    assert heights == pytest.approx((-8 - y[inside]) / 2, abs=0.01)
    assert any("terrain of 3 x 2 nodes (2 cells drawn)" in line for line in answer.our_lines)


def write_geotiff(path, rows, corner, steps, epsg):
    """By the format's own tags (OGC 19-008): rows from the north, cells as areas from a corner."""
    tags = TiffImagePlugin.ImageFileDirectory_v2()
    for tag, kind, value in (
            (33550, TiffTags.DOUBLE, (*steps, 0.0)),
            (33922, TiffTags.DOUBLE, (0.0, 0.0, 0.0, *corner, 0.0)),
            # Version, then model type, raster type and the projected coordinates' code.
            (34735, TiffTags.SHORT, (1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, epsg))):
        tags[tag], tags.tagtype[tag] = value, kind
    Image.fromarray(np.array(rows, np.float32)).save(path, tiffinfo=tags)


def test_a_geotiff_is_the_same_ground_as_its_numbers_in_ascii(run, bare, tmp_path):
    """A ridge to the south, in UTM: Golden is at 484,577 m east, 4,398,917 m north of zone 13."""
    west, south, step = 484_400.0, 4_398_700.0, 20.0
    rows = [[ELEVATION + (25.0 + column if 7 <= row <= 9 else 0.0) for column in range(18)] for row in range(12, 0, -1)]
    (tmp_path / "hill.asc").write_text(
        f"ncols 18\nnrows 12\nxllcorner {west}\nyllcorner {south}\ncellsize {step}\n"
        + "\n".join(" ".join(map(str, row)) for row in rows))
    write_geotiff(tmp_path / "hill.tif", rows, (west, south + 12 * step), (step, step), 32613)
    answers = [run(bare + f"GPUShading:SiteContext,Hill,,,,,,,{fields};\n", name)
               for name, fields in (("ascii", "hill.asc,UTM 13N"), ("geotiff", "hill.tif"))]
    remarks = [[line for line in answer.our_lines if "SiteContext" in line] for answer in answers]
    assert remarks[0] == remarks[1] and "terrain of 18 x 12 nodes" in remarks[0][0]
    found = results.differences(*(results.Results(answer.folder) for answer in answers))
    assert max(each.largest for each in found) == 0.0
    assert min(min(each.reference) for each in found) < 0.9


def test_a_horizon_shades_like_the_hills_that_it_stands_for(run, bare, tmp_path):
    """A ridge in the south and west, 3 km away and 1,500 to 1,650 m high."""
    far, step, count = 4_000.0, 200.0, 41
    rows = [[ELEVATION + (1500 + 7.5 * abs(column - 20) if min(column * step, (row - 1) * step) <= 1_000 else 0)
             for column in range(count)] for row in range(count, 0, -1)]
    (tmp_path / "hill.asc").write_text(
        f"ncols {count}\nnrows {count}\nxllcenter {484_577 - far}\nyllcenter {4_398_917 - far}\ncellsize {step}\n"
        + "\n".join(" ".join(map(str, row)) for row in rows))
    open_, drawn, horizon = (run(bare + text, name) for name, text in (
        ("open", ""), ("drawn", "GPUShading:SiteContext,Hill,,,,,,,hill.asc,UTM 13N,500;"),
        ("horizon", "GPUShading:SiteContext,Hill,,,,,,,hill.asc,UTM 13N,500,,,,1000,20000;")))
    assert any("horizon of what is within 20000 m" in line for line in horizon.our_lines)
    totals = [results.Results(answer.folder).total(results.BEAM) for answer in (open_, drawn, horizon)]
    print(totals)
    assert totals[1] < 0.95 * totals[0]
    assert totals[2] == pytest.approx(totals[1], rel=1e-3)


LIGHT = """
Daylighting:Controls,Light,Box,SplitFlux,,Continuous,0.3,0.2,,,,,,,Point,1.0,500;
Daylighting:ReferencePoint,Point,Box,3,3,0.8;
Output:Variable,*,Daylighting Reference Point 1 Illuminance,Hourly;
"""


def test_daylighting_and_reflections_do_not_see_placeholders(run, bare, tmp_path):
    """They are next to nothing, and the neighbour is too small and far to count."""
    model = input_file.Idf(bare + LIGHT)
    model.set_field("Building", (5, "solar_distribution"), "FullExteriorWithReflections")
    zone = model.field("Zone", (0, "name"))
    text = model.text.replace(",Light,Box,", f",Light,{zone},").replace(",Point,Box,", f",Point,{zone},")
    reference = run(text, "none")
    write_geojson(tmp_path / "town.geojson", [feature([[(0, 300), (1, 300), (1, 301)]], {"height": 1})])
    answer = run(text + "GPUShading:SiteContext,Town,town.geojson;\n", "context",
                 ["--gpu-shading-reflections=energyplus"])
    before, after = (lux(each) for each in (reference, answer))
    assert max(before) > 500
    assert after == pytest.approx(before, rel=1e-4)
    assert_alike(reference, answer, [])
    runs = [results.Results(each.folder) for each in (reference, answer)]
    solar = [each.total(results.SOLAR) for each in runs]
    assert solar[0] > 1
    assert solar[1] == pytest.approx(solar[0], rel=2e-3)
    assert "may be inaccurate" not in answer.text("eplusout.err")


def lux(run):
    with sqlite3.connect(f"file:{run.folder / 'eplusout.sql'}?mode=ro", uri=True) as data:
        rows = data.execute("SELECT Value FROM ReportData JOIN ReportDataDictionary USING (ReportDataDictionaryIndex) "
                            "WHERE Name LIKE 'Daylighting Reference Point%' ORDER BY ReportDataIndex").fetchall()
    data.close()
    return [value for (value,) in rows]


@pytest.mark.parametrize("fields, words", [
    ("Town,village.geojson", ("Buildings File Name", "village.geojson: no such file")),
    ("Town", ("Buildings File Name and Terrain File Name are blank",)),
])
def test_errors_are_one_line_before_the_run(patched, bare, weather, tmp_path, fields, words):
    model = tmp_path / "model.idf"
    model.write_text(bare + f"GPUShading:SiteContext,{fields};\n")
    done = subprocess.run([patched, "--gpu-shading", "-D", "-w", weather, "-d", tmp_path / "out", model],
                          capture_output=True, text=True)
    assert done.returncode == 1
    lines = done.stderr.splitlines()
    assert len(lines) == 1 and lines[0].startswith(f"gpu_shading: error: {model}: GPUShading:SiteContext Town: ")
    for word in words:
        assert word in lines[0]
    assert "GPUShading:SiteContext Town: " in (tmp_path / "out" / "eplusout.err").read_text()


def obj(path, outline, base, top, scale):
    """A prism in an OBJ file, z up: quadrilaterals with two materials and their library."""
    path.with_suffix(".mtl").write_text("newmtl Stone\nKd 1 1 1\nnewmtl Slate\nKd 0 0 0\n")
    lines = [f"mtllib {path.stem}.mtl", "o House"]
    for z in (base, top):
        lines += [f"v {x * scale:.6f} {y * scale:.6f} {z * scale:.6f}" for x, y in outline]
    count = len(outline)
    lines.append("usemtl Stone")
    for i in range(count):
        after = (i + 1) % count
        lines.append(f"f {i + 1} {after + 1} {count + after + 1} {count + i + 1}")
    lines += ["usemtl Slate", "f " + " ".join(str(count + i + 1) for i in range(count))]
    path.write_text("\n".join(lines) + "\n")


def prism(outline, base, top):
    """Corners and triangles of a house of four corners, its roof included."""
    corners = [(*corner, z) for z in (base, top) for corner in outline]
    triangles = [(4, 5, 6), (4, 6, 7)]
    for i in range(4):
        triangles += [(i, (i + 1) % 4, 4 + (i + 1) % 4), (i, 4 + (i + 1) % 4, 4 + i)]
    return corners, triangles


def gltf(path, outline, base, top):
    """A prism in a glTF file, metres and y up, moved into place by its node, buffer in the file."""
    corners, triangles = prism(outline, base, top)
    away = (3.0, -1.0, 2.0)
    data = b"".join(struct.pack("<3f", x - away[0], z - away[1], -y - away[2]) for x, y, z in corners)
    indices = b"".join(struct.pack("<3H", *triangle) for triangle in triangles)
    low = [min(struct.unpack_from("<f", data, 12 * i + 4 * axis)[0] for i in range(8)) for axis in range(3)]
    high = [max(struct.unpack_from("<f", data, 12 * i + 4 * axis)[0] for i in range(8)) for axis in range(3)]
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "House", "mesh": 0, "translation": away}],
        "materials": [{"name": "Stone"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "buffers": [{"byteLength": len(data + indices), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data + indices).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(data)},
                        {"buffer": 0, "byteOffset": len(data), "byteLength": len(indices)}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5123, "count": 3 * len(triangles), "type": "SCALAR"}]}))


def collada(path, outline, base, top):
    """A prism in a COLLADA file, inches and z up."""
    corners, triangles = prism(outline, base, top)
    numbers = " ".join(f"{value / 0.0254:.6f}" for corner in corners for value in corner)
    indices = " ".join(str(i) for triangle in triangles for i in triangle)
    path.write_text(f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert/></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="m" name="Stone"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="House"><mesh>
<source id="p"><float_array id="pa" count="24">{numbers}</float_array><technique_common>
<accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{len(triangles)}" material="s"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="n" name="House"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>
""")


def test_meshes_of_every_format_shade_like_surfaces(run, bare, tmp_path):
    reference = run(bare + tower("South", SOUTH, 0, 9) + tower("East", EAST, 3, 8), "surfaces")
    # The house to the south about its own corner, turned by 90 degrees: its x is south, its y east.
    (x0, y0), east = SOUTH[0], EAST
    turned = [(y0 - y, x - x0) for x, y in SOUTH]
    obj(tmp_path / "south.obj", turned, 0, 9, 100)
    longitude, latitude = degrees(x0, y0)
    south = (f"GPUShading:Geometry,S,south.obj,cm,Z,,,,{latitude:.12f},{longitude:.12f},,90;\n")
    obj(tmp_path / "east.obj", east, 3, 8, 1000 / 304.8)
    gltf(tmp_path / "east.gltf", east, 3, 8)
    collada(tmp_path / "east.dae", [(x - 2, y) for x, y in east], 3, 8)
    for name, geometry in (("obj", "E,east.obj,ft,Z"), ("gltf", "E,east.gltf"), ("dae", "E,east.dae,,,2,0")):
        answer = run(bare + south + f"GPUShading:Geometry,{geometry};\n", name)
        assert_alike(reference, answer, ["SOUTH", "EAST"])
        lines = [line for line in answer.our_lines if "GPUShading:Geometry E" in line]
        assert len(lines) == 1
        assert "10 triangles; x 14.0 to 20.0, y -2.0 to 10.0, z 3.0 to 8.0 m" in lines[0], lines


PANEL = [(-1, -1.5, 4), (-1, -1.5, 0), (7, -1.5, 0), (7, -1.5, 4)]


def test_materials_are_shades_and_screens_with_the_meshs_own_texture(run, bare, tmp_path):
    """A sheet of four images by two before the wall, its texture turned: u runs up, v to the left."""
    write_grey_image(tmp_path / "leaves.png", [[255, 0, 0, 255], [0, 255, 255, 255], [255, 255, 0, 255]])
    lines = ["o Sheet", "usemtl Leaves"]
    lines += [f"v {x} {z} {-y}" for x, y, z in PANEL]  # y up
    lines += [f"vt {(z - 0.3) / 1.0:.6f} {(6.5 - x) / 2.0:.6f}" for x, y, z in PANEL]
    lines += ["f 1/1 3/3 2/2", "f 1/1 3/3 4/4", "o Roof", "usemtl Glass"]
    roof = [(-1, -1.5, 4), (7, -1.5, 4), (7, 1, 4), (-1, 1, 4)]
    lines += [f"v {x} {z} {-y}" for x, y, z in roof] + ["f 5 6 7 8"]
    (tmp_path / "porch.obj").write_text("\n".join(lines) + "\n")
    # On the surface the tile lies from the lower left corner: (0, 0) at x 6.5, z 0.3, u up.
    screen = "GPUShading:PerforatedScreen,Leaves,{},Texture,leaves.png,,,,,,0.02,,,,,,{},{}{};\n"
    glass = "GPUShading:TransparentShade,Glass,{},Constant,0.4;\n"
    reference = run(bare + shade("Panel", PANEL) + shade("Roof Pane", roof) + glass.format("Roof Pane")
                    + screen.format("Panel", 1, 2, ",7.5,0.3,90"), "surfaces")
    answer = run(bare + "GPUShading:Geometry,Porch,porch.obj,m,Y;\n" + glass.format("Porch:glass:*")
                 + screen.format("Porch:Leaves:*", "", "", ""), "mesh")
    assert_alike(reference, answer, ["SOUTH", "ROOF"])
    eio = answer.text("eplusout.eio")
    assert "GPU Shading Surface,PORCH:GLASS:ROOF,transparent (constant 0.4)" in eio
    assert eio.count("PORCH:LEAVES:SHEET,perforated (texture leaves.png 4 x 3") == 1

#include "files/mesh_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>

#include "files/decoding/sandbox.h"
#include "gpu_shading/error.h"
#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;
using testing::Not;

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path write(std::string const& name, std::string const& text) {
    auto path = folder_.path() / name;
    std::ofstream(path) << text;
    return path;
  }

  std::string refusal(std::string const& name, std::string const& text) {
    return refusal_of([&] { read_meshes(write(name, text)); });
  }

  TemporaryFolder folder_;
};

TEST_F(MeshFile, ObjAsItIs) {
  write("a.mtl", "newmtl Wood\nKd 1 0 0\n");
  auto const meshes =
      read_meshes(write("a.obj",
                        "mtllib a.mtl\no Shelf\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n"
                        "vt 0 0\nvt 4 0\nvt 4 2\nvt 0 2\n"
                        "usemtl Wood\nf 1/1 2/2 3/3 4/4\n"
                        "usemtl Missing\nf 1/1 2/2 3/3\nl 1 2\n"));
  ASSERT_EQ(meshes.size(), 2U);
  EXPECT_EQ(meshes[0].name, "Shelf");
  EXPECT_EQ(meshes[0].material, "Wood");
  EXPECT_EQ(meshes[1].material, "Missing");
  EXPECT_EQ(meshes[0].triangles.size(), 2U);
  EXPECT_EQ(meshes[1].triangles.size(), 1U);
  ASSERT_EQ(meshes[0].texture.size(), meshes[0].positions.size());
  // v runs upwards, as the file has it.
  for (std::size_t i = 0; i < meshes[0].positions.size(); ++i) {
    EXPECT_EQ(meshes[0].texture[i].x, 2.0 * meshes[0].positions[i].x);
    EXPECT_EQ(meshes[0].texture[i].y, 2.0 * meshes[0].positions[i].y);
  }
}

TEST_F(MeshFile, GltfTextureIsTurnedUpwards) {
  // One triangle (0, 0, 0), (1, 0, 0), (0, 1, 0) whose third corner is at the image's top, v = 0 in
  // glTF, the others at its bottom, v = 1.
  auto const meshes = read_meshes(write("t.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"name": "N", "mesh": 0, "scale": [2, 2, 2]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}}]}],
    "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAIA/AACAPwAAAAAAAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0,0,0], "max": [1,1,0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]})"));
  ASSERT_EQ(meshes.size(), 1U);
  EXPECT_EQ(meshes[0].name, "N");
  ASSERT_EQ(meshes[0].positions.size(), 3U);
  EXPECT_EQ(meshes[0].positions[1].x, 2.0);
  EXPECT_EQ(meshes[0].positions[2].y, 2.0);
  EXPECT_EQ(meshes[0].texture[0].y, 0.0);
  EXPECT_EQ(meshes[0].texture[2].y, 1.0);
}

TEST_F(MeshFile, FormatsThatStateTheirAxes) {
  EXPECT_FALSE(states_its_axes("a.obj"));
  EXPECT_FALSE(states_its_axes("A.OBJ"));
  for (char const* name : {"a.dae", "a.gltf", "a.GLB"}) EXPECT_TRUE(states_its_axes(name)) << name;
  EXPECT_THROW(states_its_axes("a.skp"), Error);
}

TEST_F(MeshFile, SaysWhatIsWrong) {
  EXPECT_THROW(read_meshes("/nowhere/a.obj"), Error);
  EXPECT_THAT(refusal("b.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), HasSubstr("b.obj: "));
  EXPECT_THAT(refusal("c.gltf", "{"), HasSubstr("c.gltf: cannot be read: "));
  EXPECT_THAT(refusal("d.dae", "<COLLADA>"), HasSubstr("d.dae: cannot be read: "));
}

// A COLLADA file of one triangle, whose node has a name and may have others below.
std::string collada(std::string const& coordinates, std::string const& indices,
                    std::string const& node) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p">)" +
         coordinates + R"(<technique_common><accessor source="#a" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
         indices + R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">)" +
         node + R"(</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

constexpr auto triangle = R"(<float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>)";
constexpr auto leaf = R"(<node id="n"><instance_geometry url="#g"/></node>)";

std::string repeated(std::string const& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::string gltf(std::string const& nodes) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" +
         nodes + "]}";
}

// Each of the following made Assimp crash, or run on for minutes or through all memory.

TEST_F(MeshFile, DamagedCollada) {
  ASSERT_EQ(refusal("good.dae", collada(triangle, "0 1 2", leaf)), "accepted");
  for (auto const& [name, text] :
       {std::pair{"no_floats.dae", collada(R"(<float_array id="a" count="0"/>)", "0 1 2", leaf)},
        std::pair{"letter.dae", collada(triangle, "0 1 x", leaf)},
        std::pair{"outside.dae", collada(triangle, "0 1 5", leaf)},
        std::pair{"deep.dae",
                  collada(triangle, "0 1 2",
                          repeated("<node>", 100'000) + leaf + repeated("</node>", 100'000))},
        std::pair{"cyclic.dae", collada(triangle, "0 1 2",
                                        R"(<node id="c"><instance_node url="#c"/></node>)")}}) {
    if (!decoding::limits_memory && std::string_view(name) == "letter.dae") continue;
    auto const message = refusal(name, text);
    EXPECT_THAT(message, HasSubstr(std::string(name) + ": ")) << name;
    EXPECT_THAT(message, Not(HasSubstr("\n"))) << name;
  }
}

TEST_F(MeshFile, NodesOfGltfAreTrees) {
  EXPECT_THAT(refusal("cyclic.gltf", gltf(R"({"children": [1]}, {"children": [0]})")),
              HasSubstr("node 0 is more than 1000 nodes deep, or below itself"));
  std::string deep;
  for (int i = 1; i < 100'000; ++i) deep += fmt::format(R"({{"children": [{}]}},)", i);
  EXPECT_THAT(refusal("deep.gltf", gltf(deep + "{}")), HasSubstr("nodes deep"));
  std::string doubling;
  for (int i = 1; i < 41; ++i) {
    doubling += fmt::format(R"({{"children": [{0}, {0}]}},)", i);
  }
  EXPECT_THAT(refusal("doubling.gltf", gltf(doubling + "{}")),
              HasSubstr("node 1 is a child of more than one node, or twice of one"));
  EXPECT_THAT(refusal("missing.gltf", gltf(R"({"children": [1]})")),
              HasSubstr("node 0 has a child that does not exist"));
}

TEST_F(MeshFile, LengthsOfGlb) {
  auto const number = [](std::uint32_t value) {
    return std::string(reinterpret_cast<char const*>(&value), sizeof value);
  };
  auto const json = R"({"asset": {"version": "2.0"}})";
  auto const size = static_cast<std::uint32_t>(std::strlen(json));
  auto const glb = [&](std::uint32_t length, std::uint32_t chunk) {
    return "glTF" + number(2) + number(length) + number(chunk) + "JSON" + json;
  };
  EXPECT_THAT(refusal("header.glb", glb(0xFFFFFFF0, size)),
              HasSubstr("its header states 4294967280 bytes, but it has"));
  EXPECT_THAT(refusal("chunk.glb", glb(20 + size, 0xFFFFFFF0)),
              HasSubstr("a chunk states 4294967280 bytes"));
  EXPECT_THAT(refusal("short.glb", "glTF"), HasSubstr("shorter than a GLB's header"));
}

// The vertices and the face of a regular polygon around the origin.
std::string regular_polygon(int corners, double radius = 1.0) {
  std::string vertices;
  std::string face = "f";
  for (int i = 0; i < corners; ++i) {
    double const angle = 6.283185307 * i / corners;
    vertices += fmt::format("v {} {} 0\n", radius * std::cos(angle), radius * std::sin(angle));
    face += fmt::format(" {}", i + 1);
  }
  return vertices + face + "\n";
}

double mesh_area(Mesh const& mesh) {
  double area = 0.0;
  for (auto const& [a, b, c] : mesh.triangles) {
    auto const& first = mesh.positions[a];
    area += 0.5 * glm::length(glm::cross(mesh.positions[b] - first, mesh.positions[c] - first));
  }
  return area;
}

TEST_F(MeshFile, CornersOfAFace) {
  EXPECT_EQ(refusal("round.obj", regular_polygon(1000)), "accepted");
  EXPECT_THAT(refusal("rounder.obj", regular_polygon(30'000)),
              HasSubstr("a face has 30000 corners, expected at most 1000"));
}

TEST_F(MeshFile, SmallFacesAreWhole) {
  for (int const corners : {5, 12, 1000}) {
    for (double const radius : {0.0005, 0.02, 1.0, 5000.0}) {
      // A triangle far away, too.
      auto const text =
          regular_polygon(corners, radius) + "v 9000 0 0\nv 9001 0 0\nv 9000 1 0\nf -3 -2 -1\n";
      auto const meshes = read_meshes(write("small.obj", text));
      ASSERT_EQ(meshes.size(), 1U);
      auto const expected = 0.5 * corners * std::sin(6.283185307 / corners) * radius * radius;
      EXPECT_EQ(meshes[0].triangles.size(), static_cast<std::size_t>(corners - 2 + 1));
      EXPECT_NEAR(mesh_area(meshes[0]) - 0.5, expected, 1e-5 * expected + 1e-9)
          << corners << " corners, radius " << radius;
    }
  }
}

TEST_F(MeshFile, FilesThatItNamesAreInItsFolder) {
  auto const folder = folder_.path() / "model";
  std::filesystem::create_directories(folder / "sub");
  std::ofstream(folder_.path() / "out.mtl") << "newmtl Wood\n";
  std::ofstream(folder / "sub" / "in.mtl") << "newmtl Wood\n";
  std::filesystem::create_symlink("../out.mtl", folder / "link.mtl");
  auto const faces = "v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl Wood\nf 1 2 3\n";
  EXPECT_EQ(refusal("model/in.obj", std::string("mtllib sub/in.mtl\n") + faces), "accepted");
  EXPECT_EQ(refusal("model/none.obj", std::string("mtllib none.mtl\n") + faces), "accepted");
  for (auto const& name :
       {std::string("../out.mtl"), std::string("link.mtl"), std::string("missing/../link.mtl"),
        (folder_.path() / "out.mtl").string()}) {
    auto const text = "mtllib " + name + "\n" + faces;
    EXPECT_THAT(refusal("model/out.obj", text), HasSubstr("out.mtl, which is outside its folder"))
        << name;
    EXPECT_EQ(read_meshes(write("model/out.obj", text), Assets::any).size(), 1U);
  }
  std::ofstream(folder_.path() / "out.bin") << std::string(36, '\0');
  auto const buffer = [](std::string const& uri) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "buffers": [{"byteLength": 36, "uri": ")" +
           uri + R"("}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})";
  };
  EXPECT_THAT(refusal("model/out.gltf", buffer("../out.bin")),
              HasSubstr("out.bin, which is outside its folder"));
  std::filesystem::copy_file(folder_.path() / "out.bin", folder / "in.bin");
  EXPECT_EQ(refusal("model/in.gltf", buffer("in.bin")), "accepted");
}

TEST_F(MeshFile, OtherFormatsAreReadWithTheFlagAlone) {
  auto const stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid s\n";
  EXPECT_THAT(refusal("a.stl", stl), HasSubstr("expected an .obj, .dae, .gltf or .glb file"));
  EXPECT_EQ(read_meshes(write("b.stl", stl), Assets::any).size(), 1U);
  EXPECT_FALSE(states_its_axes("a.stl", Assets::any));
  // Another format behind an ending of these.
  EXPECT_THAT(refusal("c.obj", stl), HasSubstr("c.obj: "));
}

}  // namespace
}  // namespace gpu_shading::energyplus

#include "assets/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/process.h"
#include "gpu_shading/error.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

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

}  // namespace
}  // namespace gpu_shading::energyplus

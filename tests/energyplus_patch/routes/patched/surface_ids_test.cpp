#include "routes/patched/memory/surface_ids.h"

#include <gtest/gtest.h>

#include "patch_target_library.h"

namespace gpu_shading::energyplus {
namespace {

TEST(StoredResult, PathIsReadFromTheLastCall) {
  PatchTarget const target("stored");
  auto const symbols = target.symbols();
  auto const path =
      find_stored_result(*symbols.find("stores_number"), *symbols.find("gives_number"));
  ASSERT_TRUE(path);
  EXPECT_EQ(path->outer, 0x148);
  EXPECT_EQ(path->inner, 0x28);
}

TEST(StoredResult, OtherCodeGivesNone) {
  PatchTarget const target("not_stored");
  auto const symbols = target.symbols();
  EXPECT_FALSE(find_stored_result(*symbols.find("call_twice"), *symbols.find("gives_number")));
  EXPECT_FALSE(find_stored_result(*symbols.find("gives_number"), *symbols.find("gives_number")));
}

}  // namespace
}  // namespace gpu_shading::energyplus

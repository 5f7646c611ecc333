#include "binary/entry_patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "gpu_shading/error.h"
#include "patch_target_library.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

constexpr char const* twice_name = "_ZN12_GLOBAL__N_15twiceEi";

void* original = nullptr;

int hundred(int /*value*/) { return 100; }
int one_more_than_original(int value) {
  return reinterpret_cast<int (*)(int)>(original)(value) + 1;
}
int one_more_than_memory() { return reinterpret_cast<int (*)()>(original)() + 1; }
int nine() { return 9; }

template <typename Function>
void* address(Function* function) {
  return reinterpret_cast<void*>(function);
}

TEST(EntryPatch, LocalFunctionIsReplaced) {
  PatchTarget const target("replaced");
  ASSERT_EQ(target.call("call_twice", 21), 42);
  patch_entries(target.symbols(), {{twice_name, address(&hundred)}});
  EXPECT_EQ(target.call("call_twice", 21), 100);
}

TEST(EntryPatch, WatchedFunctionStillRuns) {
  PatchTarget const target("watched");
  patch_entries(target.symbols(), {{twice_name, address(&one_more_than_original), &original}});
  EXPECT_EQ(target.call("call_twice", 21), 43);
}

TEST(EntryPatch, MovedCodeStillReadsItsMemory) {
  PatchTarget const target("memory");
  ASSERT_EQ(target.call("call_reads_memory_first"), 42);
  patch_entries(target.symbols(),
                {{"reads_memory_first", address(&one_more_than_memory), &original}});
  EXPECT_EQ(target.call("call_reads_memory_first"), 43);
}

TEST(EntryPatch, RelativeJumpCannotBeMovedButCanBeReplaced) {
  PatchTarget const target("jump");
  EXPECT_THROW(patch_entries(target.symbols(), {{"jumps_first", address(&nine), &original}}),
               Error);
  EXPECT_EQ(target.call("call_jumps_first"), 7);
  patch_entries(target.symbols(), {{"jumps_first", address(&nine)}});
  EXPECT_EQ(target.call("call_jumps_first"), 9);
}

TEST(EntryPatch, OneBadEntryLeavesAllAsTheyWereAndAllAreNamed) {
  PatchTarget const target("all_or_none");
  try {
    patch_entries(target.symbols(), {{twice_name, address(&hundred)},
                                     {"too_short", address(&nine)},
                                     {"not_there", address(&nine)}});
    FAIL() << "patched a function that is too short";
  } catch (Error const& error) {
    EXPECT_THAT(error.what(), HasSubstr("too_short"));
    EXPECT_THAT(error.what(), HasSubstr("not_there: not in this build"));
  }
  EXPECT_EQ(target.call("call_twice", 21), 42);
  EXPECT_EQ(target.call("call_too_short"), 3);
}

TEST(EntryPatch, OptionalEntryMayBeMissing) {
  PatchTarget const target("optional");
  EntryPatch optional{"not_there", address(&nine)};
  optional.needed = false;
  patch_entries(target.symbols(), {optional, {twice_name, address(&hundred)}});
  EXPECT_EQ(target.call("call_twice", 21), 100);
}

TEST(EntryPatch, SecondPatchIsRefused) {
  PatchTarget const target("second");
  patch_entries(target.symbols(), {{twice_name, address(&hundred)}});
  EXPECT_THROW(patch_entries(target.symbols(), {{twice_name, address(&hundred)}}), Error);
}

TEST(EntryPatch, NoPageIsWritableAndExecutable) {
  PatchTarget const target("pages");
  patch_entries(target.symbols(), {{twice_name, address(&one_more_than_original), &original}});
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    EXPECT_THAT(line, Not(HasSubstr("rwx"))) << line;
  }
}

TEST(SymbolTable, StrippedFileIsRefused) {
  EXPECT_THROW(SymbolTable("/proc/self/cmdline", nullptr), Error);
}

}  // namespace
}  // namespace gpu_shading::energyplus

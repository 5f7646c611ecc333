#include "routes/patched/binary/entry_patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <numeric>
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

// Changes every register that a function may change.
void change_all_registers() {
  asm volatile(
      "mov $-1, %%rax\n\t"
      "mov %%rax, %%rcx\n\t"
      "mov %%rax, %%rdx\n\t"
      "mov %%rax, %%rsi\n\t"
      "mov %%rax, %%rdi\n\t"
      "mov %%rax, %%r8\n\t"
      "mov %%rax, %%r9\n\t"
      "mov %%rax, %%r10\n\t"
      "mov %%rax, %%r11\n\t"
      "movq %%rax, %%xmm0\n\t"
      "movq %%rax, %%xmm1\n\t"
      "movq %%rax, %%xmm2\n\t"
      "movq %%rax, %%xmm3\n\t"
      "movq %%rax, %%xmm4\n\t"
      "movq %%rax, %%xmm5\n\t"
      "movq %%rax, %%xmm6\n\t"
      "movq %%rax, %%xmm7\n\t"
      "movq %%rax, %%xmm8\n\t"
      "movq %%rax, %%xmm9\n\t"
      "movq %%rax, %%xmm10\n\t"
      "movq %%rax, %%xmm11\n\t"
      "movq %%rax, %%xmm12\n\t"
      "movq %%rax, %%xmm13\n\t"
      "movq %%rax, %%xmm14\n\t"
      "movq %%rax, %%xmm15\n\t"
      :
      :
      : "rax", "rcx", "rdx", "rsi", "rdi", "r8", "r9", "r10", "r11", "xmm0", "xmm1", "xmm2", "xmm3",
        "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14",
        "xmm15");
}
int change_all_and_give_integer() {
  change_all_registers();
  return 8;
}
double change_all_and_give_real() {
  change_all_registers();
  return 0.5;
}
using Digits = int(int, int, int, int, int, int, int, int, int, int, int, int, int, int);
Digits* original_digits = nullptr;
int other_digits(int a, int b, int c, int d, int e, int f, int g, int h, int i, int j, int k, int l,
                 int m, int n) {
  int const sum = a + b + c + d + e + f + g + h + i + j + k + l + m + n;
  return 1000 * sum + original_digits(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
}
int throw_from_entry() { throw Error("from the entry"); }

constexpr std::size_t first_real = 0;      // xmm0 in Registers
constexpr std::size_t first_integer = 16;  // rax
using Registers = std::array<std::uint64_t, 25>;

Registers numbered_registers() {
  Registers registers{};
  std::iota(registers.begin(), registers.end(), 1000U);
  return registers;
}

TEST(EntryPatch, OnlyTheRegisterOfAnIntegerResultChanges) {
  PatchTarget const target("integer_registers");
  patch_entries(target.symbols(), {replace("gives_integer", &change_all_and_give_integer)});
  auto registers = numbered_registers();
  target.call("call_gives_integer", registers.data());
  auto expected = numbered_registers();
  expected[first_integer] = 8;
  EXPECT_EQ(registers, expected);
}

TEST(EntryPatch, OnlyTheRegisterOfARealResultChanges) {
  PatchTarget const target("real_registers");
  patch_entries(target.symbols(), {replace("gives_real", &change_all_and_give_real)});
  auto registers = numbered_registers();
  target.call("call_gives_real", registers.data());
  auto expected = numbered_registers();
  expected[first_real] = std::bit_cast<std::uint64_t>(0.5);
  EXPECT_EQ(registers, expected);
}

TEST(EntryPatch, ArgumentsOnTheStackArrive) {
  PatchTarget const target("stack_arguments");
  int const alone = target.call("call_digits");
  patch_entries(target.symbols(), {watch("_ZN12_GLOBAL__N_16digitsEiiiiiiiiiiiiii", &other_digits,
                                         &original_digits)});
  EXPECT_EQ(target.call("call_digits"), 1000 * (13 * 14 / 2 + 5) + alone);
}

TEST(EntryPatch, ExceptionsPass) {
  PatchTarget const target("exceptions");
  patch_entries(target.symbols(), {replace(twice_name, &throw_from_entry)});
  EXPECT_THROW(target.call("call_twice", 21), Error);
}

TEST(SymbolTable, StrippedFileIsRefused) {
  EXPECT_THROW(SymbolTable("/proc/self/cmdline", nullptr, {"main"}), Error);
}

}  // namespace
}  // namespace gpu_shading::energyplus

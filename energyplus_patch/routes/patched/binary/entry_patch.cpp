#include "routes/patched/binary/entry_patch.h"

#include <Zydis/Zydis.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>

namespace gpu_shading::energyplus {
namespace {

// The first instructions of a function, to be run elsewhere: at least `length` bytes of whole
// instructions from `code`. Empty, with the reason in `problem`, if one of them cannot be relocated
// (a relative jump or call) or decoded.
struct RelocatedCode {
  std::vector<std::uint8_t> bytes;
  // Offsets in `bytes` of 32-bit displacements relative to the instruction pointer. Each must be
  // reduced by the distance that the code is moved.
  std::vector<std::size_t> displacements;
};

std::optional<RelocatedCode> take_instructions(std::byte const* code, std::size_t available,
                                               std::size_t length, std::string& problem) {
  ZydisDecoder decoder;
  ZydisDecoderInit(&decoder, ZYDIS_MACHINE_MODE_LONG_64, ZYDIS_STACK_WIDTH_64);
  RelocatedCode taken;
  while (taken.bytes.size() < length) {
    std::size_t const at = taken.bytes.size();
    ZydisDecodedInstruction instruction;
    ZydisDecodedOperand operands[ZYDIS_MAX_OPERAND_COUNT];
    if (!ZYAN_SUCCESS(
            ZydisDecoderDecodeFull(&decoder, code + at, available - at, &instruction, operands))) {
      problem = fmt::format("no instruction at byte {}", at);
      return std::nullopt;
    }
    if ((instruction.attributes & ZYDIS_ATTRIB_IS_RELATIVE) != 0) {
      bool const memory = instruction.raw.disp.size == 32;
      bool const immediate = instruction.raw.imm[0].is_relative;
      if (!memory || immediate) {
        problem = fmt::format("a relative jump at byte {}", at);
        return std::nullopt;
      }
      taken.displacements.push_back(at + instruction.raw.disp.offset);
    }
    auto const* bytes = reinterpret_cast<std::uint8_t const*>(code + at);
    taken.bytes.insert(taken.bytes.end(), bytes, bytes + instruction.length);
  }
  return taken;
}

// jmp [rip+0], followed by the absolute address: no register is touched.
constexpr std::size_t jump_size = 14;

std::array<std::uint8_t, jump_size> jump_to(void const* target) {
  std::array<std::uint8_t, jump_size> code{0xff, 0x25, 0, 0, 0, 0};
  std::memcpy(code.data() + 6, &target, sizeof target);
  return code;
}

std::uintptr_t page_size() { return static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE)); }

void protect(std::byte* begin, std::size_t size, int protection) {
  auto const page = page_size();
  auto const first = reinterpret_cast<std::uintptr_t>(begin) & ~(page - 1);
  auto const last = (reinterpret_cast<std::uintptr_t>(begin) + size + page - 1) & ~(page - 1);
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  if (mprotect(reinterpret_cast<void*>(first), last - first, protection) != 0) {
    throw Error(fmt::format("mprotect: {}: the system does not allow code to be changed in memory",
                            std::strerror(errno)));
  }
}

// Memory for trampolines to the original functions, close enough to the library for 32-bit
// displacements.
class TrampolinePage {
 public:
  explicit TrampolinePage(std::byte* near) {
    constexpr std::uintptr_t step = 1U << 20U;
    constexpr int tries = 1024;
    auto const start = reinterpret_cast<std::uintptr_t>(near) & ~(page_size() - 1);
    for (int i = 1; i <= tries && page_ == nullptr; ++i) {
      // NOLINTNEXTLINE(performance-no-int-to-ptr)
      auto* const wish = reinterpret_cast<void*>(start - static_cast<std::uintptr_t>(i) * step);
      void* const got = mmap(wish, page_size(), PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
      if (got == MAP_FAILED) continue;
      if (got == wish) {
        page_ = static_cast<std::byte*>(got);
      } else {
        munmap(got, page_size());
      }
    }
    if (page_ == nullptr) throw Error("mmap: no free memory near EnergyPlus's code");
  }

  void* add(std::byte const* from, RelocatedCode code) {
    std::byte* const at = page_ + used_;
    for (auto const offset : code.displacements) {
      std::int32_t displacement = 0;
      std::memcpy(&displacement, code.bytes.data() + offset, sizeof displacement);
      std::int64_t const moved = displacement - (at - from);
      if (moved < std::numeric_limits<std::int32_t>::min() ||
          moved > std::numeric_limits<std::int32_t>::max()) {
        throw Error("EnergyPlus's data is out of reach of the relocated code");
      }
      displacement = static_cast<std::int32_t>(moved);
      std::memcpy(code.bytes.data() + offset, &displacement, sizeof displacement);
    }
    auto const back = jump_to(from + code.bytes.size());
    if (used_ + code.bytes.size() + back.size() > page_size()) {
      throw Error("too many redirected functions for one page");
    }
    std::memcpy(at, code.bytes.data(), code.bytes.size());
    std::memcpy(at + code.bytes.size(), back.data(), back.size());
    constexpr std::size_t alignment = 16;
    used_ += (code.bytes.size() + back.size() + alignment - 1) / alignment * alignment;
    return at;
  }

  void seal() { protect(page_, page_size(), PROT_READ | PROT_EXEC); }

 private:
  // Never freed, because EnergyPlus runs through it.
  std::byte* page_ = nullptr;
  std::size_t used_ = 0;
};

// A page is either writable or executable, never both.
void write_code(std::byte* at, std::array<std::uint8_t, jump_size> const& code) {
  protect(at, code.size(), PROT_READ | PROT_WRITE);
  std::memcpy(at, code.data(), code.size());
  protect(at, code.size(), PROT_READ | PROT_EXEC);
}

bool unchanged(std::ifstream& file, Symbol const& symbol) {
  std::array<char, jump_size> code{};
  file.seekg(static_cast<std::streamoff>(symbol.file_offset));
  file.read(code.data(), code.size());
  return file && std::memcmp(code.data(), symbol.address, code.size()) == 0;
}

struct Checked {
  EntryPatch const* entry;
  Symbol const* symbol;
  RelocatedCode start;
};

// Those that can be redirected; `problems`: a line for each other one.
std::vector<Checked> check(SymbolTable const& symbols, std::vector<EntryPatch> const& entries,
                           std::string& problems) {
  std::vector<Checked> checked;
  std::ifstream file(symbols.library(), std::ios::binary);
  for (auto const& entry : entries) {
    auto const fail = [&](std::string_view why) {
      problems += fmt::format("\n  {}: {}", entry.name, why);
    };
    Symbol const* const symbol = symbols.find(entry.name);
    if (symbol == nullptr) {
      fail("not in this build");
      continue;
    }
    if (symbol->size < jump_size) {
      fail(fmt::format("{} bytes long, {} needed", symbol->size, jump_size));
      continue;
    }
    if (!unchanged(file, *symbol)) {
      fail("already changed in memory");
      continue;
    }
    RelocatedCode start;
    if (entry.original != nullptr) {
      std::string problem;
      auto taken = take_instructions(symbol->address, symbol->size, jump_size, problem);
      if (!taken) {
        fail(problem);
        continue;
      }
      start = std::move(*taken);
    }
    checked.push_back({&entry, symbol, std::move(start)});
  }
  return checked;
}

}  // namespace

std::vector<std::string_view> names_of(std::vector<EntryPatch> const& entries) {
  std::vector<std::string_view> names;
  names.reserve(entries.size());
  for (auto const& entry : entries) names.emplace_back(entry.name);
  return names;
}

Error cannot_redirect(SymbolTable const& symbols, std::string const& problems) {
  return Error(fmt::format("{}: its shading interface cannot be redirected:{}",
                           symbols.library().string(), problems));
}

std::string problems_of(SymbolTable const& symbols, std::vector<EntryPatch> const& entries) {
  std::string problems;
  check(symbols, entries, problems);
  return problems;
}

void patch_entries(SymbolTable const& symbols, std::vector<EntryPatch> const& entries) {
  std::string problems;
  auto const checked = check(symbols, entries, problems);
  if (!problems.empty()) throw cannot_redirect(symbols, problems);
  if (checked.empty()) return;

  TrampolinePage trampolines(checked.front().symbol->address);
  for (auto const& item : checked) {
    if (item.entry->original == nullptr) continue;
    *item.entry->original = trampolines.add(item.symbol->address, item.start);
  }
  trampolines.seal();
  std::vector<void*> targets;
  for (auto const& item : checked) {
    auto const& entry = *item.entry;
    targets.push_back(entry.result ? preserve_registers(entry.ours, *entry.result) : entry.ours);
  }
  for (std::size_t i = 0; i < checked.size(); ++i) {
    write_code(checked[i].symbol->address, jump_to(targets[i]));
  }
}

}  // namespace gpu_shading::energyplus

#include "routes/patched/memory/surface_ids.h"

#include <Zydis/Zydis.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

struct Instruction {
  ZydisDecodedInstruction decoded;
  std::array<ZydisDecodedOperand, ZYDIS_MAX_OPERAND_COUNT> operands;

  bool is_move() const { return decoded.mnemonic == ZYDIS_MNEMONIC_MOV; }
  // mov target, [base + displacement]
  bool loads(ZydisRegister target) const {
    return is_move() && operands[0].type == ZYDIS_OPERAND_TYPE_REGISTER &&
           operands[0].reg.value == target && operands[1].type == ZYDIS_OPERAND_TYPE_MEMORY &&
           operands[1].mem.index == ZYDIS_REGISTER_NONE;
  }
  // mov [base + index], eax
  bool stores_result() const {
    return is_move() && operands[0].type == ZYDIS_OPERAND_TYPE_MEMORY &&
           operands[0].mem.index != ZYDIS_REGISTER_NONE &&
           operands[1].type == ZYDIS_OPERAND_TYPE_REGISTER &&
           operands[1].reg.value == ZYDIS_REGISTER_EAX;
  }
};

// A few instructions after the last call of the callee.
std::vector<Instruction> after_last_call(Symbol const& caller, Symbol const& callee) {
  constexpr std::size_t window = 12;
  ZydisDecoder decoder;
  ZydisDecoderInit(&decoder, ZYDIS_MACHINE_MODE_LONG_64, ZYDIS_STACK_WIDTH_64);
  std::vector<Instruction> kept;
  bool seen = false;
  for (std::size_t at = 0; at < caller.size;) {
    Instruction instruction{};
    if (!ZYAN_SUCCESS(ZydisDecoderDecodeFull(&decoder, caller.address + at, caller.size - at,
                                             &instruction.decoded, instruction.operands.data()))) {
      return {};
    }
    std::uint64_t target = 0;
    auto const address = reinterpret_cast<std::uint64_t>(caller.address + at);
    at += instruction.decoded.length;
    if (instruction.decoded.mnemonic == ZYDIS_MNEMONIC_CALL &&
        ZYAN_SUCCESS(ZydisCalcAbsoluteAddress(&instruction.decoded, instruction.operands.data(),
                                              address, &target)) &&
        target == reinterpret_cast<std::uint64_t>(callee.address)) {
      kept.clear();
      seen = true;
      continue;
    }
    if (seen && kept.size() < window) kept.push_back(instruction);
  }
  return kept;
}

// Element 0 of the array; nullptr if the path does not lead there.
std::byte* array_at(State& state, StoredResult const& path) {
  auto* const holder = read_pointer(reinterpret_cast<std::byte*>(&state) + path.outer);
  return holder == nullptr ? nullptr : read_pointer(holder + path.inner);
}

}  // namespace

std::optional<StoredResult> find_stored_result(Symbol const& caller, Symbol const& callee) {
  auto const code = after_last_call(caller, callee);
  auto const store =
      std::ranges::find_if(code, [](Instruction const& i) { return i.stores_result(); });
  if (store == code.end()) return std::nullopt;

  // Searches backwards for the loads of the array's address and of its holder's address.
  auto const find_load = [&](auto before, ZydisRegister target) {
    return std::find_if(std::make_reverse_iterator(before), code.rend(),
                        [&](Instruction const& i) { return i.loads(target); });
  };
  auto const inner = find_load(store, store->operands[0].mem.base);
  if (inner == code.rend()) return std::nullopt;
  auto const outer = find_load(std::prev(inner.base()), inner->operands[1].mem.base);
  if (outer == code.rend()) return std::nullopt;
  return StoredResult{outer->operands[1].mem.disp.value, inner->operands[1].mem.disp.value};
}

std::optional<StoredResult> find_surface_ids(SymbolTable const& symbols) {
  Symbol const* const caller = symbols.find(symbol::determine_shadowing_combinations.symbol);
  Symbol const* const callee = symbols.find(symbol::add_surface.symbol);
  if (caller == nullptr || callee == nullptr) return std::nullopt;
  return find_stored_result(*caller, *callee);
}

std::vector<std::optional<SurfaceId>> read_surface_ids(State& state, StoredResult const& path,
                                                       std::int32_t surfaces,
                                                       Session const& session) {
  auto* const array = array_at(state, path);
  expect(array != nullptr);
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(surfaces));
  expect(read_memory(array + sizeof(std::int32_t), numbers.data(),
                     numbers.size() * sizeof(std::int32_t)));
  std::vector<std::optional<SurfaceId>> ids(1);
  for (auto const number : numbers) {
    expect(number >= -1 && number < static_cast<std::int32_t>(session.size()));
    ids.push_back(number < 0 ? std::nullopt : std::optional(static_cast<SurfaceId>(number)));
  }
  return ids;
}

std::optional<std::size_t> hand_over_mirrored_surfaces(State& state, Session& session,
                                                       StoredResult const& path) {
  auto* const origin = array_at(state, path);
  if (origin == nullptr) return std::nullopt;
  auto* const array = origin + sizeof(std::int32_t);

  // Shading surfaces come first, each followed by its copy, if it has one, with id -1.
  auto const shading = session.shading_surfaces();
  std::vector<std::int32_t> kept(2 * shading.size());
  if (!read_memory(array, kept.data(), kept.size() * sizeof(std::int32_t))) return std::nullopt;
  std::vector<std::pair<std::size_t, SurfaceId>> copies;  // index in the array, original surface
  std::size_t at = 0;
  for (auto const id : shading) {
    if (kept[at++] != static_cast<std::int32_t>(id)) return std::nullopt;
    if (at < kept.size() && kept[at] == -1) copies.emplace_back(at++, id);
  }
  for (auto const& [place, original] : copies) {
    auto const id = static_cast<std::int32_t>(session.add_mirrored(original));
    std::memcpy(array + place * sizeof id, &id, sizeof id);
  }
  return copies.size();
}

}  // namespace gpu_shading::energyplus

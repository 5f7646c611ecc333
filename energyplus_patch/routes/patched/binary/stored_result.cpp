#include "routes/patched/binary/stored_result.h"

#include <Zydis/Zydis.h>

#include <algorithm>
#include <array>
#include <vector>

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

}  // namespace

std::optional<StoredResult> find_stored_result(Symbol const& caller, Symbol const& callee) {
  auto const code = after_last_call(caller, callee);
  auto const store = std::find_if(code.begin(), code.end(),
                                  [](Instruction const& i) { return i.stores_result(); });
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

}  // namespace gpu_shading::energyplus

#include "routes/patched/binary/relocated_code.h"

#include <Zydis/Zydis.h>
#include <fmt/format.h>

namespace gpu_shading::energyplus {

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

}  // namespace gpu_shading::energyplus

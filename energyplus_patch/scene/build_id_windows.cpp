#include <windows.h>

#include <cstdint>
#include <cstring>

#include "gpu_shading/error.h"
#include "scene/scene_hash.h"

namespace gpu_shading::energyplus {

// The record that the linker's --build-id writes: "RSDS", and 16 bytes that differ by build.
std::span<std::byte const> build_id() {
  HMODULE module = nullptr;
  constexpr DWORD flags =
      GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
  GetModuleHandleExA(flags, reinterpret_cast<char const*>(&build_id), &module);
  auto const* const start = reinterpret_cast<std::byte const*>(module);
  auto const* const dos = reinterpret_cast<IMAGE_DOS_HEADER const*>(start);
  auto const* const headers = reinterpret_cast<IMAGE_NT_HEADERS const*>(start + dos->e_lfanew);
  auto const& found = headers->OptionalHeader.DataDirectory[IMAGE_DIRECTORY_ENTRY_DEBUG];
  if (found.Size >= sizeof(IMAGE_DEBUG_DIRECTORY)) {
    auto const* const entry =
        reinterpret_cast<IMAGE_DEBUG_DIRECTORY const*>(start + found.VirtualAddress);
    constexpr std::size_t mark = 4;
    constexpr std::size_t size = 16;
    auto const* const record = start + entry->AddressOfRawData;
    if (entry->Type == IMAGE_DEBUG_TYPE_CODEVIEW && std::memcmp(record, "RSDS", mark) == 0) {
      return {record + mark, size};
    }
  }
  throw Error(
      "--gpu-shading-cache: this program has no build ID, which distinguishes its answers from "
      "those of other builds; link it with --build-id");
}

}  // namespace gpu_shading::energyplus

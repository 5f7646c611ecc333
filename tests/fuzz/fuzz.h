#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/process.h"
#include "gpu_shading/error.h"

// libFuzzer's own entry. Everything but an Error is a finding.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

namespace gpu_shading::energyplus {

inline std::string_view as_text(std::uint8_t const* data, std::size_t size) {
  return {reinterpret_cast<char const*>(data), size};
}

// A file with these bytes, the same one for every call in a process.
inline std::filesystem::path file_of(std::string_view bytes, std::string_view name) {
  static TemporaryFolder const folder;
  auto path = folder.path() / name;
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

// Calls `read`, which may refuse its input with an Error of one line.
template <typename Read>
int try_to(Read const& read) {
  try {
    read();
  } catch (Error const&) {
    return 0;
  }
  return 0;
}

}  // namespace gpu_shading::energyplus

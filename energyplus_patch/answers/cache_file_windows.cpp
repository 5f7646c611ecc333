#include <windows.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "answers/cache_file.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

std::optional<std::vector<std::byte>> read_cache_file(std::filesystem::path const& path,
                                                      std::size_t max_bytes) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) return std::nullopt;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw Error("cannot be read");
  auto const size = static_cast<std::size_t>(file.tellg());
  if (size > max_bytes) throw Error("is too large");
  std::vector<std::byte> bytes(size);
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!file) throw Error("cannot be read");
  return bytes;
}

CacheLock::CacheLock(std::filesystem::path const& path) {
  constexpr int tries = 200;
  constexpr std::chrono::milliseconds pause(10);
  for (int i = 0; i < tries; ++i) {
    HANDLE const file = CreateFileW(path.c_str(), GENERIC_WRITE, 0, nullptr, OPEN_ALWAYS,
                                    FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file != INVALID_HANDLE_VALUE) {
      held_ = std::shared_ptr<void>(file, &CloseHandle);
      return;
    }
    if (GetLastError() != ERROR_SHARING_VIOLATION) return;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace gpu_shading::energyplus

#include <fmt/format.h>
#include <io.h>
#include <windows.h>

#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

#include "gpu_shading/error.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {

int find_access(std::filesystem::path const& folder) {
  constexpr int read_and_write = 6;
  return _waccess(folder.c_str(), read_and_write) == 0 ? 0 : errno;
}

int flush_file(std::filesystem::path const& file) {
  if (std::filesystem::is_directory(file)) return flush_folder(file);
  HANDLE const opened =
      CreateFileW(file.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE,
                  nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (opened == INVALID_HANDLE_VALUE) return EIO;
  bool const flushed = FlushFileBuffers(opened) != 0;
  CloseHandle(opened);
  return flushed ? 0 : EIO;
}

// MoveFileEx writes the folder itself.
int flush_folder(std::filesystem::path const& /*folder*/) { return 0; }

int replace_file(std::filesystem::path const& file, std::filesystem::path const& replaced) {
  DWORD flags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
  if (std::filesystem::is_directory(file)) {
    // It replaces no folder, not even an empty one.
    flags = MOVEFILE_WRITE_THROUGH;
    RemoveDirectoryW(replaced.c_str());
  }
  if (MoveFileExW(file.c_str(), replaced.c_str(), flags) != 0) return 0;
  return std::system_category().default_error_condition(static_cast<int>(GetLastError())).value();
}

std::string read_text_file(std::filesystem::path const& path) {
  auto const refuse = [&](std::string_view why) {
    throw Error(fmt::format("{}: {}", path.string(), why));
  };
  require_file(path);
  std::error_code failure;
  auto const bytes = std::filesystem::file_size(path, failure);
  if (failure) refuse(failure.message());
  if (bytes > max_text_bytes) refuse("is larger than 1 GiB");
  std::string text(bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(bytes));
  if (!file) refuse("cannot be read");
  return text;
}

}  // namespace gpu_shading::energyplus

#include <io.h>
#include <windows.h>

#include <cerrno>
#include <system_error>

#include "platform/disk.h"

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

}  // namespace gpu_shading::energyplus

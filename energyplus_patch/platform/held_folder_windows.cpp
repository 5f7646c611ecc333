#include <windows.h>

#include <new>

#include "platform/held_folder.h"

// The lock file is open for as long as the process lives: Windows refuses to delete it until then.

namespace gpu_shading::energyplus {

void HeldFolder::delete_if_abandoned(std::filesystem::path const& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path / lock_name, ignored)) return;
  if (DeleteFileW((path / lock_name).c_str()) != 0) std::filesystem::remove_all(path, ignored);
}

bool HeldFolder::make(std::filesystem::path const& parent) {
  std::error_code failure;
  if (!std::filesystem::create_directory(path_, failure)) {
    if (!failure) return false;  // it is there already
    fail(parent, failure);
  }
  HANDLE const lock = CreateFileW((path_ / lock_name).c_str(), GENERIC_WRITE, FILE_SHARE_READ,
                                  nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (lock == INVALID_HANDLE_VALUE) {
    std::error_code const why(static_cast<int>(GetLastError()), std::system_category());
    std::filesystem::remove(path_, failure);
    fail(parent, why);
  }
  held_ = std::shared_ptr<void>(lock, &CloseHandle);
  return true;
}

HeldFolder::~HeldFolder() {
  held_.reset();
  try {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  } catch (std::bad_alloc const&) {  // NOLINT(bugprone-empty-catch): the next object deletes it
  }
}

}  // namespace gpu_shading::energyplus

#include <fmt/format.h>
#include <windows.h>

#include <new>
#include <random>
#include <system_error>

#include "gpu_shading/error.h"
#include "platform/held_folder.h"

// The lock file is open for as long as the process lives: Windows refuses to delete it until then.

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t digits = 8;

bool may_be_ours(Path const& path, std::string_view prefix) {
  auto const name = path.filename().string();
  if (name.size() != prefix.size() + digits || !name.starts_with(prefix)) return false;
  if (name.find_first_not_of("0123456789abcdef", prefix.size()) != std::string::npos) return false;
  std::error_code ignored;
  return std::filesystem::is_regular_file(path / HeldFolder::lock_name, ignored);
}

// Deletes what killed processes have left.
void clean(Path const& parent, std::string_view prefix) {
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(parent, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    auto const& path = entry->path();
    if (!may_be_ours(path, prefix)) continue;
    std::error_code gone;
    if (DeleteFileW((path / HeldFolder::lock_name).c_str()) != 0) {
      std::filesystem::remove_all(path, gone);
    }
  }
}

}  // namespace

HeldFolder::HeldFolder(Path const& parent, std::string_view prefix) {
  clean(parent, prefix);
  while (!make(parent, prefix)) {
  }
}

bool HeldFolder::make(Path const& parent, std::string_view prefix) {
  path_ = parent / fmt::format("{}{:08x}", prefix, std::random_device{}());
  std::error_code failure;
  if (!std::filesystem::create_directory(path_, failure)) {
    if (!failure) return false;  // it is there already
    throw Error(fmt::format("{}: cannot be written ({})", parent.string(), failure.message()));
  }
  HANDLE const lock = CreateFileW((path_ / lock_name).c_str(), GENERIC_WRITE, FILE_SHARE_READ,
                                  nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (lock == INVALID_HANDLE_VALUE) {
    std::error_code const why(static_cast<int>(GetLastError()), std::system_category());
    std::filesystem::remove(path_, failure);
    throw Error(fmt::format("{}: cannot be written ({})", parent.string(), why.message()));
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

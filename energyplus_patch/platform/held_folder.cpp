#include "platform/held_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>

#include "gpu_shading/error.h"
#include "platform/file_descriptor.h"
#include "platform/folder_deletion.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// The lock file's contents.
constexpr std::string_view mark = "gpu_shading: temporary, deleted when its process has ended\n";
constexpr std::size_t digits = 8;

[[noreturn]] void fail_to_hold(Path const& path, int error) {
  throw Error(fmt::format("{}: cannot be written ({})", path.string(),
                          std::generic_category().message(error)));
}

int open_lock(Path const& path, int flags) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  return open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
}

bool lock(FileDescriptor const& file) { return flock(file.get(), LOCK_EX | LOCK_NB) == 0; }

bool has_name(FileDescriptor const& file) {
  struct stat found {};
  return fstat(file.get(), &found) == 0 && found.st_nlink > 0;
}

bool has_mark(FileDescriptor const& file) {
  std::array<char, mark.size() + 1> text{};
  auto const count = pread(file.get(), text.data(), text.size(), 0);
  return count >= 0 && std::string_view(text.data(), static_cast<std::size_t>(count)) == mark;
}

bool may_be_ours(Path const& path, std::string_view prefix) {
  auto const name = path.filename().string();
  if (name.size() != prefix.size() + digits || !name.starts_with(prefix)) return false;
  if (name.find_first_not_of("0123456789abcdef", prefix.size()) != std::string::npos) return false;
  struct stat found {};
  return lstat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid();
}

// Deletes what killed processes have left. What other processes delete meanwhile is no error.
void clean(Path const& parent, std::string_view prefix) {
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(parent, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    auto const& path = entry->path();
    if (!may_be_ours(path, prefix)) continue;
    FileDescriptor const file(open_lock(path / HeldFolder::lock_name, O_RDWR));
    if (!file.is_open()) {
      // Not locked yet, or never: empty then.
      rmdir(path.c_str());
    } else if (has_mark(file) && lock(file) && has_name(file)) {
      delete_folder(path.c_str());
    }
  }
}

}  // namespace

HeldFolder::HeldFolder(Path const& parent, std::string_view prefix) {
  clean(parent, prefix);
  // Another process may clean up between two of these steps.
  while (!make(parent, prefix)) {
  }
}

bool HeldFolder::make(Path const& parent, std::string_view prefix) {
  path_ = parent / fmt::format("{}{:08x}", prefix, std::random_device{}());
  if (mkdir(path_.c_str(), S_IRWXU) != 0) {
    if (errno == EEXIST) return false;
    fail_to_hold(parent, errno);
  }
  at_signals_.emplace(path_);
  auto const file =
      std::make_shared<FileDescriptor>(open_lock(path_ / lock_name, O_RDWR | O_CREAT | O_EXCL));
  if (!file->is_open()) {
    int const error = errno;
    rmdir(path_.c_str());
    if (error == ENOENT) return false;
    fail_to_hold(parent, error);
  }
  // A file system without locks will do: then nobody cleans up. The mark comes last, so that nobody
  // takes it for abandoned before it is locked.
  lock(*file);
  if (write(file->get(), mark.data(), mark.size()) != static_cast<ssize_t>(mark.size())) {
    int const error = errno == 0 ? ENOSPC : errno;
    unlink((path_ / lock_name).c_str());
    rmdir(path_.c_str());
    fail_to_hold(parent, error);
  }
  held_ = file;
  return true;
}

HeldFolder::~HeldFolder() {
  held_.reset();  // its descriptor may be the last one
  delete_folder(path_.c_str());
}

}  // namespace gpu_shading::energyplus

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "platform/file_descriptor.h"
#include "platform/held_folder.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// The lock file's contents.
constexpr std::string_view mark = "gpu_shading: temporary, deleted when its process has ended\n";

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

}  // namespace

void HeldFolder::delete_if_abandoned(Path const& path) {
  struct stat found {};
  bool const ours =
      lstat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid();
  if (!ours) return;
  FileDescriptor const file(open_lock(path / lock_name, O_RDWR));
  if (!file.is_open()) {
    // Not locked yet, or never: empty then.
    rmdir(path.c_str());
  } else if (has_mark(file) && lock(file) && has_name(file)) {
    delete_folder(path.c_str());
  }
}

bool HeldFolder::make(Path const& parent) {
  at_signals_.emplace(path_);
  if (mkdir(path_.c_str(), S_IRWXU) != 0) {
    if (errno == EEXIST) return false;
    fail(parent, {errno, std::generic_category()});
  }
  at_signals_->is_made();
  auto const file =
      std::make_shared<FileDescriptor>(open_lock(path_ / lock_name, O_RDWR | O_CREAT | O_EXCL));
  if (!file->is_open()) {
    int const error = errno;
    rmdir(path_.c_str());
    if (error == ENOENT) return false;
    fail(parent, {error, std::generic_category()});
  }
  // A file system without locks will do: then nobody cleans up. The mark comes last, so that nobody
  // takes it for abandoned before it is locked.
  lock(*file);
  if (write(file->get(), mark.data(), mark.size()) != static_cast<ssize_t>(mark.size())) {
    int const error = errno == 0 ? ENOSPC : errno;
    unlink((path_ / lock_name).c_str());
    rmdir(path_.c_str());
    fail(parent, {error, std::generic_category()});
  }
  held_ = file;
  return true;
}

HeldFolder::~HeldFolder() {
  held_.reset();  // its descriptor may be the last one
  delete_folder(path_.c_str());
}

}  // namespace gpu_shading::energyplus

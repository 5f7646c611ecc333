#include "platform/folder_deletion.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace gpu_shading::energyplus {
namespace {

// Entries as the kernel gives them; readdir() allocates memory.
class Entries {
 public:
  explicit Entries(int folder) : folder_(folder) {}

  // The next name, or nullptr at the end.
  char const* next() noexcept {
    if (at_ >= size_) {
      size_ = syscall(SYS_getdents64, folder_, bytes_.data(), bytes_.size());
      at_ = 0;
      if (size_ <= 0) return nullptr;
    }
    auto const* const entry = reinterpret_cast<dirent64 const*>(bytes_.data() + at_);
    at_ += entry->d_reclen;
    return static_cast<char const*>(entry->d_name);
  }

 private:
  alignas(dirent64) std::array<char, 4096> bytes_{};
  long at_ = 0;
  long size_ = 0;
  int folder_;
};

// A path that is longer and shorter by a name.
class DeepPath {
 public:
  explicit DeepPath(char const* root) noexcept : root_(std::strlen(root)), length_(root_) {
    if (length_ < path_.size()) std::memcpy(path_.data(), root, length_ + 1);
  }

  bool fits() const noexcept { return length_ < path_.size(); }
  bool is_root() const noexcept { return length_ == root_; }
  char const* text() const noexcept { return path_.data(); }

  bool descend(std::string_view name) noexcept {
    if (length_ + 1 + name.size() >= path_.size()) return false;
    path_[length_] = '/';
    std::memcpy(path_.data() + length_ + 1, name.data(), name.size());
    length_ += 1 + name.size();
    path_[length_] = '\0';
    return true;
  }
  void ascend() noexcept {
    while (path_[length_] != '/') --length_;
    path_[length_] = '\0';
  }

 private:
  std::array<char, PATH_MAX> path_{};
  std::size_t root_;
  std::size_t length_;
};

// Deletes what is directly in a folder. Returns false if the path now leads to a folder in it that
// has to be emptied first.
bool empty(int folder, DeepPath& path) noexcept {
  Entries entries(folder);
  while (char const* const name = entries.next()) {
    if (std::string_view(name) == "." || std::string_view(name) == "..") continue;
    if (unlinkat(folder, name, 0) == 0 || errno == ENOENT) continue;
    if (unlinkat(folder, name, AT_REMOVEDIR) == 0) continue;
    if ((errno == ENOTEMPTY || errno == EEXIST) && path.descend(name)) return false;
  }
  return true;
}

}  // namespace

bool delete_folder(char const* root) noexcept {
  DeepPath path(root);
  if (!path.fits()) return false;
  for (int failures = 0; failures < 100;) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
    int const folder = open(path.text(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder >= 0) {
      bool const emptied = empty(folder, path);
      close(folder);
      if (!emptied) continue;
    }
    if (rmdir(path.text()) != 0 && errno != ENOENT) {
      ++failures;
      continue;
    }
    if (path.is_root()) return true;
    path.ascend();
  }
  return false;
}

}  // namespace gpu_shading::energyplus

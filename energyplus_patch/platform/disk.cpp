#include "platform/disk.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "platform/file_descriptor.h"

namespace gpu_shading::energyplus {
namespace {

int open_file(std::filesystem::path const& path, int flags) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  return open(path.c_str(), flags | O_CLOEXEC);
}

}  // namespace

int find_access(std::filesystem::path const& folder) {
  return access(folder.c_str(), R_OK | W_OK | X_OK) == 0 ? 0 : errno;
}

int flush_file(std::filesystem::path const& file) {
  FileDescriptor const opened(open_file(file, O_RDONLY | O_NOFOLLOW));
  if (opened.is_open() && (fsync(opened.get()) == 0 || errno == EINVAL)) return 0;
  return errno == 0 ? EIO : errno;
}

int flush_folder(std::filesystem::path const& folder) {
  FileDescriptor const opened(open_file(folder, O_RDONLY));
  if (!opened.is_open() || fsync(opened.get()) == 0 || errno == EINVAL) return 0;
  return errno;
}

int replace_file(std::filesystem::path const& file, std::filesystem::path const& replaced) {
  return std::rename(file.c_str(), replaced.c_str()) == 0 ? 0 : errno;
}

}  // namespace gpu_shading::energyplus

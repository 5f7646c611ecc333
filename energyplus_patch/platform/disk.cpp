
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/file_descriptor.h"
#include "platform/files.h"

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

std::string read_text_file(std::filesystem::path const& path) {
  auto const refuse = [&](std::string_view why) {
    throw Error(fmt::format("{}: {}", path.string(), why));
  };
  require_file(path);
  // What is opened may be another file by now: a pipe must not be waited for.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  FileDescriptor const file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat found {};
  if (!file.is_open() || fstat(file.get(), &found) != 0) refuse(std::strerror(errno));
  if (!S_ISREG(found.st_mode)) refuse("is not a file");
  auto const bytes = static_cast<std::uintmax_t>(found.st_size);
  if (bytes > max_text_bytes) refuse("is larger than 1 GiB");
  std::string text(bytes, '\0');
  for (std::size_t done = 0; done < text.size();) {
    auto const count = read(file.get(), text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) refuse("cannot be read");
    done += static_cast<std::size_t>(count);
  }
  return text;
}

}  // namespace gpu_shading::energyplus

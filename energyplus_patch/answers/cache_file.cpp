#include "answers/cache_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "gpu_shading/error.h"
#include "platform/file_descriptor.h"

namespace gpu_shading::energyplus {

std::optional<std::vector<std::byte>> read_cache_file(std::filesystem::path const& path,
                                                      std::size_t max_bytes) {
  // Opened only once, because another file may replace it at any moment; a pipe is not waited for.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  FileDescriptor const file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  // ESTALE: another host has evicted it from a shared folder.
  if (!file.is_open() && (errno == ENOENT || errno == ESTALE)) return std::nullopt;
  struct stat found {};
  if (!file.is_open() || fstat(file.get(), &found) != 0 || !S_ISREG(found.st_mode)) {
    throw Error("cannot be read");
  }
  auto const size = static_cast<std::size_t>(found.st_size);
  if (size > max_bytes) throw Error("is too large");
  std::vector<std::byte> bytes(size);
  for (std::size_t done = 0; done < size;) {
    auto const count = read(file.get(), bytes.data() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Error("cannot be read");
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

CacheLock::CacheLock(std::filesystem::path const& path) {
  constexpr int tries = 200;
  constexpr std::chrono::milliseconds pause(10);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  int const opened = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  auto const file = std::make_shared<FileDescriptor>(opened);
  held_ = file;
  for (int i = 0; file->is_open() && i < tries; ++i) {
    if (flock(file->get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace gpu_shading::energyplus

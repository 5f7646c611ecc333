#include "files/memory_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] void fail() {
  throw Error(fmt::format("no memory for a picture ({})", std::generic_category().message(errno)));
}

}  // namespace

MemoryFile::MemoryFile() : descriptor_(memfd_create("picture", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail();
}

MemoryFile::~MemoryFile() { close(descriptor_); }

std::filesystem::path MemoryFile::path() const {
  return fmt::format("/proc/self/fd/{}", descriptor_);
}

std::string MemoryFile::contents() const {
  struct stat found {};
  if (fstat(descriptor_, &found) != 0) fail();
  std::string bytes(static_cast<std::size_t>(found.st_size), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    auto const count =
        pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (count <= 0) fail();
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

}  // namespace gpu_shading::energyplus

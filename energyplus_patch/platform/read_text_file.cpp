#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/file_descriptor.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {

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
  if (bytes > most_text_bytes) refuse("is larger than 1 GiB");
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

#include "files/whole_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <random>
#include <system_error>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// A name to write under. Nothing is left there.
class Unfinished {
 public:
  explicit Unfinished(std::filesystem::path const& of) : path_(of) {
    path_ += fmt::format(".{:08x}{}", std::random_device{}(), unfinished_ending);
  }
  Unfinished(Unfinished const&) = delete;
  Unfinished& operator=(Unfinished const&) = delete;
  ~Unfinished() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  std::filesystem::path const& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write) {
  Unfinished const unfinished(path);
  errno = 0;
  std::ofstream file(unfinished.path(), std::ios::binary);
  if (file) write(file);
  file.close();
  std::error_code failure;
  if (file) {
    std::filesystem::rename(unfinished.path(), path, failure);
  } else {
    failure.assign(errno == 0 ? EIO : errno, std::generic_category());
  }
  if (failure) {
    throw Error(fmt::format("{}: cannot be written ({})", path.string(), failure.message()));
  }
}

}  // namespace gpu_shading::energyplus

#include "files/whole_file.h"

#include <fmt/format.h>

#include <fstream>
#include <random>
#include <system_error>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write) {
  auto unfinished = path;
  unfinished += fmt::format(".{:08x}.part", std::random_device{}());
  std::ofstream file(unfinished, std::ios::binary);
  if (file) write(file);
  file.close();
  std::error_code failure;
  if (file) std::filesystem::rename(unfinished, path, failure);
  if (!file || failure) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw Error(fmt::format("{}: cannot be written", path.string()));
  }
}

}  // namespace gpu_shading::energyplus

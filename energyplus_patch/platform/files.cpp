#include "platform/files.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "platform/staged_files.h"

namespace gpu_shading::energyplus {

void require_file(std::filesystem::path const& path) {
  if (!std::filesystem::exists(path)) {
    throw Error(fmt::format("{}: {}", path.string(),
                            std::filesystem::is_symlink(path)
                                ? "is a link to a file that does not exist"
                                : "no such file"));
  }
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(fmt::format("{}: is not a file", path.string()));
  }
}

void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write) {
  StagedFiles files(path.parent_path());
  files.write(path.filename().string(), write);
  files.commit();
}

}  // namespace gpu_shading::energyplus

#include "programs/gpu_shading/share_folder.h"

#include <sstream>
#include <string>
#include <system_error>

#include "platform/process.h"

namespace gpu_shading::energyplus {

std::vector<std::filesystem::path> share_folders() {
  std::vector<std::filesystem::path> folders;
  // A link that patch_energyplus makes.
  std::error_code error;
  auto linked = std::filesystem::canonical(own_folder() / "gpu_shading_share", error);
  if (!error) folders.push_back(std::move(linked));
  folders.push_back(own_folder().parent_path().parent_path() / "share" / "gpu_shading");
  auto listed = get_variable("XDG_DATA_DIRS");
  if (listed.empty()) listed = "/usr/local/share:/usr/share";
  std::stringstream parts(listed);
  for (std::string folder; std::getline(parts, folder, ':');) {
    folders.push_back(std::filesystem::path(folder) / "gpu_shading");
  }
  return folders;
}

}  // namespace gpu_shading::energyplus

#include "runs/named_files.h"

#include "base/staged_files.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// Makes a path absolute that names an existing file through "..".
void anchor(std::string& value, Path const& folder) {
  if (value.find("..") == std::string::npos || Path(value).is_absolute()) return;
  std::error_code ignored;
  auto const path = folder / value;
  if (std::filesystem::exists(path, ignored)) {
    value = std::filesystem::weakly_canonical(path).string();
  }
}

}  // namespace

void bring_named_files(ModelEditor& model, Path const& original, Path const& folder) {
  model.edit_texts([&](std::string& text) { anchor(text, original.parent_path()); });
  for (auto const& entry : std::filesystem::directory_iterator(original.parent_path())) {
    auto const link = folder / entry.path().filename();
    if (entry.path() == original || std::filesystem::equivalent(entry.path(), folder)) continue;
    if (entry.path().filename().string().starts_with(StagedFiles::prefix)) continue;
    std::error_code exists;
    std::filesystem::create_symlink(entry.path(), link, exists);
  }
}

}  // namespace gpu_shading::energyplus

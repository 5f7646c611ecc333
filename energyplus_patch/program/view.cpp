#include "program/view.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "program/process.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

void copy_picture(Path const& from, Path const& to) {
  std::error_code failure;
  if (to.has_parent_path()) std::filesystem::create_directories(to.parent_path(), failure);
  if (!failure) {
    std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing,
                               failure);
  }
  if (failure) {
    throw Error(fmt::format("{}: cannot be written: {}", to.string(), failure.message()));
  }
}

}  // namespace

void draw(ModelRun const& run, std::vector<Picture> const& pictures, int size) {
  if (pictures.empty()) throw Error("no picture is asked for");
  TemporaryFolder const temporary;
  auto const drawn = temporary.path() / "views";
  std::filesystem::create_directory(drawn);
  std::vector<View> views;
  for (auto const& picture : pictures) {
    views.push_back(picture.view);
    views.back().picture = fmt::format("{}{}", views.size(), picture.file.extension().string());
  }
  write_views(drawn / "views.txt", views);
  // The last to be drawn: with it all are there.
  run_to_shading(
      run, {"GPU_SHADING_VIEW=" + drawn.string(), fmt::format("GPU_SHADING_VIEW_SIZE={}", size)},
      temporary.path(), drawn / views.back().picture);
  for (std::size_t i = 0; i < views.size(); ++i) {
    copy_picture(drawn / views[i].picture, pictures[i].file);
  }
}

}  // namespace gpu_shading::energyplus

#include "program/view.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "program/process.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

void copy_into(Path const& folder, Path const& picture) {
  std::error_code failure;
  if (!folder.empty()) std::filesystem::create_directories(folder, failure);
  if (!failure) {
    std::filesystem::copy_file(picture, folder / picture.filename(),
                               std::filesystem::copy_options::overwrite_existing, failure);
  }
  if (failure) {
    throw Error(fmt::format("{}: cannot be written: {}", (folder / picture.filename()).string(),
                            failure.message()));
  }
}

}  // namespace

void draw(ModelRun const& run, std::vector<View> const& views, int size, Path const& folder) {
  if (views.empty()) throw Error("no picture is asked for");
  TemporaryFolder const temporary;
  auto const drawn = temporary.path() / "views";
  std::filesystem::create_directory(drawn);
  write_views(drawn / "views.txt", views);
  // The last to be drawn: with it all are there.
  run_to_shading(
      run, {"GPU_SHADING_VIEW=" + drawn.string(), fmt::format("GPU_SHADING_VIEW_SIZE={}", size)},
      temporary.path(), drawn / views.back().picture);
  for (auto const& view : views) copy_into(folder, drawn / view.picture);
}

}  // namespace gpu_shading::energyplus

#include "program/view.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "images/picture_sheet.h"
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

// Into a folder of its own, under the views' pictures.
Path draw_in(Path const& temporary, ModelRun const& run, std::vector<View> const& views, int size) {
  auto drawn = temporary / "views";
  std::filesystem::create_directory(drawn);
  write_views(drawn / "views.txt", views);
  // The last to be drawn: with it all are there.
  run_to_shading(
      run, {"GPU_SHADING_VIEW=" + drawn.string(), fmt::format("GPU_SHADING_VIEW_SIZE={}", size)},
      temporary, drawn / views.back().picture);
  return drawn;
}

}  // namespace

void draw(ModelRun const& run, std::vector<Picture> const& pictures, int size) {
  if (pictures.empty()) throw Error("no picture is asked for");
  std::vector<View> views;
  for (auto const& picture : pictures) {
    views.push_back(picture.view);
    views.back().picture = fmt::format("{}{}", views.size(), picture.file.extension().string());
  }
  TemporaryFolder const temporary;
  auto const drawn = draw_in(temporary.path(), run, views, size);
  for (std::size_t i = 0; i < views.size(); ++i) {
    copy_picture(drawn / views[i].picture, pictures[i].file);
  }
}

void draw_together(ModelRun const& run, std::vector<CaptionedView> const& views, Path const& file,
                   int size) {
  std::vector<View> plain;
  for (auto const& view : views) {
    plain.push_back(view.view);
    plain.back().picture = fmt::format("{}.png", plain.size());
  }
  TemporaryFolder const temporary;
  auto const drawn = draw_in(temporary.path(), run, plain, size);
  PictureSheet sheet;
  for (std::size_t i = 0; i < views.size(); ++i) {
    sheet.entries.push_back({drawn / plain[i].picture, views[i].caption});
    sheet.scale = sheet.scale || plain[i].receiver.empty();
  }
  auto const together = temporary.path() / ("together" + file.extension().string());
  write_sheet(together, sheet);
  copy_picture(together, file);
}

}  // namespace gpu_shading::energyplus

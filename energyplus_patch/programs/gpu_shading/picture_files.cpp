#include "programs/gpu_shading/picture_files.h"

#include <fmt/format.h>

#include <cstdio>

#include "files/pictures.h"
#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/process.h"
#include "platform/staged_files.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// Into a folder of its own, under the names of the views' pictures.
Path draw_in(Path const& temporary, ModelRun const& run, std::vector<SunView> const& views,
             int size) {
  auto drawn = temporary / "views";
  std::filesystem::create_directory(drawn);
  auto const reply = run_task(run, ViewsTask{views, drawn, size});
  for (auto const& warning : reply.warnings) {
    print_line("warning: " + warning);
  }
  return drawn;
}

}  // namespace

void draw(ModelRun const& run, std::vector<SunView> const& views, Path const& folder, int size) {
  if (views.empty()) throw Error("no picture was requested");
  // Before the time is spent: whether the folder can be written to.
  StagedFiles files(folder);
  TemporaryFolder const temporary;
  auto const drawn = draw_in(temporary.path(), run, views, size);
  for (auto const& view : views) files.copy(view.picture, drawn / view.picture);
  files.commit();
}

void draw_together(ModelRun const& run, std::vector<CaptionedView> const& views, Path const& file,
                   int size) {
  StagedFiles files(file.parent_path());
  std::vector<SunView> plain;
  for (auto const& view : views) {
    plain.push_back(view.view);
    plain.back().picture = fmt::format("{}.png", plain.size());
  }
  TemporaryFolder const temporary;
  auto const drawn = draw_in(temporary.path(), run, plain, size);
  PictureSheet sheet;
  for (std::size_t i = 0; i < views.size(); ++i) {
    sheet.items.push_back({drawn / plain[i].picture, views[i].caption});
    sheet.scale = sheet.scale || plain[i].receiver.empty();
  }
  auto const name = file.filename().string();
  files.write(name, encode_sheet(name, sheet));
  files.commit();
}

}  // namespace gpu_shading::energyplus

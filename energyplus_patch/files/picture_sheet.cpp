#include "files/picture_sheet.h"

#include <cmath>

#include "files/picture_call.h"
#include "gpu_shading/image.h"
#include "gpu_shading/scene_view.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

std::vector<unsigned char> scale_colours() {
  std::vector<unsigned char> colours;
  for (int i = 0; i < gpu_shading_scale_colours; ++i) {
    auto const colour = fraction_colour(i / (gpu_shading_scale_colours - 1.0));
    for (int channel = 0; channel < 3; ++channel) {
      colours.push_back(static_cast<unsigned char>(std::lround(colour[channel])));
    }
  }
  return colours;
}

}  // namespace

bool is_animation(std::filesystem::path const& path) {
  return same_name(path.extension().string(), ".gif");
}

std::string encode_sheet(std::string const& name, PictureSheet const& sheet) {
  std::vector<char const*> pictures;
  std::vector<char const*> captions;
  for (auto const& item : sheet.items) {
    pictures.push_back(item.picture.c_str());
    captions.push_back(item.caption.c_str());
  }
  auto const scale = scale_colours();
  constexpr int columns = SheetLayout::most_columns;
  constexpr float frames_per_second = 8.0F;
  gpu_shading_sheet const all{static_cast<int>(sheet.items.size()),
                              pictures.data(),
                              captions.data(),
                              sheet.scale ? scale.data() : nullptr,
                              columns,
                              is_animation(name) ? 1 : 0,
                              frames_per_second};
  return write_picture<decltype(gpu_shading_write_sheet)>("gpu_shading_write_sheet", name, all);
}

}  // namespace gpu_shading::energyplus

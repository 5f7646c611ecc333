#include "files/labelled_image.h"

#include "files/picture_call.h"

namespace gpu_shading::energyplus {

std::string encode_labelled(std::string const& name, Image const& image,
                            std::vector<Label> const& labels) {
  std::vector<gpu_shading_label> plain;
  plain.reserve(labels.size());
  for (auto const& label : labels) {
    plain.push_back(
        {label.text.c_str(), label.x, label.y, label.size, static_cast<int>(label.align)});
  }
  gpu_shading_labelled const all{image.width, image.height, image.pixels.data(),
                                 static_cast<int>(plain.size()), plain.data()};
  return write_picture<decltype(gpu_shading_write_labelled)>("gpu_shading_write_labelled", name,
                                                             all);
}

}  // namespace gpu_shading::energyplus

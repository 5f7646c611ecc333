#pragma once

#include <string>
#include <vector>

#include "gpu_shading/image.h"

namespace gpu_shading::energyplus {

enum class LabelAlign { left, centre, right };

// A line of black text in an image.
struct Label {
  int x = 0;     // pixels from the left, of the end or the middle that `align` names
  int y = 0;     // pixels from the top, of the middle of the line
  int size = 0;  // height of the font, pixels
  LabelAlign align = LabelAlign::left;
  std::string text;
};

// An image of 3 channels with labels, as the bytes of a file, by OpenImageIO; the ending of `name`
// is its format. Without a font, labels are left out with a warning. Throws Error: "NAME: cannot be
// drawn: why".
std::string encode_labelled(std::string const& name, Image const& image,
                            std::vector<Label> const& labels);

}  // namespace gpu_shading::energyplus

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gpu_shading/image.h"

// Pictures as the bytes of files, by OpenImageIO or, on Windows, GDI+; the ending of `name` is the
// format. The functions throw Error: "NAME: cannot be drawn: why".
namespace gpu_shading::energyplus {

std::string encode_image(std::string const& name, Image const& image);

enum class LabelAlign { left, centre, right };

// A line of black text in an image.
struct Label {
  int x = 0;     // pixels from the left, of the end or the middle that `align` names
  int y = 0;     // pixels from the top, of the middle of the line
  int size = 0;  // height of the font, pixels
  LabelAlign align = LabelAlign::left;
  std::string text;
};

// An image of 3 channels. Without a font, labels are left out with a warning.
std::string encode_labelled(std::string const& name, Image const& image,
                            std::vector<Label> const& labels);

// Picture files to combine in one.
struct PictureSheet {
  struct Item {
    std::filesystem::path picture;
    std::string caption;  // lines
  };
  std::vector<Item> items;
  bool scale = true;  // of sunlit fractions, beside them
};

// In rows or, in a .gif, one after another.
std::string encode_sheet(std::string const& name, PictureSheet const& sheet);

bool is_animation(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus

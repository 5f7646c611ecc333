#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// Picture files to combine in one.
struct PictureSheet {
  struct Item {
    std::filesystem::path picture;
    std::string caption;
  };
  std::vector<Item> items;
  bool scale = false;  // a scale of sunlit fractions beside them
};

// As the bytes of a file, whose format is the ending of `name`: in rows or, in a .gif, one after
// another. Throws Error: "NAME: cannot be drawn: why".
std::string encode_sheet(std::string const& name, PictureSheet const& sheet);

bool is_animation(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus

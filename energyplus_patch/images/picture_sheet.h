#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// Pictures, as files, that go together into one.
struct PictureSheet {
  struct Entry {
    std::filesystem::path picture;
    std::string caption;
  };
  std::vector<Entry> entries;
  bool scale = false;  // of sunlit fractions, beside them
};

// In rows, or one after another where the path ends in .gif. Throws Error.
void write_sheet(std::filesystem::path const& path, PictureSheet const& sheet);

bool is_animation(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus

#pragma once

#include <algorithm>

namespace gpu_shading {

// Lengths in a sheet of pictures in proportion to the largest of them, so that all sizes look
// alike; pixels. Each picture has a cell, below the line of its caption; the scale is at the right.
struct SheetLayout {
  static constexpr int max_columns = 4;
  static constexpr int scale_colours = 256;
  static constexpr int min_bar = scale_colours / 8;

  SheetLayout(int max_width, int max_height, bool scale)
      : width(std::max(1, max_width)), height(std::max(1, max_height)) {
    constexpr int min_text = 11;
    constexpr int lines = 28;
    text = std::max(min_text, std::max(width, height) / lines);
    margin = text / 2;
    caption = 2 * text;
    cell_width = width + 2 * margin;
    cell_height = height + caption + margin;
    scale_width = scale ? 7 * text : 0;
    // Where a bar and its numbers have room.
    scale_height = scale ? caption + 2 * text + margin + min_bar : 0;
  }

  int sheet_width(int columns) const { return columns * cell_width + scale_width; }
  int sheet_height(int rows) const { return std::max(rows * cell_height, scale_height); }

  // The bar of the scale, from 0 at the bottom to 1.
  int bar_left(int columns) const { return columns * cell_width + text; }
  int bar_top() const { return caption + text; }
  int bar_height(int rows) const {
    int const below = std::max(cell_height, scale_height);
    return std::max(min_bar, std::min(sheet_height(rows), below) - bar_top() - margin - text);
  }

  int width;  // of the largest picture
  int height;
  int text;  // height of the font
  int margin;
  int caption;  // height of the line above a picture
  int cell_width;
  int cell_height;
  int scale_width;
  int scale_height;
};

}  // namespace gpu_shading

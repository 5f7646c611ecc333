#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace gpu_shading {

struct PictureSize {
  int width = 0;
  int height = 0;
};

// The lines of the captions of a sheet, and the characters of the longest.
struct CaptionSize {
  int lines = 1;
  int longest = 0;

  void add(std::string_view caption) {
    int number = 1;
    for (auto end = caption.find('\n'); end != caption.npos; end = caption.find('\n')) {
      longest = std::max(longest, static_cast<int>(end));
      caption.remove_prefix(end + 1);
      ++number;
    }
    longest = std::max(longest, static_cast<int>(caption.size()));
    lines = std::max(lines, number);
  }
};

// Lengths in a sheet of pictures in proportion to the largest of them, so that all sizes look
// alike; pixels. Each picture has a cell, below the lines of its caption, in rows that are as high
// as their highest picture; the scale, if there is one, is at the right.
struct SheetLayout {
  static constexpr int max_columns = 4;
  static constexpr int scale_colours = 256;
  static constexpr int min_bar = scale_colours / 8;

  SheetLayout(std::span<PictureSize const> pictures, int max_in_row, CaptionSize captions,
              bool has_scale)
      : columns(std::min(static_cast<int>(pictures.size()), max_in_row)) {
    int longest = 1;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      width = std::max(width, pictures[i].width);
      longest = std::max({longest, pictures[i].width, pictures[i].height});
      auto const row = i / static_cast<std::size_t>(columns);
      if (row == row_heights.size()) row_heights.push_back(1);
      row_heights[row] = std::max(row_heights[row], pictures[i].height);
    }
    constexpr int min_text = 11;
    constexpr int lines_of_longest = 28;
    text = std::max(min_text, longest / lines_of_longest);
    margin = text / 2;
    line = text + margin / 2;
    caption = text + captions.lines * line;
    // The mean width of DejaVu Sans's letters and digits is 0.58 of its height.
    cell_width = std::max(width, 6 * captions.longest * text / 10) + 2 * margin;
    for (int const height : row_heights) row_tops.push_back(row_tops.back() + cell_height(height));
    if (!has_scale) return;
    scale_width = 7 * text;
    // Where a bar and its numbers have room.
    scale_height = caption + 2 * text + margin + min_bar;
  }

  int sheet_width() const { return columns * cell_width + scale_width; }
  int sheet_height() const { return std::max(row_tops.back(), scale_height); }

  // Of the cell of a picture.
  int left(std::size_t picture) const {
    return static_cast<int>(picture % static_cast<std::size_t>(columns)) * cell_width;
  }
  int top(std::size_t picture) const { return row_tops[row_of(picture)]; }
  // The middle of a line of its caption.
  int line_middle(std::size_t picture, int number) const {
    return top(picture) + margin + number * line + line / 2;
  }
  // Where the picture is, in the middle of its cell.
  int picture_left(std::size_t picture, int its_width) const {
    return left(picture) + (cell_width - its_width) / 2;
  }
  int picture_top(std::size_t picture, int its_height) const {
    return top(picture) + caption + (row_heights[row_of(picture)] - its_height) / 2;
  }

  // The bar of the scale, from 0 at the bottom to 1.
  int bar_left() const { return columns * cell_width + text; }
  int bar_top() const { return caption + text; }
  int bar_height() const {
    int const below = std::max(row_tops[1], scale_height);
    return std::max(min_bar, std::min(sheet_height(), below) - bar_top() - margin - text);
  }

  int columns;
  int width = 1;  // of the widest picture
  std::vector<int> row_heights;
  std::vector<int> row_tops{0};  // and below the last one
  int text = 0;                  // height of the font
  int margin = 0;
  int line = 0;     // height of a line of a caption
  int caption = 0;  // height of the lines above a picture
  int cell_width = 0;
  int scale_width = 0;
  int scale_height = 0;

 private:
  std::size_t row_of(std::size_t picture) const {
    return picture / static_cast<std::size_t>(columns);
  }
  int cell_height(int height) const { return height + caption + margin; }
};

}  // namespace gpu_shading

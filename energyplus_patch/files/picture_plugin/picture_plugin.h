#pragma once

// The functions that libgpu_shading_pictures.so exports: OpenImageIO behind a C interface, so that
// its many libraries are only loaded when a picture is drawn. No exception leaves these functions.
// Each returns 0, or 1 with the reason in `message`, in one line.

#include <cstddef>

#include "files/picture_plugin/sheet_layout.h"

// It takes about 0.25 s to load.
inline constexpr char const* gpu_shading_picture_library = "libgpu_shading_pictures.so";

// Number of colours of a scale from 0 to 1.
inline constexpr int gpu_shading_scale_colours = gpu_shading::SheetLayout::scale_colours;

extern "C" {

// 8-bit pixels, rows from the top. `name`: its ending is the picture's format.
int gpu_shading_write_image(char const* path, char const* name, int width, int height, int channels,
                            unsigned char const* pixels, char* message, std::size_t message_size);

// A line of black text.
struct gpu_shading_label {
  char const* text;
  int x;      // pixels from the left, of the end or the middle that `align` names
  int y;      // pixels from the top, of the middle of the line
  int size;   // height of the font, pixels
  int align;  // 0: left, 1: centre, 2: right
};

// 8-bit red, green and blue, rows from the top, with labels.
struct gpu_shading_labelled {
  int width;
  int height;
  unsigned char const* pixels;
  int count;
  gpu_shading_label const* labels;
};
int gpu_shading_write_labelled(char const* path, char const* name,
                               gpu_shading_labelled const* picture, char* message,
                               std::size_t message_size);

// Pictures combined in one file, each below the lines of its caption.
struct gpu_shading_sheet {
  int count;
  char const* const* pictures;  // files of our own
  char const* const* captions;
  unsigned char const* scale;  // gpu_shading_scale_colours x red, green, blue; nullptr: none
  int columns;                 // of the combined picture
  int animated;                // not 0: an animation instead
  float frames_per_second;
};
int gpu_shading_write_sheet(char const* path, char const* name, gpu_shading_sheet const* sheet,
                            char* message, std::size_t message_size);
}

#pragma once

// What libgpu_shading_images.so exports: OpenImageIO behind a C interface, so that its many
// libraries are loaded only when a picture or a texture is wanted. No exception leaves these
// functions. Each returns 0, or 1 with the reason in `message`, one line.

#include <cstddef>

// It takes about 0.25 s to load.
inline constexpr char const* gpu_shading_image_library = "libgpu_shading_images.so";

// Of a scale, from 0 to 1.
inline constexpr int gpu_shading_scale_colours = 256;

extern "C" {

struct gpu_shading_image_info {
  int width;
  int height;
  int channels;
  int alpha;  // the alpha channel, -1: none
};

// 8-bit pixels, rows from the top.
int gpu_shading_write_image(char const* path, int width, int height, int channels,
                            unsigned char const* pixels, char* message, std::size_t message_size);

// Pictures together in one file, each below its caption.
struct gpu_shading_sheet {
  int count;
  char const* const* pictures;  // files
  char const* const* captions;
  unsigned char const* scale;  // gpu_shading_scale_colours x red, green, blue; or nullptr: none
  int columns;                 // of a picture of all of them
  int animated;                // not 0: one after another instead
  float frames_per_second;
};
int gpu_shading_write_sheet(char const* path, gpu_shading_sheet const* sheet, char* message,
                            std::size_t message_size);

// From the file's header alone.
int gpu_shading_probe_image(char const* path, gpu_shading_image_info* info, char* message,
                            std::size_t message_size);

// Alpha, or luminance as stored where there is none, of `width` x `height` texels, 0 .. 65535 for
// 0 .. 1 and clamped to that, rows from the BOTTOM. Besides `opacity` a few tens of MiB are used,
// unless the format itself (interlaced PNG, WebP, ...) has to be decoded whole. An image of another
// size and a texel that is not a number are errors.
int gpu_shading_read_opacity(char const* path, int width, int height, unsigned short* opacity,
                             char* message, std::size_t message_size);

// Where a GeoTIFF's cells lie.
struct gpu_shading_elevation_info {
  int columns;
  int rows;
  double x;        // of the centre of the first row's first cell
  double y;        //
  double step_x;   // to the next cell of the row, in the file's units
  double step_y;   // to the next row; below 0 where the first row is the northern one
  int epsg;        // what x and y are: 4326, 32633, ...; 0: it does not say
  double no_data;  // not a number: it does not say
};

// Headers alone. Rows that do not run east, and elevations that are not in metres, are errors.
int gpu_shading_probe_elevations(char const* path, gpu_shading_elevation_info* info, char* message,
                                 std::size_t message_size);

// Rows as in the file. An image of another size or of several channels is an error.
int gpu_shading_read_elevations(char const* path, int columns, int rows, double* elevations,
                                char* message, std::size_t message_size);
}

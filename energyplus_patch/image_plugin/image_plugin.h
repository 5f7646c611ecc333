#pragma once

// The functions that libgpu_shading_images.so exports: OpenImageIO behind a C interface, so that
// its many libraries are only loaded when a picture or a texture is needed. No exception leaves
// these functions. Each returns 0, or 1 with the reason in `message`, in one line.

#include <cstddef>

// It takes about 0.25 s to load.
inline constexpr char const* gpu_shading_image_library = "libgpu_shading_images.so";

// Number of colours of a scale from 0 to 1.
inline constexpr int gpu_shading_scale_colours = 256;

extern "C" {

struct gpu_shading_image_info {
  int width;
  int height;
  int channels;
  int alpha;  // the alpha channel, -1: none
};

// 8-bit pixels, rows from the top. `name`: its ending is the picture's format.
int gpu_shading_write_image(char const* path, char const* name, int width, int height, int channels,
                            unsigned char const* pixels, char* message, std::size_t message_size);

// Pictures combined in one file, each below its caption.
struct gpu_shading_sheet {
  int count;
  char const* const* pictures;  // files
  char const* const* captions;
  unsigned char const* scale;  // gpu_shading_scale_colours x red, green, blue; nullptr: no scale
  int columns;                 // of the combined picture
  int animated;                // not 0: an animation instead
  float frames_per_second;
};
int gpu_shading_write_sheet(char const* path, char const* name, gpu_shading_sheet const* sheet,
                            char* message, std::size_t message_size);

// Reads the file's header only.
int gpu_shading_probe_image(char const* path, gpu_shading_image_info* info, char* message,
                            std::size_t message_size);

// Alpha, or luminance as stored if there is no alpha, of `width` x `height` texels, 0 .. 65535 for
// 0 .. 1, clamped, with rows from the BOTTOM. Uses a few tens of MiB besides `opacity`, unless the
// format itself (interlaced PNG, WebP, ...) requires decoding the whole image. It is an error if
// the image has another size or a texel is NaN.
int gpu_shading_read_opacity(char const* path, int width, int height, unsigned short* opacity,
                             char* message, std::size_t message_size);

// The positions of a GeoTIFF's cells.
struct gpu_shading_elevation_info {
  int columns;
  int rows;
  double x;        // centre of the first cell of the first row
  double y;        //
  double step_x;   // step to the next cell of the row, in the file's units
  double step_y;   // step to the next row; negative if the first row is the northernmost
  int epsg;        // EPSG code of x and y: 4326, 32633, ...; 0: not stated
  double no_data;  // NaN: not stated
};

// Reads headers only. It is an error if rows do not run east or elevations are not in metres.
int gpu_shading_probe_elevations(char const* path, gpu_shading_elevation_info* info, char* message,
                                 std::size_t message_size);

// Rows as in the file. It is an error if the image has another size or several channels.
int gpu_shading_read_elevations(char const* path, int columns, int rows, double* elevations,
                                char* message, std::size_t message_size);
}

#pragma once

// What libgpu_shading_images.so exports: OpenImageIO behind a C interface, so that its many
// libraries are loaded only when a picture or a texture is wanted. No exception leaves these
// functions.

#include <cstddef>

extern "C" {

// 8-bit pixels, rows from the top. Returns 0, or 1 with the reason in `message`.
int gpu_shading_write_image(char const* path, int width, int height, int channels,
                            unsigned char const* pixels, char* message, std::size_t message_size);
}

#include "images/image_library.h"

#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>

#define EXPORTED __attribute__((visibility("default")))

extern "C" EXPORTED int gpu_shading_write_image(char const* path, int width, int height,
                                                int channels, unsigned char const* pixels,
                                                char* message, std::size_t message_size) {
  auto const fail = [&](char const* why) {
    std::snprintf(message, message_size, "%s", why);
    return 1;
  };
  try {
    auto const output = OIIO::ImageOutput::create(path);
    if (!output) return fail(OIIO::geterror().c_str());
    OIIO::ImageSpec const spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels) ||
        !output->close()) {
      return fail(output->geterror().c_str());
    }
    return 0;
  } catch (std::exception const& error) {
    return fail(error.what());
  }
}

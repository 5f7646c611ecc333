#include <OpenImageIO/imageio.h>

#include "files/picture_plugin/picture_plugin.h"
#include "platform/c_interface.h"

extern "C" EXPORTED int gpu_shading_write_image(char const* path, char const* name, int width,
                                                int height, int channels,
                                                unsigned char const* pixels, char* message,
                                                std::size_t message_size) {
  return guarded(message, message_size, [&] {
    auto const output = OIIO::ImageOutput::create(name);
    if (!output) fail(OIIO::geterror());
    OIIO::ImageSpec const spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels) ||
        !output->close()) {
      fail(output->geterror());
    }
  });
}

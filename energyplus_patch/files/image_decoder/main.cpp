// The program that reads one image or one grid of elevations; see files/decoding/decoder.h.
// Operations and answers:
//   image                 width, height, channels, alpha (32 bits each), the number of texels that
//                         follow, 0 if there are too many (64 bits), then 16 bits for each of them
//   small image           the same, for few_texels at most
//   elevations            columns, rows, EPSG code (32 bits), x, y, steps of x and y (64 bits
//                         each), the number of cells that follow, 0 if there are too many (64
//                         bits), then a double for each of them, NaN where there is no data

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <stdexcept>

#include "files/decoding/decoder.h"
#include "files/image_decoder/elevations.h"
#include "files/image_decoder/images.h"

namespace {

using namespace gpu_shading::decoding;

void put(DecodedMessage& answer, ImageHeader const& header) {
  for (auto const value : {header.width, header.height, header.channels, header.alpha}) {
    answer.put(value);
  }
}

void put(DecodedMessage& answer, ElevationHeader const& header) {
  for (auto const value : {header.columns, header.rows, header.epsg}) answer.put(value);
  for (auto const value : {header.x, header.y, header.step_x, header.step_y}) {
    answer.put(value);
  }
}

void decode(Request const& request, DecodedMessage& answer) {
  // Here, since that makes OpenImageIO's pool of threads, which a fork would not have.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  if (request.operation == "image" || request.operation == "small image") {
    auto const max_texels_wanted = request.operation == "image" ? max_texels : few_texels;
    auto const [header, opacity] =
        read_image({input_path, request.name, request.any}, max_texels_wanted);
    put(answer, header);
    answer.put(std::uint64_t{opacity.size()});
    answer.put_all(opacity);
  } else if (request.operation == "elevations") {
    auto const [header, elevations] = read_elevations(input_path);
    put(answer, header);
    answer.put(std::uint64_t{elevations.size()});
    answer.put_all(elevations);
  } else {
    throw std::runtime_error("unknown operation");
  }
}

}  // namespace

int main() {
  // Without the destructors of libraries, which a damaged file may have led astray.
  _exit(run_decoder(false, decode));
}

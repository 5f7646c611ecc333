#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "files/pictures.h"
#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "programs/gpu_shading/screen_files.h"

namespace gpu_shading::energyplus {
namespace {

constexpr glm::dvec3 behind{226.0, 238.0, 250.0};
constexpr glm::dvec3 wall{44.0, 47.0, 52.0};
constexpr glm::dvec3 face{142.0, 146.0, 152.0};

std::size_t texel_of(double position, int count) {
  auto const texel = static_cast<int>(std::floor((position - std::floor(position)) * count));
  return static_cast<std::size_t>(std::min(texel, count - 1));
}

double opacity(PerforatedScreen const& screen, double u, double v) {
  if (screen.pattern()) return screen.pattern()->is_open(u, v) ? 0.0 : 1.0;
  auto const& tile = *screen.tile();
  auto const column = texel_of(u / tile.width(), tile.columns());
  auto const row = texel_of(v / tile.height(), tile.rows());
  constexpr double solid = 65535.0;
  double const value =
      tile.opacity()[row * static_cast<std::size_t>(tile.columns()) + column] / solid;
  if (!tile.threshold()) return value;
  return value > *tile.threshold() ? 1.0 : 0.0;
}

// Along a line of sight from a point of the front face to the back face, `shift` to the left.
double largest_opacity(PerforatedScreen const& screen, glm::dvec2 from, double shift) {
  constexpr int steps = 96;
  double largest = 0.0;
  for (int i = 0; i <= steps && largest < 1.0; ++i) {
    largest = std::max(largest, opacity(screen, from.x - shift * i / steps, from.y));
  }
  return largest;
}

glm::dvec3 colour_at(PerforatedScreen const& screen, glm::dvec2 at, double shift) {
  double const front = opacity(screen, at.x, at.y);
  if (front >= 1.0) return face;
  auto const inside = glm::mix(behind, wall, largest_opacity(screen, at, shift) - front);
  return glm::mix(inside, face, front);
}

// `size` pixels on the longer side, seen from a point far to the right (where u points) at an angle
// in degrees from the normal.
Image draw_tile(PerforatedScreen const& screen, double angle, int size) {
  auto const& pattern = screen.pattern();
  glm::dvec2 const tile = pattern ? glm::dvec2(pattern->width(), pattern->height())
                                  : glm::dvec2(screen.tile()->width(), screen.tile()->height());
  // Holes of a pattern are centred on (0, 0).
  auto const start = pattern ? -0.5 * tile : glm::dvec2(0.0);
  double const pixel = std::max(tile.x, tile.y) / size;
  double const shift = screen.sheet().thickness * std::tan(glm::radians(angle));
  Image image;
  image.width = std::max(1, static_cast<int>(std::lround(tile.x / pixel)));
  image.height = std::max(1, static_cast<int>(std::lround(tile.y / pixel)));
  constexpr int samples = 2;  // each way
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      glm::dvec3 sum(0.0);
      for (int row = 0; row < samples; ++row) {
        for (int column = 0; column < samples; ++column) {
          glm::dvec2 const within((column + 0.5) / samples, (row + 0.5) / samples);
          // Rows from the top, where v is largest.
          glm::dvec2 const at = start + tile * glm::dvec2((x + within.x) / image.width,
                                                          1.0 - (y + within.y) / image.height);
          sum += colour_at(screen, at, shift);
        }
      }
      for (int channel = 0; channel < image.channels; ++channel) {
        image.pixels.push_back(
            static_cast<std::uint8_t>(std::lround(sum[channel] / (samples * samples))));
      }
    }
  }
  return image;
}

std::string encode_views(PerforatedScreen const& screen, std::string const& name) {
  constexpr int size = 480;
  constexpr double oblique = 30.0;
  TemporaryFolder const temporary;
  PictureSheet sheet{.items = {}, .scale = false};
  for (double const angle : {0.0, oblique}) {
    auto const file = temporary.path() / fmt::format("{}.png", angle);
    write_whole_file(file, [&](std::ostream& out) {
      out << encode_image("tile.png", draw_tile(screen, angle, size));
    });
    sheet.items.push_back(
        {file, angle > 0.0 ? fmt::format("{:g} degrees from the right", angle) : "from the front"});
  }
  return encode_sheet(name, sheet);
}

}  // namespace

std::optional<std::string> encode_tile(PerforatedScreen const& screen, std::string const& name) {
  try {
    return encode_views(screen, name);
  } catch (Error const& error) {
    print_line(fmt::format("warning: {}: not drawn: {}", name, error.what()));
    return std::nullopt;
  }
}

}  // namespace gpu_shading::energyplus

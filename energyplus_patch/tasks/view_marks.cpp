#include "tasks/view_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "files/pictures.h"

namespace gpu_shading::energyplus {
namespace {

void darken(Image& image, int x, int y) {
  constexpr std::uint8_t ink = 30;
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  auto const at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(at), 3, ink);
}

// So that marks are legible over anything.
void lighten(Image& image, glm::ivec2 const& corner, glm::ivec2 const& end) {
  constexpr int white = 255;
  for (int y = std::max(corner.y, 0); y < std::min(end.y, image.height); ++y) {
    for (int x = std::max(corner.x, 0); x < std::min(end.x, image.width); ++x) {
      auto const at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x));
      for (std::size_t i = at; i < at + 3; ++i) {
        image.pixels[i] = static_cast<std::uint8_t>((image.pixels[i] + 4 * white) / 5);
      }
    }
  }
}

// From one place to another, pixels from the upper left corner, `thick` pixels wide.
void draw_line(Image& image, glm::dvec2 const& from, glm::dvec2 const& to, double thick) {
  double const length = glm::distance(from, to);
  double const half = 0.5 * thick;
  auto const low = glm::min(from, to) - half;
  auto const high = glm::max(from, to) + half;
  for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y) {
    for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
      glm::dvec2 const place(x + 0.5, y + 0.5);
      double const share =
          length > 0.0 ? std::clamp(glm::dot(place - from, to - from) / (length * length), 0.0, 1.0)
                       : 0.0;
      if (glm::distance(place, from + share * (to - from)) <= half) darken(image, x, y);
    }
  }
}

// 1, 2 or 5 times a power of ten, at most so long.
double round_length(double most) {
  double const power = std::pow(10.0, std::floor(std::log10(most)));
  for (double const times : {5.0, 2.0}) {
    if (times * power <= most) return times * power;
  }
  return power;
}

}  // namespace

std::string encode_with_marks(std::string const& name, Image image, ViewScale const& scale) {
  int const shorter = std::min(image.width, image.height);
  int const font = std::clamp(shorter / 28, 10, 40);
  double const thick = std::max(2.0, font / 7.0);
  double const arm = 1.7 * font;
  std::vector<Label> labels;

  constexpr double longest = 0.25;  // of the picture's width
  double const metres = round_length(longest * image.width / scale.pixels_per_metre);
  glm::dvec2 const left(5.6 * font, image.height - 1.2 * font);
  glm::dvec2 const right = left + glm::dvec2(metres * scale.pixels_per_metre, 0.0);
  lighten(image, {0, image.height - static_cast<int>(5.4 * font)},
          {static_cast<int>(right.x + font), image.height});

  // A compass is round from above; from elsewhere it is as flat as the ground.
  glm::dvec2 const middle(2.6 * font, image.height - 2.6 * font);
  glm::dvec2 const north = glm::dvec2(scale.north_right, -scale.north_up) / scale.pixels_per_metre;
  auto const tip = middle + arm * north;
  draw_line(image, middle - arm * north, tip, thick);
  double const length = glm::length(north);
  if (length > 0.0) {
    auto const along = north / length;
    glm::dvec2 const across(-along.y, along.x);
    for (double const side : {-1.0, 1.0}) {
      draw_line(image, tip, tip - 0.6 * font * along + side * 0.35 * font * across, thick);
    }
    auto const letter = tip + 0.8 * font * along;
    labels.push_back(
        {static_cast<int>(letter.x), static_cast<int>(letter.y), font, LabelAlign::centre, "N"});
  }

  glm::dvec2 const tick(0.0, 0.35 * font);
  draw_line(image, left, right, thick);
  draw_line(image, left - tick, left + tick, thick);
  draw_line(image, right - tick, right + tick, thick);
  auto const between = 0.5 * (left + right);
  labels.push_back({static_cast<int>(between.x), static_cast<int>(between.y - 0.9 * font), font,
                    LabelAlign::centre, fmt::format("{:g} m", metres)});
  return encode_labelled(name, image, labels);
}

}  // namespace gpu_shading::energyplus

#include "filters/perforation/screen_shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "filters/perforation/sheet_outline.h"
#include "filters/perforation/sheet_rays.h"

namespace gpu_shading {
namespace {

constexpr std::size_t corners = SheetOutline::corners;

// Twice the area of a quadrilateral.
double turn(std::array<glm::dvec2, corners> const& p) { return cross(p[2] - p[0], p[3] - p[1]); }

// A quadrilateral of a sheet, with both faces in the coordinates of a view.
struct Faces {
  std::array<glm::dvec2, corners> inside;
  std::array<glm::dvec2, corners> outside;
  // More than 0 in front of the receiver, where the polygon or the middle of the body is.
  std::array<double, corners> kept;

  Faces(Screens::Quadrilateral const& part, SheetInBeam const& sheet, View const& pixels) {
    glm::dvec3 const normal(sheet.normal);
    double const middle = 0.5 * (static_cast<double>(sheet.inside) + sheet.outside);
    double const body = std::max(0.0, middle * glm::dot(glm::dvec3(pixels.cut), normal));
    for (std::size_t i = 0; i < corners; ++i) {
      glm::dvec3 const p = part.corners[i] - pixels.origin;
      glm::dvec3 const in = p + static_cast<double>(sheet.inside) * normal;
      glm::dvec3 const out = p + static_cast<double>(sheet.outside) * normal;
      inside[i] = {at(pixels.x, in), at(pixels.y, in)};
      outside[i] = {at(pixels.x, out), at(pixels.y, out)};
      kept[i] = at(pixels.cut, p) + body;
    }
  }

  ConvexArea inside_area(int side) const { return area_in_front(inside, kept, side); }

  // The areas of the strip between an edge of the inside face and that of the outside face; calls
  // use(area) for those that face the sun.
  template <typename Use>
  void each_strip(int side, Use use) const {
    glm::dvec2 const slide = outside[0] - inside[0];
    double const hand = turn(inside) < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < corners; ++i) {
      std::size_t const next = (i + 1) % corners;
      if (cross(inside[next] - inside[i], slide) * hand >= 0.0) continue;
      std::array const strip{inside[i], inside[next], outside[next], outside[i]};
      std::array const distances{kept[i], kept[next], kept[next], kept[i]};
      use(area_in_front(strip, distances, side));
    }
  }
};

// Where the rays of a tile's pixels pass the inside face of a part of a sheet, and what they meet
// from there to the outside face.
class Part {
 public:
  Part(Screens::Entry const& screen, Screens::Quadrilateral const& part, Faces const& faces,
       SheetInBeam const& sheet, View const& pixels, double pixel, bool by_rows)
      : outline_(part.places, sheet.ray_offset),
        in_place_(sheet.in_place),
        to_place_(glm::inverse(glm::dmat2(
            glm::dot(glm::dvec3(pixels.x), screen.u), glm::dot(glm::dvec3(pixels.y), screen.u),
            glm::dot(glm::dvec3(pixels.x), screen.v), glm::dot(glm::dvec3(pixels.y), screen.v)))),
        first_(part.places[0] - to_place_ * faces.inside[0]),
        rays_(*screen.screen, sheet, pixel, by_rows),
        all_or_nothing_(in_place_ == 1.0F && rays_.all_or_nothing()) {}

  // For pixels of one row.
  void shade(int row, int first, int length, PixelMask& lit, LuminanceTile& shaded) const {
    auto const [whole_first, whole_end] = whole_paths(row, first, first + length);
    shade_ends(row, first, whole_first, lit, shaded);
    if (all_or_nothing_) {
      darken_whole(row, whole_first, whole_end, lit);
    } else {
      shade_whole(row, whole_first, whole_end, lit, shaded.row(row));
    }
    shade_ends(row, whole_end, first + length, lit, shaded);
  }

 private:
  struct Pixels {
    int first;
    int end;
  };

  glm::dvec2 place(int row, int column) const {
    return first_ + to_place_ * glm::dvec2(column + 0.5, row + 0.5);
  }
  float kept(float passed) const { return 1.0F - in_place_ * (1.0F - passed); }

  // The pixels of a row whose rays are inside the outline from face to face, or fewer.
  Pixels whole_paths(int row, int first, int end) const {
    double low = first;
    double high = end;
    glm::dvec2 const start = place(row, 0);
    for (std::size_t i = 0; i < corners; ++i) {
      double const spare = outline_.within(i, start) - std::max(0.0, -outline_.step(i));
      double const change = outline_.change(i, to_place_[0]);
      if (change > 0.0) {
        low = std::max(low, -spare / change);
      } else if (change < 0.0) {
        high = std::min(high, -spare / change);
      } else if (spare < 0.0) {
        high = low;
      }
    }
    low = std::ceil(std::min(low, static_cast<double>(end)));
    high = std::floor(std::max(high, low));
    return {static_cast<int>(low), static_cast<int>(high)};
  }

  // Calls use(first, end, wanted) for parts of a row, each of one word, that have lit pixels; the
  // lowest bit of `wanted` is the first.
  template <typename Use>
  void each_word(int row, int first, int end, PixelMask const& lit, Use use) const {
    constexpr int word = PixelMask::word_bits;
    static_assert(SheetRays::max_rays == word);
    for (int x = first; x < end;) {
      int const stop = std::min(end, (x / word + 1) * word);
      auto const unused = static_cast<unsigned>(word - (stop - x));
      std::uint64_t const wanted =
          lit.word(row, x) >> static_cast<unsigned>(x % word) << unused >> unused;
      if (wanted != 0) use(x, stop, wanted);
      x = stop;
    }
  }

  void darken_whole(int row, int first, int end, PixelMask& lit) const {
    each_word(row, first, end, lit, [&](int x, int /*stop*/, std::uint64_t wanted) {
      std::uint64_t const stopped = wanted & ~rays_.passing(place(row, x), to_place_[0], wanted);
      lit.keep(row, x, ~(stopped << static_cast<unsigned>(x % PixelMask::word_bits)));
    });
  }

  void shade_whole(int row, int first, int end, PixelMask const& lit,
                   std::span<float> luminance) const {
    if (auto const passed = rays_.everywhere()) {
      float const by = kept(*passed);
      for (int x = first; x < end; ++x) luminance[static_cast<std::size_t>(x)] *= by;
      return;
    }
    SheetRays::Passed passed{};
    each_word(row, first, end, lit, [&](int x, int stop, std::uint64_t wanted) {
      rays_.whole_paths(place(row, x), to_place_[0], wanted, passed);
      for (int i = x; i < stop; ++i) {
        luminance[static_cast<std::size_t>(i)] *= kept(passed[static_cast<std::size_t>(i - x)]);
      }
    });
  }

  void shade_ends(int row, int first, int end, PixelMask& lit, LuminanceTile& shaded) const {
    for (int x = first; x < end; ++x) {
      auto const bit = std::uint64_t{1} << static_cast<unsigned>(x % PixelMask::word_bits);
      if ((lit.word(row, x) & bit) == 0) continue;
      float const by = kept(passed(place(row, x)));
      if (by == 0.0F) {
        lit.keep(row, x, ~bit);
      } else if (by != 1.0F) {
        shaded.row(row)[static_cast<std::size_t>(x)] *= by;
      }
    }
  }

  float passed(glm::dvec2 const& place) const {
    auto const part = outline_.part_within(place);
    return part ? rays_.part_of_path(place, part->begin, part->end) : 1.0F;
  }

  SheetOutline outline_;
  float in_place_;  // share of the screen
  glm::dmat2 to_place_;
  glm::dvec2 first_;
  SheetRays rays_;
  bool all_or_nothing_;
};

void shade(LuminanceTile& shaded, PixelMask& lit, View const& pixels, Screens::Entry const& screen,
           SheetInBeam const& sheet, double pixel, bool by_rows) {
  for (Screens::Quadrilateral const& quadrilateral : screen.parts) {
    Faces const faces(quadrilateral, sheet, pixels);
    if (sheet.layers == solid_sheet) {
      auto const dim = [&](ConvexArea const& area) {
        if (sheet.in_place == 1.0F) {
          lit.darken(area);
        } else {
          shaded.multiply(area, 1.0F - sheet.in_place);
        }
      };
      dim(faces.inside_area(shaded.columns()));
      faces.each_strip(shaded.columns(), dim);
      continue;
    }
    Part const part(screen, quadrilateral, faces, sheet, pixels, pixel, by_rows);
    auto const look = [&](ConvexArea const& area) {
      shaded.each_span(area, [&](int row, int first, int length) {
        part.shade(row, first, length, lit, shaded);
      });
    };
    look(faces.inside_area(shaded.columns()));
    faces.each_strip(shaded.columns(), look);
  }
}

}  // namespace

bool all_or_nothing(ScreensInView const& in_view, View const& pixels) {
  return std::all_of(in_view.numbers.begin(), in_view.numbers.end(), [&](int number) {
    SheetInBeam const& sheet = in_view.sheets[static_cast<std::size_t>(number)];
    if (sheet.in_place != 1.0F) return false;
    if (sheet.layers == solid_sheet) return true;
    Screens::Entry const& screen = (*in_view.screens)[number];
    return has_edges(sheet) &&
           static_cast<float>(drawn_pixel(in_view, screen, pixels)) <= sheet.blend_from;
  });
}

void shade_by_screens(LuminanceTile& shaded, PixelMask& lit, View const& pixels,
                      ScreensInView const& in_view) {
  for (int const number : in_view.numbers) {
    Screens::Entry const& screen = (*in_view.screens)[number];
    shade(shaded, lit, pixels, screen, in_view.sheets[static_cast<std::size_t>(number)],
          drawn_pixel(in_view, screen, pixels), in_view.by_rows);
  }
}

}  // namespace gpu_shading

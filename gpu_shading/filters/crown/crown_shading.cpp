#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "filters/crown/crowns.h"
#include "platform/instructions.h"

namespace gpu_shading {
namespace {

// Of a row of pixels, in metres along their rays: where these pass the middle of the crown's box
// and of the quadric that bounds it, the square of half of their way through the quadric, and where
// they begin.
struct RowOfRays {
  float first = 0.0F;  // distance of the first pixel
  float middle_start = 0.0F;
  float middle_slope = 0.0F;
  float half_start = 0.0F;
  float half_slope = 0.0F;
  float half_curve = 0.0F;
  float box_start = 0.0F;
  float box_slope = 0.0F;
  float box_half = 0.0F;
  float cut_start = 0.0F;
  float cut_slope = 0.0F;
  float doublings = 0.0F;  // extinction as powers of 2
};

[[gnu::always_inline]] inline float lesser(float a, float b) { return b < a ? b : a; }
[[gnu::always_inline]] inline float greater(float a, float b) { return a < b ? b : a; }

// 2^-t, within 2e-7 of it; exactly 1 at 0. std::exp is not vectorised.
[[gnu::always_inline]] inline float power_of_half(float t) {
  float const within = lesser(t, 126.0F);
  auto const whole = static_cast<std::int32_t>(within);
  float const f = within - static_cast<float>(whole);
  // Fitted at Chebyshev points.
  float sum = 0.00011498087F;
  sum = sum * f - 0.0012917895F;
  sum = sum * f + 0.009597169F;
  sum = sum * f - 0.055499277F;
  sum = sum * f + 0.2402261F;
  sum = sum * f - 0.69314717F;
  return (1.0F + f * sum) * std::bit_cast<float>((127 - whole) << 23);
}

enum class Sides { bound, open_below, open_above };  // the quadric along a ray towards the sun

// Written so that the compiler can vectorise it.
template <Sides sides>
[[gnu::always_inline]] inline void shade_some(RowOfRays const& row, float* luminance, int pixels) {
  for (int i = 0; i < pixels; ++i) {
    float const x = row.first + static_cast<float>(i);
    float const middle = row.middle_start + x * row.middle_slope;
    float const squared = row.half_start + x * (row.half_slope + x * row.half_curve);
    float const half = std::sqrt(greater(squared, 0.0F));
    float const box = row.box_start + x * row.box_slope;
    float begin = greater(box - row.box_half, row.cut_start + x * row.cut_slope);
    float end = box + row.box_half;
    if constexpr (sides == Sides::open_below) {
      end = lesser(end, middle - half);
    } else if constexpr (sides == Sides::open_above) {
      begin = greater(begin, middle + half);
    } else {
      begin = greater(begin, middle - half);
      end = lesser(end, middle + half);
    }
    luminance[i] *= power_of_half(row.doublings * greater(end - begin, 0.0F));
  }
}

[[gnu::always_inline]] inline void shade_row(RowOfRays const& row, Sides sides, float* luminance,
                                             int pixels) {
  switch (sides) {
    case Sides::bound:
      return shade_some<Sides::bound>(row, luminance, pixels);
    case Sides::open_below:
      return shade_some<Sides::open_below>(row, luminance, pixels);
    case Sides::open_above:
      return shade_some<Sides::open_above>(row, luminance, pixels);
  }
}

// A crown in the pixels of a view.
class CrownRays {
 public:
  CrownRays(CrownInBeam const& crown, View const& pixels)
      : crown_(crown), pixels_(pixels), solid_(crown.crown->solid) {
    glm::dvec3 const x(pixels.x);
    glm::dvec3 const y(pixels.y);
    anticlockwise_ = glm::dot(glm::cross(x, y), crown.towards_sun) > 0.0;
    double const xx = glm::dot(x, x);
    double const xy = glm::dot(x, y);
    double const yy = glm::dot(y, y);
    double const determinant = xx * yy - xy * xy;
    // Steps across the beam by one column and by one row.
    glm::dvec3 const across = (yy * x - xy * y) / determinant;
    glm::dvec3 const up = (xx * y - xy * x) / determinant;
    glm::dvec3 const cut(pixels.cut);
    Crowns::Entry const& entry = *crown.crown;
    glm::dvec3 const centre = entry.centre - pixels.origin;
    centre_ = {at(pixels.x, centre), at(pixels.y, centre)};
    across_ = entry.in_cube(across);
    up_ = entry.in_cube(up);
    along_ = entry.in_cube(crown.towards_sun);
    height_ = at(pixels.cut, centre);
    rise_across_ = glm::dot(cut, across);
    rise_up_ = glm::dot(cut, up);
    rise_ = glm::dot(cut, crown.towards_sun);
    for (glm::dvec3 const& corner : entry.corners()) {
      glm::dvec3 const p = corner - pixels.origin;
      glm::dvec2 const place(at(pixels.x, p), at(pixels.y, p));
      low_ = glm::min(low_, place);
      high_ = glm::max(high_, place);
    }
    steepness_ =
        glm::dot(glm::dvec2(along_), glm::dvec2(along_)) + solid_.square * along_.z * along_.z;
  }

  void shade(LuminanceTile& shaded, int first_row, int end_row) const {
    int const first = std::max(first_row, pixel(low_.y));
    int const end = std::min(end_row, pixel(high_.y));
    if (crown_.crown->crown.mesh) return shade_by_mesh(shaded, first, end);
    for (int row = first; row < end; ++row) shade(row, shaded.columns(), shaded.row(row));
  }

 private:
  // The first pixel whose centre is beyond a place.
  static int pixel(double place) {
    constexpr double most = 1e9;
    return static_cast<int>(std::ceil(std::clamp(place, -most, most) - 0.5));
  }

  // Whether a ray meets the sides of the solid, and the planes of its ends and of the cut, at an
  // angle: single precision tells them apart then.
  bool is_plain() const {
    constexpr double least = 1e-2;
    double const whole = glm::dot(along_, along_);
    return std::abs(steepness_) > least * whole &&
           std::abs(along_.z) > 0.1 * least * std::sqrt(whole) && rise_ > 0.0;
  }

  void shade(int row, int columns, std::span<float> luminance) const {
    int first = std::max(0, pixel(low_.x));
    int end = std::min(columns, pixel(high_.x));
    if (!is_plain()) {
      for (int column = first; column < end; ++column) {
        luminance[static_cast<std::size_t>(column)] *= transmittance(column, row);
      }
      return;
    }
    double const y = row + 0.5 - centre_.y;
    glm::dvec3 const p = y * up_;
    // The terms of the quadratic equation for the ray's way into the solid, as CrownSolid::inside
    // has them.
    double const a = steepness_;
    double const square = solid_.square;
    glm::dvec3 const weighted(along_.x, along_.y, square * along_.z);
    double const b = glm::dot(p, weighted) + 0.5 * solid_.linear * along_.z;
    double const b_slope = glm::dot(across_, weighted);
    glm::dvec3 const weights(1.0, 1.0, square);
    double const c = glm::dot(weights * p, p) + solid_.linear * p.z + solid_.constant;
    double const c_slope = 2.0 * glm::dot(weights * p, across_) + solid_.linear * across_.z;
    double const c_curve = glm::dot(weights * across_, across_);
    double const half = (b * b - a * c) / (a * a);
    double const half_slope = (2.0 * b * b_slope - a * c_slope) / (a * a);
    double const half_curve = (b_slope * b_slope - a * c_curve) / (a * a);
    if (a > 0.0 && half_curve < 0.0) {
      // No path beyond the zeros.
      double const discriminant = half_slope * half_slope - 4.0 * half_curve * half;
      if (discriminant <= 0.0) return;
      double const reach = -0.5 * std::sqrt(discriminant) / half_curve;
      double const middle = centre_.x - 0.5 * half_slope / half_curve;
      first = std::max(first, pixel(middle - reach));
      end = std::min(end, pixel(middle + reach));
    }
    if (first >= end) return;
    // Whole vectors: paths beyond the ends have no length, and rows are longer.
    constexpr int lanes = 8;
    first -= first % lanes;
    end += (lanes - end % lanes) % lanes;
    RowOfRays const rays{
        .first = static_cast<float>(first + 0.5 - centre_.x),
        .middle_start = static_cast<float>(-b / a),
        .middle_slope = static_cast<float>(-b_slope / a),
        .half_start = static_cast<float>(half),
        .half_slope = static_cast<float>(half_slope),
        .half_curve = static_cast<float>(half_curve),
        .box_start = static_cast<float>(-p.z / along_.z),
        .box_slope = static_cast<float>(-across_.z / along_.z),
        .box_half = static_cast<float>(1.0 / std::abs(along_.z)),
        .cut_start = static_cast<float>(-(height_ + y * rise_up_) / rise_),
        .cut_slope = static_cast<float>(-rise_across_ / rise_),
        .doublings = static_cast<float>(crown_.extinction / std::numbers::ln2),
    };
    Sides const sides = a > 0.0          ? Sides::bound
                        : along_.z > 0.0 ? Sides::open_below
                                         : Sides::open_above;
    run<shade_row>(rays, sides, luminance.data() + first, end - first);
  }

  float transmittance(int column, int row) const {
    double const x = column + 0.5 - centre_.x;
    double const y = row + 0.5 - centre_.y;
    RayPart path = solid_.inside(x * across_ + y * up_, along_);
    path.begin = std::max(path.begin, kept_from(column, row));
    return static_cast<float>(std::exp(-crown_.extinction * path.length()));
  }

  // Where the ray of a pixel leaves what the view cuts off, in metres from the middle of the box.
  double kept_from(int column, int row) const {
    double const x = column + 0.5 - centre_.x;
    double const y = row + 0.5 - centre_.y;
    double const height = height_ + x * rise_across_ + y * rise_up_;
    if (rise_ > 0.0) return -height / rise_;
    return height <= 0.0 ? HUGE_VAL : -HUGE_VAL;
  }

  // A path is the sum of the distances at which its ray leaves the mesh, less those at which it
  // enters.
  void shade_by_mesh(LuminanceTile& shaded, int first_row, int end_row) const {
    int const left = std::max(0, pixel(low_.x));
    int const right = std::min(shaded.columns(), pixel(high_.x));
    if (left >= right || first_row >= end_row) return;
    auto const columns = static_cast<std::size_t>(right - left);
    std::vector<double> lengths(columns * static_cast<std::size_t>(end_row - first_row));
    auto const lengths_of = [&](int row) {
      return std::span(lengths).subspan(static_cast<std::size_t>(row - first_row) * columns,
                                        columns);
    };
    double const reach = crown_.crown->reach();
    for (CrownMesh::Triangle const& face : crown_.crown->faces()) {
      CrownMesh::Triangle corners;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        glm::dvec3 const p = face[i] - pixels_.origin;
        corners[i] = {at(pixels_.x, p), at(pixels_.y, p),
                      glm::dot(face[i] - crown_.crown->centre, crown_.towards_sun)};
      }
      auto const [lowest, highest] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
      int const end = std::min(end_row, pixel(highest));
      for (int row = std::max(first_row, pixel(lowest)); row < end; ++row) {
        auto const crossing = FaceCrossing::of(corners, row + 0.5);
        if (!crossing) continue;
        double const sign = crossing->anticlockwise == anticlockwise_ ? 1.0 : -1.0;
        std::span<double> const to = lengths_of(row);
        int const last = std::min(right, pixel(crossing->high));
        for (int column = std::max(left, pixel(crossing->low)); column < last; ++column) {
          double const distance = std::max(crossing->distance_at(column + 0.5),
                                           std::min(kept_from(column, row), reach));
          to[static_cast<std::size_t>(column - left)] += sign * distance;
        }
      }
    }
    for (int row = first_row; row < end_row; ++row) {
      std::span<float> const luminance =
          shaded.row(row).subspan(static_cast<std::size_t>(left), columns);
      std::span<double const> const by = lengths_of(row);
      for (std::size_t i = 0; i < columns; ++i) {
        luminance[i] *= static_cast<float>(std::exp(-crown_.extinction * std::max(0.0, by[i])));
      }
    }
  }

  CrownInBeam const& crown_;
  View const& pixels_;
  CrownSolid const& solid_;
  bool anticlockwise_ = true;  // faces towards the sun in the pixels
  glm::dvec2 centre_{0.0};     // pixels
  glm::dvec2 low_{HUGE_VAL};
  glm::dvec2 high_{-HUGE_VAL};
  // In the cube: steps by a column, by a row, and by a metre towards the sun.
  glm::dvec3 across_{0.0};
  glm::dvec3 up_{0.0};
  glm::dvec3 along_{0.0};
  // Above the cut, of the centre, and the changes by the same steps.
  double height_ = 0.0;
  double rise_across_ = 0.0;
  double rise_up_ = 0.0;
  double rise_ = 0.0;
  double steepness_ = 0.0;  // more than 0 if a ray meets the quadric twice
};

}  // namespace

void shade_by_crowns(LuminanceTile& shaded, PixelMask const& lit, View const& pixels,
                     std::span<CrownInBeam const> crowns) {
  for (CrownInBeam const& crown : crowns) {
    if (crown.extinction == 0.0) continue;
    CrownRays(crown, pixels).shade(shaded, lit.first_row(), lit.end_row());
  }
}

}  // namespace gpu_shading

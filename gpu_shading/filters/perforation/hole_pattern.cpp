#include "gpu_shading/hole_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string_view>

#include "filters/perforation/check_length.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;
using std::numbers::sqrt3;

void check_sizes(Perforation const& given) {
  check_length("hole size", given.size);
  check_length("pitch", given.pitch);
  if (given.row_pitch != 0.0) check_length("row pitch", given.row_pitch);
  bool const slotted = given.hole == Hole::Slotted;
  if (slotted && !(given.length > given.size)) {
    throw Error(fmt::format("hole length is {:.9g} m, expected more than the hole size, {:.9g} m",
                            given.length, given.size));
  }
  if (!slotted && given.length != 0.0) {
    throw Error(fmt::format("hole length is {:.9g} m, but only slots have one", given.length));
  }
  double const extent = slotted ? given.length : given.size;
  if (!(extent < given.pitch)) {
    throw Error(fmt::format("hole {} is {:.9g} m, expected less than the pitch, {:.9g} m",
                            slotted ? "length" : "size", extent, given.pitch));
  }
}

// Outward normals of a hexagon's sides, one of each pair.
std::array<double, 3> across(double u, double v) {
  return {u, 0.5 * u + sqrt3 / 2.0 * v, -0.5 * u + sqrt3 / 2.0 * v};
}

// Distance to the nearest multiple of a period; several times faster than std::remainder.
double from_nearest(double place, double period) {
  return std::abs(place - period * std::floor(place / period + 0.5));
}

double hexagon_area(double across_flats) { return sqrt3 / 2.0 * across_flats * across_flats; }

// The overlap of a hexagon with its shifted copy: three strips again, of half widths h about the
// middle of the shift. Two of them form a rhomboid; the widest cuts two of its corners, or none.
double hexagon_overlap(double across_flats, double shift_u, double shift_v) {
  std::array<double, 3> h = across(shift_u, shift_v);
  for (double& width : h) width = (across_flats - std::abs(width)) / 2.0;
  std::sort(h.begin(), h.end());
  if (h[0] <= 0.0) return 0.0;
  double const cut = std::max(0.0, h[0] + h[1] - h[2]);
  return 8.0 / sqrt3 * h[0] * h[1] - 2.0 / sqrt3 * cut * cut;
}

// A slot of radius r with the centres of its ends `straight` apart along u; a circle if that is 0.
// At height v it extends to h(v) = straight / 2 + q(v) on either side, q(v) = sqrt(r^2 - v^2), and
// its overlap with a copy shifted by (su, sv) has the width min(2 h(v), 2 h(v - sv), h(v) + h(v -
// sv) - su). This is even about sv / 2; above it, the middle term is the larger of the first two.
class SlotOverlap {
 public:
  SlotOverlap(double radius, double straight, double shift_u, double shift_v)
      : r_(radius), straight_(straight), su_(std::abs(shift_u)), sv_(std::abs(shift_v)) {}

  double area() const {
    if (sv_ >= 2.0 * r_ || height(sv_ / 2.0) <= 0.0) return 0.0;
    double const from = sv_ / 2.0;
    // From where the shifted slot's end extends beyond ours, if it does.
    if (su_ <= at_top()) {
      double const turn = crossing(su_);
      return 2.0 * (both(from, turn) + straight_ * (r_ - turn) + 2.0 * under(turn, r_));
    }
    // Up to where the two ends meet, if they do.
    bool const closes = straight_ - su_ + at_top() < 0.0;
    return 2.0 * both(from, closes ? crossing(su_ - straight_) : r_);
  }

 private:
  double q(double v) const { return std::sqrt(std::max(0.0, r_ * r_ - v * v)); }
  // q(r - sv), accurate even if sv is negligible compared with r.
  double at_top() const { return std::sqrt(std::max(0.0, sv_ * (2.0 * r_ - sv_))); }
  double height(double v) const { return straight_ - su_ + q(v) + q(v - sv_); }

  // The upper intersection of two circles of radius r, with centres `offset` apart sideways and sv
  // apart in height.
  double crossing(double offset) const {
    double const apart = std::hypot(offset, sv_);
    if (apart == 0.0) return 0.0;
    return std::min(r_, sv_ / 2.0 + q(apart / 2.0) * offset / apart);
  }

  // Integrals from a to b: of q, and of the height.
  double under(double a, double b) const { return antiderivative(b) - antiderivative(a); }
  double both(double a, double b) const {
    return (straight_ - su_) * (b - a) + under(a, b) + under(a - sv_, b - sv_);
  }
  double antiderivative(double v) const {
    return (v * q(v) + r_ * r_ * std::asin(std::clamp(v / r_, -1.0, 1.0))) / 2.0;
  }

  double r_;
  double straight_;
  double su_;
  double sv_;
};

double straight_part(Perforation const& perforation) {
  return perforation.hole == Hole::Slotted ? perforation.length - perforation.size : 0.0;
}

}  // namespace

HolePattern::HolePattern(Perforation const& perforation) : perforation_(perforation) {
  check_sizes(perforation);
  double const pitch = perforation.pitch;
  double row_pitch = perforation.row_pitch;
  bool const staggered = perforation.arrangement != Arrangement::Straight;
  width_ = pitch;
  if (row_pitch == 0.0) {
    switch (perforation.arrangement) {
      case Arrangement::Straight:
        row_pitch = pitch;
        break;
      case Arrangement::Staggered45:
        width_ = sqrt2 * pitch;
        row_pitch = pitch / sqrt2;
        break;
      case Arrangement::Staggered60:
        row_pitch = sqrt3 / 2.0 * pitch;
        break;
    }
  }
  holes_ = staggered ? 2 : 1;
  height_ = holes_ * row_pitch;

  web_ = std::numeric_limits<double>::infinity();
  for (int row = 0; row <= 2; ++row) {
    double const offset = staggered && row == 1 ? 0.5 : 0.0;
    for (int place = -1; place <= 1; ++place) {
      if (row == 0 && place == 0) continue;
      web_ = std::min(web_, distance_to_neighbour((place + offset) * width_, row * row_pitch));
    }
  }
  if (!(web_ > 1e-9 * pitch)) {
    throw Error(fmt::format("{} is {:.9g} m, so holes overlap or touch; expected more",
                            perforation.row_pitch > 0.0 ? "row pitch" : "pitch",
                            perforation.row_pitch > 0.0 ? row_pitch : pitch));
  }
}

// The distance between two equal convex outlines that are symmetric about their centres equals the
// distance of one centre from the other outline at twice the size; 0 if they overlap.
double HolePattern::distance_to_neighbour(double u, double v) const {
  double const size = perforation_.size;
  u = std::abs(u);
  v = std::abs(v);
  switch (perforation_.hole) {
    case Hole::Round:
    case Hole::Slotted:
      return std::max(0.0, std::hypot(std::max(0.0, u - straight_part(perforation_)), v) - size);
    case Hole::Square:
      return std::hypot(std::max(0.0, u - size), std::max(0.0, v - size));
    case Hole::Hexagonal:
      break;
  }
  // Distance to a side, or to the corner at either end of it.
  double distance = 0.0;
  double const half_side = size / sqrt3;
  std::array<double, 3> const normal = across(u, v);
  std::array<double, 3> const along = across(v, -u);
  for (std::size_t side = 0; side < normal.size(); ++side) {
    double const beyond = std::abs(normal[side]) - size;
    double const aside = std::max(0.0, std::abs(along[side]) - half_side);
    if (beyond > 0.0 && aside == 0.0) return beyond;
    if (beyond > 0.0) {
      double const corner = std::hypot(beyond, aside);
      distance = distance == 0.0 ? corner : std::min(distance, corner);
    }
  }
  return distance;
}

bool HolePattern::is_open(double u, double v) const {
  for (int hole = 0; hole < holes_; ++hole) {
    double const x = from_nearest(u - hole * width_ / 2.0, width_);
    double const y = from_nearest(v - hole * height_ / 2.0, height_);
    double const half = perforation_.size / 2.0;
    switch (perforation_.hole) {
      case Hole::Round:
      case Hole::Slotted: {
        double const beyond = std::max(0.0, x - straight_part(perforation_) / 2.0);
        if (beyond * beyond + y * y <= half * half) return true;
        break;
      }
      case Hole::Square:
        if (x <= half && y <= half) return true;
        break;
      case Hole::Hexagonal:
        if (x <= half && 0.5 * x + sqrt3 / 2.0 * y <= half) return true;
        break;
    }
  }
  return false;
}

double HolePattern::open_fraction() const {
  double const size = perforation_.size;
  double area = 0.0;
  switch (perforation_.hole) {
    case Hole::Round:
    case Hole::Slotted:
      area = pi / 4.0 * size * size + straight_part(perforation_) * size;
      break;
    case Hole::Square:
      area = size * size;
      break;
    case Hole::Hexagonal:
      area = hexagon_area(size);
      break;
  }
  return holes_ * area / (width_ * height_);
}

double HolePattern::longest_chord() const {
  switch (perforation_.hole) {
    case Hole::Round:
    case Hole::Slotted:
      return perforation_.size + straight_part(perforation_);
    case Hole::Square:
      return sqrt2 * perforation_.size;
    case Hole::Hexagonal:
      break;
  }
  return 2.0 / sqrt3 * perforation_.size;
}

double HolePattern::transmittance(double shift_u, double shift_v) const {
  // Rounding can make the difference of two integrals negative.
  return std::max(0.0, holes_ * overlap(shift_u, shift_v) / (width_ * height_));
}

double HolePattern::overlap(double shift_u, double shift_v) const {
  double const size = perforation_.size;
  switch (perforation_.hole) {
    case Hole::Round:
    case Hole::Slotted:
      return SlotOverlap(size / 2.0, straight_part(perforation_), shift_u, shift_v).area();
    case Hole::Square:
      return std::max(0.0, size - std::abs(shift_u)) * std::max(0.0, size - std::abs(shift_v));
    case Hole::Hexagonal:
      break;
  }
  return hexagon_overlap(size, shift_u, shift_v);
}

}  // namespace gpu_shading

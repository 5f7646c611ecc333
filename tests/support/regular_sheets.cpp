#include "support/regular_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "geometry/triangulation.h"
#include "gpu_shading/error.h"
#include "support/plane_ring.h"
#include "support/processor_time.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;
using Ring = std::vector<glm::dvec2>;

// What of a convex ring is on the left of a line.
void clip(Ring& ring, Ring& spare, glm::dvec2 const& from, glm::dvec2 const& along) {
  spare.clear();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec2 const& p = ring[i];
    glm::dvec2 const& q = ring[i + 1 < ring.size() ? i + 1 : 0];
    double const at_p = crossed(along, p - from);
    double const at_q = crossed(along, q - from);
    if (at_p >= 0.0) spare.push_back(p);
    if ((at_p >= 0.0) != (at_q >= 0.0)) spare.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  std::swap(ring, spare);
}

void clip(Ring& ring, Ring& spare, Ring const& by, glm::dvec2 const& shift) {
  for (std::size_t i = 0; i < by.size() && !ring.empty(); ++i) {
    glm::dvec2 const& from = by[i];
    clip(ring, spare, from + shift, by[i + 1 < by.size() ? i + 1 : 0] - from);
  }
}

// A circle's arc, or a polygon of its area.
void add_arc(Ring& ring, glm::dvec2 const& middle, double radius, double from, double to,
             int steps) {
  double const step = (to - from) / steps;
  double const outer = radius * std::sqrt(step / std::sin(step));
  for (int i = 0; i < steps; ++i) {
    double const angle = from + (i + 0.5) * step;
    ring.push_back(middle + outer * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
}

// Counterclockwise, `sides` for a circle.
Ring outline_of(Perforation const& holes, int sides) {
  double const half = holes.size / 2.0;
  Ring ring;
  switch (holes.hole) {
    case Hole::Round:
      add_arc(ring, {0.0, 0.0}, half, 0.0, 2.0 * pi, sides);
      break;
    case Hole::Square:
      ring = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
      break;
    case Hole::Slotted: {
      double const straight = (holes.length - holes.size) / 2.0;
      add_arc(ring, {straight, 0.0}, half, -pi / 2.0, pi / 2.0, sides / 2);
      add_arc(ring, {-straight, 0.0}, half, pi / 2.0, 1.5 * pi, sides / 2);
      break;
    }
    case Hole::Hexagonal:
      for (int i = 0; i < 6; ++i) {
        double const angle = pi / 6.0 + i * pi / 3.0;
        ring.push_back(half / std::cos(pi / 6.0) * glm::dvec2(std::cos(angle), std::sin(angle)));
      }
      break;
  }
  return ring;
}

glm::dvec2 tile_of(Perforation const& holes) {
  double const rows = holes.row_pitch > 0.0 ? holes.row_pitch : holes.pitch;
  switch (holes.arrangement) {
    case Arrangement::Straight:
      return {holes.pitch, rows};
    case Arrangement::Staggered45:
      if (holes.row_pitch > 0.0) break;
      return std::numbers::sqrt2 * glm::dvec2(holes.pitch);
    case Arrangement::Staggered60:
      if (holes.row_pitch > 0.0) break;
      return {holes.pitch, std::numbers::sqrt3 * holes.pitch};
  }
  return {holes.pitch, 2.0 * holes.row_pitch};
}

struct Bounds {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  explicit Bounds(Ring const& ring) {
    for (glm::dvec2 const& p : ring) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
};

// Coordinates in which a lattice's points are whole numbers.
Ring in_lattice(Ring const& ring, glm::dmat2 const& to_lattice, glm::dvec2 const& origin) {
  Ring places;
  places.reserve(ring.size());
  for (glm::dvec2 const& p : ring) places.push_back(to_lattice * (p - origin));
  return places;
}

}  // namespace

RegularSheets::RegularSheets(Polygon receiver, std::vector<Sheet> sheets)
    : receiver_(std::move(receiver)), sheets_(std::move(sheets)) {
  Mesh const mesh = triangulate(receiver_);
  for (glm::uvec4 const& corners : convex_pieces(mesh)) {
    Ring& piece = pieces_.emplace_back();
    for (int i = 0; i < (corners[2] == corners[3] ? 3 : 4); ++i) {
      glm::dvec3 const& vertex = mesh.vertices[corners[i]];
      piece.emplace_back(vertex.x, vertex.z);
    }
    if (signed_area(piece) < 0.0) std::reverse(piece.begin(), piece.end());
  }
  Ring outline;
  for (glm::dvec3 const& vertex : receiver_.outline) outline.emplace_back(vertex.x, vertex.z);
  Bounds const bounds(outline);
  low_ = bounds.low;
  high_ = bounds.high;
}

RegularSheets::RegularSheets(double width, double height, std::vector<Sheet> sheets)
    : RegularSheets(south_facing(0, 0, 0, width, height), std::move(sheets)) {}

Polygon RegularSheets::polygon(Sheet const& sheet) const {
  glm::dvec2 const size = high_ - low_;
  glm::dvec2 const centre = 0.5 * (low_ + high_);
  double const half = 50.0 * (size.x + size.y + sheet.distance);
  glm::dvec3 const out(-std::sin(sheet.turn) * std::cos(sheet.tilt),
                       -std::cos(sheet.turn) * std::cos(sheet.tilt), std::sin(sheet.tilt));
  glm::dvec3 const right = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), out));
  glm::dvec3 const up = glm::cross(out, right);
  glm::dvec3 const middle(centre.x, -sheet.distance, centre.y);
  return parallelogram(middle - half * right - half * up, 2.0 * half * right, 2.0 * half * up);
}

Scene RegularSheets::scene(ScreenDetail detail) const {
  Scene scene;
  scene.add({"receiver", receiver_});
  for (Sheet const& sheet : sheets_) {
    Surface surface{"sheet", polygon(sheet)};
    surface.filter.set(
        PerforatedSheet{std::make_shared<PerforatedScreen const>(
                            HolePattern(sheet.holes),
                            gpu_shading::Sheet{.thickness = sheet.thickness, .detail = detail}),
                        {.rotation = sheet.rotation}});
    scene.add(surface);
  }
  return scene;
}

double RegularSheets::projected_area(SunDirection sun) const {
  return -to_vector(sun).y * area(receiver_);
}

std::optional<RegularSheets::Passing> RegularSheets::project(Sheet const& sheet,
                                                             SunDirection sun) const {
  gpu_shading::Ring const ring = polygon(sheet).outline;
  glm::dvec3 const towards_sun = to_vector(sun);
  glm::dvec3 const right = glm::normalize(ring[2] - ring[1]);
  glm::dvec3 const out = glm::normalize(glm::cross(ring[1] - ring[0], ring[2] - ring[1]));
  glm::dvec3 const up = glm::cross(out, right);
  double const cosine = glm::dot(out, towards_sun);
  constexpr double least = 0.05;
  if (cosine < least || -towards_sun.y < least) return std::nullopt;
  // The receiver must see the sheet between itself and the sun.
  for (double const x : {low_.x, high_.x}) {
    for (double const z : {low_.y, high_.y}) {
      if (glm::dot(ring[1] - glm::dvec3(x, 0, z), out) < 2.0 * sheet.thickness) return std::nullopt;
    }
  }
  glm::dvec3 const u = std::cos(sheet.rotation) * right + std::sin(sheet.rotation) * up;
  glm::dvec3 const v = glm::cross(out, u);
  auto const on_receiver = [&](glm::dvec3 const& p) {
    glm::dvec3 const at = p - towards_sun * (p.y / towards_sun.y);
    return glm::dvec2(at.x, at.z);
  };
  auto const in_sheet = [&](glm::dvec2 const& p) { return on_receiver(p.x * u + p.y * v); };

  glm::dvec2 const tile = tile_of(sheet.holes);
  bool const fine = tile.x * 300.0 < high_.x - low_.x;
  glm::dvec2 const shift(sheet.thickness / cosine *
                         glm::dvec2(glm::dot(u, towards_sun), glm::dot(v, towards_sun)));
  int const sides = sheets_.size() > 1 ? 96 : (fine ? 96 : 512);
  auto const overlap = [&](int many) {
    Ring const outline = outline_of(sheet.holes, many);
    Ring passing = outline;
    Ring spare;
    clip(passing, spare, outline, -shift);
    for (glm::dvec2& p : passing) p = in_sheet(p);
    if (signed_area(passing) < 0.0) std::reverse(passing.begin(), passing.end());
    return passing;
  };
  Passing found;
  found.outline = overlap(sides);
  // The error of polygons for arcs falls with the square of their number of sides.
  found.area = (4.0 * signed_area(overlap(2 * sides)) - signed_area(found.outline)) / 3.0;
  // The inside face, half of the thickness nearer to the receiver.
  glm::dvec2 const origin = on_receiver(ring[1] - 0.5 * sheet.thickness * out);
  found.origins = {origin};
  if (sheet.holes.arrangement != Arrangement::Straight) {
    found.origins.push_back(origin + in_sheet(0.5 * tile));
  }
  found.a = in_sheet({tile.x, 0.0});
  found.b = in_sheet({0.0, tile.y});
  return found;
}

std::optional<double> RegularSheets::sunlit_fraction(SunDirection sun) const {
  std::vector<Passing> passing;
  for (Sheet const& sheet : sheets_) {
    std::optional<Passing> const one = project(sheet, sun);
    if (!one) return std::nullopt;
    if (one->outline.size() < 3) return 0.0;
    passing.push_back(*one);
  }
  double lit = 0.0;
  for (Ring const& piece : pieces_) {
    lit += passing.size() == 1 ? through_one(piece, passing[0])
                               : through_both(piece, passing[0], passing[1]);
  }
  return lit / area(receiver_);
}

double RegularSheets::through_one(Ring const& piece, Passing const& passing) {
  struct Side {
    glm::dvec2 outwards;
    double limit;
    double most;   // reach of the outline beyond its hole's centre, outwards
    double least;  // and inwards, negative
  };
  std::vector<Side> sides(piece.size());
  for (std::size_t i = 0; i < piece.size(); ++i) {
    Side& side = sides[i];
    glm::dvec2 const edge = glm::normalize(piece[(i + 1) % piece.size()] - piece[i]);
    side.outwards = {edge.y, -edge.x};
    side.limit = glm::dot(side.outwards, piece[i]);
    side.most = -std::numeric_limits<double>::infinity();
    side.least = -side.most;
    for (glm::dvec2 const& p : passing.outline) {
      side.most = std::max(side.most, glm::dot(side.outwards, p));
      side.least = std::min(side.least, glm::dot(side.outwards, p));
    }
  }
  glm::dmat2 const to_lattice = glm::inverse(glm::dmat2(passing.a, passing.b));
  double sum = 0.0;
  Ring clipped;
  Ring spare;
  for (glm::dvec2 const& origin : passing.origins) {
    Bounds const holes(in_lattice(piece, to_lattice, origin));
    Bounds const reach(in_lattice(passing.outline, to_lattice, {0.0, 0.0}));
    double const last = std::ceil(holes.high.y - reach.low.y);
    for (double j = std::floor(holes.low.y - reach.high.y); j <= last; ++j) {
      // Holes of this row that are wholly inside, and those that meet the receiver.
      double low_in = -1e18, high_in = 1e18, low = -1e18, high = 1e18;
      for (Side const& side : sides) {
        double const rate = glm::dot(side.outwards, passing.a);
        double const start = side.limit - glm::dot(side.outwards, origin + j * passing.b);
        auto const limit = [&](double spare_room, double& from, double& to) {
          if (std::abs(rate) < 1e-12 * glm::length(passing.a)) {
            if (spare_room < 0.0) to = from - 1.0;
          } else if (rate > 0.0) {
            to = std::min(to, spare_room / rate);
          } else {
            from = std::max(from, spare_room / rate);
          }
        };
        limit(start - side.most, low_in, high_in);
        limit(start - side.least, low, high);
      }
      auto const clip_from = [&](double from, double to) {
        for (double i = from; i <= to; ++i) {
          clipped.clear();
          glm::dvec2 const centre = origin + i * passing.a + j * passing.b;
          for (glm::dvec2 const& p : passing.outline) clipped.push_back(p + centre);
          clip(clipped, spare, piece, {0.0, 0.0});
          if (clipped.size() > 2) sum += signed_area(clipped);
        }
      };
      double const first = std::ceil(low);
      double const end = std::floor(high);
      double const first_in = std::ceil(low_in);
      double const end_in = std::floor(high_in);
      if (first_in > end_in) {
        clip_from(first, end);
        continue;
      }
      clip_from(first, first_in - 1.0);
      sum += passing.area * (end_in - first_in + 1.0);
      clip_from(end_in + 1.0, end);
    }
  }
  return sum;
}

double RegularSheets::through_both(Ring const& piece, Passing const& near, Passing const& far) {
  // Calls use(centre) for the holes whose outline may meet a ring.
  auto const each_hole = [](Passing const& passing, Ring const& ring, auto use) {
    glm::dmat2 const to_lattice = glm::inverse(glm::dmat2(passing.a, passing.b));
    Bounds const reach(in_lattice(passing.outline, to_lattice, {0.0, 0.0}));
    for (glm::dvec2 const& origin : passing.origins) {
      Bounds const around(in_lattice(ring, to_lattice, origin));
      for (double j = std::ceil(around.low.y - reach.high.y); j <= around.high.y - reach.low.y;
           ++j) {
        for (double i = std::ceil(around.low.x - reach.high.x); i <= around.high.x - reach.low.x;
             ++i) {
          use(origin + i * passing.a + j * passing.b);
        }
      }
    }
  };
  double sum = 0.0;
  Ring first;
  Ring both;
  Ring spare;
  each_hole(near, piece, [&](glm::dvec2 const& centre) {
    first.clear();
    for (glm::dvec2 const& p : near.outline) first.push_back(p + centre);
    clip(first, spare, piece, {0.0, 0.0});
    if (first.size() < 3) return;
    each_hole(far, first, [&](glm::dvec2 const& other) {
      both = first;
      clip(both, spare, far.outline, other);
      if (both.size() > 2) sum += signed_area(both);
    });
  });
  return sum;
}

RegularSheets::Sheet random_sheet(std::mt19937& generator, double least, double most) {
  auto const between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / std::mt19937::max();
  };
  auto const one_of = [&](int count) {
    return static_cast<int>(generator() % static_cast<unsigned>(count));
  };
  for (;;) {
    RegularSheets::Sheet sheet;
    sheet.holes.hole = static_cast<Hole>(one_of(4));
    sheet.holes.arrangement = static_cast<Arrangement>(one_of(3));
    sheet.holes.size = std::exp(between(std::log(least), std::log(most)));
    double extent = sheet.holes.size;
    if (sheet.holes.hole == Hole::Slotted) {
      extent = sheet.holes.length = sheet.holes.size * between(1.5, 4.0);
    }
    sheet.holes.pitch = extent * between(1.1, 2.5);
    int const kind = one_of(4);
    sheet.thickness = one_of(5) == 0 ? 0.0 : sheet.holes.size * between(0.0, 4.0);
    sheet.distance = between(0.2, 1.5) + 4.0 * sheet.thickness;
    if (kind > 0) sheet.rotation = between(-pi, pi);
    if (kind > 1) {
      sheet.turn = between(-0.3, 0.3);
      sheet.tilt = between(-0.3, 0.3);
      sheet.distance += 2.0;
    }
    try {
      HolePattern const valid(sheet.holes);
      return sheet;
    } catch (Error const&) {  // holes overlap
    }
  }
}

std::vector<RegularSheets::Sheet> random_pair(std::mt19937& generator, int number) {
  RegularSheets::Sheet near = random_sheet(generator, 0.7e-3, 0.03);
  RegularSheets::Sheet far = random_sheet(generator, 0.7e-3, 0.03);
  far.turn = near.turn;
  far.tilt = near.tilt;
  if (number % 2 == 0) far.holes = near.holes;
  if (number % 4 == 0) far.rotation = near.rotation;
  near.thickness = std::min(near.thickness, 0.3 * near.holes.size);
  far.thickness = std::min(far.thickness, 0.3 * far.holes.size);
  double const share = static_cast<double>(generator()) / std::mt19937::max();
  double const apart = 0.01 * std::pow(50.0, share);
  far.distance = near.distance + apart + near.thickness + far.thickness;
  return {near, far};
}

std::vector<double> errors_behind(RegularSheets const& sheets, Renderer& renderer,
                                  std::span<SunDirection const> suns, double& seconds) {
  std::vector<SunDirection> asked;
  std::vector<double> exact;
  for (SunDirection const sun : suns) {
    std::optional<double> const fraction = sheets.sunlit_fraction(sun);
    if (!fraction) continue;
    asked.push_back(sun);
    exact.push_back(*fraction);
  }
  if (2 * asked.size() < suns.size()) return {};
  constexpr std::array<SurfaceId, 1> receiver{0};
  // Computes what is kept.
  renderer.projected_sunlit_areas(sun_at(180, 1), receiver);
  double const start = processor_seconds();
  auto const got = renderer.projected_sunlit_areas(asked, receiver);
  seconds = processor_seconds() - start;
  std::vector<double> errors;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    double const whole = sheets.projected_area(asked[i]);
    errors.push_back(std::abs(got[i].front().projected_area / whole - exact[i]));
  }
  return errors;
}

}  // namespace gpu_shading

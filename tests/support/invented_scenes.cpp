#include "support/invented_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "backends/exact/exact_view.h"
#include "filters/transmission.h"
#include "geometry/plane_frame.h"
#include "geometry/triangulation.h"
#include "gpu_shading/rays.h"
#include "gpu_shading/transmittance.h"
#include "scene/relative_polygon.h"
#include "support/crown_meshes.h"
#include "support/regular_sheets.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;
using Outline = std::vector<glm::dvec2>;

// Numbers at random.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : generator_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  std::size_t below(std::size_t count) { return generator_() % count; }
  int count(double low, double high) { return static_cast<int>(log_between(low, high)); }
  std::mt19937& generator() { return generator_; }

 private:
  std::mt19937 generator_;
};

// In a square from 0 to 1.
struct Shape {
  Outline outline;
  Outline hole = {};
};

Outline star(double inner) {
  Outline outline;
  constexpr int points = 9;
  for (int i = 0; i < 2 * points; ++i) {
    double const radius = 0.5 * (i % 2 == 0 ? 1.0 : inner);
    double const angle = pi * i / points + 0.1;
    outline.emplace_back(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle));
  }
  return outline;
}

// Teeth on a bar.
Outline comb(double thin) {
  constexpr int teeth = 7;
  Outline outline{{0, 0}, {1, 0}, {1, thin}};
  for (int i = teeth - 1; i >= 0; --i) {
    double const left = static_cast<double>(i) / teeth;
    outline.insert(outline.end(), {{left + thin, thin}, {left + thin, 1}, {left, 1}, {left, thin}});
  }
  outline.pop_back();
  return outline;
}

Outline const whole{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

// A wall around a window.
Shape frame(double thin) {
  return {whole, {{thin, thin}, {1 - thin, thin}, {1 - thin, 1 - thin}, {thin, 1 - thin}}};
}

Shape angle_of(double thin) {
  return {{{0, 0}, {1, 0}, {1, thin}, {thin, thin}, {thin, 1}, {0, 1}}};
}

Shape invent_shape(Numbers& numbers) {
  double const thin = numbers.log_between(0.01, 0.1);
  switch (numbers.below(12)) {
    case 0:
      return angle_of(thin);
    case 1:
      return frame(thin);
    case 2:
      return {star(numbers.between(0.05, 0.3))};
    case 3:
      return {comb(thin)};
    case 4:
      return {{{0, 0}, {1, 0}, {1, thin}, {0, thin}}};
    case 5:
      return {{{0, 0}, {1, 1 - thin}, {1, 1}}};
    default:
      return {whole};
  }
}

// By a sweep of all edges. Casters must be flat, and may not be perforated. None if the sweep would
// take more than some seconds.
ReferenceFractions swept(Scene const& scene, std::span<SurfaceId const> interiors,
                         SunDirection sun) {
  constexpr double max_steps = 1e9;
  PlaneFrame const frame = *plane_frame(scene[0].polygon);
  Transmission const transmission(scene);
  RelativePolygon const receiver(0, scene[0].polygon, frame, RelativePolygon::Side::within);
  std::vector<RelativePolygon> casters(scene.size() - 1);
  std::vector<RelativePolygon const*> pointers;
  for (SurfaceId id = 1; id < scene.size(); ++id) {
    casters[id - 1].set(id, scene[id].polygon, frame, RelativePolygon::Side::in_front);
    if (scene[id].casting != Casting::never) pointers.push_back(&casters[id - 1]);
  }
  std::vector<RelativePolygon> behind;
  for (SurfaceId const id : interiors) {
    behind.emplace_back(id, scene[id].polygon, frame, RelativePolygon::Side::behind);
  }
  auto const found = exact_sums(
      scene, transmission, {receiver, frame, to_vector(sun), pointers, !interiors.empty(), behind},
      max_steps);
  if (!found) return {};
  std::vector<Sunlit> answers;
  for (LuminanceSums const& sums : found->sums) {
    Sunlit& answer = answers.emplace_back();
    answer.projected_area = sums.unscheduled;
    for (auto const& [powers, sum] : sums.scheduled) answer.scheduled.push_back({powers, sum});
  }
  return {fractions_of(answers, 1.0)};
}

// By rays through what lets pass a part of the beam.
ReferenceFractions traced(Scene const& scene, SunDirection sun) {
  constexpr std::size_t lattices = 4;
  constexpr double rays_a_lattice = 131072.0;
  Mesh const mesh = triangulate(scene[0].polygon);
  double const all = area(scene[0].polygon);
  RayScene const rays(scene);
  std::array<double, lattices> means{};
  for (std::size_t lattice = 0; lattice < lattices; ++lattice) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      auto const corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]]; };
      glm::dvec3 const a = corner(1) - corner(0);
      glm::dvec3 const b = corner(2) - corner(0);
      double const share = 0.5 * glm::length(glm::cross(a, b)) / all;
      auto const count = static_cast<std::size_t>(std::ceil(rays_a_lattice * share));
      std::vector<Ray> of_triangle(count);
      for (std::size_t k = 0; k < count; ++k) {
        // The R2 sequence (Roberts 2018), folded so that it has no edges (Hickernell 2002), in two
        // triangles that are one.
        glm::dvec2 const even =
            glm::fract(0.3 * glm::dvec2(lattice, lattice * lattice) +
                       static_cast<double>(k) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        glm::dvec2 at = 1.0 - glm::abs(2.0 * even - 1.0);
        if (at.x + at.y > 1.0) at = 1.0 - at;
        of_triangle[k] = {corner(0) + at.x * a + at.y * b, to_vector(sun)};
      }
      std::vector<double> passed(count);
      rays.transmittances(of_triangle, {.receiver = 0}, passed);
      means.at(lattice) += share * std::reduce(passed.begin(), passed.end()) / double(count);
    }
  }
  double const mean = std::reduce(means.begin(), means.end()) / double{lattices};
  double squares = 0.0;
  for (double const each : means) squares += (each - mean) * (each - mean);
  constexpr double student_t = 5.841;  // of both tails, 1 %
  return {std::vector<double>(schedule_factors.size(), mean),
          student_t * std::sqrt(squares / double{lattices * (lattices - 1)})};
}

// Casters are laid out in units of the receiver's width and height, at a distance in front of it in
// units of the smaller of the two.
class Maker : public Numbers {
 public:
  explicit Maker(std::uint32_t seed) : Numbers(seed) {
    double const size = log_between(0.3, 500.0);
    double const ratio = log_between(0.5, 2.0);
    width_ = size * std::min(1.0, ratio);
    height_ = size * std::min(1.0, 1.0 / ratio);
    double const turn = between(-pi, pi);
    constexpr std::array tilts{0.0, 0.0, 0.5, pi / 2};
    double const tilt = tilts.at(below(tilts.size()));
    u_ = {std::cos(turn), std::sin(turn), 0.0};
    glm::dvec3 const out(u_.y, -u_.x, 0.0);
    glm::dvec3 const up(0.0, 0.0, 1.0);
    v_ = std::cos(tilt) * up - std::sin(tilt) * out;
    normal_ = std::cos(tilt) * out + std::sin(tilt) * up;
    scene_.add({"receiver", placed(invent_shape(*this), 0.0)});
  }

  void add(Surface surface) { scene_.add(std::move(surface)); }
  void add(Ring outline) { add({"caster", {std::move(outline), {}}}); }
  void add(Outline const& outline, double distance) {
    add({"caster", placed({outline}, distance)});
  }
  void add_plate(Outline const& outline, Outline const& hole, double distance) {
    add({"caster", placed({outline, hole}, distance)});
  }
  glm::dvec3 place(glm::dvec2 const& at, double distance) const {
    return (at.x - 0.5) * width_ * u_ + (at.y - 0.5) * height_ * v_ +
           distance * least_side() * normal_;
  }
  double least_side() const { return std::min(width_, height_); }

  // Surfaces from this one on transmit so much at normal incidence.
  void make_transparent(double transmittance, SurfaceId from = 1) {
    auto const glass = std::make_shared<Transmittance const>(
        Transmittance::polynomial_in_cosine({0.0, 2.0 * transmittance, -transmittance}));
    filter(from, [&](BeamFilter& each) { each.set(AngularTransmittance{glass}); });
  }
  // Casters have schedules, one of so many.
  void schedule(int schedules) {
    filter(1, [&](BeamFilter& each) {
      each.schedule = static_cast<int>(below(static_cast<std::size_t>(schedules)));
    });
  }

  // The receiver is the window of a room.
  void add_room() {
    double const deep = -between(0.5, 3.0);
    auto const add_wall = [&](Polygon polygon) {
      Surface wall{"wall", std::move(polygon)};
      wall.casting = Casting::never;
      interiors_.push_back(scene_.add(std::move(wall)));
    };
    auto const add_side = [&](glm::dvec2 const& from, glm::dvec2 const& to) {
      add_wall({{place(from, 0.0), place(to, 0.0), place(to, deep), place(from, deep)}, {}});
    };
    double const low = -between(0.0, 0.5);
    double const high = 1.0 + between(0.0, 0.5);
    add_side({low, low}, {high, low});
    add_side({high, low}, {high, high});
    add_side({high, high}, {low, high});
    add_side({low, high}, {low, low});
    add_wall(placed({{{low, low}, {high, low}, {high, high}, {low, high}}}, deep));
  }

  InventedScene finish(int suns) {
    InventedScene invented;
    while (static_cast<int>(invented.suns.size()) < suns) {
      SunDirection const sun{between(-pi, pi), log_between(0.1, 80.0) * pi / 180.0};
      constexpr double grazing = 0.03;
      if (glm::dot(to_vector(sun), normal_) > grazing) invented.suns.push_back(sun);
    }
    invented.scene = std::move(scene_);
    invented.interiors = interiors_;
    invented.reference = [interiors = std::move(interiors_)](Scene const& scene, SunDirection sun) {
      return swept(scene, interiors, sun);
    };
    return invented;
  }

 private:
  Polygon placed(Shape const& shape, double distance) const {
    auto const ring = [&](Outline const& outline) {
      Ring made;
      for (glm::dvec2 const& at : outline) made.push_back(place(at, distance));
      return made;
    };
    Polygon polygon{ring(shape.outline), {}};
    if (!shape.hole.empty()) polygon.holes.push_back(ring(shape.hole));
    return polygon;
  }

  template <typename Change>
  void filter(SurfaceId from, Change change) {
    Scene changed;
    for (SurfaceId id = 0; id < scene_.size(); ++id) {
      Surface surface = scene_[id];
      if (id >= from && surface.casting != Casting::never) change(surface.filter);
      changed.add(surface);
    }
    scene_ = std::move(changed);
  }

  double width_ = 1.0;
  double height_ = 1.0;
  glm::dvec3 u_{0.0};
  glm::dvec3 v_{0.0};
  glm::dvec3 normal_{0.0};
  Scene scene_;
  std::vector<SurfaceId> interiors_;
};

// Blades across the receiver and half of its size beyond, at any angle in its plane and tilted out
// of it.
void add_blades(Maker& make, int blades, double angle) {
  double const pitch = 2.0 / blades;
  double const depth = pitch * make.between(0.2, 1.2);
  double const out = pitch * make.between(-0.7, 0.7);
  double const distance = make.log_between(0.01, 0.5) + std::abs(out);
  double const offset = make.between(0.0, pitch);
  glm::dvec2 const along(std::cos(angle), std::sin(angle));
  glm::dvec2 const across(-along.y, along.x);
  for (int i = 0; i < blades; ++i) {
    glm::dvec2 const middle = glm::dvec2(0.5) + (-1.0 + i * pitch + offset) * across;
    glm::dvec2 const end = middle + depth * across;
    make.add({make.place(middle - 1.5 * along, distance),
              make.place(middle + 1.5 * along, distance),
              make.place(end + 1.5 * along, distance + out),
              make.place(end - 1.5 * along, distance + out)});
  }
}

void louvres(Maker& make) { add_blades(make, make.count(20, 5000), 0.0); }
void fins(Maker& make) { add_blades(make, make.count(20, 5000), pi / 2); }
void sloped_blades(Maker& make) { add_blades(make, make.count(20, 3000), make.between(0.0, pi)); }
void two_layers(Maker& make) {
  int const blades = make.count(20, 2500);
  add_blades(make, blades, 0.0);
  add_blades(make, static_cast<int>(blades * make.between(0.6, 1.1)), 0.0);
}
void three_layers(Maker& make) {
  int const blades = make.count(20, 1500);
  for (int i = 0; i < 3; ++i)
    add_blades(make, static_cast<int>(blades * make.between(0.8, 1.2)), 0.0);
}
void nearly_parallel_layers(Maker& make) {
  int const blades = make.count(20, 400);
  double const angle = make.between(0.0, pi);
  add_blades(make, blades, angle);
  add_blades(make, blades, angle + make.between(0.002, 0.05));
}
void crossed_layers(Maker& make) {
  add_blades(make, make.count(20, 300), 0.0);
  add_blades(make, make.count(20, 300), pi / 2);
}
void louvres_and_fins_beyond(Maker& make) {
  add_blades(make, make.count(50, 1500), 0.0);
  add_blades(make, make.count(10, 40), pi / 2);
}

void chevrons(Maker& make) {
  int const across = make.count(3, 40);
  int const rows = make.count(5, 80);
  double const pitch = 2.0 / across;
  double const step = 2.0 / rows;
  double const thick = step * make.between(0.2, 0.8);
  double const rise = step * make.between(0.3, 3.0);
  double const distance = make.log_between(0.02, 0.5);
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < across; ++i) {
      glm::dvec2 const at(-0.5 + i * pitch, -0.5 + row * step);
      glm::dvec2 const middle = at + glm::dvec2(0.5 * pitch, rise);
      glm::dvec2 const end = at + glm::dvec2(pitch, 0.0);
      glm::dvec2 const up(0.0, thick);
      make.add({at, end, end + up, middle + up, at + up}, distance);
    }
  }
}

void crate(Maker& make) {
  int const across = make.count(5, 50);
  int const rows = make.count(5, 50);
  glm::dvec2 const cell(2.0 / across, 2.0 / rows);
  double const depth = std::min(cell.x, cell.y) * make.between(0.3, 1.5);
  double const distance = make.log_between(0.005, 0.3);
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < across; ++i) {
      glm::dvec2 const at(-0.5 + i * cell.x, -0.5 + row * cell.y);
      glm::dvec2 const right = at + glm::dvec2(cell.x, 0.0);
      glm::dvec2 const above = at + glm::dvec2(0.0, cell.y);
      for (glm::dvec2 const& end : {right, above}) {
        make.add({make.place(at, distance), make.place(end, distance),
                  make.place(end, distance + depth), make.place(at, distance + depth)});
      }
    }
  }
}

void honeycomb(Maker& make) {
  int const across = make.count(5, 40);
  double const side = 2.0 / across / std::numbers::sqrt3;
  double const depth = side * make.between(0.3, 2.0);
  double const distance = make.log_between(0.005, 0.3);
  glm::dvec2 const step(2.0 / across, 1.5 * side);
  for (int row = 0; row * step.y < 2.0; ++row) {
    for (int i = 0; i < across; ++i) {
      glm::dvec2 const middle(-0.5 + (i + 0.5 * (row % 2)) * step.x, -0.5 + row * step.y);
      for (int edge = 0; edge < 3; ++edge) {
        auto const corner = [&](int number) {
          double const angle = pi / 3 * number + pi / 6;
          return middle + side * glm::dvec2(std::cos(angle), std::sin(angle));
        };
        glm::dvec2 const a = corner(edge);
        glm::dvec2 const b = corner(edge + 1);
        make.add({make.place(a, distance), make.place(b, distance), make.place(b, distance + depth),
                  make.place(a, distance + depth)});
      }
    }
  }
}

glm::dvec2 anywhere(Maker& make) { return {make.between(-0.5, 1.5), make.between(-0.5, 1.5)}; }

// Quadrilaterals around places at random; `slender` is the width by the length.
void scatter(Maker& make, int count, double cover, double slender) {
  double const length = std::sqrt(4.0 * cover / (count * slender));
  for (int i = 0; i < count; ++i) {
    glm::dvec2 const at = anywhere(make);
    double const distance = make.between(0.05, 0.8);
    double const angle = make.between(0.0, pi);
    double const out = length * make.between(-0.3, 0.3);
    glm::dvec2 const along = 0.5 * length * glm::dvec2(std::cos(angle), std::sin(angle));
    glm::dvec2 const across = slender * glm::dvec2(-along.y, along.x);
    make.add({make.place(at - along, distance + 0.5 * out), make.place(at - across, distance),
              make.place(at + along, distance - 0.5 * out), make.place(at + across, distance)});
  }
}

void leaves(Maker& make) {
  scatter(make, make.count(50, 5000), make.between(0.3, 1.5), make.between(0.3, 0.8));
}
void sticks(Maker& make) { scatter(make, make.count(20, 400), make.between(0.1, 0.7), 0.01); }
void one_large_among_leaves(Maker& make) {
  scatter(make, make.count(200, 3000), 0.3, 0.5);
  scatter(make, 1, 0.3, 0.7);
}

void triangles(Maker& make) {
  int const count = make.count(20, 1500);
  double const size = std::sqrt(2.0 / count) * make.between(0.8, 2.0);
  for (int i = 0; i < count; ++i) {
    glm::dvec2 const at = anywhere(make);
    double const distance = make.between(0.05, 0.8);
    auto const corner = [&] {
      return make.place(at + size * glm::dvec2(make.between(-1, 1), make.between(-1, 1)), distance);
    };
    Ring ring{corner(), corner()};
    ring.push_back(corner());
    make.add(ring);
  }
}

void slivers(Maker& make) {
  int const count = make.count(20, 600);
  for (int i = 0; i < count; ++i) {
    glm::dvec2 const at = anywhere(make);
    glm::dvec2 const end = anywhere(make);
    double const thin = make.log_between(1e-3, 2e-2);
    make.add({at, end, end + glm::dvec2(thin, -thin)}, make.between(0.05, 0.6));
  }
}

void city(Maker& make) {
  int const count = make.count(10, 800);
  for (int i = 0; i < count; ++i) {
    double const x = make.between(-1.0, 2.0);
    double const width = make.log_between(0.01, 0.4);
    double const height = make.between(0.0, 1.3) * make.between(0.0, 1.0);
    double const distance = make.log_between(0.1, 3.0);
    double const depth = make.between(0.05, 0.5);
    double const foot = -1.0;
    auto const at = [&](double right, double up, double behind) {
      return make.place({x + right, up}, distance + behind);
    };
    make.add({at(0, foot, 0), at(width, foot, 0), at(width, height, 0), at(0, height, 0)});
    make.add({at(0, foot, depth), at(width, foot, depth), at(width, height, depth),
              at(0, height, depth)});
    make.add({at(0, foot, 0), at(0, foot, depth), at(0, height, depth), at(0, height, 0)});
    make.add({at(width, foot, 0), at(width, foot, depth), at(width, height, depth),
              at(width, height, 0)});
    make.add(
        {at(0, height, 0), at(width, height, 0), at(width, height, depth), at(0, height, depth)});
  }
}

void sawtooth(Maker& make) {
  int const teeth = make.count(10, 500);
  double const pitch = 2.0 / teeth;
  double const rise = pitch * make.between(0.3, 1.0);
  double const lean = make.between(0.0, 0.5);
  double const distance = make.log_between(0.02, 0.4);
  for (int i = 0; i < teeth; ++i) {
    double const from = -0.5 + i * pitch;
    double const top = from + lean * pitch;
    make.add({make.place({-0.4, from}, distance), make.place({1.4, from}, distance),
              make.place({1.4, top}, distance + rise), make.place({-0.4, top}, distance + rise)});
    if (i % 2 == 0) continue;
    make.add({make.place({-0.4, top}, distance + rise), make.place({1.4, top}, distance + rise),
              make.place({1.4, from + pitch}, distance),
              make.place({-0.4, from + pitch}, distance)});
  }
}

// A dome of triangles.
void mesh(Maker& make) {
  int const rings = make.count(5, 30);
  int const segments = 2 * rings;
  double const radius = make.between(0.2, 0.6);
  double const distance = make.between(0.1, 0.5);
  double const holes = make.between(0.0, 0.5);
  auto const at = [&](int ring, int segment) {
    double const fall = 0.5 * pi * ring / rings;
    double const turn = 2 * pi * segment / segments;
    double const out = radius * std::sin(fall);
    return make.place({0.5 + out * std::cos(turn), 0.5 + out * std::sin(turn)},
                      distance + radius * std::cos(fall));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      if (make.between(0.0, 1.0) < holes) continue;
      make.add({at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1)});
      if (ring > 0) make.add({at(ring, segment), at(ring + 1, segment + 1), at(ring, segment + 1)});
    }
  }
}

void plates(Maker& make) {
  int const across = make.count(4, 30);
  double const pitch = 2.0 / across;
  double const hole = make.between(0.2, 0.45);
  double const distance = make.log_between(0.02, 0.5);
  double const skew = make.between(-0.5, 0.5);
  for (int row = 0; row < across; ++row) {
    for (int i = 0; i < across; ++i) {
      auto const around = [&](double reach) {
        glm::dvec2 const at(-0.5 + (i + 0.5 + skew * row / across) * pitch,
                            -0.5 + (row + 0.5) * pitch);
        double const half = reach * pitch;
        return Outline{at + glm::dvec2(-half, -half), at + glm::dvec2(half, -half),
                       at + glm::dvec2(half, half), at + glm::dvec2(-half, half)};
      };
      make.add_plate(around(0.48), around(hole), distance);
    }
  }
}

void dots(Maker& make) {
  int const across = make.count(5, 60);
  double const pitch = 2.0 / across;
  double const size = pitch * make.between(0.3, 0.9);
  double const turn = make.between(0.0, pi / 2);
  double const distance = make.log_between(0.02, 0.5);
  glm::dvec2 const right = pitch * glm::dvec2(std::cos(turn), std::sin(turn));
  glm::dvec2 const up(-right.y, right.x);
  double const part = size / pitch;
  for (int row = 0; row < across; ++row) {
    for (int i = 0; i < across; ++i) {
      glm::dvec2 const at =
          glm::dvec2(0.5) + (i - 0.5 * across) * right + (row - 0.5 * across) * up;
      make.add({at, at + part * right, at + part * (right + up), at + part * up}, distance);
    }
  }
}

// Bars between two chords, up and down in turn, one behind another.
void trusses(Maker& make) {
  int const bays = make.count(5, 60);
  int const number = make.count(2, 20);
  double const pitch = 2.0 / bays;
  double const thick = pitch * make.between(0.05, 0.3);
  double const distance = make.log_between(0.02, 0.3);
  for (int truss = 0; truss < number; ++truss) {
    double const low = make.between(-0.3, 1.0);
    double const high = low + make.between(0.1, 0.6);
    for (int i = 0; i < bays; ++i) {
      double const left = -0.5 + i * pitch;
      double const start = i % 2 == 0 ? low : high;
      double const end = i % 2 == 0 ? high : low;
      make.add(
          {{left, start}, {left + thick, start}, {left + pitch + thick, end}, {left + pitch, end}},
          distance * (1 + truss));
    }
  }
}

void fans(Maker& make) {
  int const number = make.count(1, 20);
  int const blades = make.count(10, 80);
  for (int fan = 0; fan < number; ++fan) {
    glm::dvec2 const at = anywhere(make);
    double const radius = make.between(0.2, 0.8);
    double const distance = make.between(0.05, 0.6);
    double const start = make.between(0.0, pi);
    double const open = make.between(0.2, 0.7);
    for (int i = 0; i < blades; ++i) {
      auto const end = [&](double part) {
        double const angle = start + 2 * pi * (i + part) / blades;
        return at + radius * glm::dvec2(std::cos(angle), std::sin(angle));
      };
      make.add({at, end(0.0), end(open)}, distance);
    }
  }
}

void mixed(Maker& make) {
  add_blades(make, make.count(20, 500), 0.0);
  leaves(make);
  city(make);
  crate(make);
}

void glass_louvres(Maker& make) {
  add_blades(make, make.count(20, 1500), 0.0);
  make.make_transparent(make.between(0.2, 0.8));
}
void glass_layers(Maker& make) {
  int const blades = make.count(20, 800);
  add_blades(make, blades, 0.0);
  add_blades(make, static_cast<int>(blades * make.between(0.6, 1.1)), 0.0);
  make.make_transparent(make.between(0.2, 0.8));
}
void glass_leaves(Maker& make) {
  scatter(make, make.count(50, 1500), make.between(0.3, 1.0), 0.5);
  make.make_transparent(make.between(0.2, 0.8));
}

void slats_of_other_pitches(Maker& make) {
  for (auto const& [slats, distance] : {std::pair(305, 0.05), std::pair(219, 0.105)}) {
    double const pitch = 1.5 / slats;
    for (int i = 0; i < slats; ++i) {
      glm::dvec2 const at(0.0, i * pitch - 0.25);
      make.add({at, at + glm::dvec2(1.0, 0.0), at + glm::dvec2(1.0, 0.5 * pitch),
                at + glm::dvec2(0.0, 0.5 * pitch)},
               distance);
    }
  }
}

void scheduled_louvres(Maker& make) {
  add_blades(make, make.count(20, 1500), 0.0);
  make.schedule(1);
}
void scheduled_leaves(Maker& make) {
  scatter(make, make.count(50, 1500), make.between(0.3, 0.8), 0.5);
  make.schedule(2);
}
void scheduled_glass(Maker& make) {
  glass_layers(make);
  make.schedule(1);
}
// Hardly two of them transmit as much.
void scheduled_canopies(Maker& make) {
  scatter(make, make.count(50, 600), make.between(0.3, 0.8), 0.5);
  make.make_transparent(0.7);
  make.schedule(2);
}

void rooms_behind_louvres(Maker& make) {
  make.add_room();
  add_blades(make, make.count(20, 1500), 0.0);
}
void rooms_behind_glass(Maker& make) {
  make.add_room();
  glass_louvres(make);
}
void rooms_behind_glass_leaves(Maker& make) {
  make.add_room();
  glass_leaves(make);
}
void rooms_behind_schedules(Maker& make) {
  make.add_room();
  scheduled_leaves(make);
}

void crowns(Maker& make) {
  int const count = make.count(1, 40);
  for (int i = 0; i < count; ++i) {
    double const side = make.log_between(0.05, 0.6);
    double const high = make.between(0.5, 2.0) * side * make.least_side();
    glm::dvec2 const at = anywhere(make);
    double const distance = make.between(0.1, 1.5);
    Surface crown{"crown",
                  {{make.place(at, distance), make.place(at + glm::dvec2(side, 0.0), distance),
                    make.place(at + glm::dvec2(side), distance),
                    make.place(at + glm::dvec2(0.0, side), distance)},
                   {}}};
    auto const shape = static_cast<CrownShape>(make.below(5));
    double const density = make.log_between(0.3, 10.0) / high;
    crown.filter.set(Crown{.shape = shape,
                           .height = high,
                           .leaf_density = density,
                           .mesh = shape == CrownShape::mesh ? ball_mesh(12) : nullptr});
    make.add(crown);
  }
}

// Sheets of holes of 1/500 to 1/15 of the receiver's sides.
InventedScene invent_sheets(Numbers& make, Shape const& shape, double size,
                            std::vector<RegularSheets::Sheet> sheets, int suns) {
  double const width = size * make.between(0.5, 1.0);
  double const height = size * make.between(0.5, 1.0);
  auto const ring = [&](Outline const& outline) {
    Ring made;
    for (glm::dvec2 const& at : outline) made.emplace_back(at.x * width, 0.0, at.y * height);
    return made;
  };
  Polygon receiver{ring(shape.outline), {}};
  if (!shape.hole.empty()) receiver.holes.push_back(ring(shape.hole));
  auto const regular =
      std::make_shared<RegularSheets const>(std::move(receiver), std::move(sheets));
  InventedScene invented{regular->scene(), {}, {}, {}};
  for (int tried = 0; tried < 20 * suns && static_cast<int>(invented.suns.size()) < suns; ++tried) {
    SunDirection const sun{make.between(0.5 * pi, 1.5 * pi),
                           make.log_between(0.1, 80.0) * pi / 180.0};
    if (regular->sunlit_fraction(sun)) invented.suns.push_back(sun);
  }
  invented.reference = [regular](Scene const&, SunDirection sun) -> ReferenceFractions {
    return {std::vector<double>(schedule_factors.size(), *regular->sunlit_fraction(sun)), 1e-6};
  };
  return invented;
}

InventedScene behind_one_sheet(Numbers& make, Shape const& shape, int suns) {
  RegularSheets::Sheet const sheet = random_sheet(make.generator(), 2e-3, 0.1);
  return invent_sheets(make, shape, sheet.holes.pitch * make.log_between(10.0, 400.0), {sheet},
                       suns);
}

InventedScene sheets(std::uint32_t seed, int suns) {
  Numbers make(seed);
  Shape const shape = invent_shape(make);
  return behind_one_sheet(make, shape, suns);
}
InventedScene two_sheets(std::uint32_t seed, int suns) {
  Numbers make(seed);
  Shape const shape = invent_shape(make);
  auto const pair = random_pair(make.generator(), static_cast<int>(seed));
  double const pitch = std::max(pair[0].holes.pitch, pair[1].holes.pitch);
  return invent_sheets(make, shape, pitch * make.log_between(5.0, 80.0), pair, suns);
}
InventedScene sheets_before_angles(std::uint32_t seed, int suns) {
  Numbers make(seed);
  return behind_one_sheet(make, angle_of(make.log_between(0.01, 0.1)), suns);
}
// Windows leave 4 to 20 % of them.
InventedScene sheets_before_walls(std::uint32_t seed, int suns) {
  Numbers make(seed);
  return behind_one_sheet(make, frame(make.log_between(0.01, 0.05)), suns);
}

InventedScene behind_crowns(std::uint32_t seed, int suns) {
  Maker make(seed);
  crowns(make);
  InventedScene invented = make.finish(suns);
  invented.reference = traced;
  return invented;
}

template <auto add>
InventedScene invent(std::uint32_t seed, int suns) {
  Maker make(seed);
  add(make);
  return make.finish(suns);
}

constexpr std::array families{
    SceneFamily{"louvres", invent<louvres>},
    SceneFamily{"fins", invent<fins>},
    SceneFamily{"sloped blades", invent<sloped_blades>},
    SceneFamily{"two layers", invent<two_layers>},
    SceneFamily{"three layers", invent<three_layers>},
    SceneFamily{"nearly parallel layers", invent<nearly_parallel_layers>},
    SceneFamily{"crossed layers", invent<crossed_layers>},
    SceneFamily{"louvres before fins", invent<louvres_and_fins_beyond>},
    SceneFamily{"chevrons", invent<chevrons>},
    SceneFamily{"egg-crates", invent<crate>},
    SceneFamily{"honeycombs", invent<honeycomb>},
    SceneFamily{"leaves", invent<leaves>},
    SceneFamily{"one large among leaves", invent<one_large_among_leaves>},
    SceneFamily{"long sticks", invent<sticks>},
    SceneFamily{"triangles", invent<triangles>},
    SceneFamily{"slivers", invent<slivers>},
    SceneFamily{"cities", invent<city>},
    SceneFamily{"sawtooth roofs", invent<sawtooth>},
    SceneFamily{"meshes", invent<mesh>},
    SceneFamily{"plates with holes", invent<plates>},
    SceneFamily{"dots", invent<dots>},
    SceneFamily{"trusses", invent<trusses>},
    SceneFamily{"fans", invent<fans>},
    SceneFamily{"mixed", invent<mixed>},
    SceneFamily{"glass louvres", invent<glass_louvres>},
    SceneFamily{"glass layers", invent<glass_layers>},
    SceneFamily{"glass leaves", invent<glass_leaves>},
    SceneFamily{"slats of other pitches", invent<slats_of_other_pitches>},
    SceneFamily{"scheduled louvres", invent<scheduled_louvres>},
    SceneFamily{"scheduled leaves", invent<scheduled_leaves>},
    SceneFamily{"scheduled glass", invent<scheduled_glass>},
    SceneFamily{"scheduled canopies", invent<scheduled_canopies>},
    SceneFamily{"rooms behind louvres", invent<rooms_behind_louvres>},
    SceneFamily{"rooms behind glass", invent<rooms_behind_glass>},
    SceneFamily{"rooms, glass leaves", invent<rooms_behind_glass_leaves>},
    SceneFamily{"rooms, schedules", invent<rooms_behind_schedules>},
    SceneFamily{"crowns", behind_crowns},
    SceneFamily{"screens", sheets},
    SceneFamily{"two screens", two_sheets},
    SceneFamily{"screens before Ls", sheets_before_angles},
    SceneFamily{"screens before walls", sheets_before_walls},
};

}  // namespace

std::span<SceneFamily const> scene_families() { return families; }

std::vector<double> fractions_of(std::span<Sunlit const> answers, double projected_area) {
  std::vector<double> fractions;
  for (Sunlit const& answer : answers) {
    for (double const factor : schedule_factors) {
      constexpr std::size_t max_schedules = 8;
      std::array<double, max_schedules> factors{};
      factors.fill(factor);
      fractions.push_back(answer.at(factors) / projected_area);
    }
  }
  return fractions;
}

}  // namespace gpu_shading

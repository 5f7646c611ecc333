#include "support/sloped_shades.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <numbers>
#include <span>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading/transmittance.h"
#include "support/exact.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

constexpr double scheduled = 0.5;
// Round holes in a sheet without thickness.
constexpr double hole = 0.005;
constexpr double pitch_of_holes = 0.01;

// In the receiver's plane from its middle, seen from outside.
Ring ring_of(std::vector<glm::dvec2> const& places, double y) {
  Ring ring;
  for (glm::dvec2 const& place : places) ring.emplace_back(place.x, y, place.y);
  return ring;
}

Ring rectangle(double width, double height) {
  double const x = 0.5 * width;
  double const z = 0.5 * height;
  return ring_of({{-x, -z}, {x, -z}, {x, z}, {-x, z}}, 0.0);
}

Polygon polygon_of(SlopedShades::Receiver receiver) {
  using Receiver = SlopedShades::Receiver;
  switch (receiver) {
    case Receiver::wide:
      return {rectangle(3, 1.5), {}};
    case Receiver::narrow:
      return {rectangle(1.4, 2), {}};
    case Receiver::square:
      return {rectangle(2, 2), {}};
    case Receiver::triangle:
      return {ring_of({{-1.5, -1}, {1.5, -1}, {0.3, 1}}, 0.0), {}};
    case Receiver::octagon: {
      std::vector<glm::dvec2> corners;
      for (int i = 0; i < 8; ++i) {
        double const turn = (i + 0.3) * std::numbers::pi / 4;
        corners.emplace_back(1.2 * std::cos(turn), 1.2 * std::sin(turn));
      }
      return {ring_of(corners, 0.0), {}};
    }
    case Receiver::with_hole:
      return {rectangle(3, 2), {rectangle(1.6, 0.9)}};
  }
  return {};
}

}  // namespace

Scene SlopedShades::scene() const {
  constexpr double in_front = -0.5;
  constexpr double far = 6.0;
  glm::dvec2 const along(std::cos(pitch * degree), std::sin(pitch * degree));
  glm::dvec2 const across(along.y, -along.x);  // down
  std::vector<Ring> rings;
  if (shade == Shade::edge) {
    glm::dvec2 const start(0.05, 0.35);
    rings.push_back(ring_of({start - far * along, start - far * along + far * across,
                             start + far * along + far * across, start + far * along},
                            in_front));
  } else if (shade == Shade::gable) {
    glm::dvec2 const apex(0.1, 0.9);
    rings.push_back(
        ring_of({apex - far * along, apex + far * glm::dvec2(along.x, -along.y), apex}, in_front));
  } else {
    constexpr int count = 30;
    constexpr double apart = 0.12;
    for (int i = 0; i < count; ++i) {
      glm::dvec2 const start = (i - 0.5 * count) * apart * across;
      glm::dvec2 const end = start + 0.45 * apart * across;
      rings.push_back(
          ring_of({start - far * along, end - far * along, end + far * along, start + far * along},
                  in_front));
    }
  }
  Scene scene;
  scene.add({"receiver", polygon_of(receiver)});
  for (Ring const& ring : rings) {
    Surface surface{"shade", {ring, {}}};
    if (beam == Beam::glass) {
      surface.filter.set(AngularTransmittance{
          std::make_shared<Transmittance const>(Transmittance::constant(0.6))});
    }
    if (beam == Beam::scheduled) surface.filter.schedule = 0;
    if (beam == Beam::screen) {
      surface.filter.set(PerforatedSheet{std::make_shared<PerforatedScreen const>(
          HolePattern(
              {.arrangement = Arrangement::Straight, .size = hole, .pitch = pitch_of_holes}),
          Sheet{.thickness = 0.0, .detail = ScreenDetail::effective})});
    }
    scene.add(surface);
  }
  return scene;
}

char const* SlopedShades::name(Shade shade) {
  constexpr std::array names{"edge", "gable", "30 slats"};
  return names.at(static_cast<std::size_t>(shade));
}

char const* SlopedShades::name(Beam beam) {
  constexpr std::array names{"opaque", "glass", "scheduled", "screen"};
  return names.at(static_cast<std::size_t>(beam));
}

std::vector<SunDirection> suns_over_edges(int count) {
  std::vector<SunDirection> suns;
  for (int i = 0; i < count; ++i) {
    double const share = (i + 0.5) / count;
    double const golden = std::fmod((i + 1) / std::numbers::phi, 1.0);
    suns.push_back(sun_at(155 + 50 * share, 5 + 40 * golden));
  }
  return suns;
}

void SlopeErrors::add(SlopedShades const& shades, std::vector<SunDirection> const& suns,
                      double target, bool samples_only) {
  Scene const scene = shades.scene();
  // Shades do not cover one another: what a screen lets through is a share of its opaque shadow.
  bool const screened = shades.beam == SlopedShades::Beam::screen;
  double const open =
      screened ? std::numbers::pi / 4 * (hole * hole) / (pitch_of_holes * pitch_of_holes) : 0.0;
  SlopedShades without_holes = shades;
  if (screened) without_holes.beam = SlopedShades::Beam::opaque;
  Scene const polygons = without_holes.scene();
  RendererOptions options;
  options.device = on_cpu;
  options.error = target;
  options.samples_only = samples_only;
  Renderer renderer(scene, options);
  for (SunDirection const sun : suns) {
    double const whole = exact::projected_area(scene, sun, 0);
    double const beside =
        exact::projected_sunlit_area(polygons, sun, 0, std::span(&scheduled, std::size_t{1}));
    double const lit = open * whole + (1.0 - open) * beside;
    Sunlit const answer = sunlit(renderer, sun, 0);
    double got = answer.projected_area;
    for (auto const& part : answer.scheduled) {
      double factor = 1.0;
      for (auto const& [schedule, power] : part.powers) factor *= std::pow(scheduled, power);
      got += factor * part.projected_area;
    }
    errors_.push_back(std::abs(got - lit) / whole);
  }
}

double SlopeErrors::most() const {
  return errors_.empty() ? 0.0 : *std::max_element(errors_.begin(), errors_.end());
}

double SlopeErrors::beyond(double error) const {
  if (errors_.empty()) return 0.0;
  auto const over =
      std::count_if(errors_.begin(), errors_.end(), [&](double value) { return value > error; });
  return static_cast<double>(over) / static_cast<double>(errors_.size());
}

}  // namespace gpu_shading

#include "routes/penumbra/library/opaque_calculation.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "gpu_shading/error.h"
#include "routes/penumbra/library/surface_of.h"

namespace gpu_shading::energyplus {
namespace {

// The other face of a surface.
Surface back_of(Surface surface) {
  std::reverse(surface.polygon.outline.begin(), surface.polygon.outline.end());
  surface.casting = Casting::never;
  return surface;
}

}  // namespace

OpaqueCalculation::OpaqueCalculation(unsigned size, answers::Log log)
    : size_(size), log_(std::move(log)) {}

unsigned OpaqueCalculation::add(answers::PlainSurface surface) {
  surfaces_.push_back(surface_of(std::move(surface)));
  return static_cast<unsigned>(surfaces_.size() - 1);
}

RendererOptions OpaqueCalculation::options() const {
  RendererOptions options;
  options.resolution = static_cast<int>(size_);
  options.warn = log_.warning;
  return options;
}

// The surfaces, and after them their backs in the same order.
void OpaqueCalculation::start(answers::Simulation /*simulation*/) {
  Scene scene;
  for (auto const& surface : surfaces_) scene.add(surface);
  for (auto const& surface : surfaces_) scene.add(back_of(surface));
  normals_.clear();
  for (auto const& surface : surfaces_) normals_.push_back(normal(surface.polygon));
  asked_.assign(surfaces_.size(), false);
  known_.clear();
  renderer_.emplace(std::move(scene), options());
}

Renderer& OpaqueCalculation::renderer() {
  if (!renderer_) throw Error("set_model() must come before questions");
  return *renderer_;
}

void OpaqueCalculation::check(unsigned surface) const {
  if (surface < normals_.size()) return;
  throw Error(fmt::format("surface {} was added after set_model()", surface));
}

SurfaceId OpaqueCalculation::lit_face(unsigned surface) const {
  bool const front = glm::dot(normals_[surface], to_vector(sun_)) >= 0.0;
  return static_cast<SurfaceId>(front ? surface : surface + surfaces_.size());
}

void OpaqueCalculation::render(std::vector<unsigned> const& wanted, Areas& areas) {
  std::vector<SurfaceId> faces;
  faces.reserve(wanted.size());
  for (auto const surface : wanted) faces.push_back(lit_face(surface));
  auto const sunlit = renderer_->projected_sunlit_areas(sun_, faces);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    areas[wanted[i]] = static_cast<float>(sunlit[i].projected_area);
  }
}

OpaqueCalculation::Areas& OpaqueCalculation::known_areas() {
  constexpr std::size_t most_numbers = std::size_t{1} << 26U;  // 512 MiB
  if (known_.size() * surfaces_.size() > most_numbers) known_.clear();
  auto& areas = known_[{sun_.azimuth, sun_.altitude}];
  areas.resize(surfaces_.size());
  return areas;
}

// All surfaces that were asked about before are rendered at the first question about a direction.
float OpaqueCalculation::sunlit_area(unsigned surface) { return sunlit_areas({surface}).front(); }

std::vector<float> OpaqueCalculation::sunlit_areas(std::vector<unsigned> const& surfaces) {
  renderer();
  auto& areas = known_areas();
  for (auto const surface : surfaces) {
    check(surface);
    asked_[surface] = true;
  }
  if (std::any_of(surfaces.begin(), surfaces.end(), [&](unsigned each) { return !areas[each]; })) {
    std::vector<unsigned> wanted;
    for (unsigned i = 0; i < asked_.size(); ++i) {
      if (asked_[i] && !areas[i]) wanted.push_back(i);
    }
    render(wanted, areas);
  }
  std::vector<float> answers;
  answers.reserve(surfaces.size());
  for (auto const surface : surfaces) answers.push_back(*areas[surface]);
  return answers;
}

std::vector<float> OpaqueCalculation::interior_areas(unsigned window,
                                                     std::vector<unsigned> const& interiors) {
  renderer();
  check(window);
  std::vector<SurfaceId> ids;
  for (auto const interior : interiors) {
    check(interior);
    ids.push_back(interior);
  }
  auto const sunlit = renderer().interior_sunlit_areas(sun_, lit_face(window), ids);
  std::vector<float> areas;
  areas.reserve(sunlit.size());
  for (auto const& each : sunlit) areas.push_back(static_cast<float>(each.projected_area));
  return areas;
}

std::string OpaqueCalculation::vendor() {
  if (renderer_) return renderer_->device().vendor;
  return Renderer(Scene{}, options()).device().vendor;
}

}  // namespace gpu_shading::energyplus

#include "gpu_shading/scene_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "backends/open_backend.h"
#include "gpu_shading/error.h"
#include "gpu_shading/fraction_colour.h"
#include "pictures/colours.h"
#include "pictures/picture_frame.h"
#include "scene/bvh.h"
#include "scene/triangulation.h"
#include "view/transmission.h"

namespace gpu_shading {
namespace {

// Samples per side of a pixel.
constexpr int samples = 2;
// Margin around everything shown, as a fraction of its longer side.
constexpr double scene_border = 0.04;

bool transmits(Surface const& surface) {
  return surface.transmittance || surface.screen || surface.schedule >= 0;
}

// The numbers of the surfaces that the sun sees in each sample, and behind those that transmit.
struct Samples {
  std::vector<std::uint32_t> front;
  std::vector<std::uint32_t> behind;
  std::size_t columns = 0;

  // Whether another surface begins to the right of a sample or above it.
  bool is_edge(std::size_t at) const {
    auto const differs = [&](std::size_t other) {
      return other < front.size() && (front[other] != front[at] || behind[other] != behind[at]);
    };
    bool const last = at % columns == columns - 1;
    return (!last && differs(at + 1)) || differs(at + columns);
  }
};

// Transmitting surfaces are half transparent; edges of surfaces are dark.
Colour sample_colour(Samples const& seen, std::vector<Colour> const& by_number, std::size_t at) {
  constexpr double through = 0.5;
  constexpr double edge = 0.45;
  Colour colour = by_number[seen.front[at]];
  if (seen.front[at] != seen.behind[at]) {
    colour = glm::mix(colour, by_number[seen.behind[at]], through);
  }
  return seen.is_edge(at) ? edge * colour : colour;
}

Colour pixel_colour(Samples const& seen, std::vector<Colour> const& by_number, int column,
                    int row) {
  Colour sum(0.0);
  for (int y = samples * row; y < samples * (row + 1); ++y) {
    for (int x = samples * column; x < samples * (column + 1); ++x) {
      sum +=
          sample_colour(seen, by_number,
                        static_cast<std::size_t>(y) * seen.columns + static_cast<std::size_t>(x));
    }
  }
  return sum / static_cast<double>(samples * samples);
}

}  // namespace

class SceneView::Implementation {
 public:
  Implementation(Scene const& scene, std::span<SurfaceId const> shown, DeviceChoice const& device)
      : scene_(scene), transmission_(scene), shown_(shown.begin(), shown.end()) {
    auto const first_transmitting = std::stable_partition(
        shown_.begin(), shown_.end(), [&](SurfaceId id) { return !transmits(scene_[id]); });
    opaque_ = static_cast<std::size_t>(first_transmitting - shown_.begin());
    find_middle();
    std::vector<Mesh> const meshes = triangulate_all(scene_);
    raster_ = open_picture_raster({scene_, meshes, transmission_}, device);
  }

  Image draw(SunDirection sun, std::span<std::optional<double> const> fractions, int size) {
    int const most = raster_->most_pixels() / samples;
    if (size < 1 || size > most) {
      throw Error(fmt::format("size {} of a view: expected 1 to {} pixels", size, most));
    }
    glm::dvec3 const towards_sun = to_vector(sun);
    SunAxes const axes(towards_sun);
    PictureGrid grid = make_grid(find_frame(axes, fractions), axes, middle_, reach_, size);
    int const width = std::exchange(grid.width, samples * grid.width);
    int const height = std::exchange(grid.height, samples * grid.height);
    Samples const seen{raster_->nearest(grid, shown_),
                       raster_->nearest(grid, std::span(shown_).first(opaque_)),
                       static_cast<std::size_t>(grid.width)};
    std::vector<Colour> const by_number = colours(fractions, towards_sun);
    return make_image(width, height, [&](int column, int row) {
      return pixel_colour(seen, by_number, column, row);
    });
  }

 private:
  template <typename Action>
  void for_each_point(Action const& action) const {
    for (SurfaceId const id : shown_) {
      for (auto const& vertex : scene_[id].polygon.outline) action(id, vertex);
    }
  }

  void find_middle() {
    Box all;
    for_each_point([&](SurfaceId, glm::dvec3 const& point) { all.include(point); });
    if (all.empty()) throw Error("there is no surface to view");
    middle_ = all.centre();
    reach_ = std::max(1.0, glm::distance(all.low, all.high));
  }

  PictureFrame find_frame(SunAxes const& axes,
                          std::span<std::optional<double> const> fractions) const {
    PictureFrame all;
    PictureFrame receivers;
    for_each_point([&](SurfaceId id, glm::dvec3 const& point) {
      all.include(axes(point - middle_));
      if (id < fractions.size() && fractions[id]) receivers.include(axes(point - middle_));
    });
    if (receivers.empty()) throw Error("there is no receiver to view");
    PictureFrame const most = receivers.widened(0.5 * receivers.longer());
    PictureFrame const frame{glm::max(all.low, most.low), glm::min(all.high, most.high)};
    return frame.widened(scene_border * frame.longer());
  }

  std::vector<Colour> colours(std::span<std::optional<double> const> fractions,
                              glm::dvec3 const& towards_sun) const {
    std::vector<Colour> by_number(scene_.size() + 1, sky);
    for (SurfaceId const id : shown_) {
      bool const receives = id < fractions.size() && fractions[id];
      by_number[id + 1] =
          receives ? fraction_colour(*fractions[id]) : tilt_grey(scene_[id], towards_sun);
    }
    return by_number;
  }

  Scene const& scene_;
  Transmission transmission_;
  std::vector<SurfaceId> shown_;  // those that transmit last
  std::size_t opaque_ = 0;        // how many do not
  glm::dvec3 middle_{0.0};
  double reach_ = 1.0;
  std::unique_ptr<PictureRaster> raster_;
};

SceneView::SceneView(Scene const& scene, std::span<SurfaceId const> shown,
                     DeviceChoice const& device)
    : implementation_(std::make_unique<Implementation>(scene, shown, device)) {}

SceneView::~SceneView() = default;

Image SceneView::draw(SunDirection sun, std::span<std::optional<double> const> fractions,
                      int size) {
  return implementation_->draw(sun, fractions, size);
}

}  // namespace gpu_shading

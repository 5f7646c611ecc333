#include "gpu_shading/scene_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <string>
#include <vector>

#include "backends/open_backend.h"
#include "filters/transmission.h"
#include "geometry/bvh.h"
#include "geometry/triangulation.h"
#include "gpu_shading/error.h"
#include "pictures/colours.h"
#include "pictures/picture_frame.h"
#include "pictures/shadow_map.h"
#include "rays/mesh_path.h"

namespace gpu_shading {
namespace {

// Samples per side of a pixel.
constexpr int samples = 2;
// Margin around everything shown, as a fraction of its longer side.
constexpr double scene_border = 0.04;

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

// The mean of a pixel's samples. colour_of(number, sample) is that of a surface, and
// share_through(number, x, y) the share that those behind it show; edges of surfaces are dark by
// edge_share(samples, sample, x, y).
template <typename ColourOf, typename ShareThrough, typename EdgeShare>
Colour pixel_colour(Samples const& seen, ColourOf const& colour_of,
                    ShareThrough const& share_through, EdgeShare const& edge_share, int column,
                    int row) {
  constexpr double edge = 0.45;
  Colour sum(0.0);
  for (int y = samples * row; y < samples * (row + 1); ++y) {
    for (int x = samples * column; x < samples * (column + 1); ++x) {
      auto const at = static_cast<std::size_t>(y) * seen.columns + static_cast<std::size_t>(x);
      Colour colour = colour_of(seen.front[at], at);
      if (seen.front[at] != seen.behind[at]) {
        colour =
            glm::mix(colour, colour_of(seen.behind[at], at), share_through(seen.front[at], x, y));
      }
      sum += seen.is_edge(at) ? glm::mix(1.0, edge, edge_share(seen, at, x, y)) * colour : colour;
    }
  }
  return sum / static_cast<double>(samples * samples);
}

// Where the plane of a surface is met by the ray of a sample of a view, m.
class SampledPositions {
 public:
  SampledPositions(Scene const& scene, SunAxes const& axes, PictureFrame const& frame,
                   PictureGrid const& grid, glm::dvec3 const& middle)
      : scene_(scene), axes_(axes), frame_(frame), grid_(grid), middle_(middle) {}

  glm::dvec3 operator()(SurfaceId surface, glm::dvec3 const& facing, std::size_t sample) const {
    return on_plane(facing, scene_[surface].polygon.outline.front(), sample);
  }
  // By a normal of the plane and a position on it.
  glm::dvec3 on_plane(glm::dvec3 const& facing, glm::dvec3 const& on, std::size_t sample) const {
    auto const columns = static_cast<std::size_t>(grid_.width);
    std::size_t const column = sample % columns;
    std::size_t const row = sample / columns;
    glm::dvec2 const share((static_cast<double>(column) + 0.5) / grid_.width,
                           (static_cast<double>(row) + 0.5) / grid_.height);
    auto const at = frame_.low + share * (frame_.high - frame_.low);
    glm::dvec3 const position = middle_ + at.x * axes_.right + at.y * axes_.up;
    double const slope = glm::dot(facing, axes_.towards_sun);
    constexpr double edge = 1e-6;
    if (std::abs(slope) < edge) return position;
    return position + glm::dot(facing, on - position) / slope * axes_.towards_sun;
  }

 private:
  Scene const& scene_;
  SunAxes const& axes_;
  PictureFrame const& frame_;
  PictureGrid const& grid_;
  glm::dvec3 const& middle_;
};

// What a picture shows of a crown along a ray towards the eye.
struct CrownLook {
  glm::dvec3 facing;  // where the ray leaves it
  double passes;      // of what is behind

  // `position`: anywhere on the ray. `mesh`: of a crown that has one.
  CrownLook(Crowns::Entry const& crown, MeshPaths const* mesh, glm::dvec3 const& towards_eye,
            glm::dvec3 const& position)
      : facing(towards_eye), passes(1.0) {
    if (mesh != nullptr) {
      double const before = glm::length(crown.half[0] + crown.half[1] + crown.half[2]);
      auto const path = (*mesh)(RayPath({position - 2.0 * before * towards_eye, towards_eye,
                                         std::numeric_limits<double>::infinity()}));
      passes = std::exp(-crown.extinction(towards_eye, {}) * path.length);
      facing = path.facing;
      return;
    }
    glm::dvec3 const start = crown.in_cube(position - crown.centre);
    glm::dvec3 const step = crown.in_cube(towards_eye);
    RayPart const path = crown.solid.inside(start, step);
    if (path.length() == 0.0) return;
    passes = std::exp(-crown.extinction(towards_eye, {}) * path.length());
    glm::dvec3 const end = start + path.end * step;
    constexpr double flat = 1.0 - 1e-6;
    glm::dvec3 slope(2.0 * end.x, 2.0 * end.y,
                     2.0 * crown.solid.square * end.z + crown.solid.linear);
    if (std::abs(end.z) > flat) slope = {0.0, 0.0, end.z};
    glm::dvec3 outwards(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 const& half = crown.half.at(static_cast<std::size_t>(axis));
      outwards += slope[axis] / glm::dot(half, half) * half;
    }
    facing = glm::normalize(outwards);
  }
};

bool overlap(PictureFrame const& one, PictureFrame const& other) {
  return glm::all(glm::greaterThan(one.high, other.low)) &&
         glm::all(glm::lessThan(one.low, other.high));
}

Mesh body_mesh(Polygon const& plan, Crown const& crown) {
  constexpr int sides = 32;
  Mesh mesh;
  for (Polygon const& face : crown_faces(plan, crown, sides)) {
    Mesh const part = triangulate(face);
    auto const base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (std::uint32_t const index : part.indices) mesh.indices.push_back(base + index);
  }
  return mesh;
}

}  // namespace

class SceneView::Implementation {
 public:
  Implementation(Scene const& scene, std::span<SurfaceId const> shown, DeviceChoice const& device)
      : scene_(scene), transmission_(scene), shown_(shown.begin(), shown.end()) {
    auto const first_transmitting = std::stable_partition(
        shown_.begin(), shown_.end(), [&](SurfaceId id) { return !scene_[id].filter.transmits(); });
    opaque_ = static_cast<std::size_t>(first_transmitting - shown_.begin());
    for (SurfaceId id = 0; id < scene_.size(); ++id) {
      has_holes_.push_back(scene_[id].filter.look().kind == FilterLook::Kind::holes);
    }
    find_middle();
    std::vector<Mesh> meshes = triangulate_all(scene_);
    for (Crowns::Entry const& crown : transmission_.crowns().entries()) {
      trees_.try_emplace(scene_[crown.surface].name, crown.surface);
      meshes[crown.surface] = body_mesh(scene_[crown.surface].polygon, crown.crown);
      if (crown.crown.mesh) crown_meshes_.try_emplace(crown.surface, crown);
    }
    raster_ = open_picture_raster({scene_, meshes, transmission_}, device);
  }

  Image draw(SunDirection sun, std::span<std::optional<double> const> fractions, int size) {
    check(size);
    glm::dvec3 const towards_sun = to_vector(sun);
    SunAxes const axes(towards_sun);
    PictureGrid grid = make_grid(find_frame(axes, fractions), axes, middle_, reach_, size);
    Samples const seen = take_samples(grid);
    std::vector<Colour> const by_number = colours(fractions, towards_sun);
    constexpr double through = 0.5;
    return make_image(grid.width / samples, grid.height / samples, [&](int column, int row) {
      return pixel_colour(
          seen, [&](std::uint32_t number, std::size_t) { return by_number[number]; },
          [](std::uint32_t, int, int) { return through; },
          [](Samples const&, std::size_t, int, int) { return 1.0; }, column, row);
    });
  }

  Image draw(SunDirection camera, SunDirection sun,
             std::span<std::optional<double> const> fractions, int size) {
    check(size);
    SunAxes const axes(to_vector(camera));
    auto const frame = find_frame(axes, fractions);
    PictureGrid grid = make_grid(frame, axes, middle_, reach_, size);
    Samples const seen = take_samples(grid);
    SunAxes const from_sun(to_vector(sun));
    ShadowMap const shadows(*raster_, shown_, opaque_,
                            find_frame_from_sun(from_sun, axes, frame, fractions), from_sun,
                            middle_, reach_);
    SampledPositions const positions(scene_, axes, frame, grid, middle_);
    auto const normals = normals_of_shown();
    constexpr double dark = 0.6;
    auto const look = [&](SurfaceId id, std::size_t sample) {
      Crowns::Entry const& crown = transmission_.crowns()[transmission_.crowns().number(id)];
      auto const mesh = crown_meshes_.find(id);
      return CrownLook(crown, mesh == crown_meshes_.end() ? nullptr : &mesh->second,
                       axes.towards_sun,
                       positions.on_plane(axes.towards_sun, crown.centre, sample));
    };
    auto const colour = [&](std::uint32_t number, std::size_t sample) -> Colour {
      if (number == 0) {
        glm::dvec3 const up(0.0, 0.0, 1.0);
        auto const position = positions.on_plane(up, {0.0, 0.0, lowest_}, sample);
        return (dark + (1.0 - dark) * shadows.light_on_ground(position)) * ground;
      }
      SurfaceId const id = number - 1;
      if (is_crown(id)) {
        // Leaves within it are lit as well.
        double const light = 0.5 + 0.5 * glm::dot(look(id, sample).facing, from_sun.towards_sun);
        return (dark + (1.0 - dark) * light) * leaves;
      }
      auto const facing =
          glm::dot(normals[id], axes.towards_sun) < 0.0 ? -normals[id] : normals[id];
      auto const fraction = id < fractions.size() ? fractions[id] : std::nullopt;
      bool const outside = glm::dot(normals[id], axes.towards_sun) > 0.0;
      double const towards = glm::dot(facing, from_sun.towards_sun);
      if (fraction && outside && towards <= 0.0) return slate;
      double const light = towards > 0.0 ? shadows.light(id, positions(id, facing, sample)) : 0.0;
      return (dark + (1.0 - dark) * light) * unlit_colour(id, fraction, outside, facing);
    };
    auto const share = [&](std::uint32_t number, int x, int y) {
      if (!is_crown(number - 1)) return share_through(number, x, y);
      auto const sample = static_cast<std::size_t>(y) * seen.columns + static_cast<std::size_t>(x);
      return look(number - 1, sample).passes;
    };
    // Edges behind a crown are as faint as what is there.
    auto const edge_share = [&](Samples const& all, std::size_t sample, int x, int y) {
      std::uint32_t const number = all.front[sample];
      return number > 0 && is_crown(number - 1) ? share(number, x, y) : 1.0;
    };
    return make_image(grid.width / samples, grid.height / samples, [&](int column, int row) {
      return pixel_colour(seen, colour, share, edge_share, column, row);
    });
  }

  ViewScale scale(SunDirection camera, std::span<std::optional<double> const> fractions,
                  int size) const {
    SunAxes const axes(to_vector(camera));
    PictureFrame const frame = find_frame(axes, fractions);
    double const pixels = size / frame.longer();
    auto const along = [&](glm::dvec3 const& axis, double from) {
      return glm::dvec4(pixels * axis, -pixels * (glm::dot(axis, middle_) + from));
    };
    return {pixels, pixels * axes.right.y, pixels * axes.up.y, along(axes.right, frame.low.x),
            along(-axes.up, -frame.high.y)};
  }

  void include(std::span<glm::dvec3 const> points) {
    included_.insert(included_.end(), points.begin(), points.end());
  }

 private:
  bool is_crown(SurfaceId id) const { return transmission_.crowns().number(id) != Crowns::none; }

  void check(int size) const {
    int const max_size = raster_->max_pixels() / samples;
    if (size < 1 || size > max_size) {
      throw Error(fmt::format("size {} of a view: expected 1 to {} pixels", size, max_size));
    }
  }

  // Makes the grid one of samples.
  Samples take_samples(PictureGrid& grid) {
    grid.width *= samples;
    grid.height *= samples;
    return {raster_->nearest(grid, shown_),
            raster_->nearest(grid, std::span(shown_).first(opaque_)),
            static_cast<std::size_t>(grid.width)};
  }

  std::vector<glm::dvec3> normals_of_shown() const {
    std::vector<glm::dvec3> normals(scene_.size());
    for (SurfaceId const id : shown_) normals[id] = normal(scene_[id].polygon);
    return normals;
  }

  // Lit by the sun. The tilt shows where the colour has no meaning.
  Colour unlit_colour(SurfaceId id, std::optional<double> const& fraction, bool outside,
                      glm::dvec3 const& facing) const {
    if (fraction && outside) return fraction_colour(*fraction);
    glm::dvec3 const brightest_facing = glm::normalize(glm::dvec3(0.35, -0.55, 0.75));
    constexpr double flat = 0.88;
    double const tilt = flat + (1.0 - flat) * glm::dot(facing, brightest_facing);
    if (has_holes_[id]) return tilt * bronze;
    return tilt * (scene_[id].filter.transmits() ? glass : sand);
  }

  // A screen is a raster of open samples, other surfaces are half transparent.
  double share_through(std::uint32_t number, int x, int y) const {
    constexpr int period = 6;
    constexpr double half = 0.5;
    if (!has_holes_[number - 1]) return half;
    bool const odd = (y / (period / 2)) % 2 != 0;
    return (x + (odd ? period / 2 : 0)) % period < period / 2 ? 0.0 : 1.0;
  }

  template <typename Action>
  void for_each_point(Action const& action) const {
    for (SurfaceId const id : shown_) {
      for (auto const& vertex : scene_[id].polygon.outline) action(id, vertex);
      if (!is_crown(id)) continue;
      auto const& crown = transmission_.crowns()[transmission_.crowns().number(id)];
      for (auto const& corner : crown.corners()) action(id, corner);
    }
  }

  void find_middle() {
    Box all;
    for_each_point([&](SurfaceId, glm::dvec3 const& point) { all.include(point); });
    if (all.empty()) throw Error("there is no surface to view");
    middle_ = all.centre();
    lowest_ = all.low.z;
    reach_ = std::max(1.0, glm::distance(all.low, all.high));
  }

  // By surface; the trunk of a tree is with its crown.
  std::map<SurfaceId, PictureFrame> find_parts(SunAxes const& axes) const {
    std::map<SurfaceId, PictureFrame> parts;
    for_each_point([&](SurfaceId id, glm::dvec3 const& point) {
      auto const tree = trees_.find(scene_[id].name);
      parts[tree == trees_.end() ? id : tree->second].include(axes(point - middle_));
    });
    return parts;
  }

  // With every tree that a camera sees, so that none is without its shadow.
  PictureFrame find_frame_from_sun(SunAxes const& from_sun, SunAxes const& camera,
                                   PictureFrame const& seen,
                                   std::span<std::optional<double> const> fractions) const {
    auto frame = find_frame(from_sun, fractions);
    auto const parts = find_parts(from_sun);
    for (auto const& [id, part] : find_parts(camera)) {
      if (is_crown(id) && overlap(part, seen)) frame.include(parts.at(id));
    }
    return frame;
  }

  PictureFrame find_frame(SunAxes const& axes,
                          std::span<std::optional<double> const> fractions) const {
    auto const parts = find_parts(axes);
    PictureFrame receivers;
    for (auto const& [id, part] : parts) {
      if (id < fractions.size() && fractions[id]) receivers.include(part);
    }
    if (receivers.empty()) throw Error("there is no receiver to view");
    // What begins nearby is shown whole, unless it goes far. Trees are, with their trunks, and so
    // are those that would otherwise be cut off.
    PictureFrame const near = receivers.widened(0.5 * receivers.longer());
    PictureFrame const limit = receivers.widened(receivers.longer());
    PictureFrame const far = receivers.widened(3.0 * receivers.longer());
    PictureFrame frame = receivers;
    for (auto const& [id, part] : parts) {
      if (is_crown(id) || !overlap(part, near)) continue;
      bool const is_small = glm::all(glm::greaterThan(part.low, limit.low)) &&
                            glm::all(glm::lessThan(part.high, limit.high));
      PictureFrame const& within = is_small ? limit : near;
      frame.include(glm::max(part.low, within.low));
      frame.include(glm::min(part.high, within.high));
    }
    for (auto const& point : included_) frame.include(axes(point - middle_));
    auto const with_border = [&] { return frame.widened(scene_border * frame.longer()); };
    for (PictureFrame seen; seen.low != frame.low || seen.high != frame.high;) {
      seen = frame;
      for (auto const& [id, part] : parts) {
        if (!is_crown(id) || !overlap(part, far)) continue;
        if (!overlap(part, near) && !overlap(part, with_border())) continue;
        frame.include(part);
      }
    }
    return with_border();
  }

  std::vector<Colour> colours(std::span<std::optional<double> const> fractions,
                              glm::dvec3 const& towards_sun) const {
    std::vector<Colour> by_number(scene_.size() + 1, sky);
    for (SurfaceId const id : shown_) {
      bool const receives = id < fractions.size() && fractions[id];
      by_number[id + 1] =
          receives ? fraction_colour(*fractions[id]) : tilt_grey(scene_[id], towards_sun);
      // A grey screen before a grey wall would not be seen.
      if (has_holes_[id]) by_number[id + 1] *= bronze / brightest;
      if (is_crown(id)) by_number[id + 1] = leaves;
    }
    return by_number;
  }

  Scene const& scene_;
  Transmission transmission_;
  std::map<SurfaceId, MeshPaths> crown_meshes_;
  std::map<std::string, SurfaceId> trees_;  // their crowns, whose names trunks share
  std::vector<SurfaceId> shown_;            // those that transmit last
  std::size_t opaque_ = 0;                  // how many do not
  std::vector<bool> has_holes_;             // by surface
  glm::dvec3 middle_{0.0};
  double lowest_ = 0.0;  // height of the lowest surface
  double reach_ = 1.0;
  std::vector<glm::dvec3> included_;
  std::unique_ptr<PictureRaster> raster_;
};

SceneView::SceneView(Scene const& scene, std::span<SurfaceId const> shown,
                     DeviceChoice const& device)
    : implementation_(std::make_unique<Implementation>(scene, shown, device)) {}

SceneView::~SceneView() = default;

void SceneView::include(std::span<glm::dvec3 const> points) { implementation_->include(points); }

Image SceneView::draw(SunDirection camera, SunDirection sun,
                      std::span<std::optional<double> const> fractions, int size) {
  return implementation_->draw(camera, sun, fractions, size);
}

ViewScale SceneView::scale(SunDirection camera, std::span<std::optional<double> const> fractions,
                           int size) const {
  return implementation_->scale(camera, fractions, size);
}

Image SceneView::draw(SunDirection sun, std::span<std::optional<double> const> fractions,
                      int size) {
  return implementation_->draw(sun, fractions, size);
}

}  // namespace gpu_shading

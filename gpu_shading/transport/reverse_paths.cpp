#include "transport/reverse_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/triangulation.h"
#include "transport/mirrors.h"

namespace gpu_shading {
namespace {

// A furnace of white walls needs some 600.
constexpr int most_bounces = 2000;

// One segment of a path.
struct Segment {
  enum class End { sky, nothing, ground, surface };

  End end = End::nothing;
  SurfaceId surface = 0;
  glm::dvec3 point{0.0};
  double passed = 1.0;  // of what transmits without holes
};

class Path {
 public:
  Path(TransportScene const& scene, RayConditions const& conditions, std::uint64_t key)
      : scene_(scene), conditions_(conditions), key_(key) {}

  // Independent numbers for what Sobol's points have no dimension.
  double random() { return random_at(key_ ^ ++drawn_ * 0xd1342543de82ef95U); }

  // Perforated sheets let a ray pass, or stop it by their solid part, by chance. Except for the
  // first, where `at_sheet` is given: that gets what it stops, and the rest passes. Behind a dense
  // one, few rays would see what is beyond.
  Segment follow(Ray ray, std::optional<Segment>* at_sheet = nullptr) {
    bool const meets_ground =
        scene_.ground && ray.direction.z < 0.0 && ray.origin.z > scene_.ground->height;
    if (meets_ground) ray.length = (scene_.ground->height - ray.origin.z) / ray.direction.z;
    Segment segment;
    for (auto const& layer : scene_.rays.layers(ray, conditions_)) {
      bool const has_holes = scene_.scene[layer.surface].filter.find<PerforatedSheet>() != nullptr;
      auto const stopped = [&](double share) {
        return Segment{Segment::End::surface, layer.surface,
                       ray.origin + layer.distance * ray.direction, share * segment.passed};
      };
      if (layer.transmittance > 0.0 && !has_holes) {
        segment.passed *= layer.transmittance;
      } else if (layer.transmittance > 0.0 && at_sheet != nullptr && !*at_sheet) {
        *at_sheet = stopped(1.0 - layer.transmittance);
        segment.passed *= layer.transmittance;
      } else if (layer.transmittance <= 0.0 || random() >= layer.transmittance) {
        return stopped(1.0);
      }
    }
    if (meets_ground) {
      segment.end = Segment::End::ground;
      segment.point = ray.origin + ray.length * ray.direction;
      segment.point.z = scene_.ground->height;
    } else if (ray.direction.z > 0.0) {
      segment.end = Segment::End::sky;
    }
    return segment;
  }

 private:
  TransportScene const& scene_;
  RayConditions const& conditions_;
  std::uint64_t key_;
  std::uint64_t drawn_ = 0;
};

struct Reflection {
  glm::dvec3 normal;
  double reflectance;
  bool is_ground;
  double mirrored = 0.0;  // 0 .. 1 - reflectance
};

Reflection reflect(TransportScene const& scene, Segment const& segment,
                   glm::dvec3 const& direction) {
  if (segment.end == Segment::End::ground) {
    return {glm::dvec3(0.0, 0.0, 1.0), scene.ground->reflectance, true};
  }
  auto const& faces = scene.reflectances[segment.surface];
  auto const& normal = scene.normals[segment.surface];
  bool const front = glm::dot(normal, direction) < 0.0;
  double const diffuse = front ? faces.front : faces.back;
  double const mirrored = mirror_reflectance(faces, diffuse, glm::dot(normal, direction));
  return {front ? normal : -normal, diffuse, faces.is_ground, mirrored};
}

// What is the same for all paths from a receiver.
struct PathRequest {
  TransportScene const& scene;
  SobolPoints const& points;
  std::uint32_t seed;
};

// From the end of its first segment. `path`: whose numbers it takes.
void trace_path(PathRequest const& request, Path& onwards, std::size_t point, Ray ray,
                Segment segment, ReversePaths& paths) {
  auto const coordinate = [&](std::size_t dimension) {
    return request.points.at(point, dimension, request.seed);
  };
  double weight = 1.0;
  int by_ground = 0;
  std::size_t step = 0;  // of the reflections that are not a mirror's
  for (int bounce = 0; bounce < most_bounces; ++bounce) {
    if (bounce > 0) {
      segment = onwards.follow(ray);
      ++paths.rays;
    }
    weight *= segment.passed;
    if (segment.end == Segment::End::sky) {
      (bounce == 0 ? paths.sky_direct : part_of(paths.sky, by_ground)) += weight;
    }
    if (segment.end != Segment::End::ground && segment.end != Segment::End::surface) return;
    auto const reflection = reflect(request.scene, segment, ray.direction);
    auto const& normal = reflection.normal;
    std::optional<SurfaceId> surface;
    if (segment.end == Segment::End::surface) surface = segment.surface;
    if (reflection.mirrored > 0.0 && onwards.random() < reflection.mirrored) {
      ray = {segment.point, ray.direction - 2.0 * glm::dot(ray.direction, normal) * normal};
      ray.from = surface;
      continue;
    }
    double const reflectance = reflection.reflectance / (1.0 - reflection.mirrored);
    if (weight * reflectance <= 0.0) return;
    if (reflection.is_ground) ++by_ground;
    paths.hits.push_back({segment.point, normal, weight * reflectance, surface, by_ground});
    bool const by_sobol = step < path_bounces_by_sobol;
    if (by_sobol) {
      weight *= reflectance;
    } else if (onwards.random() >= reflectance) {
      return;
    }
    double const u = by_sobol ? coordinate(4 + 2 * step) : onwards.random();
    double const v = by_sobol ? coordinate(5 + 2 * step) : onwards.random();
    ++step;
    ray = {segment.point, cosine_direction(normal, u, v)};
    ray.from = surface;
  }
}

}  // namespace

glm::dvec3 cosine_direction(glm::dvec3 const& normal, double u, double v) {
  constexpr double steep = 0.9;
  glm::dvec3 const other =
      std::abs(normal.x) > steep ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  auto const across = glm::normalize(glm::cross(other, normal));
  auto const along = glm::cross(normal, across);
  double const radius = std::sqrt(u);
  double const angle = 2.0 * std::numbers::pi * v;
  return radius * std::cos(angle) * across + radius * std::sin(angle) * along +
         std::sqrt(std::max(0.0, 1.0 - u)) * normal;
}

ReceiverPoints::ReceiverPoints(Polygon const& polygon) : normal_(gpu_shading::normal(polygon)) {
  auto const mesh = triangulate(polygon);
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    auto const& a = mesh.vertices[mesh.indices[i]];
    auto const& b = mesh.vertices[mesh.indices[i + 1]];
    auto const& c = mesh.vertices[mesh.indices[i + 2]];
    double const area = 0.5 * glm::length(glm::cross(b - a, c - a));
    if (area <= 0.0) continue;
    corners_.insert(corners_.end(), {a, b, c});
    up_to_.push_back(sum += area);
  }
  for (double& share : up_to_) share /= sum;
}

glm::dvec3 ReceiverPoints::at(double u, double v) const {
  auto const found = std::upper_bound(up_to_.begin(), std::prev(up_to_.end()), u);
  auto const triangle = static_cast<std::size_t>(found - up_to_.begin());
  double const from = triangle == 0 ? 0.0 : up_to_[triangle - 1];
  // The triangle's own share of u, so that a triangle's points are as even as those of all.
  double const side = std::sqrt(std::clamp((u - from) / (*found - from), 0.0, 1.0));
  auto const& a = corners_[3 * triangle];
  auto const& b = corners_[3 * triangle + 1];
  auto const& c = corners_[3 * triangle + 2];
  return a + side * ((1.0 - v) * (b - a) + v * (c - a));
}

ReversePaths trace_paths(TransportScene const& scene, SurfaceId receiver,
                         ReceiverPoints const& places, SobolPoints const& points,
                         std::uint32_t seed, RayConditions const& conditions) {
  auto first = conditions;
  first.receiver = receiver;
  auto later = conditions;
  later.receiver = std::nullopt;
  ReversePaths paths;
  for (std::size_t i = 0; i < points.count(); ++i) {
    auto const coordinate = [&](std::size_t dimension) { return points.at(i, dimension, seed); };
    std::uint64_t const key = std::uint64_t{seed} << 32U | i;
    Path from_receiver(scene, first, key);
    Path onwards(scene, later, ~key);
    Ray ray{places.at(coordinate(0), coordinate(1)),
            cosine_direction(places.normal(), coordinate(2), coordinate(3))};
    ray.from = receiver;
    std::optional<Segment> at_sheet;
    auto const segment = from_receiver.follow(ray, &at_sheet);
    ++paths.rays;
    for (auto const& end : {std::optional(segment), at_sheet}) {
      if (end) trace_path({scene, points, seed}, onwards, i, ray, *end, paths);
    }
  }
  double const share = 1.0 / static_cast<double>(points.count());
  paths.sky = share * paths.sky;
  paths.sky_direct *= share;
  return paths;
}

}  // namespace gpu_shading

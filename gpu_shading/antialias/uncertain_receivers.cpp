#include "gpu_shading/uncertain_receivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "antialias/antialias.h"
#include "geometry/plane_frame.h"
#include "scene/casters.h"

namespace gpu_shading {
namespace {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void include(Ring const& ring) {
    for (glm::dvec3 const& vertex : ring) {
      low = glm::min(low, vertex);
      high = glm::max(high, vertex);
    }
  }

  glm::dvec3 middle() const { return 0.5 * (low + high); }

  // The middle and the corners.
  std::array<glm::dvec3, 9> places() const {
    std::array<glm::dvec3, 9> places{middle()};
    for (unsigned i = 0; i < 8; ++i) {
      places[i + 1] = {(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                       (i & 4U) != 0 ? high.z : low.z};
    }
    return places;
  }

  // Whether a ray meets them.
  bool meets(glm::dvec3 const& from, glm::dvec3 const& direction) const {
    double enters = 0.0;
    double leaves = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      double const near = low[axis] - from[axis];
      double const far = high[axis] - from[axis];
      if (direction[axis] == 0.0) {
        if (near > 0.0 || far < 0.0) return false;
        continue;
      }
      auto const [first, last] = std::minmax({near / direction[axis], far / direction[axis]});
      enters = std::max(enters, first);
      leaves = std::min(leaves, last);
    }
    return enters <= leaves;
  }
};

// Blades at equal distances.
struct Layer {
  SurfaceId first = 0;
  glm::dvec3 along{0.0};  // unit vector of their longest edges
  double distance = 0.0;  // from one to the next, across these edges, m
  std::size_t count = 0;
  Bounds bounds;

  bool is_parallel(Layer const& other) const {
    constexpr double parallel = 0.98;
    return std::abs(glm::dot(along, other.along)) > parallel;
  }
  bool has_distance_of(Layer const& other) const {
    constexpr double same = 1e-3;
    return std::abs(distance - other.distance) <= same * distance;
  }
};

// With fewer, no sample of a view aliases with the pattern of two layers.
constexpr std::size_t min_blades = 16;

std::optional<Layer> layer_of(Scene const& scene, SurfaceId id) {
  auto const repeat = repeat_of(scene, id);
  if (!repeat) return std::nullopt;
  Layer layer;
  layer.first = id;
  layer.along = glm::normalize(repeat->edge);
  layer.count = 1;
  layer.distance = glm::length(repeat->step - layer.along * glm::dot(repeat->step, layer.along));
  // Blades in line, end to end, have no distance.
  if (layer.distance <= 1e-3 * glm::length(repeat->step)) return std::nullopt;
  return layer;
}

std::vector<Layer> layers_of(Scene const& scene) {
  std::vector<Layer> layers;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (scene[id].casting == Casting::never) continue;
    auto found = layer_of(scene, id);
    if (!found) continue;
    bool const goes_on = !layers.empty() && layers.back().is_parallel(*found) &&
                         layers.back().has_distance_of(*found);
    if (!goes_on) layers.push_back(*found);
    layers.back().bounds.include(scene[id].polygon.outline);
    if (goes_on) ++layers.back().count;
  }
  std::erase_if(layers, [](Layer const& layer) { return layer.count < min_blades; });
  return layers;
}

bool may_beat(Layer const& one, Layer const& other) {
  return one.is_parallel(other) && !one.has_distance_of(other);
}

class ReceiverInScene {
 public:
  ReceiverInScene(Scene const& scene, SurfaceId id)
      : scene_(scene), id_(id), frame_(plane_frame(scene[id].polygon)) {
    if (!frame_) return;
    places_ = scene[id].polygon.outline;
    places_.push_back(frame_->origin);
  }

  bool has_area() const { return frame_.has_value(); }
  double share_of_rectangle() const {
    return area(scene_[id_].polygon) / (frame_->width * frame_->height);
  }

  bool may_be_shaded_by(SurfaceId caster, Bounds const& bounds) const {
    return caster != id_ && scene_.may_shade(id_, caster) &&
           std::ranges::any_of(bounds.places(), [&](glm::dvec3 const& place) {
             return glm::dot(frame_->normal, place - frame_->origin) > coplanar;
           });
  }

  bool is_behind_beating(std::span<Layer const> layers) const {
    std::vector<Layer const*> in_front;
    for (Layer const& layer : layers) {
      if (!may_be_shaded_by(layer.first, layer.bounds)) continue;
      auto const beats = [&](Layer const* other) {
        return may_beat(layer, *other) && (passes_both(layer.bounds, other->bounds) ||
                                           passes_both(other->bounds, layer.bounds));
      };
      if (std::ranges::any_of(in_front, beats)) return true;
      in_front.push_back(&layer);
    }
    return false;
  }

 private:
  // Whether a ray of the sun, not grazing, passes a place of some bounds and meets others.
  bool passes_both(Bounds const& bounds, Bounds const& other) const {
    constexpr double grazing = 0.2;  // cosine of incidence
    return std::ranges::any_of(bounds.places(), [&](glm::dvec3 const& to) {
      return std::ranges::any_of(places_, [&](glm::dvec3 const& from) {
        glm::dvec3 const direction = to - from;
        return glm::dot(frame_->normal, direction) > grazing * glm::length(direction) &&
               other.meets(from, direction);
      });
    });
  }

  Scene const& scene_;
  SurfaceId id_;
  std::optional<PlaneFrame> frame_;
  std::vector<glm::dvec3> places_;
};

bool any_beat(std::span<Layer const> layers) {
  return std::ranges::any_of(layers, [&](Layer const& one) {
    return std::ranges::any_of(layers, [&](Layer const& other) { return may_beat(one, other); });
  });
}

}  // namespace

UncertainReceivers find_uncertain_receivers(Scene const& scene,
                                            std::span<SurfaceId const> receivers) {
  if (receivers.empty()) return {};
  auto layers = layers_of(scene);
  if (!any_beat(layers)) layers.clear();
  std::vector<SurfaceId> sheets;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (scene[id].casting != Casting::never && scene[id].filter.find<PerforatedSheet>() != nullptr)
      sheets.push_back(id);
  }
  UncertainReceivers found;
  if (layers.empty() && sheets.empty()) return found;
  for (SurfaceId const id : receivers) {
    ReceiverInScene const receiver(scene, id);
    if (!receiver.has_area()) continue;
    if (receiver.is_behind_beating(layers)) found.behind_layers.push_back(id);
    constexpr double narrow = 0.2;
    auto const is_behind_sheet = [&](SurfaceId sheet) {
      Bounds bounds;
      bounds.include(scene[sheet].polygon.outline);
      return receiver.may_be_shaded_by(sheet, bounds);
    };
    if (receiver.share_of_rectangle() < narrow && std::ranges::any_of(sheets, is_behind_sheet)) {
      found.narrow.push_back(id);
    }
  }
  return found;
}

}  // namespace gpu_shading

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/plane_frame.h"
#include "gpu_shading/scene.h"
#include "scene/turns.h"

namespace gpu_shading {

class Shadow;

// A surface lies in a receiver's plane or behind it, and does not shade the receiver, unless one of
// its vertices is this far in front of the plane, in metres: neighbours meant to be coplanar differ
// by the rounding of a model's coordinates.
inline constexpr double coplanar = 1e-4;

// Casters are clipped at the plane itself, so that one that touches it leaves no strip lit.
// Interior surfaces are clipped this far behind it, in metres: the noise of single precision within
// a building.
inline constexpr double clearance = 1e-6;

// The smallest cosine of incidence at which a surface faces the sun, as in EnergyPlus (its
// SunIsUpValue).
inline constexpr double in_the_sun = 1e-3;

// Below this cosine of incidence, a receiver is edge-on and gets nothing.
inline constexpr double edge_on = 1e-6;

// The casters that may shade a receiver at one sun direction.
struct InView {
  std::vector<SurfaceId> casters;  // in the order of their ids
  bool warped = false;             // one is not flat: its triangles cast more than its outline
};

// A sample of the casters that may shade a receiver at one sun direction, where they are many.
struct Crowd {
  std::vector<SurfaceId> sample;  // spread evenly over all of them, in the order of their ids
  double each = 1.0;              // the number of casters for which one of these stands

  double count() const { return each * static_cast<double>(sample.size()); }
};

// The shadow of a typical caster of a crowd, with areas and lengths in the receiver's rectangle as
// the unit: means over their shadows' area, as it is seen before that of others hides it.
struct CrowdShadow {
  double area = 0.0;
  double thickness = 0.0;  // its area over its longest edge
};

// A rectangle of sun directions over a receiver, by the tangents of their angles to its normal
// towards its u and its v axis.
struct SunSector {
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};
};

// The scene's surfaces as casters, for culling in double precision, at a cost that depends on the
// casters in view. Conservative: a caster whose shadow touches the receiver is never lost.
class Casters {
 public:
  explicit Casters(Scene const& scene);

  // The casters that may shade the receiver: some part of them is clearly in front of its plane,
  // that part projected along the sun's rays onto the plane overlaps its bounding rectangle, and
  // the rule allows it. `towards_sun` must be in front of the plane.
  // The memory of `reused`, if any, is.
  InView in_view(Scene const& scene, SurfaceId receiver, PlaneFrame const& frame,
                 glm::dvec3 const& towards_sun, std::vector<SurfaceId> reused = {}) const;

  // A sample of in_view() at a cost that hardly depends on their number; empty if they are no more
  // than `few`.
  std::optional<Crowd> crowd_in_view(Scene const& scene, SurfaceId receiver,
                                     PlaneFrame const& frame, glm::dvec3 const& towards_sun,
                                     std::size_t few, std::size_t max_sample = 512) const;

  // For searches by others: the tree, of the casters' boxes, and the caster at a position in it.
  Bvh const& tree() const { return tree_; }
  SurfaceId id(std::uint32_t position) const { return casters_[position].id; }
  // Whether some casters count only where the sun meets one of their faces.
  bool any_turned_away() const { return std::ranges::any_of(kinds_, &Kind::only_turned_away); }
  // Which casters count for a receiver at one sun direction, wherever they are.
  class Counted {
   public:
    Counted(Casters const& casters, Scene const& scene, SurfaceId receiver,
            glm::dvec3 const& towards_sun)
        : casters_(casters), receiver_(casters.position_of_[receiver]), towards_sun_(towards_sun) {
      if (!scene.rule().empty()) rule_.emplace(scene.rule(), receiver);
    }
    // Whether some vertex is clearly in front of a receiver's plane.
    bool is_in_front(std::uint32_t position, glm::dvec3 const& origin,
                     glm::dvec3 const& normal) const {
      auto const points = casters_.points(casters_.casters_[position]);
      return std::ranges::any_of(points, [&](glm::dvec3 const& point) {
        return glm::dot(normal, point - origin) > coplanar;
      });
    }
    // Otherwise all but the receiver count that need not be turned away from the sun.
    bool by_rule() const { return rule_.has_value(); }
    bool at_some_sun(std::uint32_t position) const {
      return position != receiver_ && (!rule_ || rule_->counts(casters_.kinds_[position].role));
    }
    bool operator()(std::uint32_t position) const {
      return at_some_sun(position) && casters_.counts_at(position, towards_sun_);
    }

   private:
    Casters const& casters_;
    std::uint32_t receiver_;  // its position
    glm::dvec3 towards_sun_;
    std::optional<ShadingRule::Receiver> rule_;
  };

  bool only_turned_away(std::uint32_t position) const { return kinds_[position].only_turned_away; }
  // Whether the caster at a position counts by the face that the sun meets.
  bool counts_at(std::uint32_t position, glm::dvec3 const& towards_sun) const {
    return !kinds_[position].only_turned_away ||
           glm::dot(casters_[position].normal, towards_sun) <= in_the_sun;
  }
  bool is_warped(std::uint32_t position) const { return casters_[position].warped; }

  // Positions in the tree of casters among which are all that are in view from some sun direction
  // of a sector, in the order of their ids; empty where a search costs less than so many tests.
  std::optional<std::vector<std::uint32_t>> in_sector(Scene const& scene, SurfaceId receiver,
                                                      PlaneFrame const& frame,
                                                      SunSector const& sector) const;
  // in_view() of these alone.
  InView in_view_of(std::span<std::uint32_t const> positions, PlaneFrame const& frame,
                    glm::dvec3 const& towards_sun, std::vector<SurfaceId> reused = {}) const;

  // Detail of the shadows of casters in view, up to `enough`.
  Detail detail(std::span<SurfaceId const> in_view, PlaneFrame const& frame,
                glm::dvec3 const& towards_sun, double enough) const;

  // Without holes.
  CrowdShadow crowd_shadow(std::span<SurfaceId const> sample, PlaneFrame const& frame,
                           glm::dvec3 const& towards_sun) const;

 private:
  struct Caster {
    SurfaceId id = 0;
    std::uint32_t count = 0;  // of points_, from `first`: the outline
    std::size_t first = 0;
    std::size_t first_hole = 0;  // of holes_
    std::size_t holes = 0;
    glm::dvec3 normal{0.0};
    BeamFilter::Faces faces;
    bool planar = true;
    bool warped = false;
  };
  // What decides whether a caster counts, in less memory than all of it: a processor's cache can
  // hold those of a crowd.
  struct Kind {
    ShadingRule::Role role;
    bool only_turned_away = false;
  };
  void add(SurfaceId id, Surface const& surface);
  std::span<glm::dvec3 const> points(Caster const& caster) const {
    return {points_.data() + caster.first, caster.count};
  }
  std::span<Ring const> holes(Caster const& caster) const {
    return {holes_.data() + caster.first_hole, caster.holes};
  }

  // Adds a caster that counts if it is in view; with `inside`, it is.
  void add_if_in_view(Caster const& caster, bool inside, PlaneFrame const& frame, Shadow& shadow,
                      InView& found) const;
  bool is_in_view(Caster const& caster, PlaneFrame const& frame, Shadow& shadow) const;

  // All in the tree's order, in which a search goes through them.
  Bvh tree_;
  std::vector<Caster> casters_;
  std::vector<Kind> kinds_;
  std::vector<glm::dvec3> points_;
  std::vector<Ring> holes_;
  // Of casters, by id; of surfaces that cast nothing no_position.
  static constexpr std::uint32_t no_position = 0xffffffff;
  std::vector<std::uint32_t> position_of_;
};

}  // namespace gpu_shading

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gpu_shading {

// Index of a surface in its scene, in the order of Scene::add.
using SurfaceId = std::uint32_t;

// Which casters count for which receivers: a table of numbers, evaluated for every pair in view.
// Surface::casting decides first; no surface shades itself in any case.
struct ShadingRule {
  enum class Shades : std::uint8_t {
    all,          // surfaces of its own wall, and of others as the zones say
    own_wall,     // surfaces of its own wall only
    other_walls,  // surfaces of other walls only, as the zones say
    one_surface,  // Role::target only, whatever the zones say
  };

  struct Role {
    std::uint32_t wall = 0;  // the same for all surfaces that lie in one wall, and for the wall
    std::uint32_t zone = 0;  // below `zones`
    Shades shades = Shades::all;
    SurfaceId target = 0;  // of Shades::one_surface

    bool operator==(Role const&) const = default;
  };

  std::vector<Role> roles;  // by surface; empty: every caster counts for every receiver
  std::size_t zones = 0;
  // Square, by the receiver's zone and then by the caster's: 1 where casters of that zone shade
  // receivers of the other walls of this zone, otherwise 0.
  std::vector<std::uint8_t> zone_shades;

  bool empty() const { return roles.empty(); }

  // The part of the rule that is the same for every caster in view of a receiver.
  class Receiver {
   public:
    Receiver(ShadingRule const& rule, SurfaceId receiver)
        : id_(receiver),
          wall_(rule.roles[receiver].wall),
          zone_shades_(&rule.zone_shades[rule.roles[receiver].zone * rule.zones]) {}

    bool counts(Role const& caster) const {
      if (caster.shades == Shades::one_surface) return caster.target == id_;
      if (caster.wall == wall_) return caster.shades != Shades::other_walls;
      return caster.shades != Shades::own_wall && zone_shades_[caster.zone] != 0;
    }

   private:
    SurfaceId id_;
    std::uint32_t wall_;
    std::uint8_t const* zone_shades_;  // a row
  };

  bool operator()(SurfaceId receiver, SurfaceId caster) const {
    return empty() || Receiver(*this, receiver).counts(roles[caster]);
  }

  bool operator==(ShadingRule const&) const = default;
};

}  // namespace gpu_shading

#include "scene/model_rule.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace gpu_shading::energyplus {
namespace {

// Numbers names in order of appearance.
class Numbering {
 public:
  std::uint32_t operator[](std::string const& name) {
    return numbers_.try_emplace(name, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

// The shading zone groups that a zone is in; the last of them is its own, as in EnergyPlus.
struct Groups {
  std::set<std::string_view> in;
  std::string_view own;

  bool operator<(Groups const& other) const {
    return std::tie(in, own) < std::tie(other.in, other.own);
  }
};

Groups groups_of(ShadingInput const& input, std::string const& zone) {
  Groups groups;
  for (auto const& group : input.shading_zone_groups) {
    auto const zones = input.zone_lists.find(group);
    if (zones == input.zone_lists.end() || !zones->second.contains(zone)) continue;
    groups.in.insert(group);
    groups.own = group;
  }
  return groups;
}

// Numbers the model's zones: the same for those in the same groups, so that the rule's matrix is
// small however many there are. 0 stands for no zone.
class ZoneNumbering {
 public:
  explicit ZoneNumbering(ShadingInput const& input) : input_(input) {}

  std::uint32_t number_of_wall(std::string const& wall) {
    auto const zone = input_.zone_of.find(wall);
    if (zone == input_.zone_of.end() || zone->second.empty()) return 0;
    auto const [known, added] = numbers_.try_emplace(zone->second, 0);
    if (!added) return known->second;
    auto const groups = groups_of(input_, zone->second);
    auto const [number, first] =
        by_groups_.try_emplace(groups, static_cast<std::uint32_t>(groups_.size()));
    if (first) {
      groups_.push_back(groups);
      zones_.emplace_back();
    }
    zones_[number->second].push_back(zone->second);
    return known->second = number->second;
  }

  std::size_t size() const { return groups_.size(); }
  std::vector<std::vector<std::string>> const& zones() const { return zones_; }

  bool shades(std::size_t receiver, std::size_t caster) const {
    if (input_.minimal_shadowing) return false;  // only reveals cast shadows
    if (caster == 0) return true;
    if (input_.disable_within_groups && input_.disable_between_groups) return false;
    auto const& own = groups_[receiver].own;
    if (own.empty()) return true;
    auto const& in = groups_[caster].in;
    return std::none_of(in.begin(), in.end(), [&](std::string_view group) {
      return group == own ? input_.disable_within_groups : input_.disable_between_groups;
    });
  }

 private:
  ShadingInput const& input_;
  std::unordered_map<std::string, std::uint32_t> numbers_;  // by zone
  std::map<Groups, std::uint32_t> by_groups_;
  std::vector<Groups> groups_{Groups()};
  std::vector<std::vector<std::string>> zones_{{}};
};

std::string describe_zones(std::vector<std::string> const& zones) {
  if (zones.empty()) return "shading surfaces";
  constexpr std::size_t most = 10;
  if (zones.size() <= most) return fmt::format("{}", fmt::join(zones, ", "));
  return fmt::format("{} and {} more zones", fmt::join(zones.begin(), zones.begin() + most, ", "),
                     zones.size() - most);
}

}  // namespace

std::optional<std::string> window_of_reveal(std::string const& surface) {
  // EnergyPlus's names are upper case otherwise.
  constexpr std::string_view mark = " reveal ";
  auto const at = surface.rfind(mark);
  if (at == std::string::npos) return std::nullopt;
  return surface.substr(0, at);
}

ModelRule make_shading_rule(ShadingInput const& input, Scene const& scene,
                            std::vector<WallCopy> const& copies) {
  std::unordered_map<std::string_view, SurfaceId> ids;
  for (SurfaceId id = 0; id < scene.size(); ++id) ids.try_emplace(scene[id].name, id);
  ModelRule made;
  Numbering walls;
  ZoneNumbering zones(input);
  made.rule.roles.resize(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const& name = scene[id].name;
    auto& role = made.rule.roles[id];
    auto const window = window_of_reveal(name);
    auto const wall = input.base_surface(window.value_or(name));
    role.wall = walls[wall];
    role.zone = zones.number_of_wall(wall);
    if (!window) continue;
    // Within one wall, a set-back window is behind its openings, whatever the model's rules say.
    role.shades = ShadingRule::Shades::one_surface;
    auto const found = ids.find(*window);
    role.target = found == ids.end() ? id : found->second;
  }
  for (auto const& [wall, copy] : copies) {
    made.rule.roles[wall].shades = ShadingRule::Shades::own_wall;
    made.rule.roles[copy].shades = ShadingRule::Shades::other_walls;
  }
  made.zones = zones.zones();
  made.rule.zones = zones.size();
  for (std::size_t receiver = 0; receiver < zones.size(); ++receiver) {
    for (std::size_t caster = 0; caster < zones.size(); ++caster) {
      made.rule.zone_shades.push_back(zones.shades(receiver, caster) ? 1 : 0);
    }
  }
  return made;
}

std::string describe(ModelRule const& made) {
  std::string text;
  auto const& rule = made.rule;
  for (std::size_t receiver = 0; receiver < rule.zones; ++receiver) {
    std::vector<std::string> others;
    for (std::size_t caster = 0; caster < rule.zones; ++caster) {
      if (rule.zone_shades[receiver * rule.zones + caster] != 0) continue;
      others.push_back(describe_zones(made.zones[caster]));
    }
    if (others.empty()) continue;
    text += fmt::format("no shadows on {} from {}\n", describe_zones(made.zones[receiver]),
                        fmt::join(others, "; "));
  }
  return text;
}

}  // namespace gpu_shading::energyplus

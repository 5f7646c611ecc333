#include "session/shading_rule.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <unordered_map>

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view reveal_mark = " reveal ";

constexpr std::string_view no_openings = " without openings";

// The window that a reveal belongs to, or "".
std::string reveal_owner(std::string const& name) {
  auto const at = name.rfind(reveal_mark);
  return at == std::string::npos ? std::string{} : name.substr(0, at);
}

// What the rule needs of each surface.
struct Place {
  std::string name;
  std::string window;   // that this is a reveal of, or ""
  std::string base;     // the base surface that it lies in; itself for a base surface
  std::string zone;     // "" for shading surfaces
  bool closed = false;  // a wall's copy without openings
  bool open = false;    // a wall that has such a copy
};

Place find_place(ShadingInput const& input, std::set<std::string_view> const& names,
                 std::string const& name) {
  Place place;
  place.name = name;
  place.window = reveal_owner(name);
  place.closed = name.ends_with(no_openings);
  place.open = names.contains(without_openings(name));
  std::string surface = place.window.empty() ? name : place.window;
  if (place.closed) surface.resize(surface.size() - no_openings.size());
  place.base = input.base_surface(surface);
  if (auto const zone = input.zone_of.find(place.base); zone != input.zone_of.end()) {
    place.zone = zone->second;
  }
  return place;
}

std::vector<Place> find_places(ShadingInput const& input, std::vector<std::string> const& names) {
  std::set<std::string_view> const all(names.begin(), names.end());
  std::vector<Place> places;
  places.reserve(names.size());
  for (auto const& name : names) places.push_back(find_place(input, all, name));
  return places;
}

// For each zone of a group, the zones whose surfaces do not shade it. A zone in several groups
// counts for the last, as in EnergyPlus.
std::unordered_map<std::string, std::set<std::string>> find_disabled(ShadingInput const& input) {
  std::unordered_map<std::string, std::string> group_of;
  for (auto const& group : input.shading_zone_groups) {
    auto const zones = input.zone_lists.find(group);
    if (zones == input.zone_lists.end()) continue;
    for (auto const& zone : zones->second) group_of[zone] = group;
  }
  std::unordered_map<std::string, std::set<std::string>> disabled;
  for (auto const& [zone, own] : group_of) {
    for (auto const& group : input.shading_zone_groups) {
      bool const off = group == own ? input.disable_within_groups : input.disable_between_groups;
      auto const zones = input.zone_lists.find(group);
      if (!off || zones == input.zone_lists.end()) continue;
      disabled[zone].insert(zones->second.begin(), zones->second.end());
    }
  }
  return disabled;
}

// Numbers names in the order in which they come.
class Numbering {
 public:
  std::uint32_t operator[](std::string const& name) {
    return numbers_.try_emplace(name, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

}  // namespace

bool is_reveal(std::string const& name) { return name.find(reveal_mark) != std::string::npos; }

std::string without_openings(std::string const& wall) { return wall + std::string(no_openings); }

ShadingRule make_shading_rule(ShadingInput const& input, std::vector<std::string> const& names) {
  bool const all_disabled = input.disable_within_groups && input.disable_between_groups;
  auto const places = std::make_shared<std::vector<Place> const>(find_places(input, names));
  auto const disabled = find_disabled(input);
  return [places, disabled, all_disabled, minimal = input.minimal_shadowing](SurfaceId receiver,
                                                                             SurfaceId caster) {
    Place const& r = (*places)[receiver];
    Place const& c = (*places)[caster];
    // What is in one wall: whatever the model's rules say, a set-back window lies behind its
    // openings.
    if (!c.window.empty()) return c.window == r.name;
    if (c.base == r.base) return !c.closed;
    if (c.open) return false;
    if (minimal) return false;  // no shadows but of reveals
    if (c.zone.empty()) return true;
    if (all_disabled) return false;
    auto const zones = disabled.find(r.zone);
    return zones == disabled.end() || !zones->second.contains(c.zone);
  };
}

std::vector<std::uint32_t> describe_shading_rule(ShadingInput const& input,
                                                 std::vector<std::string> const& names) {
  auto const flag = [](bool value) { return static_cast<std::uint32_t>(value ? 1 : 0); };
  auto const disabled = find_disabled(input);
  Numbering surfaces;
  Numbering zones;
  surfaces[""];
  zones[""];
  std::vector<std::uint32_t> numbers{flag(input.minimal_shadowing),
                                     flag(input.disable_within_groups),
                                     flag(input.disable_between_groups)};
  auto const places = find_places(input, names);
  std::vector<std::string> in_order{""};  // zones, by number
  for (auto const& place : places) {
    numbers.insert(numbers.end(),
                   {surfaces[place.name], surfaces[place.window], surfaces[place.base],
                    zones[place.zone], flag(place.closed), flag(place.open)});
    if (zones[place.zone] == in_order.size()) in_order.push_back(place.zone);
  }
  for (auto const& receiver : in_order) {
    auto const found = disabled.find(receiver);
    for (auto const& caster : in_order) {
      numbers.push_back(flag(found != disabled.end() && found->second.contains(caster)));
    }
  }
  return numbers;
}

}  // namespace gpu_shading::energyplus

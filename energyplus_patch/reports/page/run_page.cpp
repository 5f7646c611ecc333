#include "reports/page/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <string_view>

#include "gpu_shading/image.h"
#include "platform/text.h"
#include "reports/page/page_parts.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::ordered_json;

// Vertices that a page may have: with three coordinates of two bytes, a third more as text.
constexpr std::size_t max_vertices = 150000;
// What the text of modules takes of them.
constexpr std::size_t vertices_of_module = 3;
constexpr std::size_t codes_of_vertex = 6;
// More names than this of surfaces that only cast shadows are left out.
constexpr std::size_t max_caster_names = 3000;
constexpr std::size_t max_in_ring = 60000;

std::string base64(std::span<std::uint8_t const> bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    auto const byte = [&](std::size_t k) {
      return i + k < bytes.size() ? std::uint32_t{bytes[i + k]} : 0U;
    };
    std::uint32_t const three = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (std::size_t k = 0; k < 4; ++k) {
      bool const there = k == 0 || i + k - 1 < bytes.size();
      text += there ? digits[three >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

// Little-endian.
std::string base64(std::vector<std::uint16_t> const& values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (auto const value : values) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xffU));
    bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
  }
  return base64(bytes);
}

// For a script element, which ends at the first "</script", whatever is around it.
std::string script_text(Json const& json) {
  std::string text;
  // Names in IDF files may be in Latin-1.
  for (char const character : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (character == '<') {
      text += "\\u003c";
    } else {
      text += character;
    }
  }
  return text;
}

std::size_t vertices_of(PageSurface const& surface) {
  auto const& polygon = surface.polygon;
  auto const once =
      std::accumulate(polygon.holes.begin(), polygon.holes.end(), polygon.outline.size(),
                      [](std::size_t sum, Ring const& hole) { return sum + hole.size(); });
  return once * (1 + surface.moved.size());
}

std::size_t vertices_of(PageModules const& modules) {
  std::size_t vertices = 0;
  for (auto const& field : modules.fields) {
    vertices += vertices_of_module * field.modules.size();
    for (auto const& codes : field.strings) vertices += codes.size() / codes_of_vertex;
  }
  return vertices;
}

bool is_drawable(Polygon const& polygon) {
  auto const small = [](Ring const& ring) { return ring.size() <= max_in_ring; };
  return small(polygon.outline) && polygon.holes.size() <= max_in_ring &&
         std::ranges::all_of(polygon.holes, small);
}

struct Extent {
  glm::dvec3 low{0.0};
  double step = 1.0;  // m
};

Extent extent_of(std::vector<PageSurface> const& surfaces) {
  glm::dvec3 low(HUGE_VAL);
  glm::dvec3 high(-HUGE_VAL);
  auto const include = [&](Polygon const& polygon) {
    for (auto const& vertex : polygon.outline) {
      low = glm::min(low, vertex);
      high = glm::max(high, vertex);
    }
  };
  for (auto const& surface : surfaces) {
    include(surface.polygon);
    std::ranges::for_each(surface.moved, include);
  }
  if (!(low.x <= high.x)) return {};
  auto const size = high - low;
  return {low, std::max({size.x, size.y, size.z, 1e-3}) / UINT16_MAX};
}

// In steps from the lowest corner.
void add_places(std::vector<std::uint16_t>& places, Ring const& ring, Extent const& extent) {
  for (auto const& vertex : ring) {
    auto const place = glm::round((vertex - extent.low) / extent.step);
    for (int axis = 0; axis < 3; ++axis) {
      places.push_back(
          static_cast<std::uint16_t>(std::clamp(place[axis], 0.0, double{UINT16_MAX})));
    }
  }
}

// The geometry: `shape` has, for each surface, its style, the number of its rings and of the
// vertices of each; `places` the vertices in steps from the lowest corner.
Json geometry_of(RunPage const& page, Extent const& extent) {
  std::vector<std::uint16_t> shape;
  std::vector<std::uint16_t> places;
  auto const add = [&](Ring const& ring) {
    shape.push_back(static_cast<std::uint16_t>(ring.size()));
    add_places(places, ring, extent);
  };
  for (auto const& surface : page.surfaces) {
    auto const& polygon = surface.polygon;
    shape.push_back(static_cast<std::uint16_t>(surface.style));
    if (!is_drawable(polygon)) {
      shape.push_back(0);
      continue;
    }
    shape.push_back(static_cast<std::uint16_t>(1 + polygon.holes.size()));
    add(polygon.outline);
    for (auto const& hole : polygon.holes) add(hole);
  }
  return {{"low", {extent.low.x, extent.low.y, extent.low.z}},
          {"step", extent.step},
          {"shape", base64(shape)},
          {"places", base64(places)}};
}

// `places` has the vertices of each of the surfaces at each position, as geometry_of has them.
Json motions_of(RunPage const& page, Extent const& extent) {
  Json list = Json::array();
  for (std::size_t number = 0; number < page.motions.size(); ++number) {
    auto const& motion = page.motions[number];
    Json surfaces = Json::array();
    std::vector<std::uint16_t> places;
    for (std::size_t i = 0; i < page.surfaces.size(); ++i) {
      auto const& surface = page.surfaces[i];
      if (surface.motion != number || !is_drawable(surface.polygon)) continue;
      surfaces.push_back(i);
      for (auto const& polygon : surface.moved) {
        add_places(places, polygon.outline, extent);
        for (auto const& hole : polygon.holes) add_places(places, hole, extent);
      }
    }
    list.push_back({{"name", motion.name},
                    {"unit", motion.unit},
                    {"positions", motion.positions},
                    {"hours", base64(motion.hours)},
                    {"surfaces", std::move(surfaces)},
                    {"places", base64(places)}});
  }
  return list;
}

Json to_json(PageStyle const& style) {
  constexpr std::array<char const*, 5> kinds{"receiver", "opaque", "glass", "screen", "foliage"};
  return {{"kind", kinds.at(static_cast<std::size_t>(style.kind))},
          {"passes", style.passes},
          {"share", style.share ? Json(*style.share) : Json()},
          {"without", style.without},
          {"hole", style.hole},
          {"arrangement", style.arrangement},
          {"size", style.size},
          {"length", style.length},
          {"pitch", style.pitch},
          {"rowPitch", style.row_pitch}};
}

// As many digits as the page's table has.
double rounded(double value, double digits) { return std::round(value * digits) / digits; }

Json to_json(PageReceiver const& receiver) {
  constexpr double thousandths = 1e3;
  constexpr double tenths = 10.0;
  constexpr double ten_thousandths = 1e4;
  Json light = Json::array();
  for (auto const& months : receiver.months) {
    auto& list = light.emplace_back(Json::array());
    for (double const month : months) list.push_back(rounded(month, tenths));
  }
  std::vector<std::uint16_t> mean_days;
  for (auto const& months : receiver.mean_days) {
    for (auto const& hours : months) {
      for (double const hour : hours) {
        mean_days.push_back(static_cast<std::uint16_t>(std::lround(hour)));
      }
    }
  }
  return {rounded(receiver.area, thousandths),
          rounded(receiver.azimuth, tenths),
          rounded(receiver.tilt, tenths),
          receiver.mean ? Json(rounded(*receiver.mean, ten_thousandths)) : Json(),
          rounded(receiver.beam, tenths),
          rounded(receiver.beam * receiver.area, tenths),
          receiver.window ? 1 : 0,
          light,
          base64(mean_days)};
}

Json to_json(PageDay const& day) {
  Json hours = Json::array();
  for (auto const& [hour, sun, beam] : day.hours) {
    constexpr double digits = 1e4;
    double const azimuth = glm::degrees(sun.azimuth);
    hours.push_back({hour, rounded(azimuth < 0.0 ? azimuth + 360.0 : azimuth, digits),
                     rounded(glm::degrees(sun.altitude), digits), std::lround(beam)});
  }
  return {{"month", day.month}, {"day", day.day}, {"hours", hours}};
}

float max_of(std::vector<PageMap> const& maps, std::vector<float> PageMap::*values) {
  float most = 0.0F;
  for (auto const& map : maps) {
    // Not greater than it: what is not a number.
    for (float const value : map.*values) most = value > most ? value : most;
  }
  return most;
}

// In steps of a 250th of the largest value of all maps, 255 where there is no cell.
std::string map_codes(std::vector<float> const& values, float most) {
  constexpr float steps = 250.0F;
  constexpr std::uint8_t none = 255;
  std::vector<std::uint8_t> codes;
  codes.reserve(values.size());
  for (float const value : values) {
    bool const known = value == value;
    codes.push_back(
        known ? static_cast<std::uint8_t>(std::lround(most > 0.0F ? steps * value / most : 0.0F))
              : none);
  }
  return base64(codes);
}

Json maps_of(RunPage const& page) {
  auto const max_hours = max_of(page.maps, &PageMap::hours);
  auto const max_energy = max_of(page.maps, &PageMap::energy);
  auto const numbers = [](glm::dvec3 const& vector) { return Json{vector.x, vector.y, vector.z}; };
  Json list = Json::array();
  for (auto const& map : page.maps) {
    list.push_back({{"receiver", map.receiver},
                    {"corner", numbers(map.corner)},
                    {"right", numbers(map.right)},
                    {"up", numbers(map.up)},
                    {"columns", map.columns},
                    {"rows", map.rows},
                    {"means", {map.mean_hours, map.mean_energy}},
                    {"hours", map_codes(map.hours, max_hours)},
                    {"energy", map_codes(map.energy, max_energy)}});
  }
  return {{"from", page.maps_from},
          {"to", page.maps_to},
          {"most", {max_hours, max_energy}},
          {"list", list}};
}

Json skies_of(RunPage const& page) {
  Json list = Json::array();
  for (auto const& [receiver, view, unshaded, codes] : page.skies) {
    constexpr double thousandths = 1e3;
    list.push_back({{"receiver", receiver},
                    {"view", rounded(view, thousandths)},
                    {"unshaded", rounded(unshaded, thousandths)},
                    {"codes", base64(codes)}});
  }
  return {{"step", RunPage::sky_step}, {"levels", RunPage::sky_levels}, {"behind", RunPage::behind},
          {"kinds", page.sky_kinds},   {"state", page.sky_state},       {"list", list}};
}

// Heights in 65,534ths of their range, 65,535 where there is no ground.
Json terrain_of(PageTerrain const& terrain) {
  if (terrain.nodes == 0) return nullptr;
  float low = HUGE_VALF;
  float high = -HUGE_VALF;
  for (float const height : terrain.heights) {
    low = height < low ? height : low;
    high = height > high ? height : high;
  }
  constexpr std::uint16_t none = UINT16_MAX;
  float const rise = std::max(high - low, 1e-3F) / (none - 1);
  std::vector<std::uint16_t> codes;
  codes.reserve(terrain.heights.size());
  for (float const height : terrain.heights) {
    codes.push_back(
        std::isnan(height) ? none : static_cast<std::uint16_t>(std::lround((height - low) / rise)));
  }
  return {{"nodes", terrain.nodes},
          {"low", {terrain.low.x, terrain.low.y, low}},
          {"step", {terrain.step.x, terrain.step.y}},
          {"rise", rise},
          {"none", none},
          {"heights", base64(codes)}};
}

Json modules_of(PageModules const& modules) {
  Json fields = Json::array();
  for (auto const& field : modules.fields) {
    Json list = Json::array();
    for (auto const& [string, column, row, loss] : field.modules) {
      list.push_back({string, column, row, loss});
    }
    Json strings = Json::array();
    for (auto const& codes : field.strings) strings.push_back(base64(codes));
    fields.push_back({{"surface", field.surface},
                      {"width", field.width},
                      {"height", field.height},
                      {"modules", list},
                      {"strings", strings}});
  }
  return {{"days", modules.days}, {"fields", fields}, {"dark", PageModules::dark}};
}

// From 0 to 1.
Json colours() {
  Json list = Json::array();
  constexpr int steps = 64;
  for (int i = 0; i <= steps; ++i) {
    auto const colour = fraction_colour(static_cast<double>(i) / steps);
    list.push_back({std::lround(colour.x), std::lround(colour.y), std::lround(colour.z)});
  }
  return list;
}

Json content_of(RunPage const& page) {
  Json names = Json::array();
  bool const all = page.surfaces.size() - page.receivers.size() <= max_caster_names;
  auto const named = all ? page.surfaces.size() : page.receivers.size();
  for (std::size_t i = 0; i < named; ++i) names.push_back(page.surfaces[i].name);
  auto const extent = extent_of(page.surfaces);
  Json content{{"title", page.title}, {"names", names}, {"geometry", geometry_of(page, extent)}};
  content["motions"] = motions_of(page, extent);
  content["maps"] = maps_of(page);
  content["skies"] = skies_of(page);
  content["terrain"] = terrain_of(page.terrain);
  content["modules"] = modules_of(page.modules);
  content["facts"] = page.facts;
  content["notes"] = page.notes;
  content["colours"] = colours();
  content["turnedAway"] = RunPage::turned_away;
  content["percents"] = base64(page.percents);
  for (auto const* const key : {"shares", "styles", "receivers", "days"}) {
    content[key] = Json::array();
  }
  for (auto const& share : page.shares) content["shares"].push_back(base64(share));
  for (auto const& style : page.styles) content["styles"].push_back(to_json(style));
  for (auto const& receiver : page.receivers) content["receivers"].push_back(to_json(receiver));
  for (auto const& day : page.days) content["days"].push_back(to_json(day));
  return content;
}

// The text with @name@ replaced. What is put in is not searched for names.
std::string filled(std::string_view text, std::map<std::string_view, std::string> const& values) {
  std::string all;
  while (!text.empty()) {
    auto const mark = text.find('@');
    all += text.substr(0, mark);
    if (mark == std::string_view::npos) break;
    auto const end = text.find('@', mark + 1);
    all += values.at(text.substr(mark + 1, end - mark - 1));
    text.remove_prefix(end + 1);
  }
  return all;
}

}  // namespace

void simplify(RunPage& page) {
  auto const first = page.receivers.size();
  std::vector<std::size_t> casters(page.surfaces.size() - first);
  std::iota(casters.begin(), casters.end(), first);
  std::vector<double> areas(page.surfaces.size(), 0.0);
  for (auto const i : casters) areas[i] = area(page.surfaces[i].polygon);
  std::ranges::stable_sort(casters,
                           [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  std::vector<bool> kept(page.surfaces.size(), false);
  std::size_t vertices = vertices_of(page.modules);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < first; ++i) {
    kept[i] = true;
    vertices += vertices_of(page.surfaces[i]);
  }
  for (auto const i : casters) {
    vertices += vertices_of(page.surfaces[i]);
    if (vertices > max_vertices) break;
    kept[i] = is_drawable(page.surfaces[i].polygon);
    drawn += kept[i] ? 1 : 0;
  }
  if (drawn < casters.size()) {
    page.notes.push_back(
        fmt::format("The drawing is simplified: it has {} of {} casting surfaces, the largest. "
                    "The sunlit fractions are those of the whole model.",
                    drawn, casters.size()));
  }
  std::vector<PageSurface> surfaces;
  for (std::size_t i = 0; i < page.surfaces.size(); ++i) {
    if (kept[i]) surfaces.push_back(std::move(page.surfaces[i]));
  }
  page.surfaces = std::move(surfaces);
}

std::string to_html(RunPage page) {
  simplify(page);
  return filled(page_parts::page_html, {{"marker", page_marker},
                                        {"title", markup_text(page.title)},
                                        {"style", page_parts::page_css},
                                        {"content", script_text(content_of(page))},
                                        {"library", page_parts::three_js},
                                        {"scripts", page_parts::scripts}});
}

}  // namespace gpu_shading::energyplus

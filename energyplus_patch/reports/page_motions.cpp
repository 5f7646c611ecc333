#include "reports/page_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/shade_motion.h"

namespace gpu_shading::energyplus {
namespace {

// Vertices that the surfaces of a shade may have at all of its positions.
constexpr std::size_t max_moved_vertices = 60000;

// By hour of the page, at its end; at rest where there is none.
std::vector<double> positions_at_hours(RunPage const& page, std::size_t shade, double rest,
                                       PositionRecord::Hours const& known) {
  std::vector<double> positions;
  for (auto const& day : page.days) {
    for (auto const& hour : day.hours) {
      auto const found = known.find({day.month, day.day, hour.hour});
      positions.push_back(found == known.end() ? rest : (*found->second)[shade].position);
    }
  }
  return positions;
}

// Some of many, evenly spread, with the first and the last.
std::vector<double> thinned(std::vector<double> const& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<double> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * (all.size() - 1) / (most - 1)]);
  return some;
}

std::uint16_t nearest(std::vector<double> const& positions, double wanted) {
  auto const found = std::ranges::min_element(
      positions, {}, [&](double position) { return std::abs(position - wanted); });
  return static_cast<std::uint16_t>(found - positions.begin());
}

}  // namespace

void add_motions(RunPage& page, SceneAssembly const& assembly, std::span<SurfaceId const> ids,
                 RunDay::Kind kind, PositionRecord const& record) {
  auto const& shades = assembly.model().moving_shades;
  auto const known = record.ends_of_hours(kind);
  std::vector<std::size_t> vertices(shades.size(), 1);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto const shade = assembly.moving_shade_of(ids[i]);
    if (shade) vertices[*shade] += page.surfaces[i].polygon.outline.size();
  }
  for (std::size_t i = 0; i < shades.size(); ++i) {
    auto const at_hours = positions_at_hours(page, i, shades[i].rest, known);
    auto all = at_hours;
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    PageMotion motion{shades[i].name, std::string(shades[i].unit()), {}, {}};
    motion.positions = thinned(all, std::max<std::size_t>(2, max_moved_vertices / vertices[i]));
    if (motion.positions.size() < all.size()) {
      page.notes.push_back(fmt::format("{} is drawn at {} of its {} positions.", shades[i].name,
                                       motion.positions.size(), all.size()));
    }
    for (double const position : at_hours) {
      motion.hours.push_back(nearest(motion.positions, position));
    }
    page.motions.push_back(std::move(motion));
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto const shade = assembly.moving_shade_of(ids[i]);
    if (!shade) continue;
    page.surfaces[i].motion = *shade;
    for (double const position : page.motions[*shade].positions) {
      page.surfaces[i].moved.push_back(
          moved(assembly.surfaces()[ids[i]].polygon, shades[*shade], position));
    }
  }
}

}  // namespace gpu_shading::energyplus

#include "model/input/screen_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "model/extensions/extension_fields.h"
#include "platform/naming.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::uint16_t solid = 65535;

// The bounding rectangle of a surface along a tile's axes, relative to the tile's (0, 0).
struct Bounds {
  double low_u = std::numeric_limits<double>::infinity();
  double low_v = std::numeric_limits<double>::infinity();
  double high_u = -std::numeric_limits<double>::infinity();
  double high_v = -std::numeric_limits<double>::infinity();
};

Bounds bounds_of(Polygon const& polygon, double rotation) {
  auto const axes = tile_axes(polygon, {0.0, 0.0, rotation});
  Bounds bounds;
  for (auto const& vertex : polygon.outline) {
    double const u = glm::dot(vertex - axes.origin, axes.u);
    double const v = glm::dot(vertex - axes.origin, axes.v);
    bounds.low_u = std::min(bounds.low_u, u);
    bounds.low_v = std::min(bounds.low_v, v);
    bounds.high_u = std::max(bounds.high_u, u);
    bounds.high_v = std::max(bounds.high_v, v);
  }
  return bounds;
}

bool covers_each_surface(ScreenTexture const& texture) { return !texture.width && !texture.height; }

std::pair<double, double> tile_size(ScreenTexture const& texture, Polygon const& polygon,
                                    double rotation, std::optional<TextureAxes> const& axes) {
  if (covers_each_surface(texture) && axes) return {glm::length(axes->u), glm::length(axes->v)};
  if (covers_each_surface(texture)) {
    auto const bounds = bounds_of(polygon, rotation);
    return {bounds.high_u - bounds.low_u, bounds.high_v - bounds.low_v};
  }
  double const shape = static_cast<double>(texture.info.height) / texture.info.width;
  double const width = texture.width ? *texture.width : *texture.height / shape;
  return {width, texture.height.value_or(width * shape)};
}

std::string millimetres(double metres) { return fmt::format("{:.6g}", 1000.0 * metres); }

std::string describe_holes(Perforation const& perforation) {
  auto const size = millimetres(perforation.size);
  switch (perforation.hole) {
    case Hole::Round:
      return fmt::format("round holes {} mm", size);
    case Hole::Square:
      return fmt::format("square holes {} mm", size);
    case Hole::Slotted:
      return fmt::format("slots {} x {} mm", size, millimetres(perforation.length));
    case Hole::Hexagonal:
      break;
  }
  return fmt::format("hexagonal holes {} mm", size);
}

std::string describe_rows(Perforation const& perforation) {
  if (perforation.row_pitch > 0.0) {
    return fmt::format("{}, pitch {} mm, rows {} mm apart",
                       perforation.arrangement == Arrangement::Straight ? "straight" : "staggered",
                       millimetres(perforation.pitch), millimetres(perforation.row_pitch));
  }
  std::string arrangement = "straight";
  if (perforation.arrangement == Arrangement::Staggered45) arrangement = "45 degrees staggered";
  if (perforation.arrangement == Arrangement::Staggered60) arrangement = "60 degrees staggered";
  return fmt::format("{}, pitch {} mm", arrangement, millimetres(perforation.pitch));
}

std::string describe_sheet(PerforatedScreen const& screen) {
  return fmt::format("{:.1f} % open", 100.0 * screen.open_fraction());
}

}  // namespace

Error screen_error(std::string const& where, std::string message) {
  auto const field = message.substr(0, message.find(" is "));
  if (!message.empty() && std::islower(static_cast<unsigned char>(message.front())) != 0) {
    for (std::size_t i = 0; i < field.size(); ++i) {
      if (i > 0 && message[i - 1] != ' ') continue;
      message[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(message[i])));
    }
  }
  return Error(fmt::format("{}: {}", where, message));
}

ScreenMaker::ScreenMaker(std::string object, std::string where, Holes holes, Sheet const& sheet,
                         ScreenPlacement const& placement)
    : object_(std::move(object)),
      where_(std::move(where)),
      holes_(std::move(holes)),
      sheet_(sheet),
      placement_(placement) {
  if (auto const* const pattern = std::get_if<HolePattern>(&holes_)) {
    made_.push_back(make_of(*pattern));
    return;
  }
  // One texel stands for the image, so that invalid numbers are rejected before it is read.
  auto const& texture = std::get<ScreenTexture>(holes_);
  PerforatedScreen const check(
      OpacityTile(texture.width.value_or(1.0), texture.height.value_or(1.0), 1, 1,
                  std::vector<std::uint16_t>{solid}, texture.threshold),
      sheet_);
}

std::shared_ptr<PerforatedScreen const> ScreenMaker::make(
    Polygon const& polygon, std::optional<TextureAxes> const& texture) {
  return find_or_make(polygon, texture).screen;
}

std::string ScreenMaker::describe(Polygon const& polygon,
                                  std::optional<TextureAxes> const& texture) {
  return find_or_make(polygon, texture).description;
}

bool ScreenMaker::stretches() const {
  auto const* const texture = std::get_if<ScreenTexture>(&holes_);
  return texture != nullptr && covers_each_surface(*texture);
}

ScreenPlacement ScreenMaker::placement(Polygon const& polygon,
                                       std::optional<TextureAxes> const& texture) const {
  if (texture) return placement_on(*texture, polygon);
  if (!stretches()) return placement_;
  // On a rectangle, without rotation, the bounding rectangle begins at the second vertex.
  auto const bounds = bounds_of(polygon, placement_.rotation);
  double const c = std::cos(placement_.rotation);
  double const s = std::sin(placement_.rotation);
  return {placement_.origin_u + c * bounds.low_u - s * bounds.low_v,
          placement_.origin_v + s * bounds.low_u + c * bounds.low_v, placement_.rotation};
}

ScreenPlacement ScreenMaker::placement_on(TextureAxes const& texture,
                                          Polygon const& polygon) const {
  auto from = texture.origin;
  if (stretches()) {
    // Tiles repeat: using the one nearest to the polygon minimises the error if scales differ.
    auto const& outline = polygon.outline;
    auto const middle = std::accumulate(outline.begin(), outline.end(), glm::dvec3(0.0)) /
                        static_cast<double>(outline.size());
    for (auto const& axis : {texture.u, texture.v}) {
      from += std::round(glm::dot(middle - texture.origin, axis) / glm::dot(axis, axis)) * axis;
    }
  }
  auto const axes = tile_axes(polygon, {});
  auto const along = glm::normalize(texture.u);
  auto const across = glm::cross(normal(polygon), along);
  from += placement_.origin_u * along + placement_.origin_v * across - axes.origin;
  return {glm::dot(from, axes.u), glm::dot(from, axes.v),
          std::atan2(glm::dot(along, axes.v), glm::dot(along, axes.u)) + placement_.rotation};
}

ScreenMaker::Made const& ScreenMaker::find_or_make(Polygon const& polygon,
                                                   std::optional<TextureAxes> const& axes) {
  auto const* const texture = std::get_if<ScreenTexture>(&holes_);
  if (texture == nullptr) return made_.front();
  auto const [width, height] = tile_size(*texture, polygon, placement_.rotation, axes);
  // Equal surfaces can differ by the rounding of their vertices.
  constexpr double rounding = 1e-4;
  auto const same = [&](double a, double b) {
    return std::abs(a - b) <= (axes ? std::max(rounding, same_scale * b) : rounding);
  };
  for (auto const& made : made_) {
    if (same(made.width, width) && same(made.height, height)) return made;
  }
  try {
    made_.push_back(make_of(*texture, width, height));
  } catch (Error const& error) {
    throw screen_error(where_, error.what());
  }
  return made_.back();
}

ScreenMaker::Made ScreenMaker::make_of(HolePattern const& pattern) {
  auto const screen = std::make_shared<PerforatedScreen const>(pattern, sheet_);
  return {pattern.width(), pattern.height(), screen,
          fmt::format("perforated ({}, {}, {}, {} mm thick)", describe_holes(pattern.perforation()),
                      describe_rows(pattern.perforation()), describe_sheet(*screen),
                      millimetres(sheet_.thickness))};
}

ScreenMaker::Made ScreenMaker::make_of(ScreenTexture const& texture, double width, double height) {
  auto tile = made_.empty() ? OpacityTile(width, height, texture.info.width, texture.info.height,
                                          read_texture(texture), texture.threshold)
                            : made_.front().screen->tile()->stretched(width, height);
  auto const screen = std::make_shared<PerforatedScreen const>(std::move(tile), sheet_);
  double const open = screen->open_fraction();
  if (warnings_.empty() && (open <= 0.0 || open >= 1.0)) {
    warnings_.push_back(fmt::format("{} {}: {} is {} everywhere, by its {}",
                                    extension::perforated_screen::type, object_, texture.name,
                                    open <= 0.0 ? "solid" : "open",
                                    texture.info.alpha ? "alpha channel" : "luminance"));
  }
  return {width, height, screen,
          fmt::format("perforated (texture {} {} x {}, {} over {:.4g} x {:.4g} m tiles, {} mm "
                      "thick)",
                      texture.name, texture.info.width, texture.info.height,
                      describe_sheet(*screen), width, height, millimetres(sheet_.thickness))};
}

std::vector<std::uint16_t> ScreenMaker::read_texture(ScreenTexture const& texture) {
  auto texels = naming(extension::perforated_screen::texture_file_name.title,
                       [&] { return read_opacity(texture.path, texture.info, texture.assets); });
  if (texture.invert) {
    for (auto& texel : texels) texel = static_cast<std::uint16_t>(solid - texel);
  }
  return texels;
}

}  // namespace gpu_shading::energyplus

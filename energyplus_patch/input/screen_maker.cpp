#include "input/screen_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gpu_shading::energyplus {
namespace {

constexpr std::uint16_t solid = 65535;

// A surface's rectangle along a tile's axes, from the tile's (0, 0).
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
                                    double rotation) {
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

Error screen_error(std::string const& object, std::string message) {
  auto const field = message.substr(0, message.find(" is "));
  if (!message.empty() && std::islower(static_cast<unsigned char>(message.front())) != 0) {
    for (std::size_t i = 0; i < field.size(); ++i) {
      if (i > 0 && message[i - 1] != ' ') continue;
      message[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(message[i])));
    }
  }
  return Error(fmt::format("GPUShading:PerforatedScreen {}: {}", object, message));
}

ScreenMaker::ScreenMaker(std::string object, Holes holes, Sheet const& sheet,
                         ScreenPlacement const& placement)
    : object_(std::move(object)), holes_(std::move(holes)), sheet_(sheet), placement_(placement) {
  if (auto const* const pattern = std::get_if<HolePattern>(&holes_)) {
    made_.push_back(make_of(*pattern));
    return;
  }
  // A texel stands for the image, so that numbers are refused before it is read.
  auto const& texture = std::get<ScreenTexture>(holes_);
  PerforatedScreen const check(
      OpacityTile(texture.width.value_or(1.0), texture.height.value_or(1.0), 1, 1,
                  std::vector<std::uint16_t>{solid}, texture.threshold),
      sheet_);
}

std::shared_ptr<PerforatedScreen const> ScreenMaker::make(Polygon const& polygon) {
  return find_or_make(polygon).screen;
}

std::string ScreenMaker::describe(Polygon const& polygon) {
  return find_or_make(polygon).description;
}

ScreenPlacement ScreenMaker::placement(Polygon const& polygon) const {
  auto const* const texture = std::get_if<ScreenTexture>(&holes_);
  if (texture == nullptr || !covers_each_surface(*texture)) return placement_;
  // Its bounding rectangle begins at the second vertex where it is a rectangle, and not turned.
  auto const bounds = bounds_of(polygon, placement_.rotation);
  double const c = std::cos(placement_.rotation);
  double const s = std::sin(placement_.rotation);
  return {placement_.origin_u + c * bounds.low_u - s * bounds.low_v,
          placement_.origin_v + s * bounds.low_u + c * bounds.low_v, placement_.rotation};
}

ScreenMaker::Made const& ScreenMaker::find_or_make(Polygon const& polygon) {
  auto const* const texture = std::get_if<ScreenTexture>(&holes_);
  if (texture == nullptr) return made_.front();
  auto const [width, height] = tile_size(*texture, polygon, placement_.rotation);
  // Equal surfaces differ by the rounding of their vertices.
  constexpr double same = 1e-4;
  for (auto const& made : made_) {
    if (std::abs(made.width - width) <= same && std::abs(made.height - height) <= same) {
      return made;
    }
  }
  try {
    made_.push_back(make_of(*texture, width, height));
  } catch (Error const& error) {
    throw screen_error(object_, error.what());
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
    warnings_.push_back(fmt::format(
        "GPUShading:PerforatedScreen {}: {} is {} everywhere, by its {}", object_, texture.name,
        open <= 0.0 ? "solid" : "open", texture.info.alpha ? "alpha channel" : "luminance"));
  }
  return {width, height, screen,
          fmt::format("perforated (texture {} {} x {}, {} over {:.4g} x {:.4g} m tiles, {} mm "
                      "thick)",
                      texture.name, texture.info.width, texture.info.height,
                      describe_sheet(*screen), width, height, millimetres(sheet_.thickness))};
}

std::vector<std::uint16_t> ScreenMaker::read_texture(ScreenTexture const& texture) {
  std::vector<std::uint16_t> texels;
  try {
    texels = read_opacity(texture.path, texture.info);
  } catch (Error const& error) {
    throw Error(fmt::format("Texture File Name: {}", error.what()));
  }
  if (texture.invert) {
    for (auto& texel : texels) texel = static_cast<std::uint16_t>(solid - texel);
  }
  return texels;
}

}  // namespace gpu_shading::energyplus

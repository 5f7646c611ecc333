#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/scene.h"
#include "images/texture_file.h"

namespace gpu_shading::energyplus {

// The image of a tile, and how it lies on surfaces.
struct ScreenTexture {
  std::string name;  // as the user wrote it
  std::filesystem::path path;
  TextureInfo info;
  bool invert = false;
  std::optional<double> threshold = 0.5;  // none: fractional opacity
  // Of a tile, m. One of them: texels are square. None: the bounding rectangle of each surface
  // along the tile's axes.
  std::optional<double> width = std::nullopt;
  std::optional<double> height = std::nullopt;
};

// Where texture coordinates lie on a mesh, in world axes: (0, 0), and what they grow along, of the
// length that makes them 1.
struct TextureAxes {
  glm::dvec3 origin;
  glm::dvec3 u;
  glm::dvec3 v;
};

// Tiles of a mesh whose width and height differ by less than this share are one.
inline constexpr double same_scale = 5e-3;

// Makes the screens of one GPUShading:PerforatedScreen, which has one for all its surfaces, but for
// a texture that each surface has in its own size. For one thread at a time. Every function throws
// Error, naming object, field and value, the constructor without the object.
class ScreenMaker {
 public:
  using Holes = std::variant<HolePattern, ScreenTexture>;

  // Everything is checked but what only the image's texels can tell.
  ScreenMaker(std::string object, Holes holes, Sheet const& sheet,
              ScreenPlacement const& placement);

  std::string const& object() const { return object_; }

  // Equal screens are one. A texture's file is read at the first call. On a mesh, which has texture
  // coordinates, these take the place of the surface's lower left corner and lower edge, and unless
  // the tile has a size one unit of them is one tile.
  std::shared_ptr<PerforatedScreen const> make(
      Polygon const& polygon, std::optional<TextureAxes> const& texture = std::nullopt);

  ScreenPlacement placement(Polygon const& polygon,
                            std::optional<TextureAxes> const& texture = std::nullopt) const;

  // "perforated (round holes 5 mm, ...)": what make() gives.
  std::string describe(Polygon const& polygon,
                       std::optional<TextureAxes> const& texture = std::nullopt);

  // Whether tiles are of the size of each surface, or of a unit of a mesh's texture coordinates.
  bool stretches() const;

  // One line for what is odd about the screens that were made.
  std::vector<std::string> const& warnings() const { return warnings_; }

 private:
  struct Made {
    double width;  // of the tile
    double height;
    std::shared_ptr<PerforatedScreen const> screen;
    std::string description;
  };

  Made const& find_or_make(Polygon const& polygon, std::optional<TextureAxes> const& texture);
  ScreenPlacement placement_on(TextureAxes const& texture, Polygon const& polygon) const;
  Made make_of(HolePattern const& pattern);
  Made make_of(ScreenTexture const& texture, double width, double height);
  static std::vector<std::uint16_t> read_texture(ScreenTexture const& texture);

  std::string object_;
  Holes holes_;
  Sheet sheet_;
  ScreenPlacement placement_;
  std::vector<Made> made_;
  std::vector<std::string> warnings_;
};

// An error of the object: the field that the message begins with as the user writes it.
Error screen_error(std::string const& object, std::string message);

}  // namespace gpu_shading::energyplus

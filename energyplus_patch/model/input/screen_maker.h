#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "files/image_file.h"
#include "gpu_shading/error.h"
#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/scene.h"

namespace gpu_shading::energyplus {

// The image of a tile, and its placement on surfaces.
struct ScreenTexture {
  std::string name;  // as the user wrote it
  std::filesystem::path path;
  Assets assets = Assets::restricted;
  TextureInfo info;
  bool invert = false;
  std::optional<double> threshold = 0.5;  // none: fractional opacity
  // Size of a tile, m. If only one is given, texels are square; if neither is, the tile is the
  // bounding rectangle of each surface along its axes.
  std::optional<double> width = std::nullopt;
  std::optional<double> height = std::nullopt;
};

// The texture coordinates of a mesh in world axes: the point (0, 0), and the vectors along which
// each coordinate grows by 1.
struct TextureAxes {
  glm::dvec3 origin;
  glm::dvec3 u;
  glm::dvec3 v;
};

// Tiles of a mesh are treated as equal if their width and height differ by less than this fraction.
inline constexpr double same_scale = 5e-3;

// Creates the screens of one GPUShading:PerforatedScreen: one for all its surfaces, or one per
// surface for a texture sized by the surface. Not thread-safe. Every function throws Error, naming
// object, field and value; the constructor does not name the object.
class ScreenMaker {
 public:
  using Holes = std::variant<HolePattern, ScreenTexture>;

  // `where`: the start of errors. Checks everything except the image's texels.
  ScreenMaker(std::string object, std::string where, Holes holes, Sheet const& sheet,
              ScreenPlacement const& placement);

  std::string const& object() const { return object_; }
  std::string const& where() const { return where_; }

  // Equal screens are shared. A texture's file is read at the first call. On a mesh, texture
  // coordinates replace the surface's lower left corner and lower edge; one unit of them is one
  // tile, unless the tile has a size.
  std::shared_ptr<PerforatedScreen const> make(
      Polygon const& polygon, std::optional<TextureAxes> const& texture = std::nullopt);

  ScreenPlacement placement(Polygon const& polygon,
                            std::optional<TextureAxes> const& texture = std::nullopt) const;

  // "perforated (round holes 5 mm, ...)": describes the result of make().
  std::string describe(Polygon const& polygon,
                       std::optional<TextureAxes> const& texture = std::nullopt);

  // Whether tiles take the size of each surface, or of a unit of a mesh's texture coordinates.
  bool stretches() const;

  // One line for each peculiarity of the screens created so far.
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
  std::string where_;
  Holes holes_;
  Sheet sheet_;
  ScreenPlacement placement_;
  std::vector<Made> made_;
  std::vector<std::string> warnings_;
};

// An error of an object: the field that the message begins with as the user writes it.
Error screen_error(std::string const& where, std::string message);

}  // namespace gpu_shading::energyplus

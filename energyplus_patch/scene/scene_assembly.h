#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/renderer.h"
#include "model/model_reader.h"
#include "scene/digest.h"
#include "scene/schedules.h"
#include "scene/shade_motion.h"
#include "scene/shade_optics.h"

namespace gpu_shading::energyplus {

// The surfaces of one run and what they let through: those of the model that EnergyPlus adds, then
// casters that EnergyPlus does not see (lean input, surroundings). Placeholders stay out of it.
// Functions throw Error.
class SceneAssembly {
 public:
  explicit SceneAssembly(Model model) : model_(std::move(model)) {}
  ~SceneAssembly() = default;
  SceneAssembly(SceneAssembly const&) = delete;  // the optics refer to the model
  SceneAssembly& operator=(SceneAssembly const&) = delete;

  // Adds a surface of EnergyPlus's. Not after complete().
  SurfaceId add(Surface surface);
  // The same for the copy of a shading surface that faces the other way.
  SurfaceId add_mirrored(SurfaceId original);

  // EnergyPlus has added all its surfaces: adds the other casters and reads the schedules.
  void complete(Schedules schedules);

  // After complete(): reads other schedules in place of those.
  void set_schedules(Schedules schedules) { optics_ = ShadeOptics(model_, std::move(schedules)); }

  Model const& model() const { return model_; }
  ShadeOptics& optics() { return optics_; }
  ShadeOptics const& optics() const { return optics_; }

  // Without optics: names, polygons and whether they cast shadows.
  Scene const& surfaces() const { return surfaces_; }

  // Surfaces that EnergyPlus added; their ids are the first.
  std::size_t size() const { return complete_ ? receives_.size() : surfaces_.size(); }

  // Ids of the model's shading surfaces, in order.
  std::vector<SurfaceId> shading_surfaces() const;

  // EnergyPlus's area of a surface over the area that is rendered: it deletes vertices that are
  // close to each other (SimplifiedSurfaces).
  double area_ratio(SurfaceId surface) const { return area_ratios_[surface]; }

  // A warning where vertices that EnergyPlus passes are rounded by over 1 mm, or "".
  std::string warn_of_rounding() const;

  // After complete(), by surface of EnergyPlus's:
  // unit normal x net area (m2);
  std::vector<glm::dvec3> areas() const;
  // whether its sunlit fraction is wanted: that of a shading surface rarely is, that of a window's
  // reveal never;
  std::vector<bool> const& receives() const { return receives_; }
  // whether it counts as unshaded, because its sunlit fraction is not wanted but EnergyPlus may ask
  // for it.
  std::vector<bool> const& unshaded() const { return unshaded_; }

  // The surfaces with an area whose sunlit fractions are wanted.
  std::vector<SurfaceId> receivers() const;

  // The same for people: without shading surfaces that nothing names, whose sunlit fractions only
  // EnergyPlus wants, for reflections and for outputs of all surfaces.
  std::vector<SurfaceId> shown_receivers() const;

  // What shows a person the model: all but terrain, neighbouring buildings and mirrored copies that
  // nothing names.
  std::vector<SurfaceId> shown() const;

  // The positions of the model's moving shades, in order; at rest until set_positions().
  std::vector<double> const& positions() const { return positions_; }
  void set_positions(std::vector<double> positions) { positions_ = std::move(positions); }
  std::vector<double> rest_positions() const;
  // A surface without optics, at the positions as they are now.
  Surface placed(SurfaceId id) const { return placed(id, positions_); }
  Surface placed(SurfaceId id, std::vector<double> const& positions) const;
  // How its points get to some positions from where it is drawn.
  PointMotion motion_of(SurfaceId id, std::vector<double> const& positions) const;
  // By surface: the index of the moving shade that it belongs to.
  std::optional<std::size_t> moving_shade_of(SurfaceId surface) const {
    return moving_shades_.empty() ? std::nullopt : moving_shades_[surface];
  }
  // Whether a moving shade is among the casters that EnergyPlus does not see.
  bool hides_moving_shades() const;

  // The scene to render, with the optics and positions as they are now: the surfaces by their ids,
  // then a copy without openings of each wall that has openings.
  Scene scene(ShadeOptics::Radiation radiation = ShadeOptics::Radiation::solar) const {
    return scene_at(positions_, radiation);
  }
  // The same at other positions. `opaque`: a moving shade to be taken as opaque.
  Scene scene_at(std::vector<double> const& positions,
                 ShadeOptics::Radiation radiation = ShadeOptics::Radiation::solar,
                 std::optional<std::size_t> opaque = std::nullopt) const;

  // The casters that are not EnergyPlus's surfaces, with the optics as they are now for light.
  Scene hidden_casters() const;

  // Hash of all that an answer depends on: of a scene(), rendered on a device.
  Hash hash(Scene const& scene, DeviceInfo const& device) const;

 private:
  std::optional<TextureAxes> texture_of(SurfaceId id, std::vector<double> const& positions) const;
  void find_moving_shades();

  Model model_;
  Scene surfaces_;
  std::vector<double> area_ratios_;
  std::vector<std::string> rounded_;  // far from the origin, and not in Model::far_outlines
  double farthest_rounded_ = 0.0;     // their largest coordinate, m
  bool complete_ = false;
  std::vector<bool> receives_;
  std::vector<bool> unshaded_;
  ShadeOptics optics_;
  std::vector<double> positions_;
  std::vector<std::optional<std::size_t>> moving_shades_;  // empty: there are none
};

// The copy of a shading surface that faces the other way.
Surface mirrored(Surface const& original);

// How a model is rendered.
RendererOptions renderer_options(Options const& options);

// "512 x 512 pixels", "error 0.001"
std::string describe_fineness(Options const& options);

}  // namespace gpu_shading::energyplus

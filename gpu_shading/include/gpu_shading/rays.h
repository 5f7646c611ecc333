#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// A ray or, with a finite length, a segment. Metres, in the scene's axes.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0};  // of any length but 0; distances are in metres all the same
  double length = std::numeric_limits<double>::infinity();  // 0 or less: nothing is met
  // The surface on which it begins, which it does not meet: a sheet with a thickness, of which the
  // ray begins inside, or a polygon that is not flat.
  std::optional<SurfaceId> from = std::nullopt;
};

struct RayHit {
  SurfaceId surface = 0;
  double distance = 0.0;  // from the ray's origin, m
};

// A surface that a ray meets, and what it lets pass of the ray, 0 .. 1.
struct RayLayer {
  SurfaceId surface = 0;
  double distance = 0.0;  // from the ray's origin, m
  double transmittance = 0.0;
};

// The faces of a surface that stop rays.
enum class RayFaces {
  as_casting,  // by Surface::casting, with the ray's direction as the direction to the sun
  both,        // both faces, whatever Surface::casting says: EnergyPlus's rule in daylighting
};

struct RayOptions {
  RayFaces faces = RayFaces::as_casting;
  // What a ray meets of perforated sheets. A ray that stands for a cone (a part of the sky, the
  // sun's disk, a window's element) needs the effective transmittance: one point of a hole pattern
  // is noise. ScreenDetail::automatic: as each sheet's own detail says, and the effective
  // transmittance where that is automatic too.
  ScreenDetail screens = ScreenDetail::effective;
  // The surfaces that rays can meet, each of them also if its casting is Casting::never. Without a
  // list: all whose casting is not.
  std::optional<std::vector<SurfaceId>> casters = std::nullopt;
};

// What may change from ray to ray. The spans must outlive the call.
struct RayConditions {
  // The surface that the ray asks for: the scene's shading rule says which casters count, and the
  // surface itself does not.
  std::optional<SurfaceId> receiver = std::nullopt;
  // Surfaces that are passed over.
  std::span<SurfaceId const> excluded = {};
  // By BeamFilter::schedule, as in Renderer::sun_view; 1 where there are too few.
  std::span<double const> factors = {};
  // By PerforatedSheet::deployment, as in Renderer::set_deployments; 1 where there are too few.
  std::span<double const> deployments = {};
};

// Rays through the casters of a scene, by the rules of the renderer: a surface lets pass its
// transmittance at the ray's own angle of incidence, times its schedule's factor, times what its
// perforated sheet lets pass. Objects are immutable: any number of threads
// may ask one at the same time.
//
// A ray meets a surface between its ends only: a surface is not met if an end lies within a
// nanometre of its plane. That is more than rounding displaces a point on a site 100 km in size,
// and less than any gap in a model. A ray in the plane of a surface does not meet it either.
// Polygons whose vertices are more than 1e-6 m off their plane are met as the triangles that the
// renderer draws, others whole, by the odd-even rule. A ray through an edge that two triangles or
// two surfaces share meets exactly one of them, if they lie on either side of it as the ray sees
// them. Polygons are tested in double precision.
//
// A perforated sheet is met between its two faces, by the part of the ray that is inside its
// outline, if the polygon or the middle of the sheet's body lies between the ray's ends. Rays at
// less than 1e-3 rad from its plane do not pass, as in the renderer.
//
// Functions throw Error for a ray whose direction is 0, for one with a number that is not finite
// (other than an infinite length), and for a receiver that is not in the scene.
class RayScene {
 public:
  // Keeps what it needs of the scene. Throws Error if options.casters has a surface that the scene
  // has not. Computes the effective transmittance of screens, which takes seconds for large images.
  explicit RayScene(Scene const& scene, RayOptions const& options = {});
  ~RayScene();
  RayScene(RayScene const&) = delete;
  RayScene& operator=(RayScene const&) = delete;
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // The product of what the surfaces that the ray meets let pass, 0 .. 1.
  double transmittance(Ray const& ray, RayConditions const& conditions = {}) const;

  // The nearest surface that lets nothing of the ray pass, if it meets one.
  std::optional<RayHit> nearest_opaque(Ray const& ray, RayConditions const& conditions = {}) const;

  // The surfaces that the ray meets, nearest first, up to the first that lets nothing pass.
  // Surfaces in one place are in the scene's order.
  std::vector<RayLayer> layers(Ray const& ray, RayConditions const& conditions = {}) const;

  // The same of each ray, on all cores. They throw Error if there are not as many results as rays.
  void transmittances(std::span<Ray const> rays, RayConditions const& conditions,
                      std::span<double> results) const;
  void layers(std::span<Ray const> rays, RayConditions const& conditions,
              std::span<std::vector<RayLayer>> results) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation const> implementation_;
};

}  // namespace gpu_shading

#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/rays.h"
#include "gpu_shading/renderer.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Decides where the moving shades of a model stand (GPUShading:MovingShade). Functions throw Error.
class ShadeControl {
 public:
  enum class State {
    at_rest,    // the sun is down, or a limit keeps the shade at rest
    scheduled,  // Schedule
    clear,      // BlockBeam: no beam on the receivers at the position at rest
    blocking,   // BlockBeam
    admitting,  // BlockBeam: beam reaches the receivers at every position; at this one the least
    tracking,   // TrackSun
    held,       // by the hysteresis
    windy,      // the wind keeps the shade at rest
  };
  struct Decision {
    double position = 0.0;
    State state = State::at_rest;
    double exact = 0.0;  // position before it was rounded to a step
  };
  // Of this timestep; asked for where a limit needs it.
  struct Weather {
    std::function<double()> beam = {};  // direct normal irradiance, W/m2
    std::function<double()> wind = {};  // m/s
  };

  // The scene must be complete() and outlive this.
  explicit ShadeControl(SceneAssembly const& scene);

  // Reads the schedules.
  void set_time(Moment moment);
  // The sun of this time; none: it is down. By shade. A shade that looks for the beam takes those
  // that do so after it to be at rest.
  std::vector<Decision> const& decide(std::optional<SunDirection> sun, Weather const& weather);
  // The optics have changed.
  void renew() { trials_.clear(); }

  std::vector<Decision> const& decisions() const { return decisions_; }

 private:
  // Receivers are looked at from these points in turn; the last one that was lit is the first.
  struct Receiver {
    SurfaceId id;
    glm::dvec3 area;  // unit normal x m2
    std::vector<glm::dvec3> points;
    std::size_t lit = 0;
  };
  struct Shade {
    MovingShade const& shade;
    std::vector<double> outward;  // positions, from rest on
    std::vector<Receiver> receivers;
    SurfaceId first = 0;     // of its surfaces
    double scheduled = 0.0;  // position, not rounded
    bool available = true;
  };
  // The scene with some shades at certain positions, one of them opaque.
  struct Trial {
    Trial(Scene scene, RendererOptions const& options)
        : rays(scene), renderer(std::move(scene), options) {}
    RayScene rays;
    Renderer renderer;
  };

  // Of the receivers that face the sun.
  struct Beam {
    double total = 0.0;    // share of the beam on all of them, 0 .. 1
    double largest = 0.0;  // share of one of them
  };

  void check_schedules() const;
  void find_receivers();
  void find_first_surfaces();
  double value_of(MovingShade const& shade, FieldInfo const& field,
                  std::string const& schedule) const;
  bool has_beam(Shade const& shade, SunDirection sun, std::function<double()> const& beam) const;
  Decision block_beam(std::size_t index, SunDirection sun);
  Decision track_sun(std::size_t index, SunDirection sun) const;
  bool is_lit(std::size_t index, double position, SunDirection sun);
  Decision least_beam(std::size_t index, SunDirection sun);
  // By rays, to about `ray_error`, and as rendered.
  double estimated_beam(std::size_t index, double position, SunDirection sun);
  Beam rendered_beam(std::size_t index, double position, SunDirection sun);
  Trial& trial(std::size_t index, double position);
  RayConditions conditions_of(SurfaceId receiver) const;
  double held(std::size_t index, double wanted) const;

  SceneAssembly const& scene_;
  std::vector<Shade> shades_;
  Moment moment_;
  std::vector<Decision> decisions_;
  std::vector<double> positions_;  // while they are decided on
  std::map<std::pair<std::size_t, std::vector<double>>, Trial> trials_;
  std::vector<Ray> batch_;  // scratch memory
  std::vector<double> passed_;
};

// "blocking", ...
std::string_view name_of(ShadeControl::State state);

}  // namespace gpu_shading::energyplus

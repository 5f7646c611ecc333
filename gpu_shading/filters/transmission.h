#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "filters/crown/crowns.h"
#include "filters/perforation/screens.h"
#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// The effect of a flat filter on the beam at one sun direction.
struct Shade {
  static constexpr std::int32_t unscheduled = -1;

  float transmittance = 0.0F;           // 0: opaque
  std::int32_t schedule = unscheduled;  // as Transmission numbers them

  bool operator==(Shade const&) const = default;
};

// The filters of the casters of a scene. Schedules are numbered from 0 here, without gaps.
class Transmission {
 public:
  explicit Transmission(Scene const& scene);

  Screens const& screens() const { return screens_; }
  Crowns const& crowns() const { return crowns_; }

  // Deployed fractions of screens and shares of leaves, 1 beyond the end.
  void set_deployments(std::vector<double> shares) { deployments_ = std::move(shares); }

  bool all_opaque() const { return all_opaque_; }
  bool transmits(SurfaceId id) const { return entries_[id].transmits; }
  // BeamFilter::is_flat().
  bool is_flat(SurfaceId id) const { return entries_[id].is_flat; }
  int schedule(SurfaceId id) const { return entries_[id].schedule; }
  std::vector<int> const& schedules() const { return schedules_; }  // as the scene numbers them

  bool any_transmits(std::span<SurfaceId const> casters) const;
  bool any_schedule(std::span<SurfaceId const> casters) const;
  // Whether one of them is not flat only.
  bool any_body(std::span<SurfaceId const> casters) const;
  bool any_screen(std::span<SurfaceId const> casters) const;
  bool any_crown(std::span<SurfaceId const> casters) const;
  // The kinds of some casters: "transparent shades", "perforated screens and transmittance
  // schedules". Casters with equal descriptions are rendered in the same way.
  std::string describe(std::span<SurfaceId const> casters) const;
  std::vector<SurfaceId> flat_among(std::span<SurfaceId const> casters) const;
  std::vector<int> screens_among(std::span<SurfaceId const> casters) const;

  std::vector<CrownInBeam> crowns_among(std::span<SurfaceId const> casters,
                                        glm::dvec3 const& towards_sun) const;

  // Of the flat factors, without schedule; 0 for an opaque surface. `towards_sun` of unit length.
  double transmittance(SurfaceId id, glm::dvec3 const& towards_sun) const;
  Shade shade(SurfaceId id, glm::dvec3 const& towards_sun) const;

  // By index, the screens in view; empty for others.
  std::vector<SheetInBeam> sheets(ScreensAtDirection const& wanted) const {
    return sheets_in_beam(screens_, wanted, deployments_);
  }

 private:
  struct Entry {
    bool transmits = false;
    bool is_flat = true;
    int schedule = Shade::unscheduled;
    BeamFilter filter = {};  // if it transmits
    glm::dvec3 normal{0.0};
  };

  std::vector<Entry> entries_;
  bool all_opaque_ = true;
  std::vector<int> schedules_;
  Screens screens_;
  Crowns crowns_;
  std::vector<double> deployments_;
};

}  // namespace gpu_shading

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gpu_shading/rays.h"
#include "model/idf/model_editor.h"
#include "reports/sky_mask.h"

namespace gpu_shading::energyplus {

// What a receiver exchanges long-wave radiation with.
struct ViewedGroup {
  std::string name;
  std::string schedule = {};  // of its temperature; "": outdoor air
};

// The first two groups: what rays meet that meet no surface, above and below the horizon.
enum ViewedPlace : std::size_t { viewed_sky, viewed_ground, viewed_surfaces };

struct ViewFactors {
  std::vector<double> factors;  // by group; they add up to 1
  double error = 0.0;           // the largest standard error of these
};

// From rays in cosine-weighted directions of low discrepancy, the same in every run. `group_of`: by
// surface of the scene. `rays`: a multiple of view_factor_batches.
inline constexpr int view_factor_batches = 16;
ViewFactors trace_view_factors(RayScene const& scene, RayConditions const& conditions,
                               std::span<std::size_t const> group_of, std::size_t groups,
                               MaskPoints const& points, int rays);

// In millionths, which add up to a million.
std::vector<int> in_millionths(std::vector<double> const& factors);

// The view factors of a surface.
struct SurfaceViews {
  std::string surface;
  std::vector<int> millionths;  // by group
  double sky_ratio = 1.0;       // EnergyPlus's own ratio of sky diffuse radiation
};

// Adds SurfaceProperty:LocalEnvironment with :SurroundingSurfaces, for groups with a schedule, or
// else with :GroundSurfaces. EnergyPlus multiplies the sky view factor of these objects by its
// ratio of sky diffuse radiation, and then takes the ground to be all the rest. So the sky view
// factor is divided by the ratio; all without a schedule is the rest, at air temperature.
// Returns the surfaces for which EnergyPlus's limit, a sum of 1, cuts off
// sky.
std::vector<std::string> add_local_environments(ModelEditor& editor,
                                                std::vector<ViewedGroup> const& groups,
                                                std::vector<SurfaceViews> const& views);

}  // namespace gpu_shading::energyplus

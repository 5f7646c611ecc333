#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "answers/cached_renderer.h"
#include "platform/staged_files.h"

namespace gpu_shading::energyplus {

// An azimuth in degrees, 0 .. 360, from radians of either sign.
double degrees_clockwise(double radians);

// Where a plane faces, in degrees: azimuth clockwise from north, 0 if it is horizontal, and tilt.
struct Facing {
  double azimuth = 0.0;
  double tilt = 0.0;
};
Facing facing_of(glm::dvec3 const& normal);

// Wall-clock seconds of a run by stage.
using Stages = std::vector<std::pair<std::string, double>>;

// The renderer's own stages, and the remaining time since this module was loaded.
Stages stages_of(RendererStatistics const& statistics);

// The deployments and positions of moving shades at which answers were given.
struct Deployments {
  std::vector<std::string> heads;  // of a state's columns
  std::size_t shares = 0;          // how many of them are deployments
  DeploymentStates const& states;
};

inline constexpr std::size_t max_report_pictures = 300;

// Writes into `folder` what a user needs to check a surprising number by eye:
//   sunlit.csv       receiver, sun azimuth and altitude (degrees), projected sunlit area (m2),
//                    sunlit fraction, the error that 99 % of such fractions stay within (blank
//                    where it was not measured), and the share of screens in place by each
//                    deployment schedule and the positions of moving shades, where there are any:
//                    every answer that EnergyPlus was given, or interpolated between
//   NAME_AZ_ALT.png  what the sun sees of a receiver, at up to three of its answers: the one most
//                    shaded but lit, the one nearest to half sunlit, and the one at the highest
//                    sun. With deployments NAME_AZ_ALT_SHARE[_SHARE ...].png, shares in percent,
//                    then positions.
//   pictures.csv     picture, receiver, sun azimuth and altitude (degrees), shares: every picture
//                    of this report; others in the folder are of earlier ones
//   stages.csv       stage, wall-clock seconds
// and the files that `more` adds. `receivers`: by their numbers; those that were asked for, by
// surface, are reported, and those of `shown` drawn. Returns the number of pictures beyond
// max_report_pictures, which are left out. Throws Error when the folder cannot be written; its
// files are then unchanged.
std::size_t write_report(std::filesystem::path const& folder, CachedRenderer& rendered,
                         std::vector<SurfaceId> const& receivers, std::vector<bool> const& asked,
                         std::vector<SurfaceId> const& shown, AnswerStore const& answers,
                         std::vector<double> const& factors, Deployments const& deployments,
                         Stages const& stages, std::function<void(StagedFiles&)> const& more);

// The table alone. Columns: stage, seconds. Throws Error when the file cannot be written.
void write_stages(std::filesystem::path const& file, Stages const& stages);

}  // namespace gpu_shading::energyplus

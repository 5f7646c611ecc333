#pragma once

#include <glm/vec2.hpp>
#include <iosfwd>
#include <string>
#include <vector>

#include "model/site/weather_header.h"
#include "programs/gpu_shading/figure.h"
#include "reports/sky_mask.h"
#include "tasks/task.h"

// The files of `gpu_shading mask`.
namespace gpu_shading::energyplus {

// A full hour of standard time on the 21st of a month, with the sun up.
struct MaskHour {
  int month = 0;
  int hour = 0;  // 0 .. 23
  SunDirection sun;
  double beam = 0.0;    // direct normal irradiance, W/m2
  bool marked = false;  // whether that is at least the beam that was chosen
};

// A site's sun on the 21st day of the months.
struct MaskSite {
  std::string name;
  double latitude = 0.0;  // degrees
  double longitude = 0.0;
  double time_zone = 0.0;  // hours
  std::string beam;        // "over 300 W/m2 (clear sky)"
  std::vector<MaskHour> hours;

  SunDirection sun(int day_of_year, double hour) const;
};

// Day of a year of 365 days.
int day_21_of(int month);

// Direct normal irradiance of ASHRAE's clear sky on the 21st of a month, W/m2, as EnergyPlus's
// design days have it (Engineering Reference, "ASHRAE Clear Sky Solar Model"; ASHRAE Handbook of
// Fundamentals 2005, chapter 31, table 7).
double clear_sky_beam(int month, double altitude);

enum class Projection { stereographic, equidistant, cylindrical };

// The place of a direction in a diagram: x to the right, y down. Around the zenith, the horizon has
// the radius 1 and north is above; cylindrical: x from -1 to 1 with the equator's side in the
// middle, y from -1 at the zenith to 0 at the horizon.
glm::dvec2 project(Projection projection, SunDirection direction, bool northern);

struct MaskSummary {
  std::string title;  // the receiver, and the point
  std::string stem;   // of its files
  double azimuth = 0.0;
  double tilt = 0.0;  // degrees
  SkyView view;
};

Figure draw_mask(ReceiverMask const& mask, MaskSummary const& summary, SkyGrid const& grid,
                 MaskSite const& site, Projection projection);

// A row for each direction of the sky that the receiver faces.
void write_sky(ReceiverMask const& mask, SkyGrid const& grid, std::ostream& csv);

// Lines of azimuth, from -180 in the north over -90 in the east and 0 in the south, and height,
// both in degrees, as PVsyst and PV*SOL read them.
void write_horizon(ReceiverMask const& mask, SkyGrid const& grid, std::ostream& text);

void write_hours(std::vector<ReceiverMask> const& masks, std::vector<MaskSummary> const& summaries,
                 MaskSite const& site, std::ostream& csv);

void write_summaries(std::vector<ReceiverMask> const& masks,
                     std::vector<MaskSummary> const& summaries, std::ostream& csv);

}  // namespace gpu_shading::energyplus

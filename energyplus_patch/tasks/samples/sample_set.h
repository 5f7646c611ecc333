#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "gpu_shading/sampled_sunlit.h"
#include "runs/run_times.h"
#include "tasks/samples/sample_parts.h"

namespace gpu_shading::energyplus {

// All parts of a scene's samples, merged.
struct SampleSet {
  SampledScene scene;
  std::vector<std::string> devices;  // devices that rendered, each once
  std::vector<std::size_t> rounds;   // directions of each
  SampledSunlit samples;
};

// Latitude in radians. Renders nothing. Throws Error if a part is missing, or belongs to another
// request or another scene.
SampleSet gather_samples(SampleParts const& parts, std::string const& asked, Sampling sampling,
                         double latitude);

// Tables of comma-separated values, with names quoted if necessary and angles in degrees: azimuth
// clockwise from true north, altitude above the horizon.

// receiver,azimuth,altitude,scheduled,sunlit_fraction: a row for each receiver and sampled
// direction at which the sun faces it. `scheduled` is empty for light that passes no scheduled
// shade. Light through scheduled shades has a row of its own, with the product of schedule values
// to multiply by, such as "A*B^2".
void write_samples(SampleSet const& set, std::ostream& out);

// time,azimuth,altitude, then each receiver's sunlit fraction including schedule values: a row for
// each time of a run_for_year(), at the end of its timestep, "YYYY-MM-DD HH:MM" in standard time,
// where midnight is 00:00 of the next day. 0 if the sun is down or behind the receiver.
void write_year(SampleSet const& set, RunTimes const& run, std::ostream& out);

}  // namespace gpu_shading::energyplus

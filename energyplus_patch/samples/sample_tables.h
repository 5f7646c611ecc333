#pragma once

#include <iosfwd>

#include "samples/sample_set.h"
#include "scheduled/run_times.h"

namespace gpu_shading::energyplus {

// Tables of comma-separated values, names quoted where they have to be, angles in degrees: azimuth
// clockwise from true north, altitude above the horizon.

// receiver,azimuth,altitude,scheduled,sunlit_fraction: a row for each receiver and sampled
// direction at which the sun faces it. `scheduled` is empty for what passes no scheduled shade; for
// what passes some there is another row, "A*B^2" the product of schedules' values that its fraction
// is to be multiplied by, unless nothing does.
void write_samples(SampleSet const& set, std::ostream& out);

// time,azimuth,altitude, then each receiver's sunlit fraction, schedules' values in it: a row for
// each time of a run, at its timestep's end, "MM-DD HH:MM" in standard time. 0 where the sun is
// down, or turned away from.
void write_year(SampleSet const& set, RunTimes const& run, std::ostream& out);

}  // namespace gpu_shading::energyplus

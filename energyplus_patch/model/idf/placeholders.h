#pragma once

#include <string>
#include <vector>

#include "model/idf/mentions.h"
#include "model/idf/new_object.h"

namespace gpu_shading::energyplus {

// Shading surfaces that EnergyPlus reads instead of casters that it does not know.
struct Placeholder {
  std::string name;
  std::string schedule;   // transmittance schedule, or ""
  int quarter = 0;        // 0 .. 3: north-east of the model, and further counterclockwise
  double distance = 1e6;  // along x and y, m; several times the model's largest coordinate
};

// EnergyPlus asks for the sunlit area of a receiver if some caster has a vertex in front of its
// plane and reaches above its lowest vertex. Four distant poles, one in each quadrant and reaching
// as far down as up, have an end in front of any plane. They are so narrow that rays of daylighting
// and of solar reflections do not meet them. EnergyPlus also checks transmittance schedules to
// decide how often it needs the sky's shading: each of `schedules` gets a placeholder of its own.
// Names differ from all of `taken`.
std::vector<Placeholder> make_placeholders(std::vector<std::string> const& schedules,
                                           Names const& taken);

// One with a schedule of our own that varies. With DetailedSkyDiffuseModeling, EnergyPlus
// recomputes the sky's shading at every timestep only if the transmittance schedule of some shading
// surface varies. (EnergyPlus does not notice schedules that are lowest at the start of the
// day, so that a model's own schedule will not do.)
Placeholder make_sky_placeholder(Names const& taken);

// The schedule of the leaves of deciduous trees, of ours: from April 7 to October 27 (days 97 to
// 300), as in SOLWEIG; in the south half a year later.
std::string season_schedule(bool southern);

// The names of the schedules of ours that placeholders or crowns use, and what adds them to a
// model.
std::vector<std::string> own_schedules(std::vector<Placeholder> const& placeholders,
                                       std::vector<std::string> const& leaf_schedules);
bool is_own_schedule(std::string const& name);
std::vector<NewObject> schedule_objects(std::string const& name);

NewObject placeholder_object(Placeholder const& placeholder);

}  // namespace gpu_shading::energyplus

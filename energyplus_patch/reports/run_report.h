#pragma once

#include <filesystem>

#include "answers/answer_errors.h"
#include "gpu_shading/device.h"
#include "platform/staged_files.h"
#include "reports/position_record.h"
#include "reports/run_record.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// The page of a run, and the tables with its numbers:
//   index.html         the model in 3D with its sunlit fractions by day and hour
//   run_receivers.csv  receiver, area (m2), azimuth and tilt of the normal (degrees), mean sunlit
//                      fraction of the page's days, over the hours during all of which the sun
//                      faces it, blank if there are none, beam solar energy of the run (kWh/m2 and
//                      kWh), and the largest measured error of a sunlit fraction, blank if one was
//                      not measured
//   run_hours.csv      month and day, hour at whose end the sun is there, its azimuth and altitude
//                      (degrees), direct normal irradiance (W/m2), the mean of the days that the
//                      day stands for, and the sunlit fraction of each receiver, 0 if it faces away
//   run_months.csv     receiver, month; kWh/m2 of beam, the sky's light, light reflected by the
//                      ground and by shades alone, and their sum; all but beam blank if they are
//                      not known
//   run_mean_days.csv  the same in W/m2 by hour of the mean day of each month, without dark hours;
//                      none of models with very many receivers
//   run_sky.csv        receivers with a shading mask: view factor to the sky, and without shades
//   run_facts.csv      the facts below the page's title
// Maps that gpu_shading map has written into the report's folder, or its folder maps, are on the
// page, too, and so is what gpu_shading modules has written into its folder modules. Masks are of
// the schedules' lowest values and screens fully deployed, which the optics then have, and of
// moving shades at rest.
void write_run(StagedFiles& files, std::filesystem::path const& folder, SceneAssembly& assembly,
               DeviceInfo const& device, AnswerErrors const& errors, RunRecord const& record,
               PositionRecord const& positions);

// Throws Error if the folder has an index.html that is not of this report, or one that cannot be
// replaced.
void prepare_page(std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus

#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// The files in the folder of --gpu-shading-report.
inline constexpr char const* sunlit_table = "sunlit.csv";
inline constexpr char const* pictures_table = "pictures.csv";
inline constexpr char const* stages_table = "stages.csv";
inline constexpr char const* facts_table = "run_facts.csv";
inline constexpr char const* hours_table = "run_hours.csv";
inline constexpr char const* months_table = "run_months.csv";
inline constexpr char const* mean_days_table = "run_mean_days.csv";
inline constexpr char const* skies_table = "run_sky.csv";
inline constexpr char const* receivers_table = "run_receivers.csv";

// Creates the folder if it is missing. Throws Error, naming the option, if the report cannot be
// written into it.
void prepare_report(std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus

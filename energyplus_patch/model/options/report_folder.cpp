#include "model/options/report_folder.h"

#include "platform/naming.h"
#include "platform/staged_files.h"

namespace gpu_shading::energyplus {

void prepare_report(std::filesystem::path const& folder) {
  naming("--gpu-shading-report", [&] {
    StagedFiles files(folder);
    for (auto const* const name :
         {sunlit_table, pictures_table, stages_table, facts_table, hours_table, months_table,
          mean_days_table, skies_table, receivers_table}) {
      files.add(name);
    }
  });
}

}  // namespace gpu_shading::energyplus

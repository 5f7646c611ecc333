#include "program/check.h"

#include <cstdio>
#include <fstream>
#include <iostream>

#include "program/process.h"

namespace gpu_shading::energyplus {

void check(ModelRun const& run, bool vertices) {
  TemporaryFolder const folder;
  auto const listing = folder.path() / "surfaces.txt";
  std::vector<std::string> environment{"GPU_SHADING_CHECK=" + listing.string()};
  if (vertices) environment.emplace_back("GPU_SHADING_CHECK_VERTICES=1");
  run_to_shading(run, environment, folder.path(), listing);
  std::cout << std::ifstream(listing).rdbuf();
}

}  // namespace gpu_shading::energyplus

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "model/options/options.h"

namespace gpu_shading::energyplus {

// Which screens of a model to describe, and where to.
struct ScreenTask {
  std::filesystem::path model;  // IDF or epJSON
  std::string name;             // of GPUShading:PerforatedScreen objects, or a pattern; "": all
  std::optional<std::filesystem::path> folder = std::nullopt;  // for files; empty: none are written
  std::optional<std::filesystem::path> bsdf = std::nullopt;    // for one screen's, as XML
};

// Prints the sheet of each screen and a table of its transmittance by angle of incidence and
// azimuth. In the folder, each screen gets a table (CSV), a polar plot (SVG) and a picture of its
// tile (PNG): all files, or none. `bsdf` needs a single screen (screen_bsdf.h). Where pictures
// cannot be drawn, a warning says so. EnergyPlus is not run. Throws Error.
void describe_screens(ScreenTask const& task, Choices const& choices);

}  // namespace gpu_shading::energyplus

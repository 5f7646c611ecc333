#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "files/asset_folder.h"
#include "model/idf/input_object.h"
#include "model/input/screen_maker.h"
#include "model/input/shading_input.h"
#include "model/input/transparent_shades.h"

namespace gpu_shading::energyplus {

// The GPUShading:PerforatedScreen of a surface.
struct SurfaceScreen {
  std::shared_ptr<ScreenMaker> maker;  // the object's
  std::string deployment_schedule;     // upper case; "": the screen is always deployed
};

struct PerforatedScreens {
  std::map<std::string, SurfaceScreen> by_surface;  // upper-case names

  // One line for each problem of the screens created so far.
  std::vector<std::string> warnings() const;
};

// Reads every GPUShading:PerforatedScreen of a model. `folder`: where relative file names start.
// Only the headers of textures are read. Throws Error, naming object, field and value, for a
// pattern that matches no shading surface, a surface named twice or also by a TransparentShade, a
// number out of range, a field that does not apply to the shape of the holes, or a texture that is
// not an image or is too large.
PerforatedScreens read_perforated_screens(std::vector<InputObject> const& objects,
                                          ShadingInput const& input,
                                          TransparentShades const& shades,
                                          AssetFolder const& folder);

}  // namespace gpu_shading::energyplus

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "input/input_object.h"
#include "input/screen_maker.h"
#include "input/shading_input.h"
#include "input/transparent_shades.h"

namespace gpu_shading::energyplus {

// What GPUShading:PerforatedScreen says of a surface.
struct SurfaceScreen {
  std::shared_ptr<ScreenMaker> maker;  // the object's
  std::string deployment_schedule;     // upper case; "": the screen is always in place
};

struct PerforatedScreens {
  std::map<std::string, SurfaceScreen> by_surface;  // upper-case names
  std::vector<std::string> odd_lengths;             // a line each

  // These, and a line each of the screens made so far.
  std::vector<std::string> warnings() const;
};

// Reads every GPUShading:PerforatedScreen of a model. `folder`: where relative file names start. Of
// textures no more than the header is read. Throws Error, naming object, field and value: a pattern
// that matches no shading surface, a surface named twice or by a TransparentShade too, a number out
// of its range, a field that does not go with the shape of the holes, a texture that is no image or
// too large.
PerforatedScreens read_perforated_screens(std::vector<InputObject> const& objects,
                                          ShadingInput const& input,
                                          TransparentShades const& shades,
                                          std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus

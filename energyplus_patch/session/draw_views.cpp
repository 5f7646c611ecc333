#include "session/draw_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "gpu_shading/error.h"
#include "images/image_file.h"

namespace gpu_shading::energyplus {
namespace {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

SurfaceId find(Drawing const& drawing, std::string const& name) {
  auto const wanted = upper(name);
  for (SurfaceId id = 0; id < drawing.receivers; ++id) {
    auto const& surface = drawing.renderer.scene()[id];
    if (surface.name == wanted && area(surface.polygon) > 0.0) return id;
  }
  throw Error(
      fmt::format("receiver {}: the model has no such surface; see gpu_shading check", name));
}

}  // namespace

void draw_views(std::vector<View> const& views, std::filesystem::path const& folder,
                Drawing const& drawing) {
  for (auto const& view : views) {
    auto const receiver = find(drawing, view.receiver);
    write_image(folder / view.picture,
                drawing.renderer.sun_view(view.sun, receiver, drawing.size, drawing.factors));
  }
}

}  // namespace gpu_shading::energyplus

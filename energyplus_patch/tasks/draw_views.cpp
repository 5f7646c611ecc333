#include "tasks/draw_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "files/pictures.h"
#include "gpu_shading/error.h"
#include "gpu_shading/scene_view.h"
#include "platform/staged_files.h"
#include "platform/text.h"
#include "tasks/view_marks.h"

namespace gpu_shading::energyplus {
namespace {

SurfaceId find(Drawing const& drawing, std::string const& name) {
  auto const wanted = upper(name);
  for (SurfaceId const id : drawing.shown) {
    auto const& surface = drawing.renderer.scene()[id];
    if (surface.name == wanted && area(surface.polygon) > 0.0) return id;
  }
  throw Error(
      fmt::format("receiver {}: the model has no such surface; see gpu_shading check", name));
}

// By surface, for those that face the sun.
std::vector<std::optional<double>> sunlit_fractions(Drawing const& drawing, SunDirection sun) {
  auto const& scene = drawing.renderer.scene();
  auto const towards_sun = to_vector(sun);
  std::vector<std::optional<double>> fractions(scene.size());
  std::vector<SurfaceId> lit;
  for (SurfaceId const id : drawing.shown) {
    if (!drawing.receives[id] || area(scene[id].polygon) <= 0.0) continue;
    fractions[id] = 0.0;
    if (glm::dot(normal(scene[id].polygon), towards_sun) > 0.0) lit.push_back(id);
  }
  auto const areas = drawing.renderer.projected_sunlit_areas(sun, lit);
  for (std::size_t i = 0; i < lit.size(); ++i) {
    auto const& polygon = scene[lit[i]].polygon;
    double const most = area(polygon) * glm::dot(normal(polygon), towards_sun);
    fractions[lit[i]] = std::min(1.0, areas[i].at(drawing.factors) / most);
  }
  return fractions;
}

std::string draw_whole(SceneView& scene, SunView const& view,
                       std::vector<std::optional<double>> const& fractions, int size) {
  if (!view.camera) return encode_image(view.picture, scene.draw(view.sun, fractions, size));
  return encode_with_marks(view.picture, scene.draw(*view.camera, view.sun, fractions, size),
                           scene.scale(*view.camera, fractions, size));
}

}  // namespace

void draw_views(std::vector<SunView> const& views, std::filesystem::path const& folder,
                Drawing const& drawing) {
  StagedFiles files(folder);
  std::optional<SceneView> whole;
  for (auto const& view : views) {
    if (view.receiver.empty()) {
      auto const fractions = sunlit_fractions(drawing, view.sun);
      // By the device that gave them, which may be the CPU in place of a GPU that was wrong.
      if (!whole) {
        whole.emplace(drawing.renderer.scene(), drawing.shown,
                      choice_of(drawing.renderer.device()));
      }
      files.write(view.picture, draw_whole(*whole, view, fractions, drawing.size));
    } else {
      auto const receiver = find(drawing, view.receiver);
      files.write(view.picture, encode_image(view.picture, drawing.renderer.sun_view(
                                                               view.sun, receiver, drawing.size,
                                                               drawing.factors)));
    }
  }
  files.commit();
}

}  // namespace gpu_shading::energyplus

#include "model/site/surroundings.h"

#include <algorithm>
#include <string_view>

#include "model/extensions/extension_fields.h"
#include "model/site/imported_geometry.h"
#include "model/site/site_context.h"
#include "model/site/site_origin.h"

namespace gpu_shading::energyplus {
namespace {

bool any_of_type(std::vector<InputObject> const& objects, std::string_view type) {
  return std::any_of(objects.begin(), objects.end(),
                     [&](InputObject const& object) { return object.type == type; });
}

}  // namespace

std::optional<TextureAxes> Surroundings::texture_of(SurfaceId surface) const {
  if (surface < first || surface - first >= casters.size()) return std::nullopt;
  return casters[surface - first].texture;
}

Surroundings read_surroundings(std::vector<InputObject> const& objects, AssetFolder const& folder) {
  Surroundings surroundings;
  std::optional<SiteOrigin> origin;
  if (any_of_type(objects, extension::site_context::type) || needs_origin(objects)) {
    origin = find_site_origin(objects);
    read_site_contexts(objects, folder.path, *origin, surroundings);
  }
  read_geometries(objects, folder, origin, surroundings);
  return surroundings;
}

}  // namespace gpu_shading::energyplus

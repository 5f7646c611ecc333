#include "scene/scene_hash.h"

#include <glm/trigonometric.hpp>
#include <map>
#include <optional>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"

namespace gpu_shading::energyplus {
namespace {

constexpr int samples_a_degree = 100;

Hash hash_of(Transmittance const& model) {
  Digest digest;
  for (int i = 0; i <= 90 * samples_a_degree; ++i) {
    digest.add(model(glm::radians(static_cast<double>(i) / samples_a_degree)));
  }
  return digest.result();
}

Hash hash_of(std::span<std::uint16_t const> texels) {
  Digest digest;
  digest.add(texels);
  return digest.result();
}

template <typename T>
void add(Digest& digest, std::optional<T> const& value) {
  digest.add(value.has_value());
  if (value) digest.add(*value);
}

void add(Digest& digest, Ring const& ring) {
  digest.add(std::uint64_t{ring.size()});
  for (auto const& vertex : ring) {
    for (double const coordinate : {vertex.x, vertex.y, vertex.z}) digest.add(coordinate);
  }
}

void add(Digest& digest, Polygon const& polygon) {
  add(digest, polygon.outline);
  digest.add(std::uint64_t{polygon.holes.size()});
  for (auto const& hole : polygon.holes) add(digest, hole);
}

void add(Digest& digest, Perforation const& perforation) {
  digest.add(perforation.hole);
  digest.add(perforation.arrangement);
  for (double const length :
       {perforation.size, perforation.length, perforation.pitch, perforation.row_pitch}) {
    digest.add(length);
  }
}

void add(Digest& digest, Sheet const& sheet) {
  digest.add(sheet.thickness);
  digest.add(sheet.plane);
  add(digest, sheet.layers);
  digest.add(sheet.detail);
}

void add(Digest& digest, ShadingRule const& rule) {
  digest.add(std::uint64_t{rule.roles.size()});
  for (auto const& role : rule.roles) {
    digest.add(role.wall);
    digest.add(role.zone);
    digest.add(role.shades);
    digest.add(role.target);
  }
  digest.add(std::uint64_t{rule.zones});
  digest.add(std::span(rule.zone_shades));
}

// Surfaces share long parts, which are hashed once.
class SurfaceDigest {
 public:
  explicit SurfaceDigest(Digest& digest) : digest_(digest) {}

  void add_surface(Surface const& surface) {
    add(digest_, surface.polygon);
    digest_.add(surface.casting);
    digest_.add(surface.transmittance != nullptr);
    if (surface.transmittance) add_shared(surface.transmittance.get(), *surface.transmittance);
    digest_.add(surface.schedule);
    digest_.add(surface.screen != nullptr);
    if (surface.screen) add_screen(*surface.screen);
    auto const& placement = surface.placement;
    for (double const value : {placement.origin_u, placement.origin_v, placement.rotation}) {
      digest_.add(value);
    }
    digest_.add(surface.deployment);
  }

 private:
  void add_screen(PerforatedScreen const& screen) {
    add(digest_, screen.sheet());
    digest_.add(screen.pattern().has_value());
    if (screen.pattern()) add(digest_, screen.pattern()->perforation());
    digest_.add(screen.tile().has_value());
    if (!screen.tile()) return;
    auto const& tile = *screen.tile();
    digest_.add(tile.width());
    digest_.add(tile.height());
    digest_.add(tile.columns());
    digest_.add(tile.rows());
    add(digest_, tile.threshold());
    add_shared(tile.opacity().data(), tile.opacity());
  }

  template <typename T>
  void add_shared(void const* place, T const& value) {
    auto const [known, added] = known_.try_emplace(place);
    if (added) known->second = hash_of(value);
    digest_.add(known->second);
  }

  Digest& digest_;
  std::map<void const*, Hash> known_;
};

}  // namespace

Hash hash_scene(Scene const& scene, Rendering const& rendering) {
  Digest digest;
  digest.add(rendering.build);
  auto const& device = rendering.device;
  for (std::string_view const name : {device.renderer, device.vendor, device.version}) {
    digest.add(name);
  }
  digest.add(device.max_resolution);
  add(digest, rendering.options.resolution);
  digest.add(rendering.options.error);
  add(digest, scene.rule());
  digest.add(std::uint64_t{scene.size()});
  SurfaceDigest surfaces(digest);
  for (SurfaceId id = 0; id < scene.size(); ++id) surfaces.add_surface(scene[id]);
  return digest.result();
}

}  // namespace gpu_shading::energyplus

#include "scene/scene_hash.h"

#include <map>
#include <optional>
#include <vector>

namespace gpu_shading::energyplus {
namespace {

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

// Hashes filters. Those share long parts, which are hashed once.
class SceneDigest : public FilterDigest {
 public:
  using Known = std::map<void const*, Hash>;

  SceneDigest(Digest& digest, Known& known) : digest_(digest), known_(known) {}

  void add(double value) override { digest_.add(value); }
  void add(std::span<std::uint16_t const> values) override { digest_.add(values); }
  void add_shared(void const* object,
                  std::function<void(FilterDigest&)> const& add_values) override {
    auto const [known, added] = known_.try_emplace(object);
    if (added) {
      Digest digest;
      SceneDigest shared(digest, known_);
      add_values(shared);
      known->second = digest.result();
    }
    digest_.add(known->second);
  }

 private:
  Digest& digest_;
  Known& known_;
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
  SceneDigest::Known known;
  SceneDigest filters(digest, known);
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    add(digest, scene[id].polygon);
    digest.add(scene[id].casting);
    scene[id].filter.add_to(filters);
  }
  return digest.result();
}

}  // namespace gpu_shading::energyplus

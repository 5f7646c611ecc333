#include "scene/scene_hash.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <utility>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"

namespace gpu_shading::energyplus {
namespace {

// All that a hash is made of, in values that tests change one by one.
struct Everything {
  std::vector<Surface> surfaces = std::vector<Surface>(3);
  Transmittance transmittance = Transmittance::table({0, 40, 80, 90}, {0.8, 0.7, 0.3, 0.0});
  Perforation perforation{Hole::Slotted, Arrangement::Straight, 0.004, 0.02, 0.03, 0.01};
  Sheet sheet{0.002, SheetPlane::centre, 3, ScreenDetail::automatic};
  PerforatedSheet placed;
  std::vector<std::uint16_t> texels{0, 65535, 0, 65535, 0, 0};
  double tile_width = 0.2;
  double tile_height = 0.3;
  int columns = 2;
  std::optional<double> threshold = 0.5;
  RendererOptions options;
  DeviceInfo device{.id = numbered_device(0),
                    .renderer = "renderer",
                    .vendor = "vendor",
                    .version = "version",
                    .max_resolution = 4096};
  ShadingRule rule{{{0, 0}, {1, 1}, {2, 0}}, 2, {1, 0, 1, 1}};
  std::vector<std::byte> build{std::byte{1}, std::byte{2}};

  Everything() {
    for (auto& surface : surfaces) {
      surface.name = "NAME";
      surface.polygon = {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {}};
      surface.polygon.holes = {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}},
                               {{3, 3, 0}, {3.5, 3, 0}, {3.5, 3.5, 0}}};
    }
  }

  Hash hash() {
    surfaces[0].filter.set(AngularTransmittance{std::make_shared<Transmittance>(transmittance)});
    placed.screen = std::make_shared<PerforatedScreen>(HolePattern(perforation), sheet);
    surfaces[1].filter.set(placed);
    auto const rows = static_cast<int>(texels.size()) / columns;
    surfaces[2].filter.set(PerforatedSheet{std::make_shared<PerforatedScreen>(
        OpacityTile(tile_width, tile_height, columns, rows, texels, threshold), sheet)});
    Scene scene;
    for (auto const& surface : surfaces) scene.add(surface);
    rule.roles.resize(surfaces.size());
    scene.set_rule(rule);
    return hash_scene(scene, {options, device, build});
  }
};

using Change = std::function<void(Everything&)>;

TEST(SceneHash, AnyInputThatAnAnswerDependsOnChangesIt) {
  std::vector<std::pair<char const*, Change>> const changes{
      {"a vertex", [](Everything& e) { e.surfaces[0].polygon.outline[2].z = 1e-7; }},
      {"vertices' order",
       [](Everything& e) {
         std::swap(e.surfaces[0].polygon.outline[0], e.surfaces[0].polygon.outline[2]);
       }},
      {"one vertex less", [](Everything& e) { e.surfaces[0].polygon.outline.pop_back(); }},
      {"a hole's vertex", [](Everything& e) { e.surfaces[1].polygon.holes[1][0].x = 2.9; }},
      {"a hole less", [](Everything& e) { e.surfaces[1].polygon.holes.pop_back(); }},
      {"two holes made one",
       [](Everything& e) {
         auto& holes = e.surfaces[1].polygon.holes;
         holes[0].insert(holes[0].end(), holes[1].begin(), holes[1].end());
         holes.pop_back();
       }},
      {"casting", [](Everything& e) { e.surfaces[0].casting = Casting::turned_away; }},
      {"schedule", [](Everything& e) { e.surfaces[0].filter.schedule = 0; }},
      {"deployment", [](Everything& e) { e.placed.deployment = 0; }},
      {"origin u", [](Everything& e) { e.placed.placement.origin_u = 0.1; }},
      {"origin v", [](Everything& e) { e.placed.placement.origin_v = 0.1; }},
      {"rotation", [](Everything& e) { e.placed.placement.rotation = 0.1; }},
      {"surfaces' order",
       [](Everything& e) {
         e.surfaces[0].polygon.outline[0].x = -1;
         std::swap(e.surfaces[0].polygon, e.surfaces[1].polygon);
       }},
      {"one surface more", [](Everything& e) { e.surfaces.emplace_back(); }},
      {"a value of a table",
       [](Everything& e) {
         e.transmittance = Transmittance::table({0, 40, 80, 90}, {0.8, 0.7, 0.3001, 0.0});
       }},
      {"a value between others close by",
       [](Everything& e) {
         e.transmittance =
             Transmittance::table({0, 40, 40.02, 40.04, 80, 90}, {0.8, 0.7, 0.69, 0.7, 0.3, 0.0});
       }},
      {"holes",
       [](Everything& e) {
         e.perforation = {Hole::Round, Arrangement::Straight, 0.004, 0.0, 0.03, 0.01};
       }},
      {"arrangement", [](Everything& e) { e.perforation.arrangement = Arrangement::Staggered60; }},
      {"size of holes", [](Everything& e) { e.perforation.size = 0.005; }},
      {"length of holes", [](Everything& e) { e.perforation.length = 0.021; }},
      {"pitch", [](Everything& e) { e.perforation.pitch = 0.031; }},
      {"row pitch", [](Everything& e) { e.perforation.row_pitch = 0.011; }},
      {"thickness", [](Everything& e) { e.sheet.thickness = 0.003; }},
      {"sheet plane", [](Everything& e) { e.sheet.plane = SheetPlane::inside; }},
      {"layers", [](Everything& e) { e.sheet.layers = 4; }},
      {"layers as needed", [](Everything& e) { e.sheet.layers.reset(); }},
      {"detail", [](Everything& e) { e.sheet.detail = ScreenDetail::effective; }},
      {"a texel", [](Everything& e) { e.texels[5] = 1; }},
      {"texels in other rows", [](Everything& e) { e.columns = 3; }},
      {"tile width", [](Everything& e) { e.tile_width = 0.21; }},
      {"tile height", [](Everything& e) { e.tile_height = 0.31; }},
      {"threshold", [](Everything& e) { e.threshold = 0.6; }},
      {"fractional opacity", [](Everything& e) { e.threshold.reset(); }},
      {"resolution", [](Everything& e) { e.options.resolution = 513; }},
      {"error", [](Everything& e) { e.options.error = 2e-3; }},
      {"renderer", [](Everything& e) { e.device.renderer = "renderers"; }},
      {"vendor", [](Everything& e) { e.device.vendor = "other"; }},
      {"driver", [](Everything& e) { e.device.version = "version 2"; }},
      {"largest tile", [](Everything& e) { e.device.max_resolution = 2048; }},
      {"a surface's wall", [](Everything& e) { e.rule.roles[1].wall = 0; }},
      {"a surface's zone", [](Everything& e) { e.rule.roles[1].zone = 0; }},
      {"what a surface shades",
       [](Everything& e) { e.rule.roles[1].shades = ShadingRule::Shades::own_wall; }},
      {"the surface that one shades", [](Everything& e) { e.rule.roles[1].target = 2; }},
      {"which zones shade which", [](Everything& e) { e.rule.zone_shades[1] = 1; }},
      {"build", [](Everything& e) { e.build[1] = std::byte{3}; }},
  };
  std::set<Hash> seen{Everything().hash()};
  for (auto const& [name, change] : changes) {
    Everything changed;
    change(changed);
    EXPECT_TRUE(seen.insert(changed.hash()).second) << name;
  }
}

TEST(SceneHash, ScreenThatIsGoneOrSharedCounts) {
  Everything with;
  Everything without;
  with.hash();
  without.hash();
  without.surfaces[1].filter.remove<PerforatedSheet>();
  Scene scenes[2];
  for (int i = 0; i < 2; ++i) {
    for (auto const& surface : (i == 0 ? with : without).surfaces) scenes[i].add(surface);
  }
  Rendering const rendering{with.options, with.device, with.build};
  EXPECT_NE(hash_scene(scenes[0], rendering), hash_scene(scenes[1], rendering));
}

TEST(SceneHash, NamesAndWhoSharesAndTheDevicesNumberDoNot) {
  auto const hash = Everything().hash();
  Everything other;
  for (auto& surface : other.surfaces) surface.name += " renamed";
  other.device.id.number = 3;
  EXPECT_EQ(other.hash(), hash);
}

// Surfaces may share a transmittance, or have equal ones each.
TEST(SceneHash, SharedOrEqualIsTheSame) {
  Everything everything;
  auto const hash_of_two = [&](bool shared) {
    Scene scene;
    auto const first = std::make_shared<Transmittance>(everything.transmittance);
    for (int i = 0; i < 2; ++i) {
      Surface surface;
      surface.filter.set(AngularTransmittance{
          shared ? first : std::make_shared<Transmittance>(everything.transmittance)});
      scene.add(surface);
    }
    return hash_scene(scene, {everything.options, everything.device, {}});
  };
  EXPECT_EQ(hash_of_two(true), hash_of_two(false));
}

TEST(BuildId, IsThere) { EXPECT_GE(build_id().size(), 8U); }

}  // namespace
}  // namespace gpu_shading::energyplus

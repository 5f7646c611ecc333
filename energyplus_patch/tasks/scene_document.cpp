#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "tasks/perform_task.h"

namespace gpu_shading::energyplus {
namespace {

using Document = nlohmann::ordered_json;

constexpr int steps_a_degree = 2;
constexpr std::size_t max_texels = std::size_t{4096} * 4096;

std::string text_of(Document const& json) {
  // Names in IDF files may be in Latin-1; in ASCII, control characters of any kind are escaped.
  return json.dump(-1, ' ', true, Document::error_handler_t::replace);
}

Document to_json(Transmittance const& model) {
  Document values = Document::array();
  for (int i = 0; i <= 90 * steps_a_degree; ++i) {
    values.push_back(model(glm::radians(static_cast<double>(i) / steps_a_degree)));
  }
  return values;
}

std::string hexadecimal(std::span<std::uint16_t const> texels) {
  std::string digits;
  digits.reserve(4 * texels.size());
  for (auto const texel : texels) fmt::format_to(std::back_inserter(digits), "{:04x}", texel);
  return digits;
}

Document to_json(HolePattern const& pattern) {
  constexpr std::array<std::string_view, 4> holes{"round", "square", "slotted", "hexagonal"};
  constexpr std::array<std::string_view, 3> arrangements{"straight", "staggered 45",
                                                         "staggered 60"};
  auto const& perforation = pattern.perforation();
  return {{"hole", holes.at(static_cast<std::size_t>(perforation.hole))},
          {"arrangement", arrangements.at(static_cast<std::size_t>(perforation.arrangement))},
          {"size", perforation.size},
          {"length", perforation.length},
          {"pitch", perforation.pitch},
          {"row_pitch", perforation.row_pitch}};
}

Document to_json(OpacityTile const& tile) {
  auto const texels = tile.opacity();
  if (texels.size() > max_texels) {
    throw Error(
        fmt::format("a texture of {} x {} texels, expected at most {} in all for a document",
                    tile.columns(), tile.rows(), max_texels));
  }
  Document json{{"width", tile.width()},
                {"height", tile.height()},
                {"columns", tile.columns()},
                {"rows", tile.rows()},
                {"opacity", hexadecimal(texels)}};
  json["threshold"] = tile.threshold() ? Document(*tile.threshold()) : Document();
  return json;
}

Document to_json(PerforatedScreen const& screen) {
  constexpr std::array<std::string_view, 3> planes{"centre", "outside", "inside"};
  constexpr std::array<std::string_view, 3> details{"automatic", "holes", "effective"};
  auto const& sheet = screen.sheet();
  Document json{{"thickness", sheet.thickness},
                {"plane", planes.at(static_cast<std::size_t>(sheet.plane))},
                {"detail", details.at(static_cast<std::size_t>(sheet.detail))}};
  json["layers"] = sheet.layers ? Document(*sheet.layers) : Document();
  if (screen.pattern()) json["pattern"] = to_json(*screen.pattern());
  if (screen.tile()) json["tile"] = to_json(*screen.tile());
  return json;
}

Document to_json(Crown const& crown) {
  constexpr std::array shapes{"ellipsoid", "cone", "cylinder", "half ellipsoid", "mesh"};
  constexpr std::array angles{"spherical", "planophile", "erectophile"};
  Document mesh;
  if (crown.mesh) {
    for (CrownMesh::Triangle const& triangle : crown.mesh->triangles()) {
      for (auto const& corner : triangle) mesh.push_back({corner.x, corner.y, corner.z});
    }
  }
  return {{"height", crown.height},
          {"mesh", std::move(mesh)},
          {"leaf_density", crown.leaf_density},
          {"shape", shapes.at(static_cast<std::size_t>(crown.shape))},
          {"leaf_angles", angles.at(static_cast<std::size_t>(crown.leaf_angles))},
          {"wood_density", crown.wood_density}};
}

// Objects that surfaces share, each once, with its index.
template <typename T>
class Shared {
 public:
  // "null", or the index.
  std::string add(std::shared_ptr<T const> const& object) {
    if (!object) return "null";
    auto const [known, added] = indices_.try_emplace(object.get(), indices_.size());
    if (added) documents_.push_back(to_json(*object));
    return std::to_string(known->second);
  }
  Document const& documents() const { return documents_; }

 private:
  std::map<T const*, std::size_t> indices_;
  Document documents_ = Document::array();
};

// Written piece by piece: a document of each number would take ten times the memory.
class SurfaceTexts {
 public:
  void add(Surface const& surface, bool receives) {
    constexpr std::array<std::string_view, 3> castings{"always", "turned away", "never"};
    auto const* const shade = surface.filter.find<AngularTransmittance>();
    auto const* const found = surface.filter.find<PerforatedSheet>();
    PerforatedSheet const sheet = found != nullptr ? *found : PerforatedSheet{};
    auto const* const crown = surface.filter.find<Crown>();
    auto const written =
        std::ranges::count(std::array{shade != nullptr, found != nullptr, crown != nullptr}, true);
    if (written != std::ssize(surface.filter.factors)) {
      throw Error(fmt::format("{}: a document of a scene has no field for its kind of filter",
                              surface.name));
    }
    auto const& [u, v, rotation] = sheet.placement;
    write(
        "{}\n{{\"name\":{},\"casts\":\"{}\",\"receives\":{},\"outline\":", text_.empty() ? "" : ",",
        text_of(surface.name), castings.at(static_cast<std::size_t>(surface.casting)), receives);
    add(surface.polygon.outline);
    write(",\"holes\":[");
    for (std::size_t i = 0; i < surface.polygon.holes.size(); ++i) {
      if (i > 0) text_ += ',';
      add(surface.polygon.holes[i]);
    }
    write(
        "],\"transmittance\":{},\"schedule\":{},\"screen\":{},\"origin\":[{},{}],"
        "\"rotation\":{},\"deployment\":{},\"crown\":{}}}",
        transmittances_.add(shade != nullptr ? shade->model : nullptr), surface.filter.schedule,
        screens_.add(sheet.screen), u, v, glm::degrees(rotation),
        crown != nullptr ? crown->deployment : sheet.deployment,
        crown != nullptr ? text_of(to_json(*crown)) : "null");
  }

  std::string const& text() const { return text_; }
  Document const& transmittances() const { return transmittances_.documents(); }
  Document const& screens() const { return screens_.documents(); }

 private:
  template <typename... Values>
  void write(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  void add(Ring const& ring) {
    text_ += '[';
    for (std::size_t i = 0; i < ring.size(); ++i) {
      write("{}[{},{},{}]", i > 0 ? "," : "", ring[i].x, ring[i].y, ring[i].z);
    }
    text_ += ']';
  }

  std::string text_;
  Shared<Transmittance> transmittances_;
  Shared<PerforatedScreen> screens_;
};

// Surfaces with a polygon. EnergyPlus's InternalMass has none, but a place among its surfaces.
std::vector<SurfaceId> drawn(Scene const& scene) {
  constexpr std::size_t min_vertices = 3;
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (scene[id].polygon.outline.size() >= min_vertices) ids.push_back(id);
  }
  return ids;
}

// The rule for these surfaces alone, numbered anew.
std::string rule_text(ShadingRule const& rule, std::vector<SurfaceId> const& ids) {
  std::string roles;
  for (SurfaceId number = 0; !rule.empty() && number < ids.size(); ++number) {
    auto const& role = rule.roles[ids[number]];
    auto const target = std::ranges::lower_bound(ids, role.target);
    // No surface shades itself: one whose only target is left out shades none.
    auto const renumbered = target != ids.end() && *target == role.target
                                ? static_cast<SurfaceId>(target - ids.begin())
                                : number;
    fmt::format_to(std::back_inserter(roles), "{}[{},{},{},{}]", roles.empty() ? "" : ",",
                   role.wall, role.zone, static_cast<int>(role.shades), renumbered);
  }
  return fmt::format("{{\"zones\":{},\"zone_shades\":[{}],\"roles\":[{}]}}", rule.zones,
                     fmt::join(rule.zone_shades, ","), roles);
}

}  // namespace

std::string scene_document(SceneAssembly& assembly) {
  assembly.optics().update({});
  auto const scene = assembly.scene();
  std::vector<bool> receives(scene.size(), false);
  for (auto const id : assembly.shown_receivers()) receives[id] = true;
  SurfaceTexts surfaces;
  auto const ids = drawn(scene);
  for (auto const id : ids) surfaces.add(scene[id], receives[id]);
  auto const& options = assembly.model().options;
  Document head{{"format", "gpu_shading scene 1"}, {"error", options.error}};
  head["resolution"] = options.resolution ? Document(*options.resolution) : Document();
  head["schedules"] = assembly.optics().factor_names();
  head["deployments"] = assembly.optics().deployment_names();
  head["transmittances"] = surfaces.transmittances();
  head["screens"] = surfaces.screens();
  auto text = text_of(head);
  text.pop_back();
  return text + ",\n\"rule\":" + rule_text(scene.rule(), ids) + ",\n\"surfaces\":[" +
         surfaces.text() + "]}\n";
}

}  // namespace gpu_shading::energyplus

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "gpu_shading/crown.h"
#include "gpu_shading/error.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "model/idf/placeholders.h"
#include "model/site/farthest_coordinate.h"
#include "model/site/surroundings.h"
#include "model/site/tree_file.h"
#include "model/site/tree_genera.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::tree;

// The extinction along a sphere's diameter at which it transmits a share of the beam, over its
// disc: 2 (1 - (1 + k) exp(-k)) / k^2.
double extinction_of(double share) {
  double low = 0.0;
  double high = 100.0;
  for (int i = 0; i < 60; ++i) {
    double const k = 0.5 * (low + high);
    double const transmitted = 2.0 * (1.0 - (1.0 + k) * std::exp(-k)) / (k * k);
    (transmitted > share ? low : high) = k;
  }
  return 0.5 * (low + high);
}

// Konarska et al. (2014) measured 1.3 to 5.3 % of the beam through crowns of street trees in leaf,
// and 40.2 to 51.9 % without leaves.
double with_leaves() {
  static double const extinction = extinction_of(0.03);
  return extinction;
}

double without_leaves() {
  static double const extinction = extinction_of(0.46);
  return extinction;
}

CrownShape shape_of(field::CrownShape shape) {
  switch (shape) {
    case field::CrownShape::half_ellipsoid:
      return CrownShape::half_ellipsoid;
    case field::CrownShape::cone:
      return CrownShape::cone;
    case field::CrownShape::cylinder:
      return CrownShape::cylinder;
    case field::CrownShape::mesh:
      return CrownShape::mesh;
    case field::CrownShape::ellipsoid:
      break;
  }
  return CrownShape::ellipsoid;
}

// Of the extinction in leaf: on average 0.26 of eleven trees whose transmittance was measured in
// leaf and without (Brown and Gillespie, 1990; Gardner and Sydnor, 1984).
constexpr double wood_share = 0.25;

LeafAngles angles_of(field::LeafAngles angles) {
  switch (angles) {
    case field::LeafAngles::planophile:
      return LeafAngles::planophile;
    case field::LeafAngles::erectophile:
      return LeafAngles::erectophile;
    case field::LeafAngles::spherical:
      break;
  }
  return LeafAngles::spherical;
}

// Of the box around it.
double share_of_box(Crown const& crown) {
  using std::numbers::pi;
  switch (crown.shape) {
    case CrownShape::mesh:
      return crown.mesh->volume() / 8.0;
    case CrownShape::cone:
      return pi / 12.0;
    case CrownShape::cylinder:
      return pi / 4.0;
    case CrownShape::ellipsoid:
    case CrownShape::half_ellipsoid:
      break;
  }
  return pi / 6.0;
}

// Whether a mesh is the outline of crowns.
bool is_outline(Surroundings const& surroundings, OutsideCaster const& caster,
                std::string const& pattern) {
  auto const& name = caster.surface.name;
  return matches(pattern, name) && surroundings.types.at(name) == extension::geometry::type;
}

// Where a tree stands, and its own sizes.
struct Standing {
  std::string name;
  glm::dvec3 foot{0.0};
  std::optional<double> height;
  std::optional<double> diameter;
  std::optional<bool> evergreen;
  TreeGenus const* genus = nullptr;  // unknown: nullptr
};

// Outlines of crowns, by Crown Mesh Name: trees share them.
using Outlines = std::map<std::string, std::shared_ptr<CrownMesh const>>;

// The triangles of meshes as the outline of a crown.
std::shared_ptr<CrownMesh const> read_outline(std::string const& name,
                                              Surroundings const& surroundings) {
  std::vector<CrownMesh::Triangle> triangles;
  glm::dvec3 low(HUGE_VAL);
  glm::dvec3 high(-HUGE_VAL);
  for (auto const& caster : surroundings.casters) {
    if (!is_outline(surroundings, caster, name)) continue;
    auto const& ring = caster.surface.polygon.outline;
    triangles.push_back({ring[0], ring[1], ring[2]});
    for (auto const& point : ring) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  return naming(fmt::format("{}: {}", field::crown_mesh_name.title, printable(name)), [&] {
    if (triangles.empty()) throw Error("expected the name of a mesh of a GPUShading:Geometry");
    glm::dvec3 half = 0.5 * (high - low);
    half.x = half.y = std::max(half.x, half.y);
    for (auto& triangle : triangles) {
      for (auto& point : triangle) {
        point = glm::clamp((point - 0.5 * (low + high)) / half, -1.0, 1.0);
      }
    }
    return std::make_shared<CrownMesh const>(std::move(triangles));
  });
}

// Creates the casters of one object.
class Builder {
 public:
  Builder(InputObject const& object, Surroundings& surroundings, Outlines& outlines)
      : object_(object), surroundings_(surroundings) {
    if (shape_of(read(object, field::crown_shape)) == CrownShape::mesh) {
      auto const name = read(object, field::crown_mesh_name);
      auto& outline = outlines[name];
      if (!outline) outline = read_outline(name, surroundings);
      mesh_ = outline;
    } else {
      expect_blank(object, {field::crown_mesh_name}, "without the shape Mesh");
    }
  }

  void add(Standing const& tree, std::function<double()> const& latitude) {
    double const height = tree.height ? *tree.height : needed(object_, field::height);
    double const diameter = tree.diameter.value_or(0.5 * height);
    double const base = read(object_, field::crown_base_height).value_or(0.25 * height);
    if (base >= height) {
      throw Error(fmt::format("{} is {} m, expected less than the height of {} m",
                              field::crown_base_height.title, base, height));
    }
    surroundings_.types.try_emplace(tree.name, std::string(field::type));
    add_crown(tree, base, height, diameter, latitude);
    add_trunk(tree, 0.5 * (base + height));
    ++trees_;
  }

  // That of a tree in a file, which has the default densities then.
  void add_unknown_genus(std::string const& taxon) {
    ++unknown_;
    if (unknown_genera_.size() < 5) unknown_genera_.insert(printable(taxon));
  }

  std::string describe(std::string const& from) const {
    auto text = fmt::format("{} {}: {}{} tree{}; {}", field::type, object_.name,
                            from.empty() ? "" : from + ": ", trees_, trees_ == 1 ? "" : "s",
                            extent_.describe());
    if (unknown_ > 0) {
      text += fmt::format("; {} of a genus of unknown density, such as {}", unknown_,
                          fmt::join(unknown_genera_, ", "));
    }
    return text;
  }

 private:
  void add_caster(Surface surface) {
    for (auto const& point : surface.polygon.outline) {
      if (is_within_reach(point)) continue;
      throw Error(fmt::format("{} {}", printable(surface.name), describe_out_of_reach(point)));
    }
    extent_.include(surface.polygon.outline);
    surroundings_.casters.push_back({std::move(surface), std::nullopt});
  }

  void add_crown(Standing const& tree, double base, double height, double diameter,
                 std::function<double()> const& latitude) {
    Crown crown;
    crown.shape = shape_of(read(object_, field::crown_shape));
    crown.mesh = mesh_;
    crown.height = height - base;
    crown.leaf_angles = angles_of(read(object_, field::leaf_angles));
    double const box = diameter * diameter * crown.height;
    double const sphere = std::cbrt(6.0 / std::numbers::pi * share_of_box(crown) * box);
    constexpr double projection = 0.5;
    auto const* const genus = tree.genus;
    double const in_leaf = genus ? genus->density_in_leaf : with_leaves() / (projection * sphere);
    double const bare = genus ? wood_share * in_leaf : without_leaves() / (projection * sphere);
    crown.wood_density = read(object_, field::wood_area_density).value_or(bare);
    crown.leaf_density = read(object_, field::leaf_area_density)
                             .value_or(std::max(0.0, in_leaf - crown.wood_density));
    crown.deployment = leaf_share(tree, latitude);
    double const half = 0.5 * diameter;
    Surface surface;
    surface.name = tree.name;
    for (auto const& [x, y] : {std::pair(-half, -half), std::pair(half, -half),
                               std::pair(half, half), std::pair(-half, half)}) {
      surface.polygon.outline.push_back(tree.foot + glm::dvec3(x, y, base));
    }
    surface.filter.set(crown);
    add_caster(std::move(surface));
    extent_.include({tree.foot + glm::dvec3(0.0, 0.0, height)});
  }

  void add_trunk(Standing const& tree, double top) {
    double const diameter = read(object_, field::trunk_diameter);
    if (diameter == 0.0) return;
    constexpr int sides = 6;
    auto const corner = [&](int i, double z) {
      double const angle = 2.0 * std::numbers::pi * i / sides;
      return tree.foot +
             glm::dvec3(0.5 * diameter * std::cos(angle), 0.5 * diameter * std::sin(angle), z);
    };
    for (int i = 0; i < sides; ++i) {
      Surface side;
      side.name = tree.name;
      side.polygon.outline = {corner(i, 0.0), corner(i + 1, 0.0), corner(i + 1, top),
                              corner(i, top)};
      add_caster(std::move(side));
    }
  }

  // The position of the crown's schedule in those of the surroundings; -1: always all leaves.
  int leaf_share(Standing const& tree, std::function<double()> const& latitude) {
    auto schedule = upper(read(object_, field::leaf_schedule_name));
    if (schedule.empty()) {
      if (is_evergreen(tree)) return -1;
      schedule = season_schedule(latitude() < 0.0);
    }
    auto& known = surroundings_.leaf_schedules;
    auto const found = std::ranges::find(known, schedule);
    if (found != known.end()) return static_cast<int>(found - known.begin());
    known.push_back(schedule);
    return static_cast<int>(known.size() - 1);
  }

  bool is_evergreen(Standing const& tree) const {
    if (tree.evergreen) return *tree.evergreen;
    if (auto const cycle = read(object_, field::leaf_cycle)) {
      return *cycle == field::LeafCycle::evergreen;
    }
    return tree.genus && tree.genus->evergreen;
  }

  InputObject const& object_;
  Surroundings& surroundings_;
  std::shared_ptr<CrownMesh const> mesh_;
  Extent extent_;
  std::size_t trees_ = 0;
  std::size_t unknown_ = 0;
  std::set<std::string> unknown_genera_;  // some of them
};

// Of the object; nullptr if the field is blank.
TreeGenus const* read_genus(InputObject const& object) {
  auto const taxon = read(object, field::genus);
  if (taxon.empty()) return nullptr;
  if (auto const* const found = find_genus(taxon)) return found;
  throw Error(fmt::format("{} is {}, expected one of {}", field::genus.title, printable(taxon),
                          list_genera()));
}

void read_single(InputObject const& object, Builder& builder,
                 std::function<double()> const& latitude) {
  expect_blank(object, {field::coordinates}, "without File Name");
  Standing tree{
      upper(object.name),
      {needed(object, field::x), needed(object, field::y), read(object, field::z).value_or(0.0)},
      needed(object, field::height),
      read(object, field::crown_diameter),
      std::nullopt,
      read_genus(object)};
  builder.add(tree, latitude);
}

void read_mapped(InputObject const& object, Builder& builder, std::filesystem::path const& folder,
                 std::string const& file, SiteOrigin const& origin,
                 std::vector<TerrainGrid> const& terrains) {
  expect_blank(object, {field::x, field::y, field::z}, "with File Name");
  auto const coordinates = read_map_coordinates(object, field::coordinates);
  auto const trees =
      naming(field::file_name.title, [&] { return read_tree_file(folder / file, coordinates); });
  LocalAxes const axes(origin.place);
  auto const* const genus = read_genus(object);
  for (auto const& mapped : trees.trees) {
    auto place = mapped.place;
    place.elevation = origin.place.elevation;
    for (auto const& terrain : terrains) {
      if (auto const elevation = elevation_at(terrain, place)) {
        place.elevation = *elevation;
        break;
      }
    }
    Standing tree{
        upper(object.name + ":" + mapped.name),
        axes.to_local(place),
        mapped.height ? mapped.height : read(object, field::height),
        mapped.crown_diameter ? mapped.crown_diameter : read(object, field::crown_diameter),
        mapped.evergreen,
        mapped.taxon.empty() ? genus : find_genus(mapped.taxon)};
    if (!mapped.taxon.empty() && !tree.genus) builder.add_unknown_genus(mapped.taxon);
    naming(fmt::format("{}: {}: tree {}", field::file_name.title, file, mapped.name),
           [&] { builder.add(tree, [&] { return origin.place.latitude; }); });
  }
}

}  // namespace

bool needs_origin_for_trees(std::vector<InputObject> const& objects) {
  return std::ranges::any_of(objects, [](InputObject const& object) {
    return object.type == field::type && !object[field::file_name.key].empty();
  });
}

void read_trees(std::vector<InputObject> const& objects, std::filesystem::path const& folder,
                std::optional<SiteOrigin> const& origin, std::vector<TerrainGrid> const& terrains,
                Surroundings& surroundings) {
  Outlines outlines;
  std::optional<double> latitude;  // once asked for: finding the origin takes all objects
  auto const find_latitude = [&] {
    if (!latitude) latitude = (origin ? *origin : find_site_origin(objects)).place.latitude;
    return *latitude;
  };
  for_each_of(objects, field::type, [&](InputObject const& object) {
    auto const file = read(object, field::file_name);
    Builder builder(object, surroundings, outlines);
    if (file.empty()) {
      read_single(object, builder, find_latitude);
    } else {
      read_mapped(object, builder, folder, file, *origin, terrains);
    }
    surroundings.remarks.push_back(builder.describe(file));
  });
  std::erase_if(surroundings.casters, [&](OutsideCaster const& caster) {
    return std::ranges::any_of(outlines, [&](auto const& outline) {
      return is_outline(surroundings, caster, outline.first);
    });
  });
}

}  // namespace gpu_shading::energyplus

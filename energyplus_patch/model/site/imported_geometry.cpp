
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <unordered_map>
#include <utility>

#include "files/mesh_file.h"
#include "gpu_shading/error.h"
#include "gpu_shading/local_axes.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "model/site/farthest_coordinate.h"
#include "model/site/surroundings.h"
#include "model/site/texture_axes.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::geometry;

// world = origin + axes x the file's point.
struct Placement {
  glm::dmat3 axes{1.0};
  glm::dvec3 origin{0.0};

  glm::dvec3 operator()(glm::dvec3 const& point) const { return origin + axes * point; }
};

double metres_in(field::Unit unit) {
  switch (unit) {
    case field::Unit::cm:
      return 0.01;
    case field::Unit::mm:
      return 0.001;
    case field::Unit::in:
      return 0.0254;
    case field::Unit::ft:
      return 0.3048;
    case field::Unit::m:
      break;
  }
  return 1.0;
}

// The file's axes to x east, y north, z up, in metres.
glm::dmat3 read_axes(InputObject const& object, bool stated) {
  // Columns: the directions of the file's x, y and z. With y up, north is away from the viewer: -z.
  glm::dmat3 const y_up{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  if (stated) {
    expect_blank(object, {field::unit, field::up_axis}, "with a file that states its own");
    return y_up;
  }
  auto const metres = metres_in(needed(object, field::unit));
  bool const is_y = needed(object, field::up_axis) == field::UpAxis::y;
  return metres * (is_y ? y_up : glm::dmat3(1.0));
}

// Clockwise, as seen from above.
glm::dmat3 turned(double degrees) {
  double const angle = glm::radians(degrees);
  double const c = std::cos(angle);
  double const s = std::sin(angle);
  return {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
}

Placement read_placement(InputObject const& object, bool stated,
                         std::optional<SiteOrigin> const& origin) {
  auto const axes = turned(read(object, field::rotation)) * read_axes(object, stated);
  auto const coordinates = read_coordinates(object, field::latitude, field::longitude);
  if (!coordinates) {
    expect_blank(object, {field::elevation}, "without Latitude and Longitude");
    return {axes, {read(object, field::x), read(object, field::y), read(object, field::z)}};
  }
  expect_blank(object, {field::x, field::y, field::z}, "with Latitude and Longitude");
  GeographicPoint const place{coordinates->latitude, coordinates->longitude,
                              read(object, field::elevation).value_or(origin->place.elevation)};
  LocalAxes const check(place);
  LocalAxes const world(origin->place);
  return {world.axes_at(place) * axes, world.to_local(place)};
}

// A summary of what one object added.
class Builder {
 public:
  Builder(InputObject const& object, Surroundings& surroundings)
      : object_(object),
        surroundings_(surroundings),
        left_out_(read(object, field::left_out_name)) {}

  void add(Mesh const& mesh, Placement const& place) {
    auto const part = mesh.material + ":" + mesh.name;
    if (matches_any(left_out_, part)) {
      ++left_out_meshes_;
      return;
    }
    auto const name = upper(object_.name + ":" + part);
    surroundings_.types.try_emplace(name, std::string(field::type));
    ++meshes_;
    std::vector<glm::dvec3> points;
    points.reserve(mesh.positions.size());
    for (auto const& position : mesh.positions) {
      points.push_back(place(position));
      auto const& point = points.back();
      if (is_within_reach(point)) continue;
      throw Error(fmt::format("vertex {} of {} {}", points.size(), printable(part),
                              describe_out_of_reach(point)));
    }
    surroundings_.casters.reserve(surroundings_.casters.size() + mesh.triangles.size());
    for (auto const& [a, b, c] : mesh.triangles) {
      OutsideCaster caster;
      caster.surface.name = name;
      caster.surface.polygon.outline = {points[a], points[b], points[c]};
      if (!mesh.texture.empty()) {
        caster.texture = texture_axes({points[a], points[b], points[c]},
                                      {mesh.texture[a], mesh.texture[b], mesh.texture[c]});
      }
      turn_to_read(caster);
      extent_.include(caster.surface.polygon.outline);
      surroundings_.casters.push_back(std::move(caster));
      ++triangles_;
    }
  }

  std::string describe(std::string const& file) const {
    return fmt::format("{} {}: {}: {} mesh{}, {} triangles{}; {}", field::type, object_.name, file,
                       meshes_, meshes_ == 1 ? "" : "es", triangles_,
                       left_out_meshes_ == 0 ? "" : fmt::format(" ({} left out)", left_out_meshes_),
                       extent_.describe());
  }

 private:
  // Makes u, v and the normal right-handed.
  static void turn_to_read(OutsideCaster& caster) {
    if (!caster.texture) return;
    auto& ring = caster.surface.polygon.outline;
    auto const facing = glm::cross(ring[1] - ring[0], ring[2] - ring[0]);
    if (glm::dot(glm::cross(caster.texture->u, caster.texture->v), facing) < 0.0) {
      std::swap(ring[1], ring[2]);
    }
  }

  InputObject const& object_;
  Surroundings& surroundings_;
  std::vector<std::string> left_out_;
  Extent extent_;
  std::size_t meshes_ = 0;
  std::size_t triangles_ = 0;
  std::size_t left_out_meshes_ = 0;
};

// Decodes each file once, and keeps its meshes while further objects name it. Small files that are
// named next are decoded meanwhile.
class MeshFiles {
 public:
  MeshFiles(std::vector<InputObject> const& objects, AssetFolder const& folder) : folder_(folder) {
    for (auto const& object : objects) {
      if (object.type != field::type) continue;
      auto const& name = object[field::file_name.key];
      if (++files_[name].named == 1) order_.push_back(name);
    }
  }

  std::shared_ptr<std::vector<Mesh> const> read(std::string const& file) {
    begin_next();
    auto& [named, reading, kept] = files_[file];
    auto meshes = kept;
    if (!meshes) {
      ++taken_;
      if (!reading) reading = begin_reading_meshes(folder_.path / file, folder_.assets);
      meshes = std::make_shared<std::vector<Mesh> const>(std::exchange(reading, nullptr)());
    }
    --named;
    kept = named > 0 ? meshes : nullptr;
    return meshes;
  }

 private:
  struct File {
    int named = 0;  // by objects that have not read it yet
    MeshReading reading;
    std::shared_ptr<std::vector<Mesh> const> kept;
  };

  void begin_next() {
    constexpr std::size_t max_ahead = 4;
    constexpr std::uintmax_t small = std::uintmax_t{1} << 20U;
    for (; next_ < order_.size() && next_ < taken_ + max_ahead; ++next_) {
      auto const path = folder_.path / order_[next_];
      std::error_code failure;
      if (std::filesystem::file_size(path, failure) > small || failure) continue;
      try {
        files_[order_[next_]].reading = begin_reading_meshes(path, folder_.assets);
      } catch (Error const&) {  // NOLINT(bugprone-empty-catch): it comes again when it is read
      }
    }
  }

  AssetFolder const& folder_;
  std::unordered_map<std::string, File> files_;
  std::vector<std::string> order_;  // of their first objects
  std::size_t next_ = 0;            // of these to begin
  std::size_t taken_ = 0;
};

void read_geometry(InputObject const& object, MeshFiles& files, AssetFolder const& folder,
                   std::optional<SiteOrigin> const& origin, Surroundings& surroundings) {
  auto const file = read(object, field::file_name);
  bool const stated =
      naming(field::file_name.title, [&] { return states_its_axes(file, folder.assets); });
  auto const placement = read_placement(object, stated, origin);
  auto const meshes = naming(field::file_name.title, [&] { return files.read(file); });
  Builder builder(object, surroundings);
  naming(fmt::format("{}: {}", field::file_name.title, file), [&] {
    for (auto const& mesh : *meshes) builder.add(mesh, placement);
  });
  surroundings.remarks.push_back(builder.describe(file));
}

}  // namespace

bool needs_origin(std::vector<InputObject> const& objects) {
  return std::ranges::any_of(objects, [](InputObject const& object) {
    return object.type == field::type && !object[field::latitude.key].empty();
  });
}

void read_geometries(std::vector<InputObject> const& objects, AssetFolder const& folder,
                     std::optional<SiteOrigin> const& origin, Surroundings& surroundings) {
  MeshFiles files(objects, folder);
  for_each_of(objects, field::type, [&](InputObject const& object) {
    read_geometry(object, files, folder, origin, surroundings);
  });
}

}  // namespace gpu_shading::energyplus

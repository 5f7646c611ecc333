#include "model/site/geo_package.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/site/sqlite_file.h"
#include "platform/text.h"

// The formats: https://www.geopackage.org/spec/ (clauses 2.1.3 and 3.1.3), ISO WKB of OGC 06-103r4,
// and the nodes of R-trees in ext/rtree/rtree.c of SQLite.
namespace gpu_shading::energyplus::geojson {
namespace {

using Ids = std::vector<std::int64_t>;

class WkbReader {
 public:
  WkbReader(Bytes const& bytes, std::size_t place, MapCoordinates const& coordinates)
      : in_{bytes, place}, coordinates_(coordinates) {}

  Geometry read() {
    add(0);
    return std::move(geometry_);
  }

 private:
  enum class Kind : std::uint8_t {
    point = 1,
    line,
    polygon,
    multi_point,
    multi_line,
    multi_polygon,
    collection
  };

  void add(int depth) {
    constexpr int max_depth = 10;
    constexpr std::uint32_t kinds = 1000;  // each with Z, M or both
    if (depth > max_depth) throw damaged("its collections are nested");
    in_.order = in_.next<std::uint8_t>() == 0 ? std::endian::big : std::endian::little;
    auto const type = in_.next<std::uint32_t>();
    constexpr std::array<std::size_t, 4> dimensions{2, 3, 3, 4};
    if (type / kinds >= dimensions.size()) throw damaged("a geometry has an unknown type");
    dimensions_ = dimensions.at(type / kinds);
    switch (static_cast<Kind>(type % kinds)) {
      case Kind::point:
        geometry_.points.push_back(position());
        return;
      case Kind::line:
        for (auto count = in_.next<std::uint32_t>(); count > 0; --count) coordinates();
        return;
      case Kind::polygon:
        geometry_.areas.push_back(area());
        return;
      case Kind::multi_point:
      case Kind::multi_line:
      case Kind::multi_polygon:
        for (auto count = in_.next<std::uint32_t>(); count > 0; --count) add(depth + 1);
        return;
      case Kind::collection:
        for (auto count = in_.next<std::uint32_t>(); count > 0; --count) add(depth + 1);
        geometry_.points.clear();  // points in collections are none, as in GeoJSON
        return;
    }
    if (depth > 0) throw damaged("a geometry has an unknown type");
  }

  MapPoint coordinates() {
    MapPoint const point{in_.next<double>(), in_.next<double>()};
    for (std::size_t i = 2; i < dimensions_; ++i) in_.next<double>();
    return point;
  }

  GeographicPoint position() { return coordinates_.to_geographic(coordinates()); }

  std::vector<GeographicPoint> positions() {
    std::vector<GeographicPoint> points;
    for (auto count = in_.next<std::uint32_t>(); count > 0; --count) points.push_back(position());
    return points;
  }

  Footprint area() {
    Footprint area;
    auto const rings = in_.next<std::uint32_t>();
    for (std::uint32_t i = 0; i < rings; ++i) {
      if (i == 0) {
        area.outline = positions();
      } else {
        area.holes.push_back(positions());
      }
    }
    return area;
  }

  Cursor in_;
  MapCoordinates const& coordinates_;
  std::size_t dimensions_ = 2;
  Geometry geometry_;
};

Geometry read_blob(Json const& blob, MapCoordinates const& coordinates) {
  if (!blob.is_binary()) return {};
  auto const& binary = blob.get_binary();
  Bytes const bytes({binary.begin(), binary.end()});
  constexpr std::size_t flags_at = 3;
  constexpr std::size_t header = 8;
  if (bytes.text(0, 2) != "GP") throw damaged("a geometry is not of a GeoPackage");
  auto const flags = bytes.at<std::uint8_t>(flags_at);
  constexpr std::array<std::size_t, 5> envelopes{0, 4, 6, 6, 8};
  auto const envelope = flags >> 1U & 7U;
  if (envelope >= envelopes.size()) throw damaged("a geometry has an unknown envelope");
  if ((flags & 16U) != 0) return {};  // empty
  return WkbReader(bytes, header + envelopes.at(envelope) * sizeof(double), coordinates).read();
}

class Package {
 public:
  Package(std::filesystem::path const& path, std::string const& layer) : file_(path) {
    std::vector<std::string> names;
    std::string read;
    for_each("gpkg_geometry_columns", [&](Json const& row) {
      names.push_back(text_of(member(row, "table_name")));
      if (!layer.empty() && layer != names.back()) return;
      read = names.back();
      geometry_ = text_of(member(row, "column_name"));
      srs_ = member(row, "srs_id");
    });
    if (read.empty() || (layer.empty() && names.size() > 1)) throw unknown_layer(names, layer);
    layer_ = table(read);
    index_ = file_.find("rtree_" + read + "_" + geometry_ + "_node");
  }

  // Throws Error if they are not ours.
  MapCoordinates coordinates() {
    std::string name = "an unknown system";
    for_each("gpkg_spatial_ref_sys", [&](Json const& row) {
      if (member(row, "srs_id") != srs_) return;
      name = fmt::format("{}:{}", text_of(member(row, "organization")),
                         text_of(member(row, "organization_coordsys_id")));
    });
    try {
      return MapCoordinates::parse(name);
    } catch (Error const& error) {
      throw Error(fmt::format("srs_id is {}", error.what()));
    }
  }

  void read(std::optional<Nearby> const& nearby, MapCoordinates const& coordinates,
            UseFeature const& use) {
    std::optional<Ids> ids;
    if (nearby && index_) ids = find(nearby->boxes(coordinates));
    file_.read(
        layer_,
        [&](std::int64_t id, SqliteFile::Row const& row) {
          auto const properties = named(layer_, row);
          auto const read = [&] { return read_blob(member(properties, geometry_), coordinates); };
          use_numbered("", properties, static_cast<std::size_t>(id), read, use);
        },
        ids);
  }

 private:
  static Error unknown_layer(std::vector<std::string> const& names, std::string const& layer) {
    constexpr std::size_t max_listed = 10;
    std::string listed;
    for (std::size_t i = 0; i < std::min(names.size(), max_listed); ++i) {
      listed += (i == 0 ? ": " : ", ") + printable(names[i]);
    }
    auto const has = fmt::format("has {} layers{}", names.size(), listed);
    if (!layer.empty()) return Error(fmt::format("{}, but not {}", has, printable(layer)));
    return Error(has + ", expected one, or a name that ends in |layername=LAYER");
  }

  SqliteFile::Table table(std::string const& name) {
    auto const found = file_.find(name);
    if (!found)
      throw Error(
          fmt::format("is not a GeoPackage of features: it has no table {}", printable(name)));
    return *found;
  }

  static Json named(SqliteFile::Table const& table, SqliteFile::Row const& row) {
    auto values = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) values[table.columns[i]] = row[i];
    return values;
  }

  void for_each(std::string const& name, std::function<void(Json const&)> const& use) {
    auto const found = table(name);
    file_.read(found, [&](std::int64_t, SqliteFile::Row const& row) { use(named(found, row)); });
  }

  // The sorted ids of the rows whose boxes meet one of the boxes.
  Ids find(std::vector<Box> const& boxes) {
    constexpr std::int64_t root = 1;
    constexpr int max_depth = 40;
    Ids nodes{root};
    for (int level = 0, depth = 0; level <= depth; ++level) {
      Ids next;
      std::size_t found = 0;
      file_.read(
          *index_,
          [&](std::int64_t, SqliteFile::Row const& row) {
            ++found;
            if (row.size() < 2 || !row[1].is_binary()) throw damaged("its index has no node");
            auto const& node = row[1].get_binary();
            Bytes const bytes({node.begin(), node.end()});
            Cursor in{bytes, 0, std::endian::big};
            auto const levels = in.next<std::uint16_t>();
            if (level == 0) depth = levels;
            if (depth > max_depth) throw damaged("its index is too deep");
            auto const cells = in.next<std::uint16_t>();
            for (int i = 0; i < cells; ++i) {
              auto const id = in.next<std::int64_t>();
              Box box{};
              for (double* side : {&box.west, &box.east, &box.south, &box.north}) {
                *side = in.next<float>();
              }
              if (box.meets_any(boxes)) next.push_back(id);
            }
          },
          nodes);
      if (found < nodes.size()) throw damaged("its index lacks a node");
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      nodes = std::move(next);
    }
    return nodes;
  }

  SqliteFile file_;
  std::string geometry_;  // its column
  Json srs_;
  SqliteFile::Table layer_;
  std::optional<SqliteFile::Table> index_;
};

}  // namespace

MapCoordinates read_geo_package(std::filesystem::path const& path, std::string const& layer,
                                std::optional<MapCoordinates> const& coordinates,
                                std::optional<Nearby> const& nearby, UseFeature const& use) {
  Package package(path, layer);
  auto const used = coordinates ? *coordinates : package.coordinates();
  package.read(nearby, used, use);
  return used;
}

}  // namespace gpu_shading::energyplus::geojson

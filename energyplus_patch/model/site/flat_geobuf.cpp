#include "model/site/flat_geobuf.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "model/site/binary_file.h"

// The format: https://flatgeobuf.org and its header.fbs and feature.fbs; the encoding of tables:
// https://flatbuffers.dev/internals. Both are little-endian.
namespace gpu_shading::energyplus::geojson {
namespace {

struct Vector {
  std::size_t place = 0;
  std::size_t count = 0;
};

// A table of FlatBuffers. Its fields are numbered in the order of the schema.
class Table {
 public:
  Table(Bytes const& bytes, std::size_t place) : bytes_(&bytes), place_(place) {
    auto const back = bytes.at<std::int32_t>(place);
    auto const table = static_cast<std::int64_t>(place) - back;
    if (table < 0) throw damaged("an offset is too large");
    fields_ = static_cast<std::size_t>(table);
    size_ = bytes.at<std::uint16_t>(fields_);
  }

  static Table root(Bytes const& bytes) { return {bytes, bytes.at<std::uint32_t>(0)}; }

  template <typename Value>
  Value number(std::size_t field, Value otherwise) const {
    auto const place = find(field);
    return place ? bytes_->at<Value>(*place) : otherwise;
  }

  std::optional<Table> table(std::size_t field) const {
    auto const place = find(field);
    if (!place) return std::nullopt;
    return Table(*bytes_, *place + bytes_->at<std::uint32_t>(*place));
  }

  // `size`: of an element.
  Vector vector(std::size_t field, std::size_t size) const {
    auto const place = find(field);
    if (!place) return {};
    auto const start = *place + bytes_->at<std::uint32_t>(*place);
    Vector const vector{start + sizeof(std::uint32_t), bytes_->at<std::uint32_t>(start)};
    if ((bytes_->size() - vector.place) / size < vector.count) throw damaged("a list is too long");
    return vector;
  }

  std::vector<Table> tables(std::size_t field) const {
    std::vector<Table> tables;
    auto const vector = this->vector(field, sizeof(std::uint32_t));
    for (std::size_t i = 0; i < vector.count; ++i) {
      auto const place = vector.place + i * sizeof(std::uint32_t);
      tables.emplace_back(*bytes_, place + bytes_->at<std::uint32_t>(place));
    }
    return tables;
  }

  std::string text(std::size_t field) const {
    auto const vector = this->vector(field, 1);
    return std::string(bytes_->text(vector.place, vector.count));
  }

  Bytes const& bytes() const { return *bytes_; }

 private:
  std::optional<std::size_t> find(std::size_t field) const {
    auto const slot = sizeof(std::uint16_t) * (2 + field);
    if (slot + sizeof(std::uint16_t) > size_) return std::nullopt;
    auto const offset = bytes_->at<std::uint16_t>(fields_ + slot);
    return offset == 0 ? std::nullopt : std::optional(place_ + offset);
  }

  Bytes const* bytes_;
  std::size_t place_;
  std::size_t fields_ = 0;
  std::size_t size_ = 0;
};

namespace header {
constexpr std::size_t geometry_type = 2;
constexpr std::size_t columns = 7;
constexpr std::size_t features_count = 8;
constexpr std::size_t index_node_size = 9;
constexpr std::size_t crs = 10;
}  // namespace header

enum class GeometryType : std::uint8_t {
  unknown = 0,
  point = 1,
  polygon = 3,
  multi_point = 4,
  multi_polygon = 6,
  collection = 7
};

// Of features, in the order of the format.
enum class ColumnType : std::uint8_t {
  int8,
  uint8,
  boolean,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  text,
  json,
  date,
  binary
};

struct Column {
  std::string name;
  ColumnType type;
};

std::vector<Column> read_columns(Table const& table, std::size_t field) {
  std::vector<Column> columns;
  for (auto const& column : table.tables(field)) {
    columns.push_back({column.text(0), column.number(1, ColumnType::int8)});
  }
  return columns;
}

// Reads the geometry of one feature.
class GeometryReader {
 public:
  GeometryReader(Bytes const& bytes, MapCoordinates const& coordinates)
      : coordinates_(coordinates), left_(bytes.size()) {}

  Geometry read(Table const& table, GeometryType otherwise) {
    auto const type = type_of(table, otherwise);
    if (type == GeometryType::point || type == GeometryType::multi_point) {
      geometry_.points = positions(table, 0, count(table));
    } else {
      add_areas(table, type);
    }
    return std::move(geometry_);
  }

 private:
  static GeometryType type_of(Table const& table, GeometryType otherwise) {
    auto const type = table.number(6, GeometryType::unknown);
    return type == GeometryType::unknown ? otherwise : type;
  }

  void add_areas(Table const& table, GeometryType type) {
    if (type == GeometryType::polygon) {
      geometry_.areas.push_back(area(table));
    } else if (type == GeometryType::multi_polygon) {
      for (auto const& part : table.tables(7)) geometry_.areas.push_back(area(part));
    } else if (type == GeometryType::collection) {
      constexpr int max_depth = 10;
      if (++depth_ > max_depth) throw damaged("its collections are nested");
      for (auto const& part : table.tables(7)) {
        spend(1);
        add_areas(part, type_of(part, GeometryType::unknown));
      }
      --depth_;
    }
  }

  // Parts may share bytes, but no more is read than the feature could have.
  void spend(std::size_t count) {
    if (count > left_) throw damaged("its parts overlap");
    left_ -= count;
  }

  static std::size_t count(Table const& table) { return table.vector(1, sizeof(double)).count / 2; }

  std::vector<GeographicPoint> positions(Table const& table, std::size_t from, std::size_t to) {
    constexpr std::size_t size = 2 * sizeof(double);
    auto const xy = table.vector(1, sizeof(double));
    if (from > to || to > xy.count / 2) throw damaged("a ring ends beyond its positions");
    spend(1 + to - from);
    std::vector<GeographicPoint> points;
    points.reserve(to - from);
    for (auto i = from; i < to; ++i) {
      auto const place = xy.place + i * size;
      points.push_back(coordinates_.to_geographic(
          {table.bytes().at<double>(place), table.bytes().at<double>(place + sizeof(double))}));
    }
    return points;
  }

  Footprint area(Table const& table) {
    Footprint area;
    auto const ends = table.vector(0, sizeof(std::uint32_t));
    std::size_t from = 0;
    for (std::size_t i = 0; i < std::max<std::size_t>(ends.count, 1); ++i) {
      std::size_t const to =
          ends.count == 0 ? count(table)
                          : table.bytes().at<std::uint32_t>(ends.place + i * sizeof(std::uint32_t));
      auto ring = positions(table, from, to);
      if (i == 0) {
        area.outline = std::move(ring);
      } else {
        area.holes.push_back(std::move(ring));
      }
      from = to;
    }
    return area;
  }

  MapCoordinates const& coordinates_;
  std::size_t left_;
  int depth_ = 0;
  Geometry geometry_;
};

Json read_value(Cursor& values, ColumnType type) {
  switch (type) {
    case ColumnType::int8:
      return values.next<std::int8_t>();
    case ColumnType::uint8:
      return values.next<std::uint8_t>();
    case ColumnType::boolean:
      return values.next<std::uint8_t>() != 0;
    case ColumnType::int16:
      return values.next<std::int16_t>();
    case ColumnType::uint16:
      return values.next<std::uint16_t>();
    case ColumnType::int32:
      return values.next<std::int32_t>();
    case ColumnType::uint32:
      return values.next<std::uint32_t>();
    case ColumnType::int64:
      return values.next<std::int64_t>();
    case ColumnType::uint64:
      return values.next<std::uint64_t>();
    case ColumnType::float32:
      return values.next<float>();
    case ColumnType::float64:
      return values.next<double>();
    case ColumnType::text:
    case ColumnType::json:
    case ColumnType::date:
    case ColumnType::binary: {
      auto const text = values.text(values.next<std::uint32_t>());
      return type == ColumnType::binary ? Json() : Json(text);
    }
  }
  throw damaged("a column has an unknown type");
}

Json read_properties(Table const& feature, std::vector<Column> const& common) {
  auto own = read_columns(feature, 2);
  auto const& columns = own.empty() ? common : own;
  auto const values = feature.vector(1, 1);
  auto properties = Json::object();
  for (Cursor each{feature.bytes(), values.place}; each.place < values.place + values.count;) {
    auto const column = each.next<std::uint16_t>();
    if (column >= columns.size()) throw damaged("a property has no column");
    properties[columns[column].name] = read_value(each, columns[column].type);
  }
  return properties;
}

class Reader {
 public:
  explicit Reader(std::filesystem::path const& path) : file_(path), size_(file_.size()) {
    header_ = file_.read(magic_size + sizeof(std::uint32_t), table_size(magic_size));
    auto const header = Table::root(header_);
    type_ = header.number(header::geometry_type, GeometryType::unknown);
    columns_ = read_columns(header, header::columns);
    count_ = header.number(header::features_count, std::uint64_t{0});
    constexpr std::uint16_t usual = 16;
    node_size_ = header.number(header::index_node_size, usual);
    index_ = magic_size + sizeof(std::uint32_t) + header_.size();
    if (count_ > size_ / sizeof(std::uint32_t)) throw damaged("it has too few bytes");
    plan_index();
  }

  // Throws Error if they are not ours.
  MapCoordinates coordinates() const {
    auto const crs = Table::root(header_).table(header::crs);
    if (!crs) return {};
    auto const code = crs->number(1, std::int32_t{0});
    auto const organisation = crs->text(0);
    auto const name = code > 0 ? std::to_string(code) : crs->text(5);
    if (name.empty() && crs->text(2).empty()) return {};
    try {
      return MapCoordinates::parse(
          name.empty() ? crs->text(2)
                       : fmt::format("{}:{}", organisation.empty() ? "EPSG" : organisation, name));
    } catch (Error const& error) {
      throw Error(fmt::format("crs is {}", error.what()));
    }
  }

  void read_all(MapCoordinates const& coordinates, UseFeature const& use) {
    std::size_t number = 0;
    for (auto place = features_; place < size_;) {
      place += sizeof(std::uint32_t) + read_feature(place, ++number, coordinates, use);
    }
  }

  void read_near(Nearby const& nearby, MapCoordinates const& coordinates, UseFeature const& use) {
    if (levels_.empty()) return read_all(coordinates, use);
    std::uintmax_t read = 0;
    for (auto const& [number, offset] : find(nearby.boxes(coordinates))) {
      if (offset > size_ - features_) throw damaged("its index leads beyond the end");
      read += read_feature(features_ + offset, number + 1, coordinates, use);
      if (read > size_) throw damaged("its features overlap");
    }
  }

 private:
  static constexpr std::size_t magic_size = 8;

  // A node of the index: its box, and the number of its first child or, of the last level, the
  // offset of its feature.
  struct Node {
    Box box;
    std::uint64_t next;
  };
  static_assert(sizeof(Node) == 40 && std::endian::native == std::endian::little);

  // The numbers of its nodes; the root's is 0.
  struct Level {
    std::uint64_t begin;
    std::uint64_t end;
  };

  std::size_t table_size(std::uintmax_t place) {
    auto const size = file_.read(place, sizeof(std::uint32_t)).at<std::uint32_t>(0);
    if (size > max_piece) throw damaged("a table has more than 64 MiB");
    return size;
  }

  void plan_index() {
    features_ = index_;
    if (count_ == 0 || node_size_ == 0) return;
    if (node_size_ == 1) throw damaged("its index has one child for each node");
    std::vector<std::uint64_t> sizes{count_};
    std::uint64_t nodes = count_;
    do {
      sizes.push_back((sizes.back() + node_size_ - 1) / node_size_);
      nodes += sizes.back();
    } while (sizes.back() != 1);
    std::ranges::reverse(sizes);
    std::uint64_t begin = 0;
    for (auto const size : sizes) {
      levels_.push_back({begin, begin + size});
      begin += size;
    }
    if (nodes > (size_ - index_) / sizeof(Node)) throw damaged("its index ends too early");
    features_ += nodes * sizeof(Node);
  }

  // Number and offset of each feature whose box meets one of the boxes, in the file's order.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> find(std::vector<Box> const& boxes) {
    std::vector<std::uint64_t> firsts{0};
    std::vector<std::pair<std::uint64_t, std::uint64_t>> found;
    for (auto const& level : levels_) {
      std::vector<std::uint64_t> next;
      for (auto const first : firsts) {
        if (first < level.begin || first >= level.end) throw damaged("its index is inconsistent");
        auto const end = std::min<std::uint64_t>(first + node_size_, level.end);
        auto const bytes = file_.read(index_ + first * sizeof(Node),
                                      static_cast<std::size_t>(end - first) * sizeof(Node));
        for (auto number = first; number < end; ++number) {
          auto const node = bytes.at<Node>(static_cast<std::size_t>(number - first) * sizeof(Node));
          if (!node.box.meets_any(boxes)) continue;
          if (level.end == levels_.back().end) {
            found.emplace_back(number - level.begin, node.next);
          } else {
            next.push_back(node.next);
          }
        }
      }
      // Each node once, whatever leads to it.
      std::ranges::sort(next);
      next.erase(std::unique(next.begin(), next.end()), next.end());
      firsts = std::move(next);
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  // Returns the size of its table.
  std::size_t read_feature(std::uintmax_t place, std::size_t number,
                           MapCoordinates const& coordinates, UseFeature const& use) {
    auto const size = table_size(place);
    auto const bytes = file_.read(place + sizeof(std::uint32_t), size);
    auto const feature = Table::root(bytes);
    auto const read = [&] {
      auto const geometry = feature.table(0);
      return geometry ? GeometryReader(bytes, coordinates).read(*geometry, type_) : Geometry{};
    };
    use_numbered("", read_properties(feature, columns_), number, read, use);
    return size;
  }

  BinaryFile file_;
  std::uintmax_t size_;
  Bytes header_{{}};
  GeometryType type_ = GeometryType::unknown;
  std::vector<Column> columns_;
  std::uint64_t count_ = 0;
  std::uint16_t node_size_ = 0;
  std::uintmax_t index_ = 0;  // where it starts
  std::uintmax_t features_ = 0;
  std::vector<Level> levels_;
};

}  // namespace

bool is_flat_geobuf(std::filesystem::path const& path) {
  // The bytes after these are those of the version's patch.
  return begins_with(path, "fgb\003fgb");
}

MapCoordinates read_flat_geobuf(std::filesystem::path const& path,
                                std::optional<MapCoordinates> const& coordinates,
                                std::optional<Nearby> const& nearby, UseFeature const& use) {
  Reader reader(path);
  auto const used = coordinates ? *coordinates : reader.coordinates();
  if (nearby) {
    reader.read_near(*nearby, used, use);
  } else {
    reader.read_all(used, use);
  }
  return used;
}

}  // namespace gpu_shading::energyplus::geojson

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/site/binary_file.h"
#include "model/site/geojson.h"

namespace gpu_shading::energyplus::geojson {

// Recognised by its first bytes.
bool is_sqlite(std::filesystem::path const& path);

// Reads tables of an SQLite 3 database without its library: EnergyPlus has one of its own, without
// R-trees, whose symbols ours would be bound to, and Windows has none. Nothing of the database is
// executed, and no more than a row is in memory. Functions throw Error without the file's name.
class SqliteFile {
 public:
  struct Table {
    std::uint32_t root;
    std::vector<std::string> columns;
    std::optional<std::size_t> id;  // of the column that has the ids of the rows
  };
  // Values in the order of the columns, a blob as binary; columns that were added to the table
  // later may be missing.
  using Row = std::vector<Json>;
  using UseRow = std::function<void(std::int64_t id, Row const&)>;
  using Ids = std::span<std::int64_t const>;

  explicit SqliteFile(std::filesystem::path const& path);

  // Empty if there is no such table; names are compared without case.
  std::optional<Table> find(std::string const& name);

  // All rows, or those with the ids, which are sorted. Pages without them are not read.
  void read(Table const& table, UseRow const& use, std::optional<Ids> const& ids = std::nullopt);

 private:
  Bytes read_page(std::uint32_t number);
  Bytes read_payload(Bytes const& page, Cursor const& cell, std::uint64_t size);
  void visit(Table const& table, std::uint32_t number, int depth, UseRow const& use,
             std::optional<Ids> ids);

  BinaryFile file_;
  std::size_t page_size_ = 0;
  std::size_t usable_ = 0;  // bytes of each page
  // What a table without damage can have at most.
  std::uintmax_t pages_left_ = 0;
  std::uintmax_t bytes_left_ = 0;
};

}  // namespace gpu_shading::energyplus::geojson

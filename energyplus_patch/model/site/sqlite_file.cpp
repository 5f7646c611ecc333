#include "model/site/sqlite_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/site/geojson.h"
#include "platform/text.h"

// The format: https://www.sqlite.org/fileformat2.html
namespace gpu_shading::energyplus::geojson {
namespace {

constexpr std::string_view magic("SQLite format 3\0", 16);
constexpr std::size_t header_size = 100;
constexpr std::uint32_t schema_page = 1;

// Of 1 to 9 bytes, 7 bits in each but the ninth.
std::int64_t next_varint(Cursor& cursor) {
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) {
    auto const byte = cursor.next<std::uint8_t>();
    value = value << 7U | (byte & 0x7fU);
    if (byte < 0x80U) return static_cast<std::int64_t>(value);
  }
  return static_cast<std::int64_t>(value << 8U | cursor.next<std::uint8_t>());
}

std::int64_t next_integer(Cursor& cursor, int bytes) {
  auto value = static_cast<std::uint64_t>(std::int64_t{cursor.next<std::int8_t>()});
  for (int i = 1; i < bytes; ++i) value = value << 8U | cursor.next<std::uint8_t>();
  return static_cast<std::int64_t>(value);
}

Json next_value(Cursor& cursor, std::int64_t type) {
  constexpr std::array sizes{0, 1, 2, 3, 4, 6, 8};
  constexpr std::int64_t real = 7;
  constexpr std::int64_t zero = 8;
  constexpr std::int64_t one = 9;
  constexpr std::int64_t blob = 12;  // and all even numbers above; odd numbers are texts
  if (type == 0) return nullptr;
  if (type == real) return cursor.next<double>();
  if (type == zero || type == one) return type - zero;
  if (type > 0 && type < real) {
    return next_integer(cursor, sizes.at(static_cast<std::size_t>(type)));
  }
  if (type < blob) throw damaged("a value has an unknown type");
  auto const bytes = cursor.text(static_cast<std::size_t>(type - blob) / 2);
  if (type % 2 != 0) return bytes;
  return Json::binary({bytes.begin(), bytes.end()});
}

SqliteFile::Row read_record(Bytes const& record, std::size_t columns) {
  Cursor types{record, 0, std::endian::big};
  auto const size = next_varint(types);
  if (size < 0) throw damaged("a row has a negative size");
  Cursor values{record, static_cast<std::size_t>(size), std::endian::big};
  SqliteFile::Row row;
  while (std::cmp_less(types.place, size) && row.size() < columns) {
    row.push_back(next_value(values, next_varint(types)));
  }
  return row;
}

constexpr std::string_view space = " \t\r\n\f";
constexpr std::string_view quotes = "\"'`[";
constexpr std::string_view punctuation = "(),";

// Skips white space and comments.
std::size_t begin_of_token(std::string_view sql, std::size_t place) {
  for (;;) {
    place = std::min(sql.find_first_not_of(space, place), sql.size());
    auto const rest = sql.substr(place);
    if (!rest.starts_with("--") && !rest.starts_with("/*")) return place;
    std::string_view const close = rest[0] == '-' ? "\n" : "*/";
    auto const end = sql.find(close, place + 2);
    if (end == std::string_view::npos) return sql.size();
    place = end + close.size();
  }
}

// The next name, word or punctuation mark of the SQL, which is cut off; empty at its end.
std::string_view take_token(std::string_view& sql) {
  sql.remove_prefix(begin_of_token(sql, 0));
  if (sql.empty()) return {};
  std::size_t end = 1;
  if (quotes.find(sql[0]) != std::string_view::npos) {
    char const close = sql[0] == '[' ? ']' : sql[0];
    do {
      end = std::min(sql.find(close, end), sql.size() - 1) + 1;
    } while (end < sql.size() && sql[end] == close && close != ']' && ++end);
  } else if (punctuation.find(sql[0]) == std::string_view::npos) {
    end = sql.find_first_of(" \t\r\n\f\"'`[(),", 1);
  }
  auto const token = sql.substr(0, end);
  sql.remove_prefix(token.size());
  return token;
}

std::string name_of_column(std::string_view token) {
  if (quotes.find(token[0]) == std::string_view::npos) return std::string(token);
  std::string name;
  for (std::size_t i = 1; i + 1 < token.size(); ++i) {
    name += token[i];
    if (token[0] != '[' && token[i] == token[0]) ++i;
  }
  return name;
}

struct StoredColumn {
  std::string name;
  std::vector<std::string> words;  // of its definition

  bool has(std::string_view word) const {
    return std::find(words.begin(), words.end(), word) != words.end();
  }
  // Its values are the ids of the rows, and null in the records.
  bool is_id() const { return !words.empty() && words[0] == "INTEGER" && has("PRIMARY"); }
  bool is_computed() const { return has("AS") && !has("STORED"); }
};

// The stored columns of CREATE TABLE. Throws Error if one has no name.
std::vector<StoredColumn> columns_of(std::string_view sql) {
  constexpr std::array<std::string_view, 5> constraints{"CONSTRAINT", "PRIMARY", "UNIQUE", "CHECK",
                                                        "FOREIGN"};
  std::vector<StoredColumn> columns;
  int depth = 0;
  bool begins = false;
  for (auto token = take_token(sql); !token.empty(); token = take_token(sql)) {
    if (token == "(") {
      if (begins) throw damaged("a column of a table has no name");
      begins = ++depth == 1;
    } else if (token == ")") {
      if (--depth == 0) break;
    } else if (depth != 1) {
      continue;
    } else if (token == ",") {
      begins = true;
    } else if (!begins) {
      columns.back().words.push_back(upper(token));
    } else {
      if (std::find(constraints.begin(), constraints.end(), upper(token)) != constraints.end()) {
        break;
      }
      columns.push_back({name_of_column(token), {}});
      begins = false;
    }
  }
  std::erase_if(columns, [](StoredColumn const& column) { return column.is_computed(); });
  return columns;
}

}  // namespace

bool is_sqlite(std::filesystem::path const& path) { return begins_with(path, magic); }

SqliteFile::SqliteFile(std::filesystem::path const& path) : file_(path) {
  for (char const* suffix : {"-wal", "-journal"}) {
    auto const changes = path.string() + suffix;
    std::error_code failure;
    if (std::filesystem::file_size(changes, failure) > 0 && !failure) {
      throw Error(fmt::format("has changes in {}: close it where it is open", changes));
    }
  }
  constexpr std::size_t page_size_at = 16;
  constexpr std::size_t reserved_at = 20;
  constexpr std::size_t encoding_at = 56;
  constexpr std::size_t min_page = 512;
  constexpr std::size_t max_page = 65536;
  constexpr std::size_t min_usable = 480;
  auto const header = file_.read(0, header_size);
  page_size_ = header.at<std::uint16_t>(page_size_at, std::endian::big);
  if (page_size_ == 1) page_size_ = max_page;
  auto const reserved = header.at<std::uint8_t>(reserved_at);
  if (page_size_ < min_page || page_size_ - reserved < min_usable) {
    throw damaged("its pages are too small");
  }
  usable_ = page_size_ - reserved;
  if (header.at<std::uint32_t>(encoding_at, std::endian::big) > 1) {
    throw Error("has texts in UTF-16, expected UTF-8");
  }
}

std::optional<SqliteFile::Table> SqliteFile::find(std::string const& name) {
  std::optional<Table> found;
  Table const schema{schema_page, {"type", "name", "tbl_name", "rootpage", "sql"}, {}};
  read(schema, [&](std::int64_t /*id*/, Row const& row) {
    if (row.size() < schema.columns.size() || text_of(row[0]) != "table") return;
    if (upper(text_of(row[1])) != upper(name) || !row[3].is_number_integer()) return;
    found = Table{static_cast<std::uint32_t>(row[3].get<std::int64_t>()), {}, {}};
    auto const sql = text_of(row[4]);
    for (auto& column : columns_of(sql)) {
      if (column.is_id()) found->id = found->columns.size();
      found->columns.push_back(std::move(column.name));
    }
  });
  return found;
}

void SqliteFile::read(Table const& table, UseRow const& use, std::optional<Ids> const& ids) {
  pages_left_ = file_.size() / page_size_;
  bytes_left_ = file_.size();
  visit(table, table.root, 0, use, ids);
}

Bytes SqliteFile::read_page(std::uint32_t number) {
  if (pages_left_-- == 0) throw damaged("its pages lead to one another");
  if (number == 0) throw damaged("it has a page 0");
  return file_.read((std::uintmax_t{number} - 1) * page_size_, page_size_);
}

Bytes SqliteFile::read_payload(Bytes const& page, Cursor const& cell, std::uint64_t size) {
  if (size > max_piece) throw damaged("a row has more than 64 MiB");
  if (size > bytes_left_) throw damaged("its rows overlap");
  bytes_left_ -= size;
  constexpr std::size_t next_size = sizeof(std::uint32_t);
  auto const most = usable_ - 35;
  std::size_t local = size;
  if (size > most) {
    auto const least = (usable_ - 12) * 32 / 255 - 23;
    local = least + (size - least) % (usable_ - next_size);
    if (local > most) local = least;
  }
  auto const start = page.text(cell.place, local);
  std::vector<char> payload(start.begin(), start.end());
  auto next = size == local ? 0 : page.at<std::uint32_t>(cell.place + local, std::endian::big);
  while (payload.size() < size) {
    auto const overflow = read_page(next);
    auto const part =
        overflow.text(next_size, std::min<std::size_t>(usable_ - next_size, size - payload.size()));
    payload.insert(payload.end(), part.begin(), part.end());
    next = overflow.at<std::uint32_t>(0, std::endian::big);
  }
  return Bytes(std::move(payload));
}

void SqliteFile::visit(Table const& table, std::uint32_t number, int depth, UseRow const& use,
                       std::optional<Ids> ids) {
  constexpr int max_depth = 20;
  constexpr std::uint8_t interior = 5;
  constexpr std::uint8_t leaf = 13;
  if (ids && ids->empty()) return;
  if (depth > max_depth) throw damaged("a table is too deep");
  auto const page = read_page(number);
  Cursor head{page, number == schema_page ? header_size : 0, std::endian::big};
  auto const type = head.next<std::uint8_t>();
  if (type != interior && type != leaf) throw damaged("a table has a page of another kind");
  head.next<std::uint16_t>();
  auto const cells = head.next<std::uint16_t>();
  head.next<std::uint16_t>();
  head.next<std::uint8_t>();
  auto const last = type == interior ? head.next<std::uint32_t>() : 0;
  for (int i = 0; i < cells; ++i) {
    Cursor cell{page, head.next<std::uint16_t>(), std::endian::big};
    if (type == interior) {
      auto const child = cell.next<std::uint32_t>();
      auto const last_id = next_varint(cell);
      auto below = ids;
      if (ids) {
        auto const count = std::upper_bound(ids->begin(), ids->end(), last_id) - ids->begin();
        below = ids->first(static_cast<std::size_t>(count));
        ids = ids->subspan(static_cast<std::size_t>(count));
      }
      visit(table, child, depth + 1, use, below);
    } else {
      auto const size = static_cast<std::uint64_t>(next_varint(cell));
      auto const id = next_varint(cell);
      if (ids && !std::binary_search(ids->begin(), ids->end(), id)) continue;
      auto row = read_record(read_payload(page, cell, size), table.columns.size());
      if (table.id && *table.id < row.size() && row[*table.id].is_null()) row[*table.id] = id;
      use(id, row);
    }
  }
  if (type == interior) visit(table, last, depth + 1, use, ids);
}

}  // namespace gpu_shading::energyplus::geojson

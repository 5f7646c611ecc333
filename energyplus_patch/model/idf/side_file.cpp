#include "model/idf/side_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/idf_text.h"
#include "model/idf/model_file.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// Without the byte order mark, lines ended by \n.
std::string normalised(std::string text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
      text.find('\0') != std::string::npos) {
    throw Error("is not UTF-8 text (UTF-16?): save it as UTF-8");
  }
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  std::string lines;
  lines.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') {
      lines += text[i];
    } else if (i + 1 == text.size() || text[i + 1] != '\n') {
      lines += '\n';
    }
  }
  return lines;
}

[[noreturn]] void foreign(std::string_view type) {
  throw Error(
      fmt::format("{}: only {}... objects belong in this file", printable(type), extension_prefix));
}

bool is_version(std::string_view type) { return same_name(type, "Version"); }

std::vector<InputObject> read_idf_extensions(std::string_view text) {
  auto objects = parse_idf(text);
  for (auto const& object : objects) {
    if (!is_extension(object.type) && !is_version(object.type)) foreign(object.type);
    auto const cut =
        std::find_if(object.fields.begin(), object.fields.end(),
                     [](auto const& field) { return field.find('\n') != std::string::npos; });
    if (!object.is_closed || cut != object.fields.end()) {
      auto const name = object.fields.empty() ? "" : " " + printable(object.fields.front());
      throw Error(fmt::format("{}{}: is not ended by ;", object.type, name));
    }
  }
  std::erase_if(objects, [](IdfObject const& object) { return is_version(object.type); });
  return read_idf(objects);
}

std::vector<InputObject> read_epjson_extensions(std::string_view text) {
  auto const model = parse_epjson(text);
  if (!model.is_object()) throw Error("expected an object of objects");
  for (auto const& [type, instances] : model.items()) {
    if (!is_extension(type) && !is_version(type)) foreign(type);
  }
  return read_epjson(model);
}

}  // namespace

std::vector<InputObject> read_side_file(std::filesystem::path const& path) {
  auto text = read_text_file(path);
  return naming(path.string(), [&] {
    auto const lines = normalised(std::move(text));
    return is_epjson(path) ? read_epjson_extensions(lines) : read_idf_extensions(lines);
  });
}

}  // namespace gpu_shading::energyplus

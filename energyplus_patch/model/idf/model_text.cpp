#include "model/idf/model_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

bool begins(std::string_view text, std::string_view start) {
  return same_name(text.substr(0, start.size()), start);
}

std::ptrdiff_t line_of(std::string_view text, std::size_t at) {
  return std::ranges::count(text.substr(0, at), '\n') + 1;
}

void refuse_macros(std::string_view text) {
  constexpr std::string_view mark = "##";
  for (auto at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at + 1)) {
    auto const start = text.rfind('\n', at) + 1;
    auto const word = text.substr(at, text.find_first_of(" \t\r\n", at) - at);
    bool const opens = trimmed(text.substr(start, at - start)).empty();
    if (!opens || word.size() == mark.size() ||
        std::isalpha(static_cast<unsigned char>(word[mark.size()])) == 0) {
      continue;
    }
    throw Error(fmt::format(
        "line {}: {} is a macro: run energyplus with -m, so that EPMacro expands it, or give the "
        "expanded IDF",
        line_of(text, at), printable(word)));
  }
}

bool is_utf8(std::string const& text) {
  bool const ascii = std::ranges::all_of(text, [](unsigned char each) { return each < 0x80U; });
  return ascii || valid_utf8(text) == text;
}

// Other fields may hold any bytes.
void refuse_names_in_other_encodings(std::string_view text, std::vector<IdfObject> const& parsed) {
  for (auto const& object : parsed) {
    if (object.fields.empty() || is_utf8(object.fields.front())) continue;
    auto const& name = object.fields.front();
    throw Error(fmt::format("line {}: {} {} is not UTF-8 text (Latin-1?): save the file as UTF-8",
                            line_of(text, std::min(text.find(name, object.begin), text.size())),
                            object.type, printable(valid_utf8(name))));
  }
}

}  // namespace

void refuse_utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
      text.find('\0') != std::string_view::npos) {
    throw Error("is not UTF-8 text (UTF-16?): save it as UTF-8");
  }
}

void check_idf_text(std::string_view text, std::vector<IdfObject> const& parsed) {
  refuse_utf16(text);
  refuse_macros(text);
  if (parsed.empty()) throw Error("has no objects; expected a model");
  if (begins(parsed.front().type, "OS:")) {
    throw Error("is an OpenStudio model; expected an IDF: export it from OpenStudio");
  }
  refuse_names_in_other_encodings(text, parsed);
}

void check_epjson(nlohmann::json const& model) {
  if (!model.is_object()) return;
  if (model.empty()) throw Error("has no objects; expected a model");
  if (auto const type = model.find("type"); type != model.end() && type->is_string()) {
    throw Error(
        "is JSON of another program (a Honeybee model?); expected epJSON: translate it with "
        "honeybee-energy translate model-to-idf");
  }
}

std::string find_template(std::vector<IdfObject> const& parsed) {
  constexpr std::array<std::string_view, 2> groups{"HVACTemplate:", "GroundHeatTransfer:"};
  for (auto const& object : parsed) {
    for (auto const group : groups) {
      if (begins(object.type, group)) return object.type;
    }
  }
  return {};
}

}  // namespace gpu_shading::energyplus

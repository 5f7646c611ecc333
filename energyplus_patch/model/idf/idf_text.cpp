#include "model/idf/idf_text.h"

#include <fmt/format.h>

#include <cctype>
#include <utility>

#include "model/idf/input_object.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {

namespace {

// OpenStudio writes an object whose type it does not know as a Catchall, whose first field is the
// type.
void unwrap(IdfObject& object) {
  if (object.fields.empty() || !same_name(object.type, "Catchall")) return;
  if (!is_extension(object.fields.front())) return;
  object.type = std::move(object.fields.front());
  object.fields.erase(object.fields.begin());
}

// How the commas of an object are written.
class CommaStyle {
 public:
  void add(std::string_view text, std::size_t at) {
    auto const is = [](int (*kind)(int), char each) {
      return kind(static_cast<unsigned char>(each)) != 0;
    };
    if (text[at] != ',' || at == 0 || at + 1 == text.size()) return;
    if (is(std::isspace, text[at + 1])) spaced_ = true;
    if (is(std::isdigit, text[at - 1]) && is(std::isdigit, text[at + 1])) in_number_ = true;
  }

  bool are_mixed() const { return spaced_ && in_number_; }

 private:
  bool spaced_ = false;
  bool in_number_ = false;
};

}  // namespace

std::vector<IdfObject> parse_idf(std::string_view text) {
  std::vector<IdfObject> objects;
  IdfObject current;
  std::string token;
  bool inside = false;
  CommaStyle commas;
  auto const take_token = [&] {
    if (current.type.empty() && current.fields.empty()) {
      current.type = trimmed(token);
    } else {
      current.fields.push_back(trimmed(token));
    }
    token.clear();
  };
  auto const take_object = [&] {
    unwrap(current);
    if (!current.type.empty()) objects.push_back(std::move(current));
  };
  for (std::size_t at = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
       at < text.size(); ++at) {
    char const c = text[at];
    if (c == '!') {
      at = text.find('\n', at);
      if (at == std::string_view::npos) break;
      continue;
    }
    if (c == ',' || c == ';') {
      commas.add(text, at);
      take_token();
      if (c == ';') {
        current.end = at + 1;
        current.has_decimal_comma = commas.are_mixed();
        commas = {};
        take_object();
        current = {};
        inside = false;
      }
      continue;
    }
    if (!inside && c != ' ' && c != '\t' && c != '\r' && c != '\n') {
      inside = true;
      current.begin = at;
    }
    if (inside) token += c;
  }
  if (inside) {
    take_token();
    current.end = text.size();
    current.is_closed = false;
    take_object();
  }
  return objects;
}

std::string format_idf(std::string_view type, std::vector<std::string> const& fields) {
  std::string text(type);
  for (auto const& field : fields) text += fmt::format(",\n  {}", field);
  return text + ";\n";
}

}  // namespace gpu_shading::energyplus

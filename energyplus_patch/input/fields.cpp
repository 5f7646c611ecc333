#include "input/fields.h"

#include <cmath>

#include "input/number.h"

namespace gpu_shading::energyplus {

std::optional<double> number(InputObject const& object, Field const& field) {
  auto const& text = object[field.name];
  if (text.empty()) return std::nullopt;
  auto const value = parse_number(text);
  if (!value || !std::isfinite(*value)) {
    throw Error(fmt::format("{} is \"{}\", not a number", field.title, text));
  }
  return value;
}

std::vector<std::string> lengths_beyond(InputObject const& object,
                                        std::initializer_list<LengthLimit> const& limits) {
  std::vector<std::string> lines;
  for (auto const& [field, most] : limits) {
    auto const value = number(object, field);
    if (!value || *value <= most) continue;
    lines.push_back(fmt::format(
        "{} {}: {} is {} m, more than {} m: lengths are in metres, is it in millimetres?",
        object.type, object.name, field.title, *value, most));
  }
  return lines;
}

void expect_blank(InputObject const& object, std::initializer_list<Field> const& fields,
                  std::string_view why) {
  for (auto const& field : fields) {
    if (object[field.name].empty()) continue;
    throw Error(
        fmt::format("{} is \"{}\", expected blank {}", field.title, object[field.name], why));
  }
}

}  // namespace gpu_shading::energyplus

#include "model/idf/fields.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {

std::vector<std::string> read(InputObject const& object,
                              Field<std::vector<std::string>> const& field) {
  std::vector<std::string> items;
  for (auto const& item : object.list) {
    auto const title = fmt::format("{} {}", field.title, items.size() + 1);
    check(field, item, title);
    if (!item.empty()) items.push_back(item);
  }
  return items;
}

void refuse_blank(FieldInfo const& field) {
  throw Error(fmt::format("{} is blank, expected {}", field.title, expectation(field)));
}

std::optional<Coordinates> read_coordinates(InputObject const& object,
                                            Field<std::optional<double>> const& latitude,
                                            Field<std::optional<double>> const& longitude) {
  auto const north = read(object, latitude);
  auto const east = read(object, longitude);
  if (north && east) return Coordinates{*north, *east};
  if (!north && !east) return std::nullopt;
  FieldInfo const& given = north ? latitude : longitude;
  FieldInfo const& blank = north ? longitude : latitude;
  throw Error(
      fmt::format("{} is blank, expected degrees as {} is given", blank.title, given.title));
}

void expect_blank(InputObject const& object, Fields const& fields, std::string_view why) {
  for (FieldInfo const& field : fields) {
    auto const& text = object[field.key];
    if (text.empty()) continue;
    throw Error(fmt::format("{} is {}, expected blank {}", field.title, in_quotes(text), why));
  }
}

}  // namespace gpu_shading::energyplus

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "input/input_object.h"

// What users are given to read of our objects, against what is read of them.
namespace gpu_shading::energyplus {
namespace {

std::string text_of(std::string const& name) {
  std::ifstream file(std::string(EXTENSIONS) + "/" + name);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> fields_of(std::string_view type) {
  auto const* const known = find_type(type);
  std::vector<std::string> fields(known->fields.begin(), known->fields.end());
  if (!known->list.empty()) fields.emplace_back(known->list);
  return fields;
}

std::vector<std::string> extensions() {
  std::vector<std::string> types;
  for (auto const& type : known_types()) {
    if (is_extension(type.type)) types.emplace_back(type.type);
  }
  return types;
}

// "Tile Origin U" as epJSON has it.
std::string snake_case(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
    return c == ' ' ? '_' : static_cast<char>(std::tolower(c));
  });
  return name;
}

TEST(Extensions, DictionaryHasTheFieldsThatAreReadInTheirOrder) {
  auto const idd = text_of("GPUShading.idd");
  for (auto const& type : extensions()) {
    auto const begin = idd.find("\n" + type + ",\n");
    ASSERT_NE(begin, std::string::npos) << type;
    auto const object = idd.substr(begin, idd.find("\nGPUShading:", begin + 1) - begin);
    std::vector<std::string> found;
    std::regex const field(R"(\n *[AN][0-9]+ *[,;] \\field ([^\n]*))");
    for (std::sregex_iterator match(object.begin(), object.end(), field), end; match != end;
         ++match) {
      found.push_back(snake_case((*match)[1]));
    }
    auto expected = fields_of(type);
    auto const& known = *find_type(type);
    if (!known.list.empty()) expected.back() = std::string(known.list_field) + "_1";
    EXPECT_EQ(found, expected) << type;
  }
}

TEST(Extensions, SchemaHasTheFieldsThatAreRead) {
  auto const schema = nlohmann::json::parse(text_of("GPUShading.schema.epJSON"));
  for (auto const& type : extensions()) {
    auto const& object = schema.at("properties").at(type).at("patternProperties").front();
    std::vector<std::string> found;
    for (auto const& [field, unused] : object.at("properties").items()) found.push_back(field);
    auto expected = fields_of(type);
    // It is the object's key there.
    std::erase(expected, "name");
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(found, expected) << type;
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus

#include "model/idf/mentions.h"

#include "model/idf/input_object.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

enum class Reading {
  none,
  all_but_name,  // of a shading surface
  all,
};

Reading reading_of(std::string_view type) {
  constexpr std::string_view shading = "Shading:";
  if (is_extension(type) || same_name(type, "ShadingProperty:Reflectance")) return Reading::none;
  bool const surface =
      type.size() > shading.size() && same_name(type.substr(0, shading.size()), shading);
  return surface ? Reading::all_but_name : Reading::all;
}

class Search {
 public:
  explicit Search(Names const& names) : names_(names) {}

  void add(std::string const& text, std::string const& type) {
    if (text.empty()) return;
    auto name = upper(text);
    if (names_.contains(name)) found_.try_emplace(std::move(name), type);
  }

  void add(nlohmann::json const& value, std::string const& type) {
    if (value.is_string()) {
      add(value.get_ref<std::string const&>(), type);
    } else if (value.is_number()) {
      add(value.dump(), type);
    } else if (value.is_structured()) {
      for (auto const& item : value) add(item, type);
    }
  }

  Mentions found() { return std::move(found_); }

 private:
  Names const& names_;
  Mentions found_;
};

}  // namespace

Mentions find_mentions(std::vector<IdfObject> const& objects, Names const& names) {
  Search search(names);
  for (auto const& object : objects) {
    auto const reading = reading_of(object.type);
    if (reading == Reading::none) continue;
    for (std::size_t i = reading == Reading::all ? 0 : 1; i < object.fields.size(); ++i) {
      search.add(object.fields[i], object.type);
    }
  }
  return search.found();
}

Mentions find_mentions(nlohmann::json const& model, Names const& names) {
  Search search(names);
  for (auto const& [type, instances] : model.items()) {
    auto const reading = reading_of(type);
    if (reading == Reading::none || !instances.is_object()) continue;
    for (auto const& [name, fields] : instances.items()) {
      if (reading == Reading::all) search.add(name, type);
      search.add(fields, type);
    }
  }
  return search.found();
}

}  // namespace gpu_shading::energyplus

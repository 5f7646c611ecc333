#include "model/idf/model_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/idf_text.h"
#include "model/idf/input_object.h"
#include "model/idf/model_file.h"
#include "platform/files.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

class IdfEdited : public EditedObject {
 public:
  explicit IdfEdited(IdfObject& object) : object_(object) {}

  std::string get(FieldPosition const& field) const override {
    return field.index < object_.fields.size() ? object_.fields[field.index] : "";
  }

  void set(FieldPosition const& field, nlohmann::json const& value) override {
    auto& fields = object_.fields;
    fields.resize(std::max(fields.size(), field.index + 1));
    fields[field.index] = text_of(value);
  }

 private:
  IdfObject& object_;
};

class IdfEditor : public ModelEditor {
 public:
  explicit IdfEditor(std::string_view text) : objects_(parse_idf(text)) {}

  void remove(std::function<bool(std::string_view)> const& unwanted) override {
    std::erase_if(objects_, [&](IdfObject const& object) { return unwanted(object.type); });
  }

  bool has(std::string_view type, std::string_view name) const override {
    return std::ranges::any_of(objects_, [&](IdfObject const& object) {
      return same_name(object.type, type) && !object.fields.empty() &&
             same_name(object.fields.front(), name);
    });
  }

  void edit(std::string_view type, std::function<void(EditedObject&)> const& change) override {
    for (auto& object : objects_) {
      if (!same_name(object.type, type)) continue;
      IdfEdited edited(object);
      change(edited);
    }
  }

  void apply(std::vector<FieldChange> const& changes) override {
    FieldChanges applied(changes);
    for (auto& object : objects_) applied.apply(object.type, object.fields);
    for (auto const& object : applied.missing()) add(object);
  }

  void add(NewObject const& object) override {
    objects_.push_back({std::string(object.type), idf_fields(object)});
  }

  void merge(std::string_view text) override {
    for (auto& object : parse_idf(text)) objects_.push_back(std::move(object));
  }

  void edit_texts(std::function<void(std::string&)> const& change) override {
    for (auto& object : objects_) {
      for (auto& field : object.fields) change(field);
    }
  }

  std::string text() const override {
    std::string text;
    for (auto const& object : objects_) text += format_idf(object.type, object.fields);
    return text;
  }

 private:
  std::vector<IdfObject> objects_;
};

class EpjsonEdited : public EditedObject {
 public:
  explicit EpjsonEdited(nlohmann::json& fields) : fields_(fields) {}

  std::string get(FieldPosition const& field) const override {
    auto const found = fields_.find(std::string(field.name));
    return found == fields_.end() ? "" : text_of(*found);
  }

  void set(FieldPosition const& field, nlohmann::json const& value) override {
    fields_[std::string(field.name)] = value;
  }

 private:
  nlohmann::json& fields_;
};

class EpjsonEditor : public ModelEditor {
 public:
  explicit EpjsonEditor(nlohmann::json model) : model_(std::move(model)) {}

  void remove(std::function<bool(std::string_view)> const& unwanted) override {
    for (auto type = model_.begin(); type != model_.end();) {
      type = unwanted(type.key()) ? model_.erase(type) : std::next(type);
    }
  }

  bool has(std::string_view type, std::string_view name) const override {
    for (auto const& [key, instances] : model_.items()) {
      if (!same_name(key, type)) continue;
      for (auto const& instance : instances.items()) {
        if (same_name(instance.key(), name)) return true;
      }
    }
    return false;
  }

  void edit(std::string_view type, std::function<void(EditedObject&)> const& change) override {
    for (auto const& [key, instances] : model_.items()) {
      if (!same_name(key, type)) continue;
      for (auto& fields : instances) {
        EpjsonEdited edited(fields);
        change(edited);
      }
    }
  }

  void apply(std::vector<FieldChange> const& changes) override { apply_changes(model_, changes); }

  void add(NewObject const& object) override { add_object(model_, object); }

  void merge(std::string_view text) override { model_.merge_patch(parse_epjson(text)); }

  void edit_texts(std::function<void(std::string&)> const& change) override {
    edit_texts_in(model_, change);
  }

  std::string text() const override { return model_.dump(1); }

 private:
  // NOLINTNEXTLINE(misc-no-recursion): as deep as the model
  static void edit_texts_in(nlohmann::json& value,
                            std::function<void(std::string&)> const& change) {
    if (value.is_string()) {
      change(value.get_ref<std::string&>());
    } else if (value.is_structured()) {
      for (auto& item : value) edit_texts_in(item, change);
    }
  }

  nlohmann::json model_;
};

}  // namespace

std::unique_ptr<ModelEditor> edit_idf(std::string_view text) {
  return std::make_unique<IdfEditor>(text);
}

std::unique_ptr<ModelEditor> edit_epjson(nlohmann::json model) {
  return std::make_unique<EpjsonEditor>(std::move(model));
}

std::unique_ptr<ModelEditor> edit_model(Path const& path) {
  auto const text = read_text_file(path);
  if (!is_epjson(path)) return edit_idf(text);
  try {
    return edit_epjson(nlohmann::json::parse(text));
  } catch (nlohmann::json::exception const& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace gpu_shading::energyplus

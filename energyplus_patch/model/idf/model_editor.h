#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/idf/field_changes.h"
#include "model/idf/new_object.h"

namespace gpu_shading::energyplus {

// An object of the edited model.
class EditedObject {
 public:
  EditedObject() = default;
  EditedObject(EditedObject const&) = delete;
  EditedObject& operator=(EditedObject const&) = delete;
  virtual ~EditedObject() = default;

  // The field as text; "" if it is blank or absent.
  virtual std::string get(FieldPosition const& field) const = 0;
  virtual void set(FieldPosition const& field, nlohmann::json const& value) = 0;
};

// A model, IDF or epJSON, edited object by object. Unchanged objects keep their content, but not
// their layout.
class ModelEditor {
 public:
  ModelEditor() = default;
  ModelEditor(ModelEditor const&) = delete;
  ModelEditor& operator=(ModelEditor const&) = delete;
  virtual ~ModelEditor() = default;

  virtual void remove(std::function<bool(std::string_view type)> const& unwanted) = 0;
  virtual bool has(std::string_view type, std::string_view name) const = 0;
  // All objects of a type.
  virtual void edit(std::string_view type, std::function<void(EditedObject&)> const& change) = 0;
  virtual void apply(std::vector<FieldChange> const& changes) = 0;
  virtual void add(NewObject const& object) = 0;
  // Adds the objects of a text of the same kind.
  virtual void merge(std::string_view text) = 0;
  // All fields of all objects that are text.
  virtual void edit_texts(std::function<void(std::string&)> const& change) = 0;
  virtual std::string text() const = 0;
};

std::unique_ptr<ModelEditor> edit_idf(std::string_view text);
std::unique_ptr<ModelEditor> edit_epjson(nlohmann::json model);

// Chosen by the file name extension. Throws Error if the file cannot be read.
std::unique_ptr<ModelEditor> edit_model(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus

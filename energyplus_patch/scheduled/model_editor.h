#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// A field of an object, as each kind of file finds it.
struct FieldPlace {
  std::size_t position;   // in the IDF, from 0
  std::string_view name;  // in epJSON
};

// An object of a model that is being edited.
class EditedObject {
 public:
  EditedObject() = default;
  EditedObject(EditedObject const&) = delete;
  EditedObject& operator=(EditedObject const&) = delete;
  virtual ~EditedObject() = default;

  // As text; "" where it is blank or absent.
  virtual std::string get(FieldPlace const& field) const = 0;
  virtual void set(FieldPlace const& field, nlohmann::json const& value) = 0;
};

// A value, a string or a number, under its name in epJSON.
struct NewField {
  std::string_view name;
  nlohmann::json value;
};

// A model, IDF or epJSON, changed object by object. Objects that are not touched keep their
// content, not their layout.
class ModelEditor {
 public:
  ModelEditor() = default;
  ModelEditor(ModelEditor const&) = delete;
  ModelEditor& operator=(ModelEditor const&) = delete;
  virtual ~ModelEditor() = default;

  virtual void remove(std::function<bool(std::string_view type)> const& unwanted) = 0;
  // Every object of a type.
  virtual void edit(std::string_view type, std::function<void(EditedObject&)> const& change) = 0;
  // Fields in the IDF's order, all of them up to the last.
  virtual void add(std::string_view type, std::vector<NewField> const& fields) = 0;
  // Makes absolute what names an existing file relative to a folder by way of "..".
  virtual void anchor_paths(std::filesystem::path const& folder) = 0;
  virtual std::string text() const = 0;
};

std::unique_ptr<ModelEditor> edit_idf(std::string_view text);
std::unique_ptr<ModelEditor> edit_epjson(nlohmann::json model);

// By the name's ending. Throws Error where the file cannot be read.
std::unique_ptr<ModelEditor> edit_model(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus

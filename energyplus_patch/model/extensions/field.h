#pragma once

#include <optional>
#include <span>
#include <string_view>

// What the dictionary (GPUShading.idd) says of the extension objects' fields. The fields themselves
// are in extension_fields.h, which is generated from it.
namespace gpu_shading::energyplus {

enum class FieldKind { text, choice, integer, real };

struct Limit {
  double value;
  bool open;  // the value itself is beyond it
};

struct FieldInfo {
  std::string_view key;    // in epJSON
  std::string_view title;  // in the IDF
  FieldKind kind = FieldKind::text;
  bool required = false;  // may not be blank
  bool any_text = false;  // a number may also be text
  // The words of a choice, or those that may replace a number.
  std::span<std::string_view const> words = {};
  std::optional<Limit> minimum = std::nullopt;
  std::optional<Limit> maximum = std::nullopt;
  std::string_view units = {};  // "" where it has none
  std::string_view blank = {};  // the text that a blank field stands for; "": none
};

// `Value`: what is read from the field (see read() in fields.h); optional where it may be blank and
// has no default.
template <typename Value>
struct Field : FieldInfo {};

struct ExtensionType {
  std::string_view type;
  std::span<FieldInfo const* const> fields;  // in the IDF's order, without the extensible one
  std::string_view list;                     // the epJSON array of the extensible one, or ""
  FieldInfo const* list_field;               // or nullptr
  bool unique;                               // one object of the type at most
};

}  // namespace gpu_shading::energyplus

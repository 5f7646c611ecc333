#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

// Fields of extension objects as the dictionary (GPUShading.idd) describes them, and their values
// checked against it. The fields themselves are in extension_fields.h, which is generated from it.
namespace gpu_shading::energyplus {

enum class FieldKind { text, choice, integer, real };

struct Limit {
  double value;
  bool open;  // the value itself is outside
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
  std::string_view units = {};  // or ""
  std::string_view blank = {};  // the default, or ""
};

// `Value`: the type that read() in fields.h returns; optional if the field may be blank and has no
// default.
template <typename Value>
struct Field : FieldInfo {};

struct ExtensionType {
  std::string_view type;
  std::span<FieldInfo const* const> fields;  // in the IDF's order, without the extensible one
  std::string_view list;                     // the epJSON array of the extensible one, or ""
  FieldInfo const* list_field;               // or nullptr
  bool unique;                               // at most one object of the type
};

// The values that a field may hold, e.g. "Auto or an integer from 1 to 64".
std::string expectation(FieldInfo const& field);

// Throws Error (title, text, what was expected) for a text that the field may not hold.
void check(FieldInfo const& field, std::string const& text, std::string_view title);

// For a length that is too long, in metres: what it would be if it had been meant in millimetres,
// centimetres or inches, where that is in the field's range and at most `max`. "" if none is.
std::string ask_for_units(FieldInfo const& field, double value, double max);

// The index of the field's word that equals the text, ignoring case.
std::optional<std::size_t> word_index(FieldInfo const& field, std::string const& text);

namespace detail {

// The number in a text that check() accepted.
double checked_number(std::string const& text);

template <typename Value>
struct Parser {
  static Value parse(FieldInfo const& field, std::string const& text) {
    if constexpr (std::is_enum_v<Value>) {
      return static_cast<Value>(word_index(field, text).value());
    } else {
      return static_cast<Value>(checked_number(text));
    }
  }
};

template <>
struct Parser<std::string> {
  static std::string parse(FieldInfo const&, std::string const& text) { return text; }
};

template <typename Number, typename Word>
struct Parser<std::variant<Number, Word>> {
  static std::variant<Number, Word> parse(FieldInfo const& field, std::string const& text) {
    if (word_index(field, text)) return Parser<Word>::parse(field, text);
    return Parser<Number>::parse(field, text);
  }
};

template <typename Value>
struct Parser<std::optional<Value>> {
  static std::optional<Value> parse(FieldInfo const& field, std::string const& text) {
    if (text.empty()) return std::nullopt;
    return Parser<Value>::parse(field, text);
  }
};

}  // namespace detail

// The field's value; a blank one stands for the default. Throws Error as check() does.
template <typename Value>
Value parse(Field<Value> const& field, std::string const& text, std::string_view title) {
  check(field, text, title);
  return detail::Parser<Value>::parse(field, text.empty() ? std::string(field.blank) : text);
}

}  // namespace gpu_shading::energyplus

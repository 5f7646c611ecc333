#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "model/extensions/field.h"

// Fields of extension objects as text, checked against the dictionary.
namespace gpu_shading::energyplus {

// What a field holds, e.g. "Auto or an integer from 1 to 64".
std::string expectation(FieldInfo const& field);

// Throws Error if the field may not hold this text: the title, the text, what was expected.
void check(FieldInfo const& field, std::string const& text, std::string_view title);

// Which of the field's words the text is, without regard to case; nothing if it is none.
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

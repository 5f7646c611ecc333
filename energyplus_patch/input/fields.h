#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"
#include "input/input_object.h"

// Reading an extension object's fields. Every function throws Error: field, value, what was
// expected; the object is for the caller to name.
namespace gpu_shading::energyplus {

struct Field {
  char const* name;  // of the epJSON schema
  char const* title;
};

template <typename Value>
struct Key {
  char const* word;
  Value value;
};

template <typename Value>
Value choice(InputObject const& object, Field const& field,
             std::initializer_list<Key<Value>> const& keys) {
  std::vector<std::string> words;
  for (auto const& key : keys) {
    if (same_name(object[field.name], key.word)) return key.value;
    words.emplace_back(key.word);
  }
  auto const last = words.back();
  words.pop_back();
  throw Error(fmt::format("{} is \"{}\", expected {} or {}", field.title, object[field.name],
                          fmt::join(words, ", "), last));
}

template <typename Value>
Value choice(InputObject const& object, Field const& field,
             std::initializer_list<Key<Value>> const& keys, Value const& blank) {
  return object[field.name].empty() ? blank : choice(object, field, keys);
}

// Nothing where it is blank.
std::optional<double> number(InputObject const& object, Field const& field);

// A length in metres, and what it may be at most without looking like one in millimetres.
struct LengthLimit {
  Field field;
  double most;
};

// A line for each that is beyond.
std::vector<std::string> lengths_beyond(InputObject const& object,
                                        std::initializer_list<LengthLimit> const& limits);

// `why`, as in "with Hole Shape Texture".
void expect_blank(InputObject const& object, std::initializer_list<Field> const& fields,
                  std::string_view why);

}  // namespace gpu_shading::energyplus

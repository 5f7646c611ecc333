#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "model/extensions/field.h"
#include "model/options/options.h"

namespace gpu_shading::energyplus {

enum class Audience {
  everyone,
  experts,   // in the help only if all options are wanted
  scripts,   // not documented
  programs,  // not documented, and without an environment variable
};

// One option under all its names, and where its value is stored.
struct OptionRow {
  std::string_view name;   // "lean": --gpu-shading-lean and GPU_SHADING_LEAN; "": --gpu-shading
  FieldInfo const& value;  // words and range; of GPUShading:Settings where a model may set it
  std::string_view placeholder = {};   // of a value that is not a word: N, DIR
  std::string_view default_text = {};  // for the help; "": value.blank
  std::string_view meaning;            // Markdown
  Audience audience = Audience::everyone;
  bool in_settings = false;
  std::string_view bare = {};  // the value of the flag alone; "": a value follows

  // From a text that `value` allows.
  void (*assign)(Choices&, FieldInfo const&, std::string const&) = nullptr;
  // The inverse; nothing if it is not chosen.
  std::optional<std::string> (*text)(Choices const&, FieldInfo const&) = nullptr;
  void (*fill)(Choices&, Choices const& lower) = nullptr;

  std::string flag() const;
  std::string variable() const;     // "" for programs
  std::string syntax() const;       // "--gpu-shading-lean auto|on|off"
  std::string expectation() const;  // of a value: "a folder or off"
};

std::span<OptionRow const> option_rows();

// A paragraph of the help.
std::string help_of(OptionRow const& row);

// The Markdown table of the manual.
std::string options_table();

}  // namespace gpu_shading::energyplus

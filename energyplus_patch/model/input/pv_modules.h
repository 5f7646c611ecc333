#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/extensions/extension_fields.h"
#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// A GPUShading:PVModules: how surfaces are divided into modules and cells. Lengths in m.
struct PvModules {
  using Orientation = extension::pvmodules::Orientation;
  using Direction = extension::pvmodules::StringDirection;

  std::string name;
  std::string where;                  // type and name, for messages
  std::vector<std::string> surfaces;  // upper case
  double width = 0.0;
  double length = 0.0;
  Orientation orientation = Orientation::portrait;
  int cell_columns = 0;  // along the width
  int cell_rows = 0;     // along the length
  int diodes = 0;
  double frame = 0.0;
  double gap = 0.0;
  std::optional<int> columns = std::nullopt;
  std::optional<int> rows = std::nullopt;
  std::optional<int> string_length = std::nullopt;
  Direction direction = Direction::rows;
  bool half_cut = false;

  // "GPUShading:PVModules M: 3 surfaces, modules of 1 m x 1.65 m with 6 x 10 cells"
  std::string describe() const;
  std::size_t cells() const {
    return static_cast<std::size_t>(cell_columns) * static_cast<std::size_t>(cell_rows);
  }
};

// Reads every GPUShading:PVModules of a model. Throws Error, naming object, field and value.
std::vector<PvModules> read_pv_modules(std::vector<InputObject> const& objects,
                                       ShadingInput const& input);

}  // namespace gpu_shading::energyplus

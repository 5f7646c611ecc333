#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "programs/gpu_shading/figure.h"
#include "reports/module_layout.h"
#include "runs/run_times.h"
#include "tasks/task.h"

// The files of `gpu_shading modules`.
namespace gpu_shading::energyplus {

// A string at one time.
struct StringLight {
  float sunlit = 0.0F;       // mean sunlit fraction of its cells
  float least = 0.0F;        // of a cell
  std::uint32_t blocks = 0;  // bypass diodes with a cell that is partly shaded
};

// The modules of one surface over the period.
struct FieldLight {
  ModuleField field;
  ModuleLayout layout;
  std::string stem;  // of its files
  // Beam on a plane parallel to the surface, kWh/m2: unshaded, and by module and cell.
  double unshaded = 0.0;
  std::vector<double> cells;
  std::vector<double> cosines;       // of incidence, by time; 0 with the sun behind
  std::vector<StringLight> strings;  // by time, then by string

  // Mean over the cells of a module, kWh/m2.
  double beam(std::size_t module) const;
};

// Reads the array of a ModulesTask. Throws Error.
FieldLight read_light(ModuleField field, PvModules const& spec, RunTimes const& run,
                      std::filesystem::path const& array);

// The array in NumPy's format: unsigned 16 bits of shape (times, modules, cell rows, cell columns).
void write_cells(FieldLight const& light, std::size_t times, std::filesystem::path const& array,
                 std::ostream& npy);

// A row for each module.
void write_modules(std::vector<FieldLight> const& fields, std::ostream& csv);
// A row for each time: the first axis of the arrays.
void write_times(RunTimes const& run, std::ostream& csv);
// A row for each string at each time at which the sun is in front of it.
void write_strings(std::vector<FieldLight> const& fields, RunTimes const& run, std::ostream& csv);

// The cells by their loss of beam over the period.
Figure draw_field(FieldLight const& light, std::string const& period);
// The mean sunlit fraction of a string by day and hour.
Figure draw_string(FieldLight const& light, int string, RunTimes const& run);

}  // namespace gpu_shading::energyplus

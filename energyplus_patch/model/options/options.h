#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/asset_folder.h"
#include "gpu_shading/device.h"
#include "gpu_shading/sampled_sunlit.h"
#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

enum class Mode {
  automatic,  // a GPU if there is one, otherwise the CPU with a warning
  require,    // an error if there is no GPU
  off,        // EnergyPlus's PolygonClipping, with extension objects removed
};

// Whether shading surfaces that only cast shadows are left out of EnergyPlus's input.
enum class Lean {
  automatic,  // if there are many
  on,         // for any number
  off,
};

// How the sky's diffuse radiation is distributed.
enum class SkyModel {
  energyplus,     // as EnergyPlus does: isotropic, circumsolar and horizon parts
  perez_patches,  // by patch, after Perez et al. (1993)
};

// Which light that ground, shades and neighbours reflect reaches EnergyPlus's surfaces.
enum class Reflections {
  automatic,   // this module's, if the model has objects of ours that shade
  energyplus,  // EnergyPlus's own
  all,         // this module's
};

// When shading is calculated.
struct Update {
  bool every_timestep = false;  // if false: as often as the model asks
  // At every timestep, interpolated between samples of the sun's positions.
  std::optional<Sampling> sampling = std::nullopt;

  bool operator==(Update const&) const = default;
};

// How sunlit fractions reach EnergyPlus.
enum class Method {
  automatic,  // the first of these that the library allows
  patched,    // its shading functions are redirected to ours
  opengl,     // it counts pixels, and its calls of OpenGL are answered
  scheduled,  // as schedules, rendered before the run
};

// The user's choices from one source; choices that it does not make are empty. option_table.cpp
// has a row for each.
struct Choices {
  std::optional<Mode> mode = std::nullopt;
  // Resolution or target error; at most one of them.
  std::optional<int> resolution = std::nullopt;
  std::optional<double> error = std::nullopt;
  std::optional<Update> update = std::nullopt;
  std::optional<DeviceChoice> device = std::nullopt;
  std::optional<std::filesystem::path> file = std::nullopt;
  std::optional<std::filesystem::path> report = std::nullopt;
  std::optional<bool> maps = std::nullopt;
  std::optional<SkyModel> sky = std::nullopt;
  std::optional<Reflections> reflections = std::nullopt;
  // View factors are applied; the objects are those of the file, which the launcher has written.
  std::optional<bool> surroundings = std::nullopt;
  std::optional<std::filesystem::path> surrounding_objects = std::nullopt;
  std::optional<std::filesystem::path> pv = std::nullopt;
  std::optional<std::filesystem::path> cache = std::nullopt;  // empty: off
  std::optional<double> cache_size = std::nullopt;            // GiB
  std::optional<bool> cache_read_only = std::nullopt;
  // The folder where relative file names in the model start, set by the launcher; empty: the
  // model's folder.
  std::optional<std::filesystem::path> folder = std::nullopt;
  // Where the user started EnergyPlus, if the launcher starts it in another folder.
  std::optional<std::filesystem::path> start = std::nullopt;
  std::optional<Lean> lean = std::nullopt;
  // Not in GPUShading:Settings: a model does not widen what is read for it.
  std::optional<Assets> assets = std::nullopt;
  std::optional<Method> method = std::nullopt;
  std::optional<std::string> positions = std::nullopt;  // at rest, of moving shades
  std::optional<int> threads = std::nullopt;
  std::optional<bool> quiet = std::nullopt;
  std::optional<bool> verbose = std::nullopt;
  std::optional<bool> paper_grid = std::nullopt;
  std::optional<std::filesystem::path> stages = std::nullopt;
  // EnergyPlus is run only for the task in this file (task_file.h).
  std::optional<std::filesystem::path> task = std::nullopt;

  // Fills empty choices from a source of lower precedence. If one of resolution and error is set,
  // the lower source sets neither.
  void fill_from(Choices const& lower);
  // Whether a user made any.
  bool any() const;
};

// Removes our flags from `arguments` (both "--flag=value" and "--flag value", except for switches,
// whose value needs the equals sign). Throws Error for an unknown --gpu flag or an invalid value.
Choices take_flags(std::vector<std::string>& arguments);

// The inverse of take_flags().
std::vector<std::string> to_flags(Choices const& choices);

// The value as in the flag.
std::string name_of(Update const& update);
std::string name_of(Method method);

// Applies threads and quiet, which hold for the whole process.
void apply_to_process(Choices const& choices);

// GPU_SHADING, GPU_SHADING_RESOLUTION, ...; empty variables count as unset.
Choices read_environment();

// GPUShading:Settings. Throws Error if a value cannot be used.
Choices read_settings(std::vector<InputObject> const& objects);

// A folder in which answers are kept after the run.
struct CacheFolder {
  std::filesystem::path path;
  std::uint64_t max_bytes = std::uint64_t{1} << 30U;  // of its files
  bool read_only = false;
};

// The resolved options of a run.
struct Options {
  static constexpr double default_error = 1e-3;

  Mode mode = Mode::automatic;
  std::optional<int> resolution = std::nullopt;  // empty: determined by the error
  double error = default_error;
  Update update;
  DeviceChoice device;
  std::optional<std::filesystem::path> report;
  Lean lean = Lean::automatic;
  SkyModel sky = SkyModel::energyplus;
  Reflections reflections = Reflections::automatic;
  std::optional<CacheFolder> cache = std::nullopt;
  std::optional<std::filesystem::path> stages = std::nullopt;
  bool verbose = false;

  // Whether the sky's light is weighed by its patches, in place of EnergyPlus's own terms.
  bool weighs_sky_patches() const { return sky == SkyModel::perez_patches; }
};

// Precedence: `choices` (command line, then environment), GPUShading:Settings, the model's Pixel
// Counting Resolution, default. The first source that gives a resolution or an error decides both.
Options resolve(Choices choices, Choices const& settings, ShadingInput const& input);

// For --help: a paragraph for each option. `all`: with those for experts.
std::string options_help(bool all = false);

// For the official program's --help.
inline constexpr char const* help_hint =
    "GPU shading: energyplus --gpu-shading --help lists its options\n\n";

}  // namespace gpu_shading::energyplus

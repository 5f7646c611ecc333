#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/sampled_sunlit.h"
#include "input/input_object.h"
#include "input/shading_input.h"

namespace gpu_shading::energyplus {

enum class Mode {
  automatic,  // GPU where there is one, else software with a warning
  require,    // no GPU is an error
  off,        // stock PolygonClipping, extension objects taken out
};

// Whether shading surfaces that only cast shadows are left out of what EnergyPlus reads.
enum class Lean {
  automatic,  // where there are many
  on,         // however few there are
  off,
};

// When shading is calculated.
struct Update {
  bool every_timestep = false;  // else as often as the model asks
  // At every timestep, from samples of the sun's positions.
  std::optional<Sampling> sampling = std::nullopt;

  bool operator==(Update const&) const = default;
};

// How sunlit fractions get into EnergyPlus.
enum class Method {
  automatic,  // by patching, where the library can be patched
  patched,
  scheduled,  // as schedules, rendered before the run
};

// The user's choices from one source; what it does not say is empty.
struct Choices {
  std::optional<Mode> mode;
  // How fine: one of the two at most.
  std::optional<int> resolution;
  std::optional<double> error = std::nullopt;
  std::optional<Update> update;
  std::optional<DeviceChoice> device;
  std::optional<std::filesystem::path> file;
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> cache = std::nullopt;  // empty: off
  // Where relative names of files in the model start, the launcher's to say: none, where the model
  // lies.
  std::optional<std::filesystem::path> folder = std::nullopt;
  std::optional<Lean> lean;
  std::optional<Method> method = std::nullopt;

  // Fills what is empty from a source of lower rank. Where one says how fine, the lower has no say.
  void fill_from(Choices const& lower);
  bool any() const;
};

// Takes our flags out of `arguments` (both "--flag=value" and "--flag value", but for
// --gpu-shading, whose value needs the equals sign). Throws Error on an unknown flag of ours or a
// bad value.
Choices take_flags(std::vector<std::string>& arguments);

// As the flag's value has it.
std::string name_of(Mode mode);
std::string name_of(Update const& update);
std::string name_of(DeviceChoice const& device);
std::string name_of(Lean lean);
std::string name_of(Method method);

// The inverse, one flag a line.
std::string to_flags(Choices const& choices);

// GPU_SHADING, GPU_SHADING_RESOLUTION, ... ; unset and empty say nothing.
Choices read_environment();

// GPUShading:Settings. Throws Error when it is given twice or has a bad value.
Choices read_settings(std::vector<InputObject> const& objects);

// What a run does, every question answered.
struct Options {
  static constexpr double default_error = 1e-3;

  Mode mode = Mode::automatic;
  std::optional<int> resolution = std::nullopt;  // nothing: by the error
  double error = default_error;
  Update update;
  DeviceChoice device;
  std::optional<std::filesystem::path> report;
  Lean lean = Lean::automatic;
  std::optional<std::filesystem::path> cache = std::nullopt;
};

// Precedence: `choices` (command line, then environment), GPUShading:Settings, the model's Pixel
// Counting Resolution, built in. Which of resolution and error is given first counts.
Options resolve(Choices choices, Choices const& settings, ShadingInput const& input);

// One line a flag, for --help.
std::string_view flags_help();

}  // namespace gpu_shading::energyplus

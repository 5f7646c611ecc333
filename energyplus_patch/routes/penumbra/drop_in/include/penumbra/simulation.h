#ifndef GPU_SHADING_PENUMBRA_SIMULATION_H
#define GPU_SHADING_PENUMBRA_SIMULATION_H

#include <functional>
#include <string>
#include <utility>
#include <vector>

// What Penumbra's interface cannot say: the options and the model of a simulation. Penumbra has
// nothing of this; a program that does not call these functions gets what Penumbra computes.
//
// A thread makes one simulation at a time: take_options(), then read_model(), then an object of
// class Penumbra.

namespace Penumbra {

// How a simulation is asked for what a model's transmittances depend on. What is not needed may be
// empty.
struct Simulation {
  std::function<double()> latitude;  // of the site, in radians
  // The number of a schedule, by its name in upper case; 0: there is none.
  std::function<int(std::string const& name)> schedule;
  // The lowest and the highest value of a schedule.
  std::function<std::pair<double, double>(int schedule)> schedule_range;
  // The value of a schedule today; hour: 1 .. 24; timestep: from 1.
  std::function<double(int schedule, int hour, int timestep)> schedule_value;
  std::function<void(std::string const&)> initialization;  // lines for the .eio file
};

// Begins a simulation: returns the arguments without the options --gpu-shading... An option that is
// wrong is an error in read_model().
std::vector<std::string> take_options(std::vector<std::string> const& arguments);
std::string options_help();

// Whether the options, or the environment variable GPU_SHADING, ask for gpu_shading.
bool is_wanted();

// If it is wanted: understands a model with its GPUShading objects, for the next object of class
// Penumbra in this thread, and returns the model for EnergyPlus to read: without these objects, and
// with PixelCounting as the shading method. Otherwise returns the text unchanged. `path` is the
// file that it comes from, `version` EnergyPlus's, e.g. "24.2". Throws std::runtime_error.
std::string read_idf(std::string const& text, std::string const& path, std::string const& version);
std::string read_epjson(std::string const& text, std::string const& path,
                        std::string const& version);

}  // namespace Penumbra

#endif

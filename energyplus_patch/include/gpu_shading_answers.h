#ifndef GPU_SHADING_ANSWERS_H
#define GPU_SHADING_ANSWERS_H

// What the target penumbra (energyplus_patch/routes/penumbra/drop_in) asks
// libgpu_shading_answers.so. In C++17 and with types of the standard library alone, because its
// caller is compiled as EnergyPlus is.
//
// Coordinates are in metres, in world axes: x east, y north, z up. Areas are in m2 normal to the
// beam. Functions throw std::runtime_error with one line that can be shown to a user.

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#define GPU_SHADING_ANSWERS __attribute__((visibility("default")))

namespace gpu_shading::answers {

using Coordinates = std::vector<float>;  // x, y, z of every vertex, one vertex after another

// The outline runs counterclockwise as seen from outside.
struct PlainSurface {
  std::string name;
  Coordinates outline;
  std::vector<Coordinates> holes;
};

// Where a calculation's messages go.
struct Log {
  std::function<void(std::string const&)> warning;
  std::function<void(std::string const&)> info;
};

// What a calculation of a model asks the simulation. All of them may be empty for models without
// schedules and without sampled positions of the sun.
struct Simulation {
  std::function<double()> latitude;  // of the site, in radians
  // The number of a schedule, by its upper-case name; 0: there is none of that name.
  std::function<int(std::string const& name)> schedule;
  // The lowest and the highest value of a schedule in the simulation.
  std::function<std::pair<double, double>(int schedule)> schedule_range;
  // hour: 1 .. 24; timestep: from 1.
  std::function<double(int schedule, int hour, int timestep)> schedule_value;
  std::function<void(std::string const&)> initialization;  // text for the .eio file
};

struct DaylightRay {
  std::array<double, 3> origin;
  std::array<double, 3> direction;  // unit vector
  int hour;                         // 1 .. 24
};

// One shading calculation: surfaces first, then start(), then the sun and questions.
class GPU_SHADING_ANSWERS Calculation {
 public:
  // For the model that this thread has read, if one was read; otherwise surfaces are opaque and all
  // of them cast shadows. size: pixels along each side of a surface's picture.
  Calculation(unsigned size, Log log);
  ~Calculation();
  Calculation(Calculation const&) = delete;
  Calculation& operator=(Calculation const&) = delete;
  Calculation(Calculation&&) = delete;
  Calculation& operator=(Calculation&&) = delete;

  unsigned add(PlainSurface surface);  // returns its number, from 0
  // Adds the other face of a shading surface; -1: the model has no use for it.
  int add_mirrored(unsigned original);
  void start(Simulation const& simulation);

  void set_time(int hour, int timestep);  // timestep 0: the whole simulation
  void set_sun(double azimuth, double altitude);
  float sunlit_area(unsigned surface);
  std::vector<float> sunlit_areas(std::vector<unsigned> const& surfaces);
  // The areas that the sun lights of interior surfaces through a window, in order.
  std::vector<float> interior_areas(unsigned window, std::vector<unsigned> const& interiors);

  // Transmittance, 0 .. 1, of geometry that EnergyPlus does not see for a ray of daylighting.
  double ray_transmittance(DaylightRay const& ray);
  void begin_daylighting();  // of another period

  std::string vendor();  // of the device that computes: GL_VENDOR, "" for the CPU
  void finish();         // at the end of the run: says what was rendered

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// One run at a time is made in a thread, from its options over its model to its calculation.

// Begins a run: takes the options of gpu_shading out of a command line. If one of them is wrong,
// reading the model will fail.
GPU_SHADING_ANSWERS std::vector<std::string> take_options(std::vector<std::string> arguments);
GPU_SHADING_ANSWERS std::string options_help();  // a paragraph for each option

// Whether this run's options, or the environment, ask for gpu_shading.
GPU_SHADING_ANSWERS bool is_wanted();

enum class Format { idf, epjson };

// Reads the text of a model. Returns the text that EnergyPlus is to read: without GPUShading
// objects, and with PixelCounting as its method. `path`: of the model; `version`: EnergyPlus's.
GPU_SHADING_ANSWERS std::string read_model(std::string text, Format format, std::string const& path,
                                           std::string const& version);

}  // namespace gpu_shading::answers

#endif

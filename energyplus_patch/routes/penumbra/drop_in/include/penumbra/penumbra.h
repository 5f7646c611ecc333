#ifndef GPU_SHADING_PENUMBRA_PENUMBRA_H
#define GPU_SHADING_PENUMBRA_PENUMBRA_H

#include <penumbra/logging.h>
#include <penumbra/simulation.h>
#include <penumbra/surface.h>

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

namespace Penumbra {

enum class VendorType { unknown, nvidia, amd, intel, vmware, mesa };

class PenumbraImplementation;

// Projected sunlit surface areas (PSSA) of planar surfaces: m2 normal to the beam, sunlit area x
// cosine of the angle of incidence. Surfaces shade each other and may be lit from both sides.
// Computed by gpu_shading, by OpenGL where there is a GPU, otherwise on the CPU.
//
// First come the surfaces, then set_model(), then for each position of the sun set_sun_position()
// and the questions. Every failure is an error in the logger and a PenumbraException.
class Penumbra {
 public:
  // size: pixels along each side of a surface's picture. At most what the device can draw, 16,384
  // as a rule.
  explicit Penumbra(unsigned int size = 512u, std::shared_ptr<Courierr::Courierr> const& logger =
                                                  std::make_shared<PenumbraLogger>());
  explicit Penumbra(std::shared_ptr<Courierr::Courierr> const& logger);
  ~Penumbra();
  Penumbra(Penumbra const&) = delete;
  Penumbra& operator=(Penumbra const&) = delete;
  Penumbra(Penumbra&&) = delete;
  Penumbra& operator=(Penumbra&&) = delete;

  static bool is_valid_context();  // always: every machine has a CPU

  unsigned int add_surface(Surface const& surface);  // returns its index, from 0
  unsigned int get_number_of_surfaces();
  void set_model();
  void clear_model();  // removes all surfaces

  void set_sun_position(float azimuth,  // radians, clockwise from north
                        float altitude  // radians, from the horizon
  );
  float get_sun_azimuth();
  float get_sun_altitude();

  // Nothing is computed until the first area is retrieved, so that only those are computed that are
  // asked for.
  void submit_pssa(unsigned int surface_index);
  void submit_pssa(std::vector<unsigned int> const& surface_indices);
  void submit_pssa();

  float retrieve_pssa(unsigned int surface_index);
  std::vector<float> retrieve_pssa(std::vector<unsigned int> const& surface_indices);
  std::vector<float> retrieve_pssa();

  float calculate_pssa(unsigned int surface_index);
  std::vector<float> calculate_pssa(std::vector<unsigned int> const& surface_indices);
  std::vector<float> calculate_pssa();

  // What the sun lights of interior surfaces through transparent ones, by index; surfaces that are
  // not listed cast shadows.
  std::unordered_map<unsigned int, float> calculate_interior_pssas(
      std::vector<unsigned int> const& transparent_surface_indices,
      std::vector<unsigned int> const& interior_surface_indices);

  // For debugging: instead of a window, the areas as lines in the logger.
  void render_scene(unsigned int surface_index);
  void render_interior_scene(std::vector<unsigned int> const& transparent_surface_indices,
                             std::vector<unsigned int> const& interior_surface_indices);

  VendorType get_vendor_name();  // of the device; unknown for the CPU
  std::shared_ptr<Courierr::Courierr> get_logger();

  // The following functions are not Penumbra's. They matter for a model that was read with
  // read_model() (penumbra/simulation.h), and need not be called otherwise.

  // Before set_model(): how to ask the simulation.
  void set_simulation(Simulation simulation);

  // Before set_model(): adds the other face of a shading surface that is shown or reflects light.
  // Returns its index, or -1 if the model has no use for it.
  int add_mirrored_surface(unsigned int original_index);

  // The time of the following questions: hour 1 .. 24, timestep from 1; timestep 0: the whole
  // simulation, for which the lowest values of schedules are taken.
  void set_time(int hour, int timestep);

  // The share of the light that a ray of daylighting keeps behind geometry that EnergyPlus does not
  // see: 0 .. 1. The direction is a unit vector; hour: 1 .. 24.
  double ray_transmittance(std::array<double, 3> const& origin,
                           std::array<double, 3> const& direction, int hour);

  // Before the rays of another period, as schedules may have other values from then on.
  void begin_daylighting();

  // At the end of the simulation, while the logger is still there: says what was computed, and
  // writes the report that was asked for. A failure is a warning in the logger.
  void finish();

 private:
  std::unique_ptr<PenumbraImplementation> penumbra;
};

}  // namespace Penumbra

#endif

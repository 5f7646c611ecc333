#ifndef GPU_SHADING_PENUMBRA_PENUMBRA_IMPLEMENTATION_H
#define GPU_SHADING_PENUMBRA_PENUMBRA_IMPLEMENTATION_H

#include <gpu_shading_answers.h>
#include <penumbra/penumbra.h>

#include <exception>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace Penumbra {

class PenumbraImplementation {
 public:
  PenumbraImplementation(unsigned int size, std::shared_ptr<Courierr::Courierr> logger);

  // Calls `action`; an exception of gpu_shading becomes one of Penumbra's.
  template <typename Action>
  auto guarded(Action const& action) -> decltype(action()) {
    try {
      return action();
    } catch (PenumbraException const&) {
      throw;
    } catch (std::exception const& error) {
      throw PenumbraException(error.what(), *logger);
    }
  }

  void renew();  // without surfaces
  unsigned int add(Surface const& surface);
  void set_model();
  void check(std::vector<unsigned int> const& surfaces, std::string_view what = "Surface") const;
  std::vector<unsigned int> all() const;

  unsigned int size;
  std::shared_ptr<Courierr::Courierr> logger;
  std::unique_ptr<gpu_shading::answers::Calculation> calculation;
  Simulation simulation;
  std::vector<std::string> names;  // of surfaces
  bool started = false;            // set_model() was called
  float azimuth = 0.0f;
  float altitude = 0.0f;
};

}  // namespace Penumbra

#endif

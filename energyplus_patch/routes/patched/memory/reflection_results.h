#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "routes/patched/memory/reflection_memory.h"

// Finds the arrays in which EnergyPlus's functions of solar reflections store their results, by
// what the functions change.
namespace gpu_shading::energyplus {

// Changes of EnergyPlus's memory that are taken back at the end.
class Edits {
 public:
  Edits() = default;
  Edits(Edits const&) = delete;
  Edits& operator=(Edits const&) = delete;
  ~Edits() {
    for (auto undo = undo_.rbegin(); undo != undo_.rend(); ++undo) (*undo)();
  }

  template <typename Value>
  void set(Value* at, std::type_identity_t<Value> const& value) {
    undo_.emplace_back([at, before = *at] { *at = before; });
    *at = value;
  }

 private:
  std::vector<std::function<void()>> undo_;
};

struct DiffuseResults {
  double* shades = nullptr;
  double* ground = nullptr;
};

// Among `candidates`, whose element at `offset` is that of the first surface: without rays, the
// function sets both of a receiver to 0, and with one ray that meets the ground, `far` away in a
// direction from which nothing keeps light, it sets that of the ground. The ray's solid angle is
// negative, so that the result is not limited. `call`: calls the function.
std::optional<DiffuseResults> find_diffuse_results(ReflectionMemory const& memory,
                                                   std::vector<double*> const& candidates,
                                                   std::size_t offset, glm::dvec3 const& far,
                                                   std::function<void()> const& call);

// The two arrays that the function of mirrors divides by the number of points, in unknown order.
std::optional<std::pair<double*, double*>> find_specular_results(ReflectionMemory const& memory,
                                                                 int hour,
                                                                 std::function<void()> const& call);

}  // namespace gpu_shading::energyplus

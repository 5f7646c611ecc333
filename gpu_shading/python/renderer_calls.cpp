#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "gpu_shading/renderer.h"
#include "python/guard.h"

namespace gpu_shading::python {

// One thread at a time may use a renderer.
struct RendererObject {
  RendererObject(Scene const& scene, RendererOptions options)
      : renderer(scene, watched(std::move(options))), device(describe(renderer.device())) {}

  RendererOptions watched(RendererOptions options) {
    options.warn = [this](std::string const& line) { warnings += line + "\n"; };
    return options;
  }

  std::mutex mutex;
  std::string warnings;
  Renderer renderer;
  std::string device;
};

namespace {

std::vector<SunDirection> directions_of(double const* suns, std::size_t count) {
  std::vector<SunDirection> directions;
  directions.reserve(count);
  for (std::size_t i = 0; i < count; ++i) directions.push_back({suns[2 * i], suns[2 * i + 1]});
  return directions;
}

std::span<double const> row_of(FactorTable const& table, std::size_t direction) {
  auto const row = table.rows > 1 ? direction : 0;
  return {table.values + row * table.columns, table.columns};
}

void require_rows(FactorTable const& table, std::size_t directions) {
  if (table.rows == 1 || table.rows == directions) return;
  throw Error(fmt::format("factors have {} rows, expected 1 or {}", table.rows, directions));
}

// Areas, and errors at least of rounding, not a number where they were not measured.
void copy(std::span<Sunlit const> answers, std::span<double const> factors, double*& areas,
          double*& errors) {
  for (auto const& answer : answers) {
    *areas++ = answer.at(factors);
    *errors++ = answer.error ? std::max(*answer.error, Sunlit::rounding)
                             : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

// Device: as parse_device_choice() reads it. Resolution 0: by the error. The scene is copied.
GPU_SHADING_CALL int gpu_shading_renderer_new(SceneObject const* scene, char const* device,
                                              int resolution, double error, RendererObject** made) {
  return guarded([&] {
    RendererOptions options;
    options.device = parse_device_choice(device);
    if (resolution != 0) options.resolution = resolution;
    options.error = error;
    *made = new RendererObject(scene->scene, std::move(options));
  });
}

// Leaves the device's description in gpu_shading_message().
GPU_SHADING_CALL int gpu_shading_renderer_device(RendererObject const* renderer) {
  return guarded([&] { message() = renderer->device; });
}

// Leaves the warnings since the last call in gpu_shading_message(), one a line.
GPU_SHADING_CALL int gpu_shading_renderer_warnings(RendererObject* renderer) {
  return guarded([&] {
    std::scoped_lock const lock(renderer->mutex);
    message() = std::exchange(renderer->warnings, {});
  });
}

GPU_SHADING_CALL int gpu_shading_renderer_set_deployments(RendererObject* renderer,
                                                          double const* shares, std::size_t count) {
  return guarded([&] {
    std::scoped_lock const lock(renderer->mutex);
    renderer->renderer.set_deployments({shares, shares + count});
  });
}

// Suns: azimuth and altitude of each; areas: projected areas (m2), directions x receivers; errors:
// of sunlit fractions, likewise.
GPU_SHADING_CALL int gpu_shading_renderer_sunlit(RendererObject* renderer, double const* suns,
                                                 std::size_t directions,
                                                 std::uint32_t const* receivers, std::size_t count,
                                                 FactorTable const* factors, double* areas,
                                                 double* errors) {
  return guarded([&] {
    require_rows(*factors, directions);
    std::scoped_lock const lock(renderer->mutex);
    auto const answers = renderer->renderer.projected_sunlit_areas(directions_of(suns, directions),
                                                                   std::span(receivers, count));
    for (std::size_t i = 0; i < directions; ++i) {
      copy(answers[i], row_of(*factors, i), areas, errors);
    }
  });
}

// The same of interior surfaces behind one window.
GPU_SHADING_CALL int gpu_shading_renderer_interior(RendererObject* renderer, double const* suns,
                                                   std::size_t directions, std::uint32_t window,
                                                   std::uint32_t const* interiors,
                                                   std::size_t count, FactorTable const* factors,
                                                   double* areas, double* errors) {
  return guarded([&] {
    require_rows(*factors, directions);
    std::vector<InteriorQuestion> const question{{window, {interiors, interiors + count}}};
    std::scoped_lock const lock(renderer->mutex);
    auto const answers =
        renderer->renderer.interior_sunlit_areas(directions_of(suns, directions), question);
    for (std::size_t i = 0; i < directions; ++i) {
      copy(answers[i].front(), row_of(*factors, i), areas, errors);
    }
  });
}

GPU_SHADING_CALL void gpu_shading_renderer_release(RendererObject* renderer) { release(renderer); }

}  // namespace gpu_shading::python

#include "gpu_shading/device_test.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "backends/open_backend.h"
#include "gpu_shading/error.h"
#include "gpu_shading/renderer.h"
#include "render/device_test/cases.h"
#include "render/renderer_with_backend.h"

namespace gpu_shading {
namespace {

// By view: areas in the order of ClosedForm::View::exact.
using Areas = std::vector<std::vector<double>>;

// Views by direction: those of one are answered together.
struct Batch {
  std::vector<SunDirection> suns;
  std::vector<SurfaceId> receivers;
  std::vector<InteriorQuestion> windows;
};

Batch batch_of(ClosedForm const& form) {
  Batch batch;
  auto const add_once = [](auto& all, auto const& value, auto const& same) {
    if (std::ranges::none_of(all, same)) all.push_back(value);
  };
  for (ClosedForm::View const& view : form.views) {
    add_once(batch.suns, view.sun, [&](SunDirection const& sun) { return sun == view.sun; });
    if (view.inside.empty()) {
      add_once(batch.receivers, view.receiver, [&](SurfaceId id) { return id == view.receiver; });
    } else {
      add_once(batch.windows, InteriorQuestion{view.receiver, view.inside},
               [&](InteriorQuestion const& one) { return one.window == view.receiver; });
    }
  }
  return batch;
}

std::map<std::pair<std::size_t, SurfaceId>, std::vector<Sunlit>> answers_of(Renderer& renderer,
                                                                            Batch const& batch) {
  std::map<std::pair<std::size_t, SurfaceId>, std::vector<Sunlit>> answers;
  if (!batch.receivers.empty()) {
    auto const rows = renderer.projected_sunlit_areas(batch.suns, batch.receivers);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t k = 0; k < rows[i].size(); ++k) {
        answers[{i, batch.receivers[k]}] = {rows[i][k]};
      }
    }
  }
  if (!batch.windows.empty()) {
    auto rows = renderer.interior_sunlit_areas(batch.suns, batch.windows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t k = 0; k < rows[i].size(); ++k) {
        answers[{i, batch.windows[k].window}] = std::move(rows[i][k]);
      }
    }
  }
  return answers;
}

double error_of(ClosedForm const& form, Batch const& batch, Renderer& renderer) {
  auto const answers = answers_of(renderer, batch);
  double worst = 0.0;
  for (ClosedForm::View const& view : form.views) {
    auto const sun = std::ranges::find(batch.suns, view.sun);
    auto const& found =
        answers.at({static_cast<std::size_t>(sun - batch.suns.begin()), view.receiver});
    for (std::size_t i = 0; i < view.exact.size(); ++i) {
      double const error = std::abs(found[i].at(form.factors) - view.exact[i]) / view.whole;
      // What is no number stays so.
      if (!(error <= worst)) worst = error;
    }
  }
  return worst;
}

// Per view, over enough rounds to be measured.
double milliseconds_of(ClosedForm const& form, Batch const& batch, Renderer& renderer) {
  using Clock = std::chrono::steady_clock;
  constexpr double enough = 200.0;
  constexpr int max_rounds = 50;
  double spent = 0.0;
  int rounds = 0;
  while (rounds == 0 || (spent < enough && rounds < max_rounds)) {
    auto const began = Clock::now();
    answers_of(renderer, batch);
    spent += std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    ++rounds;
  }
  return spent / rounds / static_cast<double>(form.views.size());
}

}  // namespace

bool DeviceTest::right() const {
  return failure.empty() &&
         std::ranges::all_of(kinds, [](Kind const& kind) { return kind.right(); });
}

double DeviceTest::milliseconds() const {
  return std::accumulate(kinds.begin(), kinds.end(), 0.0,
                         [](double sum, Kind const& kind) { return sum + kind.milliseconds; });
}

DeviceTest test_device(DeviceInfo const& device) {
  DeviceTest test{device, {}, {}};
  try {
    for (ClosedForm const& form : closed_forms()) {
      // Without views that need no device, and without the check by which the CPU takes over.
      RendererOptions options;
      options.samples_only = true;
      Renderer renderer = RendererWithBackend::make(
          form.scene, options,
          [&](BackendInput const& input) { return open_backend(input, {device.id}); });
      Batch const batch = batch_of(form);
      // The first answers, which count, also compile programs.
      double const error = error_of(form, batch, renderer);
      test.kinds.push_back({form.kind, error, milliseconds_of(form, batch, renderer)});
    }
  } catch (Error const& error) {
    test.failure = error.what();
  }
  return test;
}

}  // namespace gpu_shading

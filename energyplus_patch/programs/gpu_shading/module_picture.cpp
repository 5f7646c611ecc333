#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <set>

#include "gpu_shading/image.h"
#include "platform/text.h"
#include "programs/gpu_shading/module_files.h"

namespace gpu_shading::energyplus {
namespace {

constexpr glm::dvec3 ink{20.0, 24.0, 28.0};
constexpr glm::dvec3 ground{236.0, 238.0, 240.0};
constexpr glm::dvec3 faint{176.0, 182.0, 190.0};
constexpr double percent = 100.0;
constexpr int title_size = 20;
constexpr int text_size = 14;
constexpr int small_size = 12;

// A bar of colours from `low` to `high`, with both ends.
void draw_scale(Figure& figure, glm::dvec2 const& at, std::string const& low,
                std::string const& high, bool downwards) {
  constexpr int steps = 60;
  constexpr double length = 180.0;
  figure.text({at.x - 8.0, at.y}, text_size, LabelAlign::right, low);
  for (int i = 0; i < steps; ++i) {
    double const share = (i + 0.5) / steps;
    figure.box({at.x + length * i / steps, at.y - 7.0}, {length / steps + 0.5, 14.0},
               fraction_colour(downwards ? 1.0 - share : share));
  }
  figure.text({at.x + length + 8.0, at.y}, text_size, LabelAlign::left, high);
}

// The largest loss of a cell, as the end of a scale: a round number of percent.
double scale_end(FieldLight const& light) {
  double most = 0.0;
  for (double const beam : light.cells) {
    most = std::max(most, light.unshaded > 0.0 ? 1.0 - beam / light.unshaded : 0.0);
  }
  for (double const end : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5}) {
    if (most <= end) return end;
  }
  return 1.0;
}

}  // namespace

Figure draw_field(FieldLight const& light, std::string const& period) {
  auto const& layout = light.layout;
  glm::dvec2 low = layout.bounds().low;
  glm::dvec2 high = layout.bounds().high;
  for (auto const& ring : layout.rings()) {
    for (auto const& point : ring) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  constexpr double room = 1080.0;
  constexpr double tallest = 760.0;
  constexpr double margin = 30.0;
  constexpr double top = 110.0;
  auto const size = high - low;
  double const scale = std::min(room / size.x, tallest / size.y);
  constexpr int least_width = 620;
  int const width = std::max(least_width, static_cast<int>(2.0 * margin + scale * size.x));
  int const height = static_cast<int>(top + margin + scale * size.y);
  Figure figure(width, height);
  auto const at = [&](glm::dvec2 const& point) {
    return glm::dvec2(margin + scale * (point.x - low.x), top + scale * (high.y - point.y));
  };
  auto const box = [&](FlatBox const& flat, glm::dvec3 const& colour) {
    auto const corner = at({flat.low.x, flat.high.y});
    figure.box(corner, scale * (flat.high - flat.low), colour);
  };
  double beam = 0.0;
  for (std::size_t m = 0; m < layout.modules().size(); ++m) beam += light.beam(m);
  beam /= static_cast<double>(layout.modules().size());
  double const loss = light.unshaded > 0.0 ? 1.0 - beam / light.unshaded : 0.0;
  figure.text({margin, 28.0}, title_size, LabelAlign::left, printable(light.field.surface));
  figure.text({margin, 54.0}, text_size, LabelAlign::left,
              fmt::format("{} modules, {}: beam {:.4g} of {:.4g} kWh/m2, shading loss {:.1f} %",
                          layout.modules().size(), period, beam, light.unshaded, percent * loss));
  double const end = scale_end(light);
  draw_scale(figure, {margin + 150.0, 82.0}, "loss of beam, 0 %",
             fmt::format("{:.0f} %", percent * end), true);
  for (std::size_t i = 0; i < layout.rings().size(); ++i) {
    std::vector<glm::dvec2> outline;
    for (auto const& point : layout.rings()[i]) outline.push_back(at(point));
    figure.area(outline, i == 0 ? ground : glm::dvec3(255.0));
    outline.push_back(outline.front());
    figure.line(outline, 1.0, faint);
  }
  auto const cells = layout.spec().cells();
  for (std::size_t m = 0; m < layout.modules().size(); ++m) {
    auto const& module = layout.modules()[m];
    box(module.box, ink);
    for (std::size_t k = 0; k < cells; ++k) {
      double const lost =
          light.unshaded > 0.0 ? 1.0 - light.cells[m * cells + k] / light.unshaded : 0.0;
      box(layout.cell(module, k), fraction_colour(1.0 - std::clamp(lost / end, 0.0, 1.0)));
    }
  }
  return figure;
}

Figure draw_string(FieldLight const& light, int string, RunTimes const& run) {
  constexpr double left = 70.0;
  constexpr double top = 100.0;
  constexpr double room = 1000.0;
  constexpr double hour_height = 18.0;
  constexpr int hours = 24;
  std::set<int> days;
  int first = hours;
  int last = 0;
  for (auto const& time : run.times) {
    days.insert(day_of_schedule(time.month, time.day));
    first = std::min(first, time.hour - 1);
    last = std::max(last, time.hour);
  }
  double const step = std::min(room / static_cast<double>(days.size()), 40.0);
  double const plot = step * static_cast<double>(days.size());
  constexpr int least_width = 620;
  int const width = std::max(least_width, static_cast<int>(left + plot + 30.0));
  int const height = static_cast<int>(top + (last - first) * hour_height + 40.0);
  Figure figure(width, height);
  figure.text({24.0, 28.0}, title_size, LabelAlign::left,
              fmt::format("{}, string {}", printable(light.field.surface), string + 1));
  draw_scale(figure, {190.0, 62.0}, "sunlit fraction, 0", "1; grey: sun behind or down", false);
  figure.box({left, top}, {plot, (last - first) * hour_height}, ground);
  auto const strings = static_cast<std::size_t>(light.layout.strings());
  auto const column_of = [&](RunTime const& time) {
    auto const found = days.find(day_of_schedule(time.month, time.day));
    return static_cast<double>(std::distance(days.begin(), found));
  };
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    auto const& time = run.times[i];
    if (light.cosines[i] <= 0.0) continue;
    double const tall = hour_height / run.steps_per_hour;
    double const y = top + (time.hour - 1 - first) * hour_height + (time.timestep - 1) * tall;
    figure.box(
        {left + step * column_of(time), y}, {step + 0.3, tall + 0.3},
        fraction_colour(light.strings[i * strings + static_cast<std::size_t>(string)].sunlit));
  }
  for (int hour = first; hour <= last; hour += 2) {
    figure.text({left - 8.0, top + (hour - first) * hour_height}, small_size, LabelAlign::right,
                fmt::format("{:02}:00", hour));
  }
  int month = 0;
  for (auto const& time : run.times) {
    if (time.month == month) continue;
    month = time.month;
    double const x = left + step * column_of(time);
    figure.line({{x, top}, {x, top + (last - first) * hour_height + 6.0}}, 0.8, faint);
    figure.text({x + 3.0, top + (last - first) * hour_height + 14.0}, small_size, LabelAlign::left,
                fmt::format("{}/{}", time.month, time.day));
  }
  return figure;
}

}  // namespace gpu_shading::energyplus

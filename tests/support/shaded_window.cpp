#include "support/shaded_window.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "gpu_shading/sun_position.h"

namespace gpu_shading::shaded_window {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Interval {
  double from = 0.0;
  double to = 0.0;
};

// The sun in the window's axes.
struct LocalSun {
  double x;
  double y;
  double z;
};

struct Axes {
  glm::dvec3 right;
  glm::dvec3 out;
  glm::dvec3 up;
};

Axes axes_of(Window const& window) {
  double const s = std::sin(window.azimuth);
  double const c = std::cos(window.azimuth);
  double const rise = std::sin(window.tilt);
  double const level = std::cos(window.tilt);
  return {{-c, s, 0.0}, {s * rise, c * rise, level}, {-s * level, -c * level, rise}};
}

// The shaded part of the line at x, along z: a ray from (x, 0, z) is at x + t sun.x, t sun.y, z + t
// sun.z.
Interval shadow(Blade const& blade, LocalSun const& sun, double /*x*/) {
  double const slope = sun.z / sun.y;
  double const a = blade.near_z - blade.near * slope;
  double const b = blade.far_z - blade.far * slope;
  return {std::min(a, b), std::max(a, b)};
}

Interval shadow(Overhang const& overhang, LocalSun const& sun, double x) {
  double from = 0.0;
  double to = overhang.depth / sun.y;
  if (sun.x == 0.0) {
    if (x < overhang.left || x > overhang.right) return {};
  } else {
    double const a = (overhang.left - x) / sun.x;
    double const b = (overhang.right - x) / sun.x;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (to <= from) return {};
  double const a = overhang.z - to * sun.z;
  double const b = overhang.z - from * sun.z;
  return {std::min(a, b), std::max(a, b)};
}

Interval shadow(Fin const& fin, LocalSun const& sun, double x) {
  double const t = (fin.x - x) / sun.x;
  if (!(t > 0.0) || t * sun.y >= fin.depth) return {};
  return {fin.bottom - t * sun.z, fin.top - t * sun.z};
}

Interval shadow(Rectangle const& rectangle, LocalSun const& sun, double x) {
  double const t = rectangle.distance / sun.y;
  double const there = x + t * sun.x;
  if (there <= rectangle.left || there >= rectangle.right) return {};
  return {rectangle.bottom - t * sun.z, rectangle.top - t * sun.z};
}

// Where along x a shadow starts or ends, or stops growing.
std::vector<double> bends(Blade const& /*blade*/, LocalSun const& /*sun*/) { return {}; }

std::vector<double> bends(Overhang const& overhang, LocalSun const& sun) {
  double const shift = overhang.depth / sun.y * sun.x;
  return {overhang.left, overhang.right, overhang.left - shift, overhang.right - shift};
}

std::vector<double> bends(Fin const& fin, LocalSun const& sun) {
  return {fin.x, fin.x - fin.depth / sun.y * sun.x};
}

std::vector<double> bends(Rectangle const& rectangle, LocalSun const& sun) {
  double const shift = rectangle.distance / sun.y * sun.x;
  return {rectangle.left - shift, rectangle.right - shift};
}

double covered(std::vector<Interval>& intervals, double height) {
  std::sort(intervals.begin(), intervals.end(),
            [](Interval const& a, Interval const& b) { return a.from < b.from; });
  double sum = 0.0;
  double end = 0.0;
  for (auto const& [from, to] : intervals) {
    double const top = std::min(to, height);
    sum += std::max(0.0, top - std::max(from, end));
    end = std::max(end, top);
  }
  return sum;
}

// The shaded area between two lines, with no bend between them.
double shaded_between(double from, double to, std::vector<Caster> const& casters,
                      LocalSun const& sun, double height) {
  // Shadows that overlap may still have kinks.
  constexpr double lines_per_metre = 20.0;
  int const lines = 2 + static_cast<int>(lines_per_metre * (to - from));
  double shaded = 0.0;
  std::vector<Interval> intervals;
  for (int i = 0; i < lines; ++i) {
    double const x = from + (i + 0.5) / lines * (to - from);
    intervals.clear();
    for (auto const& caster : casters) {
      auto const interval =
          std::visit([&](auto const& shape) { return shadow(shape, sun, x); }, caster);
      if (interval.to > std::max(interval.from, 0.0)) intervals.push_back(interval);
    }
    shaded += covered(intervals, height);
  }
  return shaded / lines * (to - from);
}

std::vector<Scene> make_scenes() {
  std::vector<Caster> const overhang_and_fins{Overhang{2.2, 1.0, -0.5, 3.5}, Fin{-0.3, 0.8, 0, 2.2},
                                              Fin{3.3, 0.8, 0, 2.2}};
  std::vector<Caster> const neighbour{Rectangle{10, -3, 7, -3, 7}};
  std::vector<Caster> louvres;
  louvres.reserve(11);
  for (int i = 1; i < 12; ++i) louvres.push_back(Blade{0.05, 0.15 * i, 0.2, 0.15 * i - 0.05});
  std::vector<Caster> slats;
  slats.reserve(20);
  for (int i = 0; i < 20; ++i) {
    slats.push_back(Rectangle{0.6, 0.3 * i - 1.5, 0.3 * i - 1.35, -0.5, 2.5});
  }
  std::vector<Caster> upward;
  for (int i = 1; i < 12; ++i) upward.push_back(Blade{0.05, 0.15 * i, 0.2, 0.15 * i + 0.1});
  std::vector<Caster> blades;
  for (int i = 1; i < 60; ++i) blades.push_back(Blade{0.5, 0.1 * i - 1.5, 0.6, 0.1 * i - 1.53});
  std::vector<Caster> fins;
  for (int i = 0; i <= 20; ++i) fins.push_back(Fin{0.15 * i + 0.001, 0.15, 0, 1.5});
  std::vector<Caster> const masts{Fin{-1.5, 8, 0.5, 1.2},   Fin{4, 8, 0.5, 1.0},
                                  Overhang{4, 8, 0.5, 1.2}, Overhang{-3, 8, 0.5, 1.2},
                                  Overhang{8, 8, 6, 8},     Fin{-6, 8, -6, -4}};
  std::vector<Caster> over_skylight;
  for (int i = -20; i < 60; ++i) {
    over_skylight.push_back(Blade{0.3, 0.15 * i, 0.4, 0.15 * i + 0.1});
  }
  std::vector<Scene> made{{"overhang and fins", 5e-3, 5e-3, {}},
                          {"neighbour", 5e-3, 5e-3, {}},
                          {"louvres", 5e-3, 2e-2, {}},
                          {"slats", 5e-3, 2e-2, {}},
                          {"upward louvres", 7.5e-3, 2e-2, {}},
                          {"distant blades", 6.6e-3, 2e-2, {}},
                          {"rows of fins", 5e-3, 2e-2, {}},
                          {"masts about a skylight", 5e-3, 5e-3, {}},
                          {"blades over a skylight", 1.2e-2, 2e-2, {}}};
  for (double const azimuth : {180.0, 250.0, 90.0, 0.0}) {
    made[0].windows.push_back({3.0, 2.0, azimuth * degree, overhang_and_fins});
    made[1].windows.push_back({3.0, 2.0, azimuth * degree, neighbour});
    made[2].windows.push_back({3.0, 1.5, azimuth * degree, louvres});
    made[3].windows.push_back({3.0, 1.5, azimuth * degree, slats});
    made[4].windows.push_back({3.0, 1.5, azimuth * degree, upward});
    made[5].windows.push_back({3.0, 1.5, azimuth * degree, blades});
    made[6].windows.push_back({3.0, 1.5, azimuth * degree, fins});
  }
  for (double const azimuth : {180.0, 225.0}) {
    made[7].windows.push_back({2.0, 1.5, azimuth * degree, masts, 0.0});
    made[8].windows.push_back({2.0, 1.5, azimuth * degree, over_skylight, 0.0});
  }
  return made;
}

}  // namespace

glm::dvec3 Window::normal_times_area() const { return width * height * axes_of(*this).out; }

double Window::cosine(SunDirection sun) const {
  return std::max(0.0, glm::dot(axes_of(*this).out, to_vector(sun)));
}

double Window::sunlit_fraction(SunDirection sun) const {
  auto const [right, out, up] = axes_of(*this);
  auto const towards_sun = to_vector(sun);
  LocalSun const local{glm::dot(right, towards_sun), glm::dot(out, towards_sun),
                       glm::dot(up, towards_sun)};
  if (local.y <= 0.0) return 0.0;
  std::vector<double> parts{0.0, width};
  for (auto const& caster : casters) {
    auto const more = std::visit([&](auto const& shape) { return bends(shape, local); }, caster);
    for (double const x : more) {
      if (x > 0.0 && x < width) parts.push_back(x);
    }
  }
  std::sort(parts.begin(), parts.end());
  double shaded = 0.0;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    shaded += shaded_between(parts[i], parts[i + 1], casters, local, height);
  }
  return 1.0 - shaded / (width * height);
}

std::vector<Scene> const& scenes() {
  static auto const all = make_scenes();
  return all;
}

SunlitSource source_of(std::vector<Window> const& windows, int schedule) {
  return [&windows, schedule](std::span<SunDirection const> directions) {
    std::vector<std::vector<Sunlit>> answers;
    for (auto const sun : directions) {
      auto& row = answers.emplace_back();
      for (auto const& window : windows) {
        double const whole = window.width * window.height * window.cosine(sun);
        Sunlit sunlit;
        sunlit.projected_area = whole * window.sunlit_fraction(sun);
        double const shaded = whole - sunlit.projected_area;
        if (schedule >= 0 && shaded > 0.0) sunlit.scheduled.push_back({{{schedule, 1}}, shaded});
        row.push_back(std::move(sunlit));
      }
    }
    return answers;
  };
}

std::vector<glm::dvec3> receivers_of(std::vector<Window> const& windows) {
  std::vector<glm::dvec3> receivers;
  receivers.reserve(windows.size());
  for (auto const& window : windows) receivers.push_back(window.normal_times_area());
  return receivers;
}

std::vector<SunDirection> year_of_suns(double latitude, int every) {
  constexpr int steps = 96;
  std::vector<SunDirection> suns;
  for (int day = 1; day <= 365; day += every) {
    auto const sun = sun_of_day(day);
    double const shift = sun.equation_of_time / 1440.0;
    for (int step = 0; step < steps; ++step) {
      double const turn = static_cast<double>(step) / steps + shift - 0.5;
      auto const direction =
          to_direction(HourDirection{sun.declination, 2.0 * std::numbers::pi * turn}, latitude);
      if (direction.altitude > 0.0) suns.push_back(direction);
    }
  }
  return suns;
}

Errors errors_of(SampledSunlit const& sampled, std::vector<Window> const& windows,
                 std::vector<SunDirection> const& suns) {
  struct Sums {
    double count = 0.0;
    double error = 0.0;
    double beam = 0.0;
    double beam_error = 0.0;
  };
  std::vector<Sums> of_window(windows.size());
  Errors errors;
  for (auto const sun : suns) {
    auto const answers = sampled.at(sun);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      auto const& window = windows[i];
      double const cosine = window.cosine(sun);
      if (cosine < 1e-5) continue;
      double const exact = window.sunlit_fraction(sun);
      double const got = answers[i].projected_area / (window.width * window.height * cosine);
      auto& sums = of_window[i];
      sums.count += 1.0;
      sums.error += std::abs(got - exact);
      sums.beam += cosine * exact;
      sums.beam_error += cosine * (got - exact);
      errors.largest = std::max(errors.largest, std::abs(got - exact));
    }
  }
  double most = 0.0;
  for (auto const& sums : of_window) most = std::max(most, sums.beam);
  for (auto const& sums : of_window) {
    if (sums.count == 0.0) continue;
    errors.mean += sums.error / sums.count / static_cast<double>(windows.size());
    errors.worst = std::max(errors.worst, sums.error / sums.count);
    if (sums.beam < 0.1 * most) continue;
    errors.beam = std::max(errors.beam, std::abs(sums.beam_error) / sums.beam);
  }
  return errors;
}

}  // namespace gpu_shading::shaded_window

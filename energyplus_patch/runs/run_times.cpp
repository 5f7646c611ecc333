#include "runs/run_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "gpu_shading/error.h"
#include "platform/text.h"
#include "runs/schedule_value.h"

namespace gpu_shading::energyplus {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

double number(std::string const& text) {
  auto const value = parse_number(text);
  if (!value) throw Error(fmt::format("eplusout.eso: \"{}\" is not a number", text));
  return *value;
}

// The meaning of the numbers at the beginning of lines, from the dictionary at the top.
struct Dictionary {
  std::string azimuth;
  std::string altitude;
  std::unordered_map<std::string, double RunTime::*> weather;
  std::unordered_map<std::string, std::size_t> schedules;  // to indices in RunTime::schedules
};

Dictionary read_dictionary(std::istream& eso, RunTimes& run) {
  Dictionary dictionary;
  for (std::string line; std::getline(eso, line);) {
    if (line.starts_with("End of Data Dictionary")) break;
    auto const words = comma_separated(line);
    if (words.size() < 4) continue;
    if (words[3].starts_with("Site Solar Azimuth Angle")) dictionary.azimuth = words[0];
    if (words[3].starts_with("Site Solar Altitude Angle")) dictionary.altitude = words[0];
    for (auto const& [name, member] : weather_variables) {
      if (words[3].starts_with(name)) dictionary.weather[words[0]] = member;
    }
    if (words[3].starts_with("Schedule Value")) {
      dictionary.schedules[words[0]] = run.schedules.size();
      run.schedules.push_back(upper(words[2]));
    }
  }
  if (dictionary.azimuth.empty() || dictionary.altitude.empty()) {
    throw Error("eplusout.eso: has no sun positions");
  }
  return dictionary;
}

bool differ(RunTime const& a, RunTime const& b) {
  constexpr double max_difference = 0.01 * degree;
  if (std::max(a.sun.altitude, b.sun.altitude) <= 0.0) return false;
  return std::abs(a.sun.altitude - b.sun.altitude) > max_difference ||
         std::abs(std::remainder(a.sun.azimuth - b.sun.azimuth, 2.0 * std::numbers::pi)) >
             max_difference ||
         a.schedules != b.schedules;
}

}  // namespace

int day_of_schedule(int month, int day) {
  constexpr std::array<int, 12> before{0, 31, 60, 91, 121, 152, 182, 213, 244, 274, 305, 335};
  return before.at(static_cast<std::size_t>(month - 1)) + day - 1;
}

std::size_t row_of(RunTime const& time, int steps_per_hour) {
  constexpr int hours = 24;
  auto const hour = hours * day_of_schedule(time.month, time.day) + time.hour - 1;
  return static_cast<std::size_t>(hour * steps_per_hour + time.timestep - 1);
}

double schedule_value(RunTimes const& run, RunTime const& time, std::string const& name) {
  auto const found = std::ranges::find(run.schedules, name);
  if (found == run.schedules.end()) {
    throw Error(fmt::format("a run of the schedules alone has none called \"{}\"", name));
  }
  return checked_value(name,
                       time.schedules[static_cast<std::size_t>(found - run.schedules.begin())]);
}

bool sun_is_up(SunDirection sun) { return to_vector(sun).z >= min_cosine; }

double sunlit_fraction(double projected_area, glm::dvec3 const& area, glm::dvec3 const& sun) {
  double const whole = glm::length(area);
  double const facing = glm::dot(area, sun);
  if (whole <= 0.0 || facing < min_cosine * whole) return 0.0;
  return std::clamp(projected_area / facing, 0.0, 1.0);
}

RunTimes read_run_times(std::istream& eso, Repeated repeated) {
  RunTimes run;
  auto const dictionary = read_dictionary(eso, run);
  std::map<std::size_t, RunTime> times;
  std::optional<RunTime> current;
  auto const close = [&] {
    if (!current) return;
    auto const [place, added] = times.try_emplace(row_of(*current, run.steps_per_hour), *current);
    if (!added && repeated == Repeated::alike && differ(place->second, *current)) {
      throw Error(
          fmt::format("RunPeriod: two run periods have different sun positions or transmittance "
                      "schedules on {:02}/{:02}, which one schedule of sunlit fractions cannot "
                      "represent: run them separately",
                      current->month, current->day));
    }
    current.reset();
  };
  bool complete = false;
  for (std::string line; std::getline(eso, line);) {
    complete = complete || line.starts_with("End of Data");
    auto const words = comma_separated(line);
    if (words.size() < 2) continue;
    auto const& kind = words[0];
    if (kind == "2" && words.size() >= 8) {
      close();
      constexpr double minutes = 60.0;
      double const start = number(words[6]);
      double const step = number(words[7]) - start;
      run.steps_per_hour = static_cast<int>(std::lround(minutes / step));
      current = RunTime{static_cast<int>(number(words[2])),
                        static_cast<int>(number(words[3])),
                        static_cast<int>(number(words[5])),
                        static_cast<int>(std::lround(start / step)) + 1,
                        {},
                        std::vector<double>(run.schedules.size(), 0.0)};
    } else if (current && kind == dictionary.azimuth) {
      current->sun.azimuth = number(words[1]) * degree;
    } else if (current && kind == dictionary.altitude) {
      current->sun.altitude = number(words[1]) * degree;
    } else if (auto const weather = dictionary.weather.find(kind);
               current && weather != dictionary.weather.end()) {
      (*current).*(weather->second) = number(words[1]);
    } else if (current) {
      auto const schedule = dictionary.schedules.find(kind);
      if (schedule != dictionary.schedules.end()) {
        current->schedules[schedule->second] = number(words[1]);
      }
    }
  }
  if (!complete) throw Error("eplusout.eso: ends before its End of Data");
  close();
  for (auto& [row, time] : times) run.times.push_back(std::move(time));
  return run;
}

int read_first_year(std::istream& eio) {
  for (std::string line; std::getline(eio, line);) {
    // Environment,NAME,WeatherFileRunPeriod,01/01/2017,12/31/2017,...
    auto const words = comma_separated(line);
    if (words.size() < 4 || words[0] != "Environment" || words[2] != "WeatherFileRunPeriod")
      continue;
    auto const year = parse_number(words[3].substr(words[3].rfind('/') + 1));
    constexpr double min_year = 1583.0;  // EnergyPlus's own limits
    constexpr double max_year = 9999.0;
    if (year && *year >= min_year && *year <= max_year) return static_cast<int>(*year);
  }
  throw Error("eplusout.eio: has no run period with a year");
}

}  // namespace gpu_shading::energyplus

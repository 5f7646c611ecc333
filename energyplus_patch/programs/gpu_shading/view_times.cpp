#include "programs/gpu_shading/view_times.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>
#include <regex>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

namespace chrono = std::chrono;

chrono::local_days day_of(char const* option, std::smatch const& words, SiteClock const& clock) {
  chrono::year const year = words[1].matched ? chrono::year(std::stoi(words[1])) : clock.year();
  auto const date = year / std::stoi(words[2]) / std::stoi(words[3]);
  if (!date.ok()) {
    throw Error(fmt::format("{} \"{}\": {} has no such day", option, words[0].str(),
                            static_cast<int>(year)));
  }
  return chrono::local_days(date);
}

std::string caption_of(ClockTime time) {
  chrono::year_month_day const date(chrono::floor<chrono::days>(time));
  chrono::hh_mm_ss const clock(time - chrono::floor<chrono::days>(time));
  return fmt::format("{:02}-{:02} {:02}:{:02}", static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count());
}

std::vector<SunTime> times_of(chrono::local_days day, SiteClock const& clock,
                              chrono::minutes step) {
  std::vector<SunTime> times;
  for (ClockTime time = day; time < day + chrono::days(1); time += step) {
    auto const sun = clock.sun(time);
    if (sun.altitude > 0.0) times.push_back({caption_of(time), sun});
  }
  return times;
}

}  // namespace

SunTime sun_time(std::string const& text, SiteClock const& clock) {
  static std::regex const form(R"((?:(\d{4})-)?(\d\d?)-(\d\d?)[ T](\d\d?):(\d\d))");
  std::smatch words;
  if (!std::regex_match(text, words, form)) {
    throw Error(
        fmt::format("--at \"{}\": expected month, day and time, as in \"06-21 15:00\"", text));
  }
  auto const day = day_of("--at", words, clock);
  auto const time = day + chrono::hours(std::stoi(words[4])) + chrono::minutes(std::stoi(words[5]));
  if (std::stoi(words[5]) >= 60 || time > day + chrono::days(1)) {
    throw Error(fmt::format("--at \"{}\": expected a time from 00:00 to 24:00", text));
  }
  auto const sun = clock.sun(time);
  if (sun.altitude <= 0.0) {
    throw Error(fmt::format("--at \"{}\": the sun is down, {:.1f} degrees below the horizon", text,
                            -glm::degrees(sun.altitude)));
  }
  return {caption_of(time), sun};
}

std::vector<SunTime> sun_times(std::string const& text, SiteClock const& clock,
                               std::chrono::minutes step) {
  static std::regex const form(R"((?:(\d{4})-)?(\d\d?)-(\d\d?))");
  std::smatch words;
  if (!std::regex_match(text, words, form)) {
    throw Error(fmt::format("--day \"{}\": expected month and day, as in 06-21", text));
  }
  auto const day = day_of("--day", words, clock);
  auto times = times_of(day, clock, step);
  // The sun may be up only between two steps.
  if (times.empty()) times = times_of(day, clock, chrono::minutes(1));
  if (times.empty()) throw Error(fmt::format("--day \"{}\": the sun does not rise", text));
  return times;
}

}  // namespace gpu_shading::energyplus

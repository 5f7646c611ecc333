#include "runs/schedule_days.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr int hours_of_a_day = 24;
constexpr int max_steps = 60;  // per hour, EnergyPlus's own limit

double to_number(std::string const& text) {
  auto const value = parse_number(text);
  if (!value) throw Error(fmt::format("eplusout.eso: \"{}\" is not a number", text));
  return *value;
}

int to_whole(std::string const& text, int min, int max) {
  double const value = to_number(text);
  if (!(value >= min && value <= max)) {
    throw Error(fmt::format("eplusout.eso: {} is not within {} and {}", text, min, max));
  }
  return static_cast<int>(std::lround(value));
}

class Reader {
 public:
  ScheduleDays read(std::istream& eso) {
    read_schedules(eso);
    bool complete = false;
    for (std::string line; std::getline(eso, line);) {
      complete = complete || line.starts_with("End of Data");
      read_line(comma_separated(line));
    }
    if (!complete) throw Error("eplusout.eso: ends before its End of Data");
    end_period();
    return std::move(read_);
  }

 private:
  void read_schedules(std::istream& eso) {
    for (std::string line; std::getline(eso, line);) {
      if (line.starts_with("End of Data Dictionary")) break;
      auto const words = comma_separated(line);
      constexpr std::size_t variable = 3;
      if (words.size() <= variable || !words[variable].starts_with("Schedule Value")) continue;
      places_[words[0]] = read_.schedules.size();
      read_.schedules.push_back(upper(words[2]));
    }
  }

  void read_line(std::vector<std::string> const& words) {
    constexpr std::size_t of_period = 5;
    constexpr std::size_t of_time = 9;
    if (words.size() >= of_time && words[0] == "2") {
      begin_timestep(words);
    } else if (words.size() >= of_period && words[0] == "1") {
      end_period();
      site_.latitude = to_number(words[2]);
      site_.longitude = to_number(words[3]);
      site_.time_zone = to_number(words[4]);
    } else if (words.size() >= 2 && day_open_) {
      auto const place = places_.find(words[0]);
      if (place != places_.end()) {
        read_.days.back().values[row_ * read_.schedules.size() + place->second] =
            to_number(words[1]);
      }
    }
  }

  void begin_timestep(std::vector<std::string> const& words) {
    constexpr int minutes = 60;
    int const start = to_whole(words[6], 0, minutes);
    int const step = to_whole(words[7], 0, minutes) - start;
    if (step <= 0) throw Error("eplusout.eso: has a timestep that ends before it starts");
    read_.steps_per_hour = std::min(minutes / step, max_steps);
    int const month = to_whole(words[2], 1, 12);
    int const day = to_whole(words[3], 1, 31);
    int const hour = to_whole(words[5], 1, hours_of_a_day);
    auto const& type = words[8];
    bool const same = day_open_ && read_.days.back().month == month &&
                      read_.days.back().day == day && read_.days.back().type == type;
    if (!same) {
      auto& added = read_.days.emplace_back(site_);
      added.month = month;
      added.day = day;
      added.type = type;
      added.values.assign(rows() * read_.schedules.size(), 0.0);
      day_open_ = true;
    }
    int const row = (hour - 1) * read_.steps_per_hour + start / step;
    row_ = static_cast<std::size_t>(row);
    if (row_ >= rows() || read_.days.back().values.size() != rows() * read_.schedules.size()) {
      throw Error("eplusout.eso: has timesteps of different lengths");
    }
  }

  std::size_t rows() const {
    int const all = hours_of_a_day * read_.steps_per_hour;
    return static_cast<std::size_t>(all);
  }

  void end_period() {
    for (std::size_t i = first_; i < read_.days.size(); ++i) {
      read_.days[i].days_left = static_cast<int>(read_.days.size() - i);
    }
    first_ = read_.days.size();
    day_open_ = false;
  }

  ScheduleDays read_;
  std::unordered_map<std::string, std::size_t> places_;  // by the number that begins a line
  ScheduleDay site_;                                     // the period's
  std::size_t first_ = 0;                                // day of the period
  std::size_t row_ = 0;
  bool day_open_ = false;
};

}  // namespace

ScheduleDays read_schedule_days(std::istream& eso) { return Reader().read(eso); }

}  // namespace gpu_shading::energyplus

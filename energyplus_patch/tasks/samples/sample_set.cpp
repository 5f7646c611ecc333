#include "tasks/samples/sample_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <numeric>
#include <ostream>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// The scene is that of the first part.
SampledScene scene_of(SampleParts const& parts, std::string const& asked) {
  auto first = parts.find(1, 1);
  auto const file = parts.file(1, 1).string();
  if (!first) throw Error(fmt::format("{}: is missing; render it first", file));
  if (first->scene.asked != asked) {
    throw Error(fmt::format("{}: belongs to {}; expected {}", file, first->scene.asked, asked));
  }
  return std::move(first->scene);
}

void add(std::vector<std::string> const& from, std::vector<std::string>& devices) {
  for (auto const& device : from) {
    if (std::find(devices.begin(), devices.end(), device) == devices.end()) {
      devices.push_back(device);
    }
  }
}

struct Degrees {
  double azimuth;  // 0 .. 360
  double altitude;

  explicit Degrees(SunDirection sun)
      : azimuth(std::fmod(glm::degrees(sun.azimuth) + 720.0, 360.0)),
        altitude(glm::degrees(sun.altitude)) {}
};

std::string product_of(std::vector<std::pair<int, int>> const& powers,
                       std::vector<std::string> const& schedules) {
  std::string text;
  for (auto const& [schedule, power] : powers) {
    text += fmt::format("{}{}", text.empty() ? "" : "*",
                        schedules.at(static_cast<std::size_t>(schedule)));
    if (power > 1) text += fmt::format("^{}", power);
  }
  return text;
}

// The end of a timestep as ISO 8601 has it: midnight is 00:00 of the next day.
std::string time_of(RunTimes const& run, RunTime const& time) {
  using namespace std::chrono;
  sys_days const day = year(run.year) / time.month / time.day;
  minutes const minute((time.hour - 1) * 60 + time.timestep * 60 / run.steps_per_hour);
  auto const end = day + minute;
  year_month_day const date(floor<days>(end));
  hh_mm_ss const clock(end - floor<days>(end));
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count());
}

std::vector<double> fractions_at(SampleSet const& set, RunTime const& time,
                                 std::vector<double> const& factors) {
  std::vector<double> fractions(set.scene.receivers.size(), 0.0);
  if (!sun_is_up(time.sun)) return fractions;
  auto const answers = set.samples.at(time.sun);
  auto const sun = to_vector(time.sun);
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    fractions[i] = sunlit_fraction(answers[i].at(factors), set.scene.receivers[i].area, sun);
  }
  return fractions;
}

}  // namespace

SampleSet gather_samples(SampleParts const& parts, std::string const& asked, Sampling sampling,
                         double latitude) {
  auto scene = scene_of(parts, asked);
  std::vector<std::string> devices;
  std::vector<std::size_t> counts;
  SampleRounds rounds(sampling, latitude, scene.areas());
  for (int round = 1; !rounds.directions().empty(); ++round) {
    auto const found = find_round(parts, scene, round, rounds.directions());
    if (!found.missing.empty()) {
      throw Error(fmt::format(
          "{}: is missing, or belongs to another model or build; render shards {} of round {} "
          "first",
          parts.file(round, found.missing.front()).string(), list_shards(found.missing), round));
    }
    add(found.devices, devices);
    counts.push_back(rounds.directions().size());
    rounds.add(found.answers);
  }
  return {std::move(scene), std::move(devices), std::move(counts),
          SampledSunlit(std::move(rounds))};
}

void write_samples(SampleSet const& set, std::ostream& out) {
  out << "receiver,azimuth,altitude,scheduled,sunlit_fraction\n";
  auto const& directions = set.samples.directions();
  auto const& columns = set.samples.fractions();
  std::vector<std::size_t> order(columns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return columns[a].receiver < columns[b].receiver;
  });
  for (auto const place : order) {
    auto const& [receiver, powers, fractions] = columns[place];
    auto const& lit = set.samples.lit(receiver);
    auto const name = csv_field(set.scene.receivers[receiver].name);
    auto const product = csv_field(product_of(powers, set.scene.schedules));
    fmt::memory_buffer lines;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (!lit[i] || (!powers.empty() && fractions[i] == 0.0)) continue;
      Degrees const sun(directions[i]);
      fmt::format_to(std::back_inserter(lines), "{},{:.6f},{:.6f},{},{:.6g}\n", name, sun.azimuth,
                     sun.altitude, product, fractions[i]);
    }
    out.write(lines.data(), static_cast<std::streamsize>(lines.size()));
  }
}

void write_year(SampleSet const& set, RunTimes const& run, std::ostream& out) {
  out << "time,azimuth,altitude";
  for (auto const& receiver : set.scene.receivers) out << ',' << csv_field(receiver.name);
  out << '\n';
  for (auto const& time : run.times) {
    std::vector<double> factors;
    for (auto const& name : set.scene.schedules) {
      factors.push_back(schedule_value(run, time, name));
    }
    Degrees const sun(time.sun);
    fmt::memory_buffer line;
    auto const end = std::back_inserter(line);
    fmt::format_to(end, "{},{:.4f},{:.4f}", time_of(run, time), sun.azimuth, sun.altitude);
    for (double const fraction : fractions_at(set, time, factors)) {
      fmt::format_to(end, ",{:.6g}", fraction);
    }
    out.write(line.data(), static_cast<std::streamsize>(line.size())) << '\n';
  }
}

}  // namespace gpu_shading::energyplus

#include "routes/schedules/rendered_fractions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <iterator>
#include <memory>
#include <ostream>
#include <set>
#include <utility>

#include "platform/progress.h"
#include "runs/drawing.h"
#include "scene/run_schedules.h"

namespace gpu_shading::energyplus {
namespace {

struct Receiver {
  SurfaceId id;
  glm::dvec3 area;  // times the unit normal
};

float fraction(Session& session, Receiver const& receiver, glm::dvec3 const& sun) {
  if (glm::dot(receiver.area, sun) <= 0.0) return 0.0F;
  return static_cast<float>(
      sunlit_fraction(session.projected_sunlit_area(receiver.id), receiver.area, sun));
}

constexpr int hours_of_day = 24;

// Calls `row` for each timestep of a leap year with the table's fractions at that time, or nullptr.
template <typename Row>
void for_each_row(SunlitFractions const& table, Row const& row) {
  constexpr std::array<int, 12> days{31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  std::size_t at = 0;
  for (int month = 1; month <= static_cast<int>(days.size()); ++month) {
    for (int day = 1; day <= days.at(static_cast<std::size_t>(month - 1)); ++day) {
      for (int hour = 1; hour <= hours_of_day; ++hour) {
        for (int step = 1; step <= table.steps_per_hour; ++step) {
          RunTime const time{month, day, hour, step, {}, {}};
          auto const number = row_of(time, table.steps_per_hour);
          bool const known =
              at < table.times.size() && row_of(table.times[at], table.steps_per_hour) == number;
          row(known ? &table.fractions[at] : nullptr);
          if (known) ++at;
        }
      }
    }
  }
}

}  // namespace

SunlitFractions render_fractions(Model model, std::vector<Surface> const& surfaces,
                                 RunTimes const& run, Messages const& messages,
                                 std::function<double()> const& latitude) {
  auto const now = std::make_shared<RunTime const*>(nullptr);
  SunlitFractions table;
  table.steps_per_hour = run.steps_per_hour;
  model.options.update.every_timestep = true;
  Session session(std::move(model));
  std::vector<Receiver> receivers;
  for (auto const& surface : surfaces) {
    auto const id = session.add(surface);
    if (!is_exterior(surface.name, session.input())) continue;
    receivers.push_back({id, area(surface.polygon) * normal(surface.polygon)});
    table.surfaces.push_back(surface.name);
  }
  auto schedules = schedules_of(run, now);
  schedules.position = nullptr;  // the weather that moving shades need is not known here
  session.start({messages, std::move(schedules), latitude});
  Progress progress("rendering sunlit fractions", run.times.size());
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    auto const& time = run.times[i];
    auto const sun = to_vector(time.sun);
    if (!sun_is_up(time.sun)) continue;
    *now = &time;
    session.set_time({time.hour, time.timestep});
    session.set_sun(time.sun);
    auto& row = table.fractions.emplace_back();
    row.reserve(receivers.size());
    for (auto const& receiver : receivers) row.push_back(fraction(session, receiver, sun));
    table.times.push_back(time);
    progress.at(i + 1);
  }
  session.finish();
  return table;
}

void write_schedule_file(SunlitFractions const& table, std::ostream& out) {
  for (std::size_t i = 0; i < table.surfaces.size(); ++i) {
    out << (i == 0 ? "" : ",") << table.surfaces[i];
  }
  out << '\n';
  std::string dark;
  for (std::size_t i = 0; i < table.surfaces.size(); ++i) dark += i == 0 ? "0" : ",0";
  for_each_row(table, [&](std::vector<float> const* fractions) {
    if (fractions == nullptr) {
      out << dark << '\n';
      return;
    }
    fmt::memory_buffer line;
    for (std::size_t i = 0; i < fractions->size(); ++i) {
      fmt::format_to(std::back_inserter(line), "{}{:.7g}", i == 0 ? "" : ",", (*fractions)[i]);
    }
    out.write(line.data(), static_cast<std::streamsize>(line.size())) << '\n';
  });
}

std::optional<std::string> warn_of_actuated(Model const& model) {
  auto names = shade_schedules(model);
  std::erase_if(names, [&](auto const& name) { return !model.shading.actuated.contains(name); });
  if (names.empty()) return std::nullopt;
  return fmt::format(
      "{}: an EMS actuator sets this schedule of a shade, whose values are not known in advance; "
      "the schedule's own values are used",
      fmt::join(names, ", "));
}

std::vector<std::string> shade_schedules(Model const& model) {
  std::set<std::string> names;
  for (auto const& [name, surface] : model.shading.shading_surfaces) {
    names.insert(surface.transmittance_schedule);
  }
  for (auto const& [name, screen] : model.screens.by_surface) {
    names.insert(screen.deployment_schedule);
  }
  names.insert(model.surroundings.leaf_schedules.begin(), model.surroundings.leaf_schedules.end());
  for (auto const& shade : model.moving_shades) {
    names.insert({shade.schedule, shade.availability});
  }
  names.erase("");
  return {names.begin(), names.end()};
}

}  // namespace gpu_shading::energyplus

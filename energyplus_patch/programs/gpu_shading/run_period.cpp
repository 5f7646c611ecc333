#include "programs/gpu_shading/run_period.h"

#include <fmt/format.h>

#include <chrono>
#include <regex>

#include "gpu_shading/error.h"
#include "model/model_reader.h"
#include "platform/console.h"
#include "platform/text.h"
#include "routes/schedules/rendered_run.h"
#include "runs/installation.h"
#include "runs/short_runs.h"

namespace gpu_shading::energyplus {
namespace {

constexpr int month_step = 100;

int parse_day(char const* option, std::string const& text) {
  static std::regex const form(R"((\d\d?)-(\d\d?))");
  std::smatch words;
  if (std::regex_match(text, words, form)) {
    constexpr int leap_year = 2024;
    auto const date = std::chrono::year(leap_year) / std::stoi(words[1]) / std::stoi(words[2]);
    if (date.ok()) return month_step * std::stoi(words[1]) + std::stoi(words[2]);
  }
  throw Error(fmt::format("{} {}: expected month and day, as in 06-21", option, in_quotes(text)));
}

}  // namespace

void add_days(CLI::App& command, DayOptions& days) {
  command.add_option("--from", days.from, "First day (default: 01-01)")->type_name("MM-DD");
  command.add_option("--to", days.to, "Last day (default: 12-31)")->type_name("MM-DD");
}

bool Period::has(RunTime const& time) const {
  int const day = month_step * time.month + time.day;
  return from <= to ? from <= day && day <= to : day >= from || day <= to;
}

Period period_of(DayOptions const& days) {
  constexpr int first = 101;
  constexpr int last = 1231;
  return {days.from.empty() ? first : parse_day("--from", days.from),
          days.to.empty() ? last : parse_day("--to", days.to)};
}

std::string day_text(int number) {
  return fmt::format("{:02}-{:02}", number / month_step, number % month_step);
}

std::string describe_days(Period const& period) {
  if (period.from == period.to) return day_text(period.from);
  return fmt::format("{} to {}", day_text(period.from), day_text(period.to));
}

std::filesystem::path const& weather_of(ModelRun const& run) {
  if (run.weather) return *run.weather;
  throw Error("-w: a weather file is required (it sets site, calendar and beam radiation)");
}

RunTimes times_of(ModelRun const& run, Period const& period) {
  EnergyPlusCall call;
  call.program = find_launcher();
  call.model = run.model;
  call.weather = weather_of(run);
  auto const model = read_model(run.model, run.choices);
  auto times = run_for_beam(call, shade_schedules(model));
  if (auto const warning = warn_of_actuated(model)) print_line("warning: " + *warning);
  std::erase_if(times.times,
                [&](RunTime const& time) { return !period.has(time) || !sun_is_up(time.sun); });
  if (times.times.empty()) {
    throw Error(fmt::format("--from {} --to {}: the sun does not rise in the weather file's days",
                            day_text(period.from), day_text(period.to)));
  }
  return times;
}

}  // namespace gpu_shading::energyplus

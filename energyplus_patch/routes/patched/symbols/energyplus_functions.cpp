#include "routes/patched/symbols/energyplus_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <unordered_map>

#include "gpu_shading/error.h"
#include "runs/schedule_value.h"

namespace gpu_shading::energyplus {
namespace {

// When EnergyPlus takes the sun for a timestep, in hours of the day: at its end, or in the middle
// of the hour if that is the timestep.
double hour_of_sun(int hour_from_0, int timestep_from_1, int steps_per_hour) {
  constexpr double middle = 0.5;
  return hour_from_0 + (steps_per_hour == 1 ? middle : double(timestep_from_1) / steps_per_hour);
}

}  // namespace

void EnergyPlusFunctions::fatal(State& state, std::string const& message) const {
  symbol::show_fatal.in(symbols_)(state, message, std::nullopt, std::nullopt);
  std::abort();  // it throws
}

void EnergyPlusFunctions::warning(State& state, std::string const& message) const {
  symbol::issue_warning.in(symbols_)(&state, message.c_str());
}

void EnergyPlusFunctions::text(State& state, std::string const& message) const {
  symbol::show_message.in(symbols_)(state, message, std::nullopt, std::nullopt);
}

Vector EnergyPlusFunctions::sun(State const& state, double hour, double equation_of_time,
                                double sine_of_declination, double cosine_of_declination) const {
  Vector cosines{};
  if (auto const function = symbol::sun_cosines.in(symbols_)) {
    function(state, hour, equation_of_time, sine_of_declination, cosine_of_declination, cosines);
  } else {
    symbol::sun_cosines_of_mutable_state.in(symbols_)(const_cast<State&>(state), hour,
                                                      equation_of_time, sine_of_declination,
                                                      cosine_of_declination, cosines);
  }
  return cosines;
}

double EnergyPlusFunctions::latitude(State const& state) const {
  // A sun at the celestial pole is as high as the latitude, in the north or in the south. If it is
  // below the horizon, EnergyPlus returns its depth alone; the same holds on the horizon, at the
  // equator.
  for (double const sine : {1.0, -1.0}) {
    auto const pole = sun(state, 12.0, 0.0, sine, 0.0);
    if (pole.y != 0.0) return sine * std::atan2(pole.z, std::abs(pole.y));
  }
  return 0.0;
}

Vector EnergyPlusFunctions::sun(State const& state, SunOfTime const& day, double hour) const {
  constexpr double minutes = 60.0;
  return sun(state, hour, day.equation_of_time / minutes, std::sin(day.declination),
             std::cos(day.declination));
}

RunDay EnergyPlusFunctions::day(State& state) const {
  // Its enumeration of simulations.
  constexpr int design_day = 1;
  constexpr int run_period = 3;
  int const kind = symbol::kind_of_simulation.in(symbols_)(&state);
  RunDay day;
  if (kind == design_day) day.kind = RunDay::Kind::design_day;
  if (kind == run_period) day.kind = RunDay::Kind::run_period;
  day.environment = symbol::environment_number.in(symbols_)(&state);
  day.month = symbol::month.in(symbols_)(&state);
  day.day = symbol::day_of_month.in(symbols_)(&state);
  day.warm_up = symbol::warm_up_flag.in(symbols_)(&state) != 0;
  day.steps_per_hour = symbol::steps_per_hour.in(symbols_)(&state);
  return day;
}

template <typename ValueAt>
std::vector<double> EnergyPlusFunctions::of_day(State& state, ValueAt value_at) const {
  constexpr int hours = 24;
  int const steps_per_hour = symbol::steps_per_hour.in(symbols_)(&state);
  std::vector<double> values;
  for (int hour = 0; hour < hours; ++hour) {
    for (int step = 1; step <= steps_per_hour; ++step) {
      values.push_back(value_at(hour, step, hour_of_sun(hour, step, steps_per_hour)));
    }
  }
  return values;
}

std::vector<double> EnergyPlusFunctions::beam_of_day(State& state) const {
  auto const weather_beam = symbol::weather_beam.in(symbols_);
  auto const sun = sun_of_day(symbol::day_of_year.in(symbols_)(&state));
  return of_day(state, [&](int hour, int step, double of_sun) {
    // Between hours, the weather may have a beam before sunrise, which EnergyPlus drops.
    return this->sun(state, sun, of_sun).z > 0.0 ? weather_beam(&state, hour, step) : 0.0;
  });
}

std::vector<double> EnergyPlusFunctions::wind_of_day(State& state) const {
  auto const weather_wind = symbol::weather_wind.in(symbols_);
  return of_day(state, [&](int hour, int step, double /*of_sun*/) {
    return weather_wind(&state, hour, step);
  });
}

Moment EnergyPlusFunctions::moment(State& state) const {
  return {symbol::hour_from_0.in(symbols_)(&state) + 1,
          symbol::timestep_from_1.in(symbols_)(&state)};
}

SkyWeather EnergyPlusFunctions::sky_weather(State& state) const {
  int const day = symbol::day_of_year.in(symbols_)(&state);
  auto const now = moment(state);
  int const hour = now.hour - 1;
  int const step = now.timestep;
  double const of_sun = hour_of_sun(hour, step, symbol::steps_per_hour.in(symbols_)(&state));
  return {to_glm(sun(state, sun_of_day(day), of_sun)),
          symbol::weather_beam.in(symbols_)(&state, hour, step),
          symbol::weather_diffuse.in(symbols_)(&state, hour, step), day};
}

void EnergyPlusFunctions::add_output(State& state, std::string const& name, std::string_view unit,
                                     std::string const& object, double& value) const {
  // Its enumerations, and the defaults of its arguments.
  constexpr int none = 6;
  constexpr int watts_per_square_metre = 20;
  constexpr int metres = 21;
  constexpr int degrees = 34;
  constexpr int zone_timestep = 0;
  constexpr int average = 0;
  constexpr int invalid = -1;
  constexpr int no_index_group = -999;
  constexpr int hourly = 2;  // any other would override the frequency that a model asks for
  int const units = unit == "deg"    ? degrees
                    : unit == "m"    ? metres
                    : unit == "W/m2" ? watts_per_square_metre
                                     : none;
  symbol::setup_output_variable.in(symbols_)(state, name, units, value, zone_timestep, average,
                                             object, invalid, invalid, invalid, {}, {}, 1, 1, {},
                                             no_index_group, {}, hourly);
}

namespace {

constexpr char const* reflected_by_ground = "Site Ground Reflected Solar Radiation Rate per Area";
constexpr char const* whole_site = "Environment";

// On the outside of a surface.
std::string incident(std::string_view light) {
  return fmt::format("Surface Outside Face Incident {}Solar Radiation Rate per Area", light);
}
constexpr std::array<std::string_view, 4> kinds_of_light{"", "Beam ", "Sky Diffuse ",
                                                         "Ground Diffuse "};

}  // namespace

void EnergyPlusFunctions::request_light_of_ground(State& state) const {
  symbol::request_variable.in(symbols_)(&state, reflected_by_ground, whole_site);
}

void EnergyPlusFunctions::at_end_of_timesteps(State& state, void (*function)(State*)) const {
  for (auto const& light : kinds_of_light) {
    symbol::request_variable.in(symbols_)(&state, incident(light).c_str(), "*");
  }
  symbol::call_at_end_of_timestep.in(symbols_)(&state, function);
}

EnergyPlusFunctions::Irradiances EnergyPlusFunctions::irradiances_of(
    State& state, std::string const& surface) const {
  Irradiances numbers{};
  std::ranges::transform(kinds_of_light, numbers.begin(), [&](std::string_view light) {
    return symbol::variable_handle.in(symbols_)(&state, incident(light).c_str(), surface.c_str());
  });
  return numbers;
}

DiffuseLight EnergyPlusFunctions::diffuse_light(State& state, Irradiances const& numbers) const {
  if (std::ranges::min(numbers) < 0) return {};
  auto const [all, beam, sky, ground] = numbers;
  DiffuseLight light{variable(state, sky), variable(state, ground)};
  // EnergyPlus's own solar reflections, if it has them; otherwise rounding.
  light.by_shades =
      std::max(0.0, variable(state, all) - variable(state, beam) - light.sky - light.by_ground);
  return light;
}

int EnergyPlusFunctions::light_of_ground(State& state) const {
  int const handle = symbol::variable_handle.in(symbols_)(&state, reflected_by_ground, whole_site);
  if (handle < 0) throw Error(fmt::format("EnergyPlus has no {}", reflected_by_ground));
  return handle;
}

double EnergyPlusFunctions::variable(State& state, int number) const {
  return symbol::variable_value.in(symbols_)(&state, number);
}

class ScheduleInterface {
 public:
  // A schedule of EnergyPlus's; neither an object nor a number: there is none.
  struct Handle {
    ScheduleObject* object = nullptr;  // from 25.1 on
    int number = 0;

    bool exists() const { return object != nullptr || number > 0; }
  };

  ScheduleInterface() = default;
  virtual ~ScheduleInterface() = default;
  ScheduleInterface(ScheduleInterface const&) = delete;
  ScheduleInterface& operator=(ScheduleInterface const&) = delete;
  ScheduleInterface(ScheduleInterface&&) = delete;
  ScheduleInterface& operator=(ScheduleInterface&&) = delete;

  virtual Handle find(State& state, std::string const& name) const = 0;
  virtual double minimum(State& state, Handle schedule) const = 0;
  virtual double maximum(State& state, Handle schedule) const = 0;
  virtual double at(State& state, Handle schedule, Moment moment) const = 0;
};

namespace {

// From 25.1 on, schedules are objects.
class ScheduleObjects : public ScheduleInterface {
 public:
  explicit ScheduleObjects(SymbolTable const& symbols)
      : get_(symbol::get_schedule.in(symbols)),
        minimum_(symbol::schedule_minimum.in(symbols)),
        maximum_(symbol::schedule_maximum.in(symbols)),
        constant_at_(symbol::constant_schedule_at.in(symbols)),
        index_(index_of(constant_at_, symbol::constant_schedules.in(symbols))) {
    if (has_all(symbols, Need::constants)) {
      number_ = symbol::schedule_number.in(symbols);
      current_ = symbol::current_schedule_value.in(symbols);
    }
    if (index_) return;
    throw Error(
        fmt::format("{}: ScheduleConstant has no virtual getHrTsVal", symbols.library().string()));
  }

  Handle find(State& state, std::string const& name) const override {
    auto* const object = get_(state, name);
    return {object, object != nullptr && number_ != nullptr ? number_(state, name) : 0};
  }
  double minimum(State& state, Handle schedule) const override {
    return minimum_(schedule.object, state);
  }
  double maximum(State& state, Handle schedule) const override {
    return maximum_(schedule.object, state);
  }
  // By the object's own function, because releases add types of schedules. That of a constant one
  // ignores what an EMS or another program has set.
  double at(State& state, Handle schedule, Moment moment) const override {
    auto const* const found = schedule.object;
    auto const at_hour = (*reinterpret_cast<AtHour const* const*>(found))[*index_];
    if (at_hour == constant_at_ && current_ != nullptr) return current_(state, schedule.number);
    return at_hour(found, state, moment.hour, moment.timestep);
  }

 private:
  using AtHour = PointerTo<symbol::constant_schedule_at>;

  // Where a function is in a class's table of virtual functions.
  static std::optional<std::size_t> index_of(AtHour function, std::byte const* table) {
    constexpr std::size_t max_functions = 16;
    for (std::size_t i = 0; table != nullptr && i < max_functions; ++i) {
      AtHour entry = nullptr;
      std::memcpy(&entry, table + i * sizeof entry, sizeof entry);
      if (entry == function) return i;
    }
    return std::nullopt;
  }

  PointerTo<symbol::get_schedule> get_;
  PointerTo<symbol::schedule_minimum> minimum_;
  PointerTo<symbol::schedule_maximum> maximum_;
  AtHour constant_at_;
  std::optional<std::size_t> index_;
  PointerTo<symbol::schedule_number> number_ = nullptr;
  PointerTo<symbol::current_schedule_value> current_ = nullptr;
};

// Before, they were numbered from 1.
class NumberedSchedules : public ScheduleInterface {
 public:
  explicit NumberedSchedules(SymbolTable const& symbols)
      : find_(symbol::schedule_index.in(symbols)),
        minimum_(symbol::numbered_schedule_minimum.in(symbols)),
        maximum_(symbol::numbered_schedule_maximum.in(symbols)),
        at_(symbol::numbered_schedule_at.in(symbols)) {}

  Handle find(State& state, std::string const& name) const override {
    return {nullptr, std::max(find_(state, name), 0)};
  }
  double minimum(State& state, Handle schedule) const override {
    return minimum_(state, schedule.number);
  }
  double maximum(State& state, Handle schedule) const override {
    return maximum_(state, schedule.number);
  }
  double at(State& state, Handle schedule, Moment moment) const override {
    return at_(state, schedule.number, moment.hour, moment.timestep);
  }

 private:
  PointerTo<symbol::schedule_index> find_;
  PointerTo<symbol::numbered_schedule_minimum> minimum_;
  PointerTo<symbol::numbered_schedule_maximum> maximum_;
  PointerTo<symbol::numbered_schedule_at> at_;
};

// The schedules of one run.
class FoundSchedules {
 public:
  FoundSchedules(State& state, std::shared_ptr<ScheduleInterface const> interface)
      : state_(state), interface_(std::move(interface)) {}

  std::pair<double, double> range(std::string const& name) {
    auto const found = schedule(name);
    return {checked_share(name, interface_->minimum(state_, found)),
            checked_share(name, interface_->maximum(state_, found))};
  }

  double unlimited(std::string const& name, Moment moment) {
    return checked_value(name, interface_->at(state_, schedule(name), moment));
  }

  double at(std::string const& name, Moment moment) {
    auto const found = schedule(name);
    return checked_share(name, moment.timestep > 0 ? interface_->at(state_, found, moment)
                                                   : interface_->minimum(state_, found));
  }

 private:
  ScheduleInterface::Handle schedule(std::string const& name) {
    auto const [place, added] = known_.try_emplace(name);
    if (added) place->second = interface_->find(state_, name);
    if (!place->second.exists())
      throw Error(fmt::format("EnergyPlus has no schedule \"{}\"", name));
    return place->second;
  }

  State& state_;
  std::shared_ptr<ScheduleInterface const> interface_;
  std::unordered_map<std::string, ScheduleInterface::Handle> known_;
};

}  // namespace

ScheduleFunctions::ScheduleFunctions(SymbolTable const& symbols) {
  if (has_all(symbols, Need::from_25_1)) {
    interface_ = std::make_shared<ScheduleObjects>(symbols);
  } else {
    interface_ = std::make_shared<NumberedSchedules>(symbols);
  }
}

Schedules ScheduleFunctions::of(State& state) const {
  auto const found = std::make_shared<FoundSchedules>(state, interface_);
  return {
      [found](std::string const& name) { return found->range(name); },
      [found](std::string const& name, Moment moment) { return found->at(name, moment); },
      [found](std::string const& name, Moment moment) { return found->unlimited(name, moment); }};
}

}  // namespace gpu_shading::energyplus

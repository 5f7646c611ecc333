#include "routes/patched/symbols/schedule_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <unordered_map>
#include <utility>

#include "gpu_shading/error.h"
#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

class ScheduleInterface {
 public:
  // A schedule of EnergyPlus's: where it is, or its number; 0 if there is none.
  using Handle = std::uintptr_t;

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
        index_(index_of(symbol::constant_schedule_at.in(symbols),
                        symbol::constant_schedules.in(symbols))) {
    if (index_) return;
    throw Error(
        fmt::format("{}: ScheduleConstant has no virtual getHrTsVal", symbols.library().string()));
  }

  Handle find(State& state, std::string const& name) const override {
    return reinterpret_cast<Handle>(get_(state, name));
  }
  double minimum(State& state, Handle schedule) const override {
    return minimum_(object(schedule), state);
  }
  double maximum(State& state, Handle schedule) const override {
    return maximum_(object(schedule), state);
  }
  // By the object's own function, because releases add types of schedules.
  double at(State& state, Handle schedule, Moment moment) const override {
    auto const* const found = object(schedule);
    auto* const* const functions = *reinterpret_cast<AtHour const* const*>(found);
    return functions[*index_](found, state, moment.hour, moment.timestep);
  }

 private:
  using AtHour = PointerTo<symbol::constant_schedule_at>;

  static ScheduleObject* object(Handle schedule) {
    return reinterpret_cast<ScheduleObject*>(schedule);  // NOLINT(performance-no-int-to-ptr)
  }

  // Where a function is in a class's table of virtual functions.
  static std::optional<std::size_t> index_of(AtHour function, std::byte const* table) {
    constexpr std::size_t most_functions = 16;
    for (std::size_t i = 0; table != nullptr && i < most_functions; ++i) {
      AtHour entry = nullptr;
      std::memcpy(&entry, table + i * sizeof entry, sizeof entry);
      if (entry == function) return i;
    }
    return std::nullopt;
  }

  PointerTo<symbol::get_schedule> get_;
  PointerTo<symbol::schedule_minimum> minimum_;
  PointerTo<symbol::schedule_maximum> maximum_;
  std::optional<std::size_t> index_;
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
    return static_cast<Handle>(std::max(find_(state, name), 0));
  }
  double minimum(State& state, Handle schedule) const override {
    return minimum_(state, static_cast<int>(schedule));
  }
  double maximum(State& state, Handle schedule) const override {
    return maximum_(state, static_cast<int>(schedule));
  }
  double at(State& state, Handle schedule, Moment moment) const override {
    return at_(state, static_cast<int>(schedule), moment.hour, moment.timestep);
  }

 private:
  PointerTo<symbol::schedule_index> find_;
  PointerTo<symbol::numbered_schedule_minimum> minimum_;
  PointerTo<symbol::numbered_schedule_maximum> maximum_;
  PointerTo<symbol::numbered_schedule_at> at_;
};

double limited(double value) { return std::clamp(value, 0.0, 1.0); }

// The schedules of one run.
class FoundSchedules {
 public:
  FoundSchedules(State& state, std::shared_ptr<ScheduleInterface const> interface)
      : state_(state), interface_(std::move(interface)) {}

  std::pair<double, double> range(std::string const& name) {
    auto const found = schedule(name);
    return {limited(interface_->minimum(state_, found)),
            limited(interface_->maximum(state_, found))};
  }

  double at(std::string const& name, Moment moment) {
    auto const found = schedule(name);
    return limited(moment.timestep > 0 ? interface_->at(state_, found, moment)
                                       : interface_->minimum(state_, found));
  }

 private:
  ScheduleInterface::Handle schedule(std::string const& name) {
    auto const [place, added] = known_.try_emplace(name, 0);
    if (added) place->second = interface_->find(state_, name);
    if (place->second == 0) throw Error(fmt::format("EnergyPlus has no schedule \"{}\"", name));
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
  return {[found](std::string const& name) { return found->range(name); },
          [found](std::string const& name, Moment moment) { return found->at(name, moment); }};
}

}  // namespace gpu_shading::energyplus

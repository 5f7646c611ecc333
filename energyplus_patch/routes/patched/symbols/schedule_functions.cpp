#include "routes/patched/symbols/schedule_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <unordered_map>
#include <utility>

#include "gpu_shading/error.h"
#include "routes/patched/binary/function_finder.h"

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

constexpr char const* get_schedule =
    "_ZN10EnergyPlus5Sched11GetScheduleERNS_14EnergyPlusDataERKNSt7__cxx1112basic_"
    "stringIcSt11char_traitsIcESaIcEEE";

// From 25.1 on, schedules are objects.
class ScheduleObjects : public ScheduleInterface {
 public:
  explicit ScheduleObjects(SymbolTable const& symbols) {
    FunctionFinder finder(symbols);
    finder.find(get_schedule, get_);
    finder.find("_ZN10EnergyPlus5Sched12ScheduleBase9getMinValERNS_14EnergyPlusDataE", minimum_);
    finder.find("_ZN10EnergyPlus5Sched12ScheduleBase9getMaxValERNS_14EnergyPlusDataE", maximum_);
    AtHour* constant_at_hour = nullptr;
    finder.find("_ZNK10EnergyPlus5Sched16ScheduleConstant10getHrTsValERNS_14EnergyPlusDataEii",
                constant_at_hour);
    finder.check();
    index_ = index_of(reinterpret_cast<void*>(constant_at_hour),
                      symbols.virtual_functions("N10EnergyPlus5Sched16ScheduleConstantE"));
    if (index_) return;
    throw Error(fmt::format("{}: functions missing in this build:\n  virtual getHrTsVal",
                            symbols.library().string()));
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
    auto* const* const functions = *reinterpret_cast<AtHour* const* const*>(found);
    return functions[*index_](found, state, moment.hour, moment.timestep);
  }

 private:
  struct Schedule;  // EnergyPlus's own
  using Get = Schedule*(State&, std::string const&);
  using Extreme = double(Schedule*, State&);
  using AtHour = double(Schedule const*, State&, int hour, int timestep);

  static Schedule* object(Handle schedule) {
    return reinterpret_cast<Schedule*>(schedule);  // NOLINT(performance-no-int-to-ptr)
  }

  // Where a function is in a class's table of virtual functions.
  static std::optional<std::size_t> index_of(void const* function, std::byte const* table) {
    constexpr std::size_t most_functions = 16;
    for (std::size_t i = 0; table != nullptr && i < most_functions; ++i) {
      void* entry = nullptr;
      std::memcpy(&entry, table + i * sizeof entry, sizeof entry);
      if (entry == function) return i;
    }
    return std::nullopt;
  }

  Get* get_ = nullptr;
  Extreme* minimum_ = nullptr;
  Extreme* maximum_ = nullptr;
  std::optional<std::size_t> index_;
};

// Before, they were numbered from 1.
class NumberedSchedules : public ScheduleInterface {
 public:
  explicit NumberedSchedules(SymbolTable const& symbols) {
    FunctionFinder finder(symbols);
    finder.find(
        "_ZN10EnergyPlus15ScheduleManager16GetScheduleIndexERNS_14EnergyPlusDataERKNSt7__"
        "cxx1112basic_stringIcSt11char_traitsIcESaIcEEE",
        find_);
    finder.find("_ZN10EnergyPlus15ScheduleManager19GetScheduleMinValueERNS_14EnergyPlusDataEi",
                minimum_);
    finder.find("_ZN10EnergyPlus15ScheduleManager19GetScheduleMaxValueERNS_14EnergyPlusDataEi",
                maximum_);
    finder.find("_ZN10EnergyPlus15ScheduleManager19LookUpScheduleValueERNS_14EnergyPlusDataEiii",
                at_);
    finder.check();
  }

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
  int (*find_)(State&, std::string const&) = nullptr;
  double (*minimum_)(State&, int) = nullptr;
  double (*maximum_)(State&, int) = nullptr;
  double (*at_)(State&, int, int hour, int timestep) = nullptr;
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
  if (symbols.find(get_schedule) != nullptr) {
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

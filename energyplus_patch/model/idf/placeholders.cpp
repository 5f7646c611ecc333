#include "model/idf/placeholders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace gpu_shading::energyplus {
namespace {

constexpr char const* sky_schedule = "GPU SHADING SKY";

struct OwnSchedule {
  char const* name;
  std::vector<char const*> data;
};

std::array<OwnSchedule, 3> const& schedules_of_ours() {
  static std::array<OwnSchedule, 3> const schedules{{
      {sky_schedule, {"Through: 12/31", "For: AllDays", "Until: 12:00", "1", "Until: 24:00", "0"}},
      {"GPU SHADING NORTHERN LEAVES",
       {"Through: 4/6", "For: AllDays", "Until: 24:00", "0", "Through: 10/27", "For: AllDays",
        "Until: 24:00", "1", "Through: 12/31", "For: AllDays", "Until: 24:00", "0"}},
      {"GPU SHADING SOUTHERN LEAVES",
       {"Through: 4/27", "For: AllDays", "Until: 24:00", "1", "Through: 10/5", "For: AllDays",
        "Until: 24:00", "0", "Through: 12/31", "For: AllDays", "Until: 24:00", "1"}},
  }};
  return schedules;
}

OwnSchedule const& schedule_of_ours(std::string const& name) {
  auto const& schedules = schedules_of_ours();
  return *std::ranges::find(schedules, name, &OwnSchedule::name);
}

using Corner = std::array<double, 3>;

// Centred on the ground, which determines the air temperature that EnergyPlus uses for a surface.
// It faces the model.
std::array<Corner, 4> corners(Placeholder const& placeholder) {
  double const far = placeholder.distance;
  constexpr double width = 0.1;
  double const east = placeholder.quarter == 0 || placeholder.quarter == 3 ? 1.0 : -1.0;
  double const north = placeholder.quarter < 2 ? 1.0 : -1.0;
  auto const corner = [&](double side, double z) {
    return Corner{east * far + side * north * width, north * far - side * east * width, z * far};
  };
  return {corner(-1, 1), corner(-1, -1), corner(1, -1), corner(1, 1)};
}

// Creates placeholders with names of their own.
class Maker {
 public:
  explicit Maker(Names const& taken) : taken_(taken) {}

  void add(std::string const& schedule, int quarter) {
    std::string name;
    do {
      name = fmt::format("GPU SHADING PLACEHOLDER {}", ++number_);
    } while (taken_.contains(name));
    made_.push_back({name, schedule, quarter});
  }

  std::vector<Placeholder>& made() { return made_; }

 private:
  Names const& taken_;
  int number_ = 0;
  std::vector<Placeholder> made_;
};

}  // namespace

std::vector<Placeholder> make_placeholders(std::vector<std::string> const& schedules,
                                           Names const& taken) {
  Maker maker(taken);
  for (int quarter = 0; quarter < 4; ++quarter) maker.add("", quarter);
  for (auto const& schedule : schedules) maker.add(schedule, 0);
  return std::move(maker.made());
}

Placeholder make_sky_placeholder(Names const& taken) {
  Maker maker(taken);
  maker.add(sky_schedule, 0);
  return maker.made().front();
}

std::string season_schedule(bool southern) { return schedules_of_ours().at(southern ? 2 : 1).name; }

std::vector<std::string> own_schedules(std::vector<Placeholder> const& placeholders,
                                       std::vector<std::string> const& leaf_schedules) {
  std::vector<std::string> names;
  for (auto const& each : schedules_of_ours()) {
    bool const used =
        std::ranges::find(placeholders, each.name, &Placeholder::schedule) != placeholders.end() ||
        std::ranges::find(leaf_schedules, each.name) != leaf_schedules.end();
    if (used) names.emplace_back(each.name);
  }
  return names;
}

bool is_own_schedule(std::string const& name) {
  return std::ranges::find(schedules_of_ours(), name, &OwnSchedule::name) !=
         schedules_of_ours().end();
}

std::vector<NewObject> schedule_objects(std::string const& name) {
  NewObject schedule{
      "Schedule:Compact", {{"name", name}, {"schedule_type_limits_name", name}}, "data"};
  for (auto const* field : schedule_of_ours(name).data)
    schedule.items.push_back({{"field", field}});
  return {{"ScheduleTypeLimits", {{"name", name}}}, std::move(schedule)};
}

NewObject placeholder_object(Placeholder const& placeholder) {
  NewObject object{"Shading:Site:Detailed",
                   {{"name", placeholder.name},
                    {"transmittance_schedule_name", placeholder.schedule},
                    {"number_of_vertices", 4}},
                   "vertices"};
  for (auto const& [x, y, z] : corners(placeholder)) {
    object.items.push_back(
        {{"vertex_x_coordinate", x}, {"vertex_y_coordinate", y}, {"vertex_z_coordinate", z}});
  }
  return object;
}

}  // namespace gpu_shading::energyplus

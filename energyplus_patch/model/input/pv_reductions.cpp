#include "model/input/pv_reductions.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view heading = "month,day,hour,timestep,reduction,PVWatts,surface";
constexpr std::size_t numbers = 6;  // before the surface, which may contain commas
constexpr int max_steps = 60;

struct Row {
  PvReductions::Time time;
  double reduction = 0.0;
  double of_pvwatts = 0.0;
  std::string surface;
};

int whole_number(std::string const& text, std::string_view title, int most) {
  auto const number = parse_number(text);
  if (number && *number >= 1.0 && *number <= most && *number == std::floor(*number)) {
    return static_cast<int>(*number);
  }
  throw Error(
      fmt::format("{} is {}, expected an integer from 1 to {}", title, in_quotes(text), most));
}

double share(std::string const& text, std::string_view title) {
  auto const number = parse_number(text);
  if (number && *number >= 0.0 && *number <= 1.0) return *number;
  throw Error(fmt::format("{} is {}, expected a number from 0 to 1", title, in_quotes(text)));
}

Row read_row(std::string const& line) {
  std::array<std::string, numbers> words;
  std::size_t start = 0;
  for (auto& word : words) {
    auto const end = line.find(',', start);
    if (end == std::string::npos) {
      throw Error(fmt::format("{}: expected {}", in_quotes(line), heading));
    }
    word = trimmed(std::string_view(line).substr(start, end - start));
    start = end + 1;
  }
  auto const surface = trimmed(std::string_view(line).substr(start));
  constexpr int months = 12;
  constexpr int days = 31;
  constexpr int hours = 24;
  return {{whole_number(words[0], "month", months), whole_number(words[1], "day", days),
           whole_number(words[2], "hour", hours), whole_number(words[3], "timestep", max_steps)},
          share(words[4], "reduction"),
          share(words[5], "PVWatts"),
          upper(surface)};
}

void check_surface(std::string const& surface, ShadingInput const& input) {
  if (input.shading_surfaces.contains(surface)) return;
  if (input.zone_of.contains(surface) || input.base_of.contains(surface)) {
    throw Error(
        fmt::format("{} is a surface of the building, whose heat balance would change: "
                    "expected a shading surface",
                    in_quotes(surface)));
  }
  std::vector<std::string> names;
  for (auto const& [name, unused] : input.shading_surfaces) names.push_back(name);
  throw Error(fmt::format("{} is no shading surface of the model{}", in_quotes(surface),
                          did_you_mean(surface, names)));
}

}  // namespace

int PvReductions::Time::key() const {
  constexpr int days = 32;
  constexpr int hours = 24;
  return ((month * days + day) * hours + hour - 1) * (max_steps + 1) + timestep;
}

PvReductions read_pv_reductions(std::filesystem::path const& file,
                                std::vector<InputObject> const& objects,
                                ShadingInput const& input) {
  std::set<std::string> pvwatts;
  for (auto const& object : objects) {
    if (object.type == "Generator:PVWatts") pvwatts.insert(upper(object["surface_name"]));
  }
  std::istringstream text(read_text_file(file));
  PvReductions reductions;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (trimmed(line).empty()) continue;
    naming(fmt::format("{}, line {}", file.string(), number), [&] {
      if (number == 1) {
        if (trimmed(line) == heading) return;
        throw Error(fmt::format("{}: expected {}", in_quotes(line), heading));
      }
      auto const row = read_row(line);
      auto& of_surface = reductions.by_surface[row.surface];
      if (of_surface.empty()) check_surface(row.surface, input);
      of_surface[row.time.key()] =
          static_cast<float>(pvwatts.contains(row.surface) ? row.of_pvwatts : row.reduction);
    });
  }
  return reductions;
}

}  // namespace gpu_shading::energyplus

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <ostream>
#include <utility>
#include <vector>

#include "platform/console.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "programs/gpu_shading/listed_folder.h"
#include "runs/run_times.h"
#include "tasks/samples/sky_patches.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {
namespace {

std::array<SkyDivision, 3> skies() { return {energyplus_sky(), reinhart_sky(1), reinhart_sky(2)}; }

// The cosine of incidence of a patch's centre; 0 if it is behind the receiver.
double cosine_of(SkyPatch const& patch, SampledReceiver const& receiver) {
  double const cosine = glm::dot(glm::normalize(receiver.area), to_vector(patch.centre));
  return cosine < min_cosine ? 0.0 : cosine;
}

std::vector<ReceiverFractions> render_sky(ModelRun const& run) {
  std::vector<SunDirection> directions;
  for (auto const& sky : skies()) {
    for (auto const& patch : sky.patches) directions.push_back(patch.centre);
  }
  TemporaryFolder const temporary;
  auto const file = temporary.path() / "fractions";
  auto const reply = run_task(run, DirectionsTask{std::move(directions), file});
  for (auto const& warning : reply.warnings) print_line("warning: " + warning);
  print_line(reply.text);
  return read_fractions(file);
}

// Irradiance from the first `count` patches of a uniform sky, as a fraction of the unshaded one.
// `fractions` begins with that of the first patch.
double shaded_ratio(SkyDivision const& sky, SampledReceiver const& receiver,
                    double const* fractions, std::size_t count) {
  double unshaded = 0.0;
  double shaded = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    auto const& patch = sky.patches[i];
    double const share = cosine_of(patch, receiver) * patch.solid_angle;
    unshaded += share;
    shaded += share * fractions[i];
  }
  return unshaded > 0.0 ? shaded / unshaded : 0.0;
}

void write_patches(std::vector<ReceiverFractions> const& receivers, std::ostream& csv) {
  csv << "sky,patch,azimuth,altitude,solid_angle,receiver,cosine,sunlit_fraction\n";
  std::size_t first = 0;
  for (auto const& sky : skies()) {
    for (std::size_t i = 0; i < sky.patches.size(); ++i) {
      auto const& patch = sky.patches[i];
      auto const patch_text = fmt::format("{},{},{:.6g},{:.6g},{:.8g}", sky.name, i + 1,
                                          glm::degrees(patch.centre.azimuth),
                                          glm::degrees(patch.centre.altitude), patch.solid_angle);
      for (auto const& [receiver, fractions] : receivers) {
        double const cosine = cosine_of(patch, receiver);
        if (cosine <= 0.0) continue;
        csv << fmt::format("{},{},{:.8g},{:.6f}\n", patch_text, csv_field(receiver.name), cosine,
                           fractions[first + i]);
      }
    }
    first += sky.patches.size();
  }
}

void write_view(ReceiverFractions const& one, std::ostream& csv) {
  constexpr std::size_t horizon = 24;  // patches of the lowest row of EnergyPlus's sky
  double const up = glm::normalize(one.receiver.area).z;
  double const unshaded = (1.0 + up) / 2.0;
  auto const* fractions = one.fractions.data();
  for (auto const& sky : skies()) {
    double const ratio = shaded_ratio(sky, one.receiver, fractions, sky.patches.size());
    csv << fmt::format("{},{:.6g},{:.4g},{},{:.6f},{:.6f},{:.6f},", csv_field(one.receiver.name),
                       glm::length(one.receiver.area),
                       glm::degrees(std::acos(std::clamp(up, -1.0, 1.0))), sky.name, unshaded,
                       unshaded * ratio, ratio);
    // Only EnergyPlus has a separate ratio for the horizon.
    if (fractions == one.fractions.data()) {
      csv << fmt::format("{:.6f}", shaded_ratio(sky, one.receiver, fractions, horizon));
    }
    csv << '\n';
    fractions += sky.patches.size();
  }
}

void write_views(std::vector<ReceiverFractions> const& receivers, std::ostream& csv) {
  csv << "receiver,area [m2],tilt [deg],sky,unshaded view factor,shaded view factor,ratio,"
         "horizon ratio\n";
  for (auto const& one : receivers) write_view(one, csv);
}

}  // namespace

void sample_sky(ModelRun const& run, std::filesystem::path const& folder) {
  ListedFolder files(folder, "sky.json", "gpu_shading sky 1");
  auto const receivers = render_sky(run);
  files.write("sky.csv", [&](std::ostream& out) { write_patches(receivers, out); });
  files.write("sky_view.csv", [&](std::ostream& out) { write_views(receivers, out); });
  files.commit(nlohmann::ordered_json::object());
  for (auto const* const name : {"sky.csv", "sky_view.csv"}) {
    print("{}\n", (folder / name).string());
  }
}

}  // namespace gpu_shading::energyplus

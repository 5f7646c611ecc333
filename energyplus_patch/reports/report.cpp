#include "reports/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <tuple>

#include "files/pictures.h"
#include "model/options/report_folder.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

constexpr int picture_size = 800;

struct Row {
  SurfaceId receiver;
  SunDirection sun;
  std::uint32_t state;
  double projected_area;
  double fraction;
  std::optional<double> error;
};

std::vector<Row> collect(Renderer const& renderer, SurfaceId receiver, ReceiverNumber number,
                         AnswerStore const& answers, std::vector<double> const& factors) {
  auto const& polygon = renderer.scene()[receiver].polygon;
  double const full = area(polygon);
  auto const facing = normal(polygon);
  std::vector<Row> rows;
  answers.for_each([&](AnswerStore::Direction const& direction) {
    double const cosine = glm::dot(facing, to_vector(direction.sun));
    // What was rendered ahead depends on what the cache knew.
    if (!direction.asked && !direction.sampled) return;
    if (!direction.knows(number) || cosine <= 0.0 || full <= 0.0) return;
    double const answer = direction.area(number, factors);
    rows.push_back({receiver, direction.sun, direction.state, answer,
                    std::min(1.0, answer / (full * cosine)), direction.error(number)});
  });
  std::ranges::sort(rows, {}, [](Row const& row) {
    return std::tuple(row.sun.azimuth, row.sun.altitude, row.state);
  });
  return rows;
}

std::vector<Row> choose(std::vector<Row> const& rows) {
  std::vector<Row> shaded;
  std::ranges::copy_if(rows, std::back_inserter(shaded),
                       [](Row const& row) { return row.fraction < 1.0 && !is_sky_patch(row.sun); });
  if (shaded.empty()) return {};
  auto const least = [&](auto const& measure) {
    return *std::ranges::min_element(shaded, {}, measure);
  };
  std::vector<Row> chosen{
      least([](Row const& row) { return row.fraction > 0.0 ? row.fraction : 2.0; }),
      least([](Row const& row) { return std::abs(row.fraction - 0.5); }),
      least([](Row const& row) { return -row.sun.altitude; }),
  };
  auto const last = std::unique(chosen.begin(), chosen.end(), [](Row const& a, Row const& b) {
    return a.sun == b.sun && a.state == b.state;
  });
  chosen.erase(last, chosen.end());
  return chosen;
}

std::string stem_of(std::string const& surface, SunDirection sun, Deployments const& deployments,
                    std::uint32_t state) {
  auto name = fmt::format("{}_{:05.1f}_{:04.1f}", surface, degrees_clockwise(sun.azimuth),
                          glm::degrees(sun.altitude));
  auto const& values = deployments.states[state];
  for (std::size_t i = 0; i < values.size(); ++i) {
    name += fmt::format("_{:.6g}", i < deployments.shares ? 100.0 * values[i] : values[i]);
  }
  return name;
}

std::string heads_of(Deployments const& deployments) {
  std::string text;
  for (auto const& head : deployments.heads) text += ',' + csv_quoted(head);
  return text;
}

std::string list(DeploymentStates::Shares const& shares) {
  std::string text;
  for (double const share : shares) text += fmt::format(",{:.6g}", share);
  return text;
}

std::string describe_error(std::optional<double> error) {
  return error ? fmt::format("{:.2g}", std::max(*error, Sunlit::rounding)) : "";
}

void write_table(std::ostream& csv, Stages const& stages) {
  csv << "stage,seconds\n";
  for (auto const& [stage, seconds] : stages) csv << fmt::format("{},{:.3f}\n", stage, seconds);
}

auto const loaded = std::chrono::steady_clock::now();

}  // namespace

double degrees_clockwise(double radians) {
  double const degrees = glm::degrees(radians);
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}

Facing facing_of(glm::dvec3 const& normal) {
  constexpr double horizontal = 1e-6;  // sine of the tilt
  bool const inclined = std::hypot(normal.x, normal.y) > horizontal;
  return {inclined ? degrees_clockwise(std::atan2(normal.x, normal.y)) : 0.0,
          glm::degrees(std::acos(std::clamp(normal.z, -1.0, 1.0)))};
}

Stages stages_of(RendererStatistics const& statistics) {
  double const passed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - loaded).count();
  double const staged = statistics.cull_seconds + statistics.count_seconds +
                        statistics.submit_seconds + statistics.wait_seconds +
                        statistics.read_seconds;
  return {{"cull", statistics.cull_seconds},
          {"count", statistics.count_seconds},
          {"submit", statistics.submit_seconds},
          {"wait", statistics.wait_seconds},
          {"read", statistics.read_seconds},
          {"other rendering", std::max(0.0, statistics.seconds - staged)},
          {"EnergyPlus", std::max(0.0, passed - statistics.seconds)}};
}

void write_stages(std::filesystem::path const& file, Stages const& stages) {
  write_whole_file(file, [&](std::ostream& csv) { write_table(csv, stages); });
}

std::size_t write_report(std::filesystem::path const& folder, CachedRenderer& rendered,
                         std::vector<SurfaceId> const& receivers, std::vector<bool> const& asked,
                         std::vector<SurfaceId> const& shown, AnswerStore const& answers,
                         std::vector<double> const& factors, Deployments const& deployments,
                         Stages const& stages, std::function<void(StagedFiles&)> const& more) {
  Renderer const& renderer = rendered.renderer();
  std::vector<Row> pictures;
  auto const write_sunlit = [&](std::ostream& csv) {
    csv << "receiver,sun azimuth [deg],sun altitude [deg],projected sunlit area [m2],sunlit "
           "fraction,error"
        << heads_of(deployments) << '\n';
    for (ReceiverNumber number = 0; number < receivers.size(); ++number) {
      auto const receiver = receivers[number];
      if (!asked[receiver]) continue;
      auto const rows = collect(renderer, receiver, number, answers, factors);
      for (auto const& row : rows) {
        csv << fmt::format(
            "{},{:.4f},{:.4f},{:.7g},{:.6f},{}{}\n", csv_quoted(renderer.scene()[receiver].name),
            degrees_clockwise(row.sun.azimuth), glm::degrees(row.sun.altitude), row.projected_area,
            row.fraction, describe_error(row.error), list(deployments.states[row.state]));
      }
      if (std::ranges::find(shown, receiver) == shown.end()) continue;
      auto const chosen = choose(rows);
      pictures.insert(pictures.end(), chosen.begin(), chosen.end());
    }
  };
  std::size_t left_out = 0;
  naming("--gpu-shading-report", [&] {
    StagedFiles files(folder);
    files.write(stages_table, [&](std::ostream& csv) { write_table(csv, stages); });
    files.write(sunlit_table, write_sunlit);
    left_out = pictures.size() - std::min(pictures.size(), max_report_pictures);
    pictures.resize(pictures.size() - left_out);

    std::string drawn = "picture,receiver,sun azimuth [deg],sun altitude [deg]";
    drawn += heads_of(deployments) + '\n';
    FileNames names;
    for (auto const& picture : pictures) {
      auto const& shares = deployments.states[picture.state];
      auto const& receiver = renderer.scene()[picture.receiver].name;
      auto const name =
          names.add(stem_of(receiver, picture.sun, deployments, picture.state), ".png");
      auto& drawing = rendered.renderer_in(picture.state);
      files.write(name, encode_image(name, drawing.sun_view(picture.sun, picture.receiver,
                                                            picture_size, factors)));
      drawn += fmt::format("{},{},{:.4f},{:.4f}{}\n", csv_quoted(name), csv_quoted(receiver),
                           degrees_clockwise(picture.sun.azimuth),
                           glm::degrees(picture.sun.altitude), list(shares));
    }
    files.write(pictures_table, drawn);
    more(files);
    files.commit();
  });
  return left_out;
}

}  // namespace gpu_shading::energyplus

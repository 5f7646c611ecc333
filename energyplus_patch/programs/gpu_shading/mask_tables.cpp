#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <ostream>

#include "model/site/site_clock.h"
#include "platform/text.h"
#include "programs/gpu_shading/mask_files.h"
#include "reports/report.h"

namespace gpu_shading::energyplus {
namespace {

std::string kind_columns() {
  std::string columns;
  for (std::size_t k = 0; k < shade_kinds; ++k) {
    columns += fmt::format(",{}", name_of(static_cast<ShadeKind>(k)));
  }
  return columns;
}

template <typename Value>
std::string fields(std::array<Value, shade_kinds> const& values) {
  std::string text;
  for (auto const value : values) text += fmt::format(",{:.4f}", value);
  return text;
}

}  // namespace

SunDirection MaskSite::sun(int day_of_year, double hour) const {
  return sun_in_standard_time(glm::radians(latitude),
                              hours_ahead({name, latitude, longitude, time_zone, 0.0}), day_of_year,
                              hour);
}

int day_21_of(int month) {
  constexpr std::array<int, 12> before{0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
  constexpr int day = 21;
  return before.at(static_cast<std::size_t>(month - 1)) + day;
}

double clear_sky_beam(int month, double altitude) {
  constexpr std::array<double, 12> extraterrestrial{1202, 1187, 1164, 1130, 1106, 1092,
                                                    1093, 1107, 1136, 1166, 1190, 1204};
  constexpr std::array<double, 12> extinction{0.141, 0.142, 0.149, 0.164, 0.177, 0.185,
                                              0.186, 0.182, 0.165, 0.152, 0.144, 0.141};
  if (altitude <= 0.0) return 0.0;
  auto const i = static_cast<std::size_t>(month - 1);
  return extraterrestrial.at(i) * std::exp(-extinction.at(i) / std::sin(altitude));
}

void write_sky(ReceiverMask const& mask, SkyGrid const& grid, std::ostream& csv) {
  csv << "azimuth [deg],altitude [deg],sunlit fraction" << kind_columns() << '\n';
  auto const directions = grid.directions();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    auto const& share = mask.sky[i];
    if (!share.faced) continue;
    csv << fmt::format("{:g},{:g},{:.4f}{}\n", glm::degrees(directions[i].azimuth),
                       glm::degrees(directions[i].altitude), share.sunlit, fields(share.stopped));
  }
}

void write_horizon(ReceiverMask const& mask, SkyGrid const& grid, std::ostream& text) {
  constexpr double south = 180.0;
  for (std::size_t i = 0; i < mask.horizon.size(); ++i) {
    text << fmt::format("{:g} {:.2f}\n", (static_cast<double>(i) + 0.5) * grid.step() - south,
                        mask.horizon[i]);
  }
}

void write_hours(std::vector<ReceiverMask> const& masks, std::vector<MaskSummary> const& summaries,
                 MaskSite const& site, std::ostream& csv) {
  csv << "receiver,month,hour,sun azimuth [deg],sun altitude [deg],sunlit fraction"
      << kind_columns() << ",beam [W/m2],marked\n";
  for (std::size_t m = 0; m < masks.size(); ++m) {
    for (std::size_t i = 0; i < site.hours.size(); ++i) {
      auto const& [month, hour, sun, beam, marked] = site.hours[i];
      auto const& share = masks[m].suns[i];
      csv << fmt::format("{},{},{},{:.4f},{:.4f},{}{},{:.1f},{}\n", csv_field(summaries[m].title),
                         month, hour, degrees_clockwise(sun.azimuth), glm::degrees(sun.altitude),
                         share.faced ? fmt::format("{:.4f}", share.sunlit) : "",
                         share.faced ? fields(share.stopped) : std::string(shade_kinds, ','), beam,
                         marked ? "yes" : "no");
    }
  }
}

void write_summaries(std::vector<ReceiverMask> const& masks,
                     std::vector<MaskSummary> const& summaries, std::ostream& csv) {
  csv << "receiver,files,x [m],y [m],z [m],azimuth [deg],tilt [deg],area [m2],"
         "unshaded view factor,sky view factor"
      << kind_columns() << '\n';
  for (std::size_t i = 0; i < masks.size(); ++i) {
    auto const& [title, stem, azimuth, tilt, view] = summaries[i];
    auto const& point = masks[i].point;
    csv << fmt::format(
        "{},{},{},{:.2f},{:.2f},{:.6g},{:.6f},{:.6f}{}\n", csv_field(title), stem,
        point ? fmt::format("{:.4f},{:.4f},{:.4f}", point->x, point->y, point->z) : ",,", azimuth,
        tilt, glm::length(masks[i].receiver.area), view.unshaded, view.view, fields(view.stopped));
  }
}

}  // namespace gpu_shading::energyplus

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

#include "gpu_shading/image.h"
#include "platform/text.h"
#include "programs/gpu_shading/map_files.h"
#include "programs/gpu_shading/mask_files.h"

namespace gpu_shading::energyplus {
namespace {

using Points = std::vector<glm::dvec2>;

constexpr glm::dvec3 ink{20.0, 24.0, 28.0};
constexpr glm::dvec3 soft{110.0, 116.0, 124.0};
constexpr glm::dvec3 faint{176.0, 182.0, 190.0};
constexpr glm::dvec3 paper{255.0, 255.0, 255.0};
constexpr glm::dvec3 clear_sky{240.0, 247.0, 255.0};
constexpr glm::dvec3 turned_away{214.0, 216.0, 219.0};

// Okabe and Ito (2008): colours that differ with any kind of colour vision.
glm::dvec3 colour_of(ShadeKind kind) {
  switch (kind) {
    case ShadeKind::building:
      return {120.0, 124.0, 130.0};
    case ShadeKind::shades:
      return {86.0, 180.0, 233.0};
    case ShadeKind::geometry:
      return {204.0, 121.0, 167.0};
    case ShadeKind::trees:
      return {0.0, 158.0, 115.0};
    case ShadeKind::neighbours:
      return {213.0, 94.0, 0.0};
    case ShadeKind::terrain:
      return {150.0, 110.0, 60.0};
  }
  return ink;
}

std::string_view description_of(ShadeKind kind) {
  switch (kind) {
    case ShadeKind::building:
      return "The building itself";
    case ShadeKind::shades:
      return "Shades";
    case ShadeKind::geometry:
      return "Imported geometry";
    case ShadeKind::trees:
      return "Trees";
    case ShadeKind::neighbours:
      return "Neighbours and site shades";
    case ShadeKind::terrain:
      return "Terrain";
  }
  return "";
}

// Pixels.
constexpr int width = 1160;
constexpr int height = 760;
constexpr int text_size = 14;
constexpr int small = 12;
constexpr double column = 720.0;  // of the legend
constexpr double chart_top = 372.0;
constexpr double chart_column = 30.0;
constexpr double chart_row = 17.0;

constexpr int month_count = 12;
constexpr std::array<std::string_view, month_count> month_names{
    "Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

class MaskFigure {
 public:
  MaskFigure(ReceiverMask const& mask, SkyGrid const& grid, MaskSite const& site,
             Projection projection)
      : mask_(mask), grid_(grid), site_(site), projection_(projection) {}

  Figure draw(MaskSummary const& summary) {
    draw_heading(summary);
    draw_sky();
    draw_axes();
    draw_paths();
    draw_hours();
    draw_legend(summary.view);
    draw_chart();
    return std::move(figure_);
  }

 private:
  bool flat() const { return projection_ == Projection::cylindrical; }
  bool northern() const { return site_.latitude >= 0.0; }
  glm::dvec2 place(SunDirection direction) const {
    auto const point = project(projection_, direction, northern());
    return flat() ? glm::dvec2(350.0 + 300.0 * point.x, 560.0 + 400.0 * point.y)
                  : glm::dvec2(340.0 + radius * point.x, 420.0 + radius * point.y);
  }
  static SunDirection degrees(double azimuth, double altitude) {
    return {glm::radians(azimuth), glm::radians(altitude)};
  }

  void draw_heading(MaskSummary const& summary) {
    constexpr int title = 20;
    figure_.text({24.0, 30.0}, title, LabelAlign::left, printable(summary.title));
    figure_.text({24.0, 58.0}, text_size, LabelAlign::left,
                 fmt::format("{:.4g} m2, faces {}, tilt {:.0f} degrees. {}, latitude {:.2f}, "
                             "longitude {:.2f}, standard time UTC{:+g} h",
                             glm::length(mask_.receiver.area), describe_azimuth(summary.azimuth),
                             summary.tilt, printable(site_.name), site_.latitude, site_.longitude,
                             site_.time_zone));
  }

  glm::dvec3 colour_of_cell(BeamShare const& share) const {
    if (!share.faced) return turned_away;
    // In steps, so that neighbouring cells join.
    constexpr float steps = 16.0F;
    auto colour = glm::dvec3(0.0);
    double rest = 1.0;
    for (std::size_t k = 0; k < shade_kinds; ++k) {
      double const part = std::round(share.stopped.at(k) * steps) / steps;
      colour += part * colour_of(static_cast<ShadeKind>(k));
      rest -= part;
    }
    return glm::clamp(colour + std::max(rest, 0.0) * clear_sky, 0.0, 255.0);
  }

  void draw_cells(std::size_t row, std::size_t from, std::size_t to, glm::dvec3 const& colour) {
    double const step = grid_.step();
    double const low = static_cast<double>(row) * step;
    // A cylinder is cut opposite the equator's side, where `from` is 0.
    double const start = northern() ? 0.0 : 180.0;
    Points outline;
    auto const add = [&](std::size_t i, double altitude) {
      double azimuth = start + static_cast<double>(i) * step;
      constexpr double inside = 1e-6;
      if (flat()) azimuth += i == 0 ? inside : i == grid_.columns() ? -inside : 0.0;
      outline.push_back(place(degrees(azimuth, altitude)));
    };
    for (auto i = from; i <= to; ++i) add(i, low);
    for (auto i = to + 1; i-- > from;) add(i, low + step);
    figure_.area(std::move(outline), colour);
  }

  void draw_sky() {
    auto const shift = northern() ? 0 : grid_.columns() / 2;
    auto const colour = [&](std::size_t row, std::size_t i) {
      return colour_of_cell(mask_.sky[row * grid_.columns() + (i + shift) % grid_.columns()]);
    };
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
      std::size_t from = 0;
      for (std::size_t i = 1; i <= grid_.columns(); ++i) {
        if (i < grid_.columns() && colour(row, i) == colour(row, from)) continue;
        draw_cells(row, from, i, colour(row, from));
        from = i;
      }
    }
  }

  void draw_axes() {
    constexpr int circle = 360;
    for (int altitude = 0; altitude < 90; altitude += 30) {
      Points ring;
      for (int azimuth = 0; azimuth <= circle; azimuth += 3) {
        double const turned = (northern() ? 0.0 : 180.0) + azimuth;
        constexpr double inside = 1e-6;
        double const end = azimuth == 0 ? inside : azimuth == circle ? -inside : 0.0;
        ring.push_back(place(degrees(turned + end, altitude)));
      }
      figure_.line(std::move(ring), altitude == 0 ? 1.6 : 0.8, altitude == 0 ? ink : faint);
      if (altitude > 0 && !flat()) {
        auto const at = place(degrees(0.0, altitude));
        figure_.text({at.x, at.y - 8.0}, small, LabelAlign::centre, fmt::format("{}", altitude));
      }
    }
    constexpr std::array<std::string_view, 4> letters{"N", "E", "S", "W"};
    for (int i = 0; i < 4; ++i) {
      auto const rim = place(degrees(90.0 * i, 0.0));
      auto const end =
          flat() ? place(degrees(90.0 * i, 90.0)) : place(degrees(90.0 * i + 180.0, 0.0));
      if (flat() || i < 2) figure_.line({rim, end}, 0.8, faint);
      auto const away =
          flat() ? glm::dvec2(0.0, 16.0) : 15.0 * glm::normalize(rim - place(degrees(0.0, 90.0)));
      figure_.text(rim + away, text_size, LabelAlign::centre,
                   std::string(letters.at(static_cast<std::size_t>(i))));
    }
    if (!flat()) return;
    for (int altitude = 0; altitude <= 90; altitude += 30) {
      figure_.text({44.0, 560.0 - 400.0 * altitude / 90.0}, small, LabelAlign::right,
                   fmt::format("{}", altitude));
    }
  }

  // Of consecutive directions above the horizon.
  void draw_track(std::vector<SunDirection> const& suns, double thick, glm::dvec3 const& colour) {
    Points points;
    auto const finish = [&] {
      if (points.size() > 1) figure_.line(points, thick, colour);
      points.clear();
    };
    for (auto const& sun : suns) {
      auto const next = place(sun);
      constexpr double jump = 200.0;  // across the cut of a cylinder
      if (sun.altitude < 0.0 || (!points.empty() && glm::distance(points.back(), next) > jump))
        finish();
      if (sun.altitude >= 0.0) points.push_back(next);
    }
    finish();
  }

  void draw_paths() {
    constexpr int hours = 24;
    constexpr int parts = 12;
    for (int hour = 0; hour < hours; ++hour) {
      std::vector<SunDirection> analemma;
      for (int day = 1; day <= 366; day += 5) analemma.push_back(site_.sun(day, hour));
      draw_track(analemma, 0.8, soft);
      auto const top = *std::ranges::max_element(analemma, {}, &SunDirection::altitude);
      constexpr double lowest = 0.05;
      if (top.altitude < lowest) continue;
      auto const at = place(top);
      auto const zenith = place(degrees(0.0, 90.0));
      auto const up =
          flat() ? glm::dvec2(0.0, -1.0) : (zenith - at) / std::max(glm::distance(zenith, at), 1.0);
      figure_.text(at + 14.0 * up, small, LabelAlign::centre, std::to_string(hour));
    }
    for (int month = 1; month <= month_count; ++month) {
      std::vector<SunDirection> path;
      for (int i = 0; i <= hours * parts; ++i) {
        path.push_back(site_.sun(day_21_of(month), static_cast<double>(i) / parts));
      }
      draw_track(path, 1.0, soft);
      label_month(month, path);
    }
  }

  // At sunrise; months with nearly the same path share a label.
  void label_month(int month, std::vector<SunDirection> const& path) {
    constexpr int june = 6;
    if (month > june && month != month_count) return;
    auto const rises =
        std::ranges::find_if(path, [](SunDirection const& sun) { return sun.altitude >= 0.0; });
    if (rises == path.end() || rises == path.begin() || flat()) return;
    auto const zenith = place(degrees(0.0, 90.0));
    auto const rim = place({rises->azimuth, 0.0});
    auto const away = glm::normalize(rim - zenith);
    figure_.line({rim + 4.0 * away, rim + 24.0 * away}, 0.8, faint);
    auto label = std::string(month_names.at(static_cast<std::size_t>(month - 1)));
    if (month < june) {
      label +=
          fmt::format(", {}", month_names.at(static_cast<std::size_t>(month_count - month - 1)));
    }
    figure_.text(rim + 28.0 * away, small, LabelAlign::left, label);
  }

  void draw_hours() {
    constexpr double dot = 5.0;
    for (std::size_t i = 0; i < site_.hours.size(); ++i) {
      auto const& hour = site_.hours[i];
      auto const& share = mask_.suns[i];
      if (!share.faced) continue;
      auto const at = place(hour.sun);
      figure_.disc(at, dot + (hour.marked ? 2.2 : 0.8), hour.marked ? ink : paper);
      figure_.disc(at, dot, fraction_colour(share.sunlit));
    }
  }

  void draw_legend(SkyView const& view) {
    double y = 104.0;
    constexpr double swatch = 16.0;
    auto const line = [&](glm::dvec3 const& colour, std::string const& words) {
      figure_.box({column, y - swatch / 2.0}, {swatch, swatch}, colour);
      figure_.text({column + 26.0, y}, text_size, LabelAlign::left, words);
      y += 22.0;
    };
    figure_.text({column, y}, 16, LabelAlign::left,
                 fmt::format("Sky view factor {:.3f}, unshaded {:.3f}", view.view, view.unshaded));
    y += 30.0;
    constexpr double percent = 100.0;
    line(clear_sky, "Sky that the receiver sees");
    for (std::size_t k = 0; k < shade_kinds; ++k) {
      double const share = view.stopped.at(k) / view.unshaded;
      constexpr double least = 5e-4;
      if (share < least) continue;
      auto const kind = static_cast<ShadeKind>(k);
      line(colour_of(kind),
           fmt::format("{}: hides {:.1f} % of its sky", description_of(kind), percent * share));
    }
    line(turned_away, "Behind the receiver");
    y += 6.0;
    constexpr int steps = 60;
    constexpr double length = 180.0;
    for (int i = 0; i < steps; ++i) {
      figure_.box({column + length * i / steps, y - 7.0}, {length / steps + 0.5, 14.0},
                  fraction_colour((i + 0.5) / steps));
    }
    figure_.text({column + length + 12.0, y}, text_size, LabelAlign::left,
                 "sunlit fraction, 0 to 1");
    y += 24.0;
    figure_.disc({column + 8.0, y}, 7.2, ink);
    figure_.disc({column + 8.0, y}, 5.0, fraction_colour(1.0));
    figure_.text({column + 26.0, y}, text_size, LabelAlign::left, site_.beam);
  }

  // Hours of the months, each a bar of what is sunlit and what each kind shades.
  void draw_chart() {
    int first = 24;
    int last = 0;
    for (auto const& hour : site_.hours) {
      first = std::min(first, hour.hour);
      last = std::max(last, hour.hour);
    }
    constexpr double left = column + 40.0;
    figure_.text({column, chart_top - 34.0}, text_size, LabelAlign::left,
                 "On the 21st, standard time: sunlit (yellow) and shaded parts");
    for (int month = 1; month <= month_count; ++month) {
      figure_.text({left + (month - 0.5) * chart_column, chart_top - 11.0}, small,
                   LabelAlign::centre,
                   std::string(month_names.at(static_cast<std::size_t>(month - 1))));
    }
    for (int hour = first; hour <= last; ++hour) {
      figure_.text({left - 8.0, chart_top + (hour - first + 0.5) * chart_row}, small,
                   LabelAlign::right, fmt::format("{:02}:00", hour));
    }
    for (std::size_t i = 0; i < site_.hours.size(); ++i) {
      auto const& hour = site_.hours[i];
      draw_bar(
          {left + (hour.month - 1) * chart_column, chart_top + (hour.hour - first) * chart_row},
          mask_.suns[i], hour.marked);
    }
  }

  void draw_bar(glm::dvec2 const& corner, BeamShare const& share, bool marked) {
    constexpr glm::dvec2 gap{1.5, 1.5};
    glm::dvec2 const size = glm::dvec2(chart_column, chart_row) - 2.0 * gap;
    auto const at = corner + gap;
    if (marked) figure_.box(at - 1.2, size + 2.4, ink);
    figure_.box(at, size, share.faced ? clear_sky : turned_away);
    if (!share.faced) return;
    double x = at.x;
    auto const part = [&](double length, glm::dvec3 const& colour) {
      if (length <= 0.0) return;
      figure_.box({x, at.y}, {length * size.x, size.y}, colour);
      x += length * size.x;
    };
    part(share.sunlit, fraction_colour(1.0));
    for (std::size_t k = 0; k < shade_kinds; ++k) {
      part(share.stopped.at(k), colour_of(static_cast<ShadeKind>(k)));
    }
  }

  static constexpr double radius = 270.0;

  ReceiverMask const& mask_;
  SkyGrid const& grid_;
  MaskSite const& site_;
  Projection projection_;
  Figure figure_{width, height};
};

}  // namespace

glm::dvec2 project(Projection projection, SunDirection direction, bool northern) {
  constexpr double right_angle = std::numbers::pi / 2.0;
  if (projection == Projection::cylindrical) {
    double const middle = northern ? std::numbers::pi : 0.0;
    double const x = std::remainder(direction.azimuth - middle, 2.0 * std::numbers::pi);
    return {x / std::numbers::pi, -direction.altitude / right_angle};
  }
  double const from_zenith = right_angle - direction.altitude;
  double const radius = projection == Projection::equidistant ? from_zenith / right_angle
                                                              : std::tan(from_zenith / 2.0);
  return {radius * std::sin(direction.azimuth), -radius * std::cos(direction.azimuth)};
}

Figure draw_mask(ReceiverMask const& mask, MaskSummary const& summary, SkyGrid const& grid,
                 MaskSite const& site, Projection projection) {
  return MaskFigure(mask, grid, site, projection).draw(summary);
}

}  // namespace gpu_shading::energyplus

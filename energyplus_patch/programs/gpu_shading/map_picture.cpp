#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "files/pictures.h"
#include "gpu_shading/image.h"
#include "gpu_shading/sun_direction.h"
#include "programs/gpu_shading/map_canvas.h"
#include "programs/gpu_shading/map_files.h"

namespace gpu_shading::energyplus {
namespace {

constexpr glm::dvec3 black{0.0, 0.0, 0.0};
constexpr glm::dvec3 white{255.0, 255.0, 255.0};
constexpr glm::dvec3 grey{90.0, 90.0, 90.0};

// Pixels.
constexpr int text = 15;
constexpr int title_text = 22;
constexpr int margin = 26;
constexpr int line_height = 23;
constexpr int left_axis = 52;
constexpr int bottom_axis = 52;
constexpr int panel_heading = 54;
constexpr int bar_gap = 26;
constexpr int bar_width = 20;
constexpr int bar_labels = 70;
constexpr int tick = 5;
constexpr glm::dvec2 most_of_map{760.0, 560.0};
constexpr double least_of_map = 60.0;
constexpr int min_bar = 150;
constexpr double least_cell_with_lines = 7.0;

struct Quantity {
  std::string name;
  std::string unit;
  double top;
  double mean;
  double least;
  double most;
  std::vector<double> values;  // by cell of the whole rectangle, row by row; nan outside
};

// 1, 2, 2.5 or 5 times a power of ten, so that `about` steps or fewer reach a length.
double round_step(double length, int about) {
  double const least = length / about;
  double const power = std::pow(10.0, std::floor(std::log10(least)));
  for (double const factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

constexpr int scale_steps = 6;

double top_of(double most) {
  if (most <= 0.0) return 1.0;
  double const step = round_step(most, scale_steps);
  return step * std::ceil(most / step - 1e-9);
}

// The position of a panel's map.
struct Frame {
  glm::dvec2 corner;  // upper left
  glm::dvec2 size;
  glm::dvec2 scale;  // pixels per metre

  glm::dvec2 place(glm::dvec2 const& point) const {
    return {corner.x + point.x * scale.x, corner.y + size.y - point.y * scale.y};
  }
};

std::vector<double> by_cell(MapGrid const& grid, std::vector<MapValue> const& values,
                            double MapValue::*field) {
  std::vector<double> all(
      static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()),
      std::nan(""));
  for (std::size_t i = 0; i < values.size(); ++i) {
    auto const& cell = grid.cells()[i];
    all[static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(grid.columns()) +
        static_cast<std::size_t>(cell.column)] = values[i].*field;
  }
  return all;
}

// u of the edges that a row of points crosses, in order.
std::vector<double> crossings(MapGrid const& grid, double v) {
  std::vector<double> found;
  for (auto const& ring : grid.rings()) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      auto const& a = ring[i];
      auto const& b = ring[(i + 1) % ring.size()];
      if ((a.y > v) == (b.y > v)) continue;
      found.push_back(a.x + (v - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }
  std::ranges::sort(found);
  return found;
}

// The cells, each in one colour up to the receiver's edges, with lines between them if there is
// room.
class CellPainter {
 public:
  CellPainter(MapCanvas& canvas, Frame const& frame, MapGrid const& grid, Quantity const& quantity)
      : canvas_(canvas), frame_(frame), grid_(grid), quantity_(quantity) {
    auto const cell = grid.cell_size() * frame.scale;
    lines_ = std::min(cell.x, cell.y) >= least_cell_with_lines;
  }

  void paint() {
    auto const first = glm::ivec2(glm::floor(frame_.corner));
    auto const last = glm::ivec2(glm::ceil(frame_.corner + frame_.size));
    for (int y = first.y; y < last.y; ++y) {
      for (int x = first.x; x < last.x; ++x) sums_.emplace_back();
      for (int part = 0; part < parts; ++part) add_row(y + (part + 0.5) / parts, first.x, last.x);
      for (int x = first.x; x < last.x; ++x) {
        auto const& [colour, count] = sums_[static_cast<std::size_t>(x - first.x)];
        if (count > 0) {
          canvas_.mix(x, y, colour / static_cast<double>(count),
                      static_cast<double>(count) / (parts * parts));
        }
      }
      sums_.clear();
    }
  }

 private:
  static constexpr int parts = 3;  // samples of a pixel, each axis

  struct Sum {
    glm::dvec3 colour{0.0};
    int count = 0;
  };

  void add_row(double y, int first, int last) {
    double const v = (frame_.corner.y + frame_.size.y - y) / frame_.scale.y;
    auto const edges = crossings(grid_, v);
    std::size_t passed = 0;
    for (int i = 0; i < (last - first) * parts; ++i) {
      double const x = first + (i + 0.5) / parts;
      double const u = (x - frame_.corner.x) / frame_.scale.x;
      while (passed < edges.size() && edges[passed] < u) ++passed;
      if (passed % 2 == 1) add_sample({u, v}, sums_[static_cast<std::size_t>(i / parts)]);
    }
  }

  void add_sample(glm::dvec2 const& point, Sum& sum) const {
    auto const place = point / grid_.cell_size();
    auto const cell = glm::clamp(glm::ivec2(glm::floor(place)), glm::ivec2(0),
                                 glm::ivec2(grid_.columns() - 1, grid_.rows() - 1));
    double const value =
        quantity_
            .values[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(grid_.columns()) +
                    static_cast<std::size_t>(cell.x)];
    auto colour = std::isnan(value) ? grey : fraction_colour(value / quantity_.top);
    if (lines_) {
      auto const off = glm::abs(place - glm::round(place)) * grid_.cell_size() * frame_.scale;
      constexpr double half_width = 0.5;
      constexpr double strength = 0.35;
      if (std::min(off.x, off.y) < half_width) colour = glm::mix(colour, white, strength);
    }
    sum.colour += colour;
    ++sum.count;
  }

  MapCanvas& canvas_;
  Frame const& frame_;
  MapGrid const& grid_;
  Quantity const& quantity_;
  bool lines_;
  std::vector<Sum> sums_;
};

std::string number(double value) {
  double const size = std::abs(value);
  if (size == 0.0) return "0";
  if (size >= 100.0) return fmt::format("{:.0f}", value);
  return size >= 10.0 ? fmt::format("{:.1f}", value) : fmt::format("{:.2f}", value);
}

std::string_view compass_point(double azimuth) {
  constexpr std::array<std::string_view, 8> points{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  constexpr double circle = 360.0;
  constexpr double sector = circle / points.size();
  auto const turned = std::fmod(azimuth + circle + sector / 2.0, circle);
  return points.at(static_cast<std::size_t>(turned / sector) % points.size());
}

double azimuth_of(glm::dvec3 const& direction) {
  return std::fmod(glm::degrees(std::atan2(direction.x, direction.y)) + 360.0, 360.0);
}

class MapDrawing {
 public:
  MapDrawing(MapGrid const& grid, MapHeading const& heading) : grid_(grid), heading_(heading) {
    auto const extent = glm::dvec2(grid.columns(), grid.rows()) * grid.cell_size();
    double const even = std::min(most_of_map.x / extent.x, most_of_map.y / extent.y);
    // A long strip is widened.
    scale_ = glm::max(glm::dvec2(even), least_of_map / extent);
    map_ = extent * scale_;
    panel_ = glm::ivec2(glm::ceil(map_)) +
             glm::ivec2(left_axis + bar_gap + bar_width + bar_labels, panel_heading + bottom_axis);
    panel_.y = std::max(panel_.y, panel_heading + bottom_axis + min_bar);
    constexpr int min_panel = 420;  // room for its heading
    panel_.x = std::max(panel_.x, min_panel);
    stacked_ = map_.x > map_.y;
    top_ = margin + title_text + 12 + line_height * static_cast<int>(lines().size()) + 24;
  }

  std::string draw(std::string const& name, std::array<Quantity, 2> const& quantities) {
    int const across = stacked_ ? panel_.x : 2 * panel_.x + margin;
    int const down = stacked_ ? 2 * panel_.y + margin : panel_.y;
    MapCanvas canvas(std::max(across, width_of_text()) + 2 * margin, top_ + down + margin / 2);
    write_heading();
    if (shows_north_arrow()) draw_north(canvas);
    glm::ivec2 corner{margin, top_};
    for (auto const& quantity : quantities) {
      draw_panel(canvas, quantity, corner);
      corner += stacked_ ? glm::ivec2(0, panel_.y + margin) : glm::ivec2(panel_.x + margin, 0);
    }
    return encode_labelled(name, canvas.image(), labels_);
  }

 private:
  void label(double x, double y, std::string words, LabelAlign align, int size = text) {
    labels_.push_back({static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), size,
                       align, std::move(words)});
  }

  std::vector<std::string> lines() const {
    auto lines = heading_.lines;
    double const ratio = scale_.y / scale_.x;
    constexpr double equal = 1.01;
    if (std::max(ratio, 1.0 / ratio) > equal) {
      lines.push_back(ratio > 1.0 ? fmt::format("Heights are stretched by {:.1f}", ratio)
                                  : fmt::format("Widths are stretched by {:.1f}", 1.0 / ratio));
    }
    return lines;
  }

  // About, with the compass next to it.
  int width_of_text() const {
    constexpr double wide = 0.62;  // of a letter, by its height
    constexpr int compass = 80;
    auto most = static_cast<double>(heading_.title.size()) * title_text;
    for (auto const& line : lines()) most = std::max(most, static_cast<double>(line.size()) * text);
    return static_cast<int>(most * wide) + compass;
  }

  void write_heading() {
    double y = margin + title_text / 2.0;
    label(margin, y, heading_.title, LabelAlign::left, title_text);
    y += title_text / 2.0 + 12;
    for (auto const& line : lines()) {
      label(margin, y + line_height / 2.0, line, LabelAlign::left);
      y += line_height;
    }
  }

  bool shows_north_arrow() const {
    constexpr double steep = 0.5;  // cosine of the tilt
    return std::abs(grid_.axes().normal.z) > steep;
  }

  void draw_north(MapCanvas& canvas) {
    auto const& axes = grid_.axes();
    constexpr double length = 22.0;
    auto const arrow = length * glm::normalize(glm::dvec2(axes.u.y, -axes.v.y));
    glm::dvec2 const centre{canvas.image().width - margin - 34.0, margin + 34.0};
    auto const tip = centre + arrow;
    canvas.line(centre - arrow, tip, 2.5, black);
    auto const side = glm::dvec2(-arrow.y, arrow.x);
    canvas.line(tip, tip - 0.45 * arrow + 0.3 * side, 2.5, black);
    canvas.line(tip, tip - 0.45 * arrow - 0.3 * side, 2.5, black);
    auto const beyond = centre + 1.55 * arrow;
    label(beyond.x, beyond.y, "N", LabelAlign::centre);
  }

  void draw_panel(MapCanvas& canvas, Quantity const& quantity, glm::ivec2 const& corner) {
    Frame const frame{glm::dvec2(corner) + glm::dvec2(left_axis, panel_heading), map_, scale_};
    label(corner.x + left_axis, corner.y + text / 2.0,
          fmt::format("{}: mean {} {}, {} to {}", quantity.name, number(quantity.mean),
                      quantity.unit, number(quantity.least), number(quantity.most)),
          LabelAlign::left);
    CellPainter(canvas, frame, grid_, quantity).paint();
    for (auto const& ring : grid_.rings()) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        canvas.line(frame.place(ring[i]), frame.place(ring[(i + 1) % ring.size()]), 1.6, black);
      }
    }
    draw_axes(canvas, frame);
    draw_scale(canvas, quantity, frame);
  }

  // Positions of numbers along an axis, m: at least at both ends.
  std::vector<double> ticks(int axis) const {
    double const extent = map_[axis] / scale_[axis];
    constexpr double apart = 70.0;  // pixels between numbers
    constexpr double rounding = 1e-6;
    double const step = round_step(extent, std::max(1, static_cast<int>(map_[axis] / apart)));
    std::vector<double> places;
    for (int i = 0; i * step <= extent * (1.0 + rounding); ++i) places.push_back(i * step);
    if (places.size() == 1) places.push_back(extent);
    return places;
  }

  void draw_axes(MapCanvas& canvas, Frame const& frame) {
    double const below = frame.corner.y + map_.y + 6.0;
    double const axis_x = frame.corner.x - 6.0;
    for (double const u : ticks(0)) {
      double const x = frame.place({u, 0.0}).x;
      canvas.line({x, below}, {x, below + tick}, 1.0, grey);
      label(x, below + tick + text * 0.8, fmt::format("{:.3g}", u), LabelAlign::centre);
    }
    for (double const v : ticks(1)) {
      double const y = frame.place({0.0, v}).y;
      canvas.line({axis_x - tick, y}, {axis_x, y}, 1.0, grey);
      label(axis_x - tick - 4.0, y, fmt::format("{:.3g}", v), LabelAlign::right);
    }
    canvas.line({frame.corner.x, below}, {frame.corner.x + map_.x, below}, 1.0, grey);
    canvas.line({axis_x, frame.corner.y}, {axis_x, frame.corner.y + map_.y}, 1.0, grey);
    draw_ends(frame, below + tick + text * 2.2);
  }

  // The points of the compass at both ends of u, and the meaning of the numbers.
  void draw_ends(Frame const& frame, double y) {
    double const right = azimuth_of(grid_.axes().u);
    std::string const middle = "m";
    label(frame.corner.x, y, std::string(compass_point(right + 180.0)), LabelAlign::centre);
    label(frame.corner.x + map_.x, y, std::string(compass_point(right)), LabelAlign::centre);
    label(frame.corner.x + map_.x / 2.0, y, middle, LabelAlign::centre);
  }

  void draw_scale(MapCanvas& canvas, Quantity const& quantity, Frame const& frame) {
    glm::ivec2 const corner{static_cast<int>(frame.corner.x + map_.x) + bar_gap,
                            static_cast<int>(frame.corner.y)};
    int const tall = std::max(static_cast<int>(map_.y), min_bar);
    for (int y = 0; y < tall; ++y) {
      canvas.fill({corner.x, corner.y + y}, {bar_width, 1},
                  fraction_colour((tall - 0.5 - y) / tall));
    }
    double const step = round_step(quantity.top, scale_steps);
    auto const count = static_cast<int>(std::lround(quantity.top / step));
    for (int i = 0; i <= count; ++i) {
      double const y = corner.y + tall * (1.0 - step * i / quantity.top);
      canvas.line({corner.x + bar_width, y}, {corner.x + bar_width + tick, y}, 1.0, grey);
      label(corner.x + bar_width + tick + 5.0, y, fmt::format("{:g}", step * i), LabelAlign::left);
    }
    label(corner.x, corner.y - text - 2, quantity.unit, LabelAlign::left);
  }

  MapGrid const& grid_;
  MapHeading const& heading_;
  glm::dvec2 scale_{};
  glm::dvec2 map_{};
  glm::ivec2 panel_{};
  bool stacked_ = false;
  int top_ = 0;
  std::vector<Label> labels_;
};

Quantity quantity_of(std::string name, std::string unit, double top, MapGrid const& grid,
                     std::vector<MapValue> const& values, double MapValue::*field) {
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += grid.cells()[i].area * (values[i].*field);
    area += grid.cells()[i].area;
  }
  auto const [least, most] = std::ranges::minmax_element(values, {}, field);
  return {std::move(name),
          std::move(unit),
          top,
          sum / area,
          (*least).*field,
          (*most).*field,
          by_cell(grid, values, field)};
}

}  // namespace

MapScales scales_for(MapValue const& most) { return {top_of(most.hours), top_of(most.energy)}; }

std::string describe_azimuth(double azimuth) {
  return fmt::format("{:.0f} degrees ({})", azimuth, compass_point(azimuth));
}

std::string draw_map(std::string const& name, MapHeading const& heading, MapGrid const& grid,
                     std::vector<MapValue> const& values, MapScales const& scales) {
  std::array<Quantity, 2> const quantities{
      {quantity_of("Sunlit hours", "h", scales.hours, grid, values, &MapValue::hours),
       quantity_of("Beam solar energy", "kWh/m2", scales.energy, grid, values, &MapValue::energy)}};
  return MapDrawing(grid, heading).draw(name, quantities);
}

}  // namespace gpu_shading::energyplus

#include "programs/gpu_shading/figure.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ostream>
#include <string_view>
#include <utility>

#include "platform/text.h"
#include "programs/gpu_shading/map_canvas.h"

namespace gpu_shading::energyplus {
namespace {

// Images are drawn at this multiple of the figure's size.
constexpr double scale = 1.5;

std::string hex(glm::dvec3 const& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(colour.r), std::lround(colour.g),
                     std::lround(colour.b));
}

std::string path_of(std::vector<glm::dvec2> const& points) {
  std::string path;
  for (auto const& point : points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', point.x, point.y);
  }
  return path;
}

template <typename... Kinds>
struct Visitor : Kinds... {
  using Kinds::operator()...;
};
template <typename... Kinds>
Visitor(Kinds...) -> Visitor<Kinds...>;

}  // namespace

void Figure::area(std::vector<glm::dvec2> outline, glm::dvec3 const& colour) {
  shapes_.emplace_back(Area{std::move(outline), colour});
}

void Figure::line(std::vector<glm::dvec2> points, double width, glm::dvec3 const& colour) {
  shapes_.emplace_back(Line{std::move(points), width, colour});
}

void Figure::disc(glm::dvec2 const& centre, double radius, glm::dvec3 const& colour) {
  shapes_.emplace_back(Disc{centre, radius, colour});
}

void Figure::box(glm::dvec2 const& corner, glm::dvec2 const& size, glm::dvec3 const& colour) {
  area({corner, {corner.x + size.x, corner.y}, corner + size, {corner.x, corner.y + size.y}},
       colour);
}

void Figure::text(glm::dvec2 const& place, int size, LabelAlign align, std::string text) {
  labels_.push_back({static_cast<int>(std::lround(place.x)), static_cast<int>(std::lround(place.y)),
                     size, align, std::move(text)});
}

void Figure::write_svg(std::string const& title, std::string const& description,
                       std::ostream& svg) const {
  svg << fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" aria-labelledby=\"title about\" font-family=\"sans-serif\" "
      "fill=\"#111111\">\n<title id=\"title\">{2}</title>\n<desc id=\"about\">{3}</desc>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width_, height_, markup_text(title), markup_text(description));
  Visitor const draw{
      [&](Area const& area) {
        svg << fmt::format(
            "<path fill=\"{}\" fill-rule=\"evenodd\" shape-rendering=\"crispEdges\" d=\"{}Z\"/>\n",
            hex(area.colour), path_of(area.outline));
      },
      [&](Line const& line) {
        svg << fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" d=\"{}\"/>\n",
                           hex(line.colour), line.width, path_of(line.points));
      },
      [&](Disc const& disc) {
        svg << fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"{}\"/>\n",
                           disc.centre.x, disc.centre.y, disc.radius, hex(disc.colour));
      }};
  for (auto const& shape : shapes_) std::visit(draw, shape);
  constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
  constexpr double baseline = 0.35;  // below the middle of a line, of its height
  for (auto const& [x, y, size, align, text] : labels_) {
    svg << fmt::format(
        "<text x=\"{}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\">{}</text>\n", x,
        y + baseline * size, size, anchors.at(static_cast<std::size_t>(align)), markup_text(text));
  }
  svg << "</svg>\n";
}

std::string Figure::encode(std::string const& name) const {
  MapCanvas canvas(static_cast<int>(scale * width_), static_cast<int>(scale * height_));
  Visitor const draw{[&](Area const& area) {
                       auto outline = area.outline;
                       for (auto& point : outline) point *= scale;
                       canvas.area(outline, area.colour);
                     },
                     [&](Line const& line) {
                       for (std::size_t i = 1; i < line.points.size(); ++i) {
                         canvas.line(scale * line.points[i - 1], scale * line.points[i],
                                     scale * line.width, line.colour);
                       }
                     },
                     [&](Disc const& disc) {
                       canvas.line(scale * disc.centre, scale * disc.centre,
                                   2.0 * scale * disc.radius, disc.colour);
                     }};
  for (auto const& shape : shapes_) std::visit(draw, shape);
  auto labels = labels_;
  for (auto& label : labels) {
    label.x = static_cast<int>(scale * label.x);
    label.y = static_cast<int>(scale * label.y);
    label.size = static_cast<int>(scale * label.size);
  }
  return encode_labelled(name, canvas.image(), labels);
}

}  // namespace gpu_shading::energyplus

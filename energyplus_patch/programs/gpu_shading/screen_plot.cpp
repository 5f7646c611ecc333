#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include "gpu_shading/image.h"
#include "platform/text.h"
#include "programs/gpu_shading/screen_files.h"

namespace gpu_shading::energyplus {
namespace {

// Pixels.
constexpr double width = 760.0;
constexpr double height = 696.0;
constexpr glm::dvec2 centre{330.0, 370.0};
constexpr double radius = 240.0;

// Degrees. Cells are centred on directions of the CSV table.
constexpr int theta_step = 2;
constexpr int last_theta = 88;
constexpr int phi_step = 5;
constexpr double right_angle = 90.0;
constexpr int circle = 360;

glm::dvec2 place(double theta, double phi) {
  double const distance = radius * theta / right_angle;
  // v points up, and the y axis of SVG down.
  return {centre.x + distance * std::cos(glm::radians(phi)),
          centre.y - distance * std::sin(glm::radians(phi))};
}

std::string colour_of(double fraction) {
  auto const colour = fraction_colour(fraction);
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(colour.r), std::lround(colour.g),
                     std::lround(colour.b));
}

std::string cell(double low, double high, double from, double to, std::string const& colour) {
  auto const a = place(low, from);
  auto const b = place(low, to);
  auto const c = place(high, to);
  auto const d = place(high, from);
  double const inner = radius * low / right_angle;
  double const outer = radius * high / right_angle;
  return fmt::format(
      "<path fill=\"{}\" d=\"M{:.2f} {:.2f}A{:.2f} {:.2f} 0 0 0 {:.2f} {:.2f}L{:.2f} {:.2f}"
      "A{:.2f} {:.2f} 0 0 1 {:.2f} {:.2f}Z\"/>\n",
      colour, a.x, a.y, inner, inner, b.x, b.y, c.x, c.y, outer, outer, d.x, d.y);
}

std::string disc(double theta, std::string const& attributes) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:.2f}\" {}/>\n", centre.x, centre.y,
                     radius * theta / right_angle, attributes);
}

void write_cells(PerforatedScreen const& screen, double top_of_scale, std::ostream& svg) {
  auto const none = colour_of(0.0);
  svg << "<g shape-rendering=\"crispEdges\">\n"
      << disc(right_angle, fmt::format("fill=\"{}\"", none));
  for (int theta = theta_step; theta <= last_theta; theta += theta_step) {
    for (int phi = 0; phi < circle; phi += phi_step) {
      auto const colour = colour_of(transmittance(screen, theta, phi) / top_of_scale);
      if (colour == none) continue;
      double const high = theta == last_theta ? right_angle : theta + theta_step / 2.0;
      svg << cell(theta - theta_step / 2.0, high, phi - phi_step / 2.0, phi + phi_step / 2.0,
                  colour);
    }
  }
  svg << disc(theta_step / 2.0,
              fmt::format("fill=\"{}\"", colour_of(transmittance(screen, 0.0, 0.0) / top_of_scale)))
      << "</g>\n";
}

std::string label(double x, double y, std::string_view anchor, std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     text);
}

void write_axes(std::ostream& svg) {
  constexpr int ring = 30;
  constexpr int spoke = 45;
  constexpr double middle_of_text = 5.0;
  svg << "<g fill=\"none\" stroke=\"#ffffff\" stroke-opacity=\"0.7\">\n";
  for (int theta = ring; theta < right_angle; theta += ring) svg << disc(theta, "");
  for (int phi = 0; phi < circle / 2; phi += spoke) {
    auto const a = place(right_angle, phi);
    auto const b = place(right_angle, phi + circle / 2.0);
    svg << fmt::format("<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\"/>\n", a.x, a.y, b.x, b.y);
  }
  svg << "</g>\n" << disc(right_angle, "fill=\"none\" stroke=\"#333333\"");
  constexpr double beside_spokes = 67.5;
  svg << "<g stroke=\"#000000\" stroke-width=\"3\" paint-order=\"stroke\" fill=\"#ffffff\">\n";
  for (int theta = ring; theta <= right_angle; theta += ring) {
    auto const at = place(theta, beside_spokes);
    svg << label(at.x, at.y + middle_of_text, "middle", fmt::format("{}\u00b0", theta));
  }
  svg << "</g>\n";
  constexpr double outside = 97.0;
  for (int phi = 0; phi < circle; phi += spoke) {
    auto const at = place(outside, phi);
    auto const* const anchor = phi % 180 == 90 ? "middle" : phi < 90 || phi > 270 ? "start" : "end";
    auto const* const axis = phi == 0 ? " (u)" : phi == 90 ? " (v)" : "";
    svg << label(at.x, at.y + middle_of_text, anchor, fmt::format("{}\u00b0{}", phi, axis));
  }
}

void write_scale(double top_of_scale, std::ostream& svg) {
  constexpr double x = 655.0;
  constexpr double bar = 22.0;
  constexpr int stops = 16;
  constexpr int ticks = 4;
  double const top = centre.y - radius;
  svg << "<defs><linearGradient id=\"scale\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">\n";
  for (int i = 0; i <= stops; ++i) {
    double const fraction = static_cast<double>(i) / stops;
    svg << fmt::format("<stop offset=\"{:.4f}\" stop-color=\"{}\"/>\n", fraction,
                       colour_of(fraction));
  }
  svg << fmt::format(
      "</linearGradient></defs>\n<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
      "fill=\"url(#scale)\" stroke=\"#333333\"/>\n",
      x, top, bar, 2.0 * radius);
  svg << label(x + bar / 2.0, top - 14.0, "middle", "tau");
  for (int i = 0; i <= ticks; ++i) {
    double const fraction = static_cast<double>(i) / ticks;
    double const y = top + 2.0 * radius * (1.0 - fraction);
    svg << fmt::format("<path stroke=\"#333333\" d=\"M{} {}h5\"/>\n", x + bar, y)
        << label(x + bar + 9.0, y + 5.0, "start", fmt::format("{:.3f}", top_of_scale * fraction));
  }
}

}  // namespace

void write_polar_plot(PerforatedScreen const& screen, std::string const& title,
                      std::string const& subtitle, std::ostream& svg) {
  double const open = screen.open_fraction();
  double const top_of_scale = open > 0.0 ? open : 1.0;
  auto const name = markup_text(title);
  svg << fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" aria-labelledby=\"title about\" font-family=\"sans-serif\" "
      "font-size=\"15\" fill=\"#111111\">\n"
      "<title id=\"title\">Transmittance of {2}</title>\n"
      "<desc id=\"about\">Polar plot of the fraction of the beam that passes, by angle of "
      "incidence and azimuth. {3}</desc>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, name, markup_text(subtitle));
  svg << "<g font-size=\"20\" font-weight=\"bold\">" << label(24.0, 36.0, "start", name) << "</g>\n"
      << "<g font-size=\"13\">" << label(24.0, 60.0, "start", markup_text(subtitle)) << "</g>\n";
  write_cells(screen, top_of_scale, svg);
  write_axes(svg);
  write_scale(top_of_scale, svg);
  svg << "<g font-size=\"13\">"
      << label(24.0, height - 35.0, "start", "tau: fraction of the beam that passes.")
      << label(24.0, height - 16.0, "start",
               "Radius: angle of incidence. Around: azimuth from u to v, seen from outside.")
      << "</g>\n"
      << "</svg>\n";
}

}  // namespace gpu_shading::energyplus

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "python/guard.h"

namespace gpu_shading::python {
namespace {

template <typename Make>
int make_transmittance(FilterObject** made, Make const& make) {
  return guarded([&] {
    *made = new FilterObject{AngularTransmittance{std::make_shared<Transmittance const>(make())}};
  });
}

Sheet sheet_of(SheetRecord const& record) {
  Sheet sheet;
  sheet.thickness = record.thickness;
  sheet.plane = enumerator(record.plane, SheetPlane::inside, "plane");
  if (record.layers != 0) sheet.layers = record.layers;
  sheet.detail = enumerator(record.detail, ScreenDetail::effective, "detail");
  return sheet;
}

double tau_of_pattern(HolePattern const& pattern, double thickness, double theta, double phi) {
  double const shift = thickness * std::tan(std::clamp(theta, 0.0, std::numbers::pi / 2.0));
  if (!(shift < pattern.longest_chord())) return shift > 0.0 ? 0.0 : pattern.open_fraction();
  return pattern.transmittance(shift * std::cos(phi), shift * std::sin(phi));
}

}  // namespace

GPU_SHADING_CALL int gpu_shading_transmittance_constant(double value, FilterObject** made) {
  return make_transmittance(made, [&] { return Transmittance::constant(value); });
}

GPU_SHADING_CALL int gpu_shading_transmittance_polynomial(double const* coefficients,
                                                          std::size_t count, int in_cosine,
                                                          FilterObject** made) {
  return make_transmittance(made, [&] {
    std::vector<double> values(coefficients, coefficients + count);
    return in_cosine != 0 ? Transmittance::polynomial_in_cosine(std::move(values))
                          : Transmittance::polynomial_in_degrees(std::move(values));
  });
}

// Angles in degrees.
GPU_SHADING_CALL int gpu_shading_transmittance_table(double const* angles, double const* values,
                                                     std::size_t count, FilterObject** made) {
  return make_transmittance(made, [&] {
    return Transmittance::table({angles, angles + count}, {values, values + count});
  });
}

// Layers: transmittance, front and back reflectance of each.
GPU_SHADING_CALL int gpu_shading_transmittance_glazing(double const* layers, std::size_t count,
                                                       FilterObject** made) {
  return make_transmittance(made, [&] {
    std::vector<GlassLayer> panes;
    for (std::size_t i = 0; i < count; ++i) {
      panes.push_back({layers[3 * i], layers[3 * i + 1], layers[3 * i + 2]});
    }
    return Transmittance::glazing(panes);
  });
}

GPU_SHADING_CALL int gpu_shading_transmittance_simple_glazing(double u_factor, double shgc,
                                                              FilterObject** made) {
  return make_transmittance(made, [&] {
    return Transmittance::glazing(SimpleGlazing{u_factor, shgc});
  });
}

GPU_SHADING_CALL int gpu_shading_transmittance_at(FilterObject const* object, double const* angles,
                                                  std::size_t count, double* results) {
  return guarded([&] {
    std::transform(angles, angles + count, results,
                   *std::get<AngularTransmittance>(object->factor).model);
  });
}

GPU_SHADING_CALL void gpu_shading_filter_release(FilterObject* object) { release(object); }

// Lengths: size, length, pitch, row pitch.
GPU_SHADING_CALL int gpu_shading_screen_pattern(int hole, int arrangement, double const* lengths,
                                                SheetRecord const* sheet, ScreenObject** made) {
  return guarded([&] {
    Perforation const perforation{enumerator(hole, Hole::Hexagonal, "hole"),
                                  enumerator(arrangement, Arrangement::Staggered60, "arrangement"),
                                  lengths[0],
                                  lengths[1],
                                  lengths[2],
                                  lengths[3]};
    *made = new ScreenObject{
        std::make_shared<PerforatedScreen const>(HolePattern(perforation), sheet_of(*sheet))};
  });
}

// Opacity: rows x columns of 0 .. 65535; a threshold that is not a number: none.
GPU_SHADING_CALL int gpu_shading_screen_tile(double width, double height, int columns, int rows,
                                             std::uint16_t const* opacity, double threshold,
                                             SheetRecord const* sheet, ScreenObject** made) {
  return guarded([&] {
    auto const texels = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    std::optional<double> const limit =
        std::isnan(threshold) ? std::nullopt : std::optional(threshold);
    OpacityTile tile(width, height, columns, rows,
                     std::vector<std::uint16_t>(opacity, opacity + texels), limit);
    *made = new ScreenObject{
        std::make_shared<PerforatedScreen const>(std::move(tile), sheet_of(*sheet))};
  });
}

// Open fraction, size of a hole, width of a web.
GPU_SHADING_CALL int gpu_shading_screen_sizes(ScreenObject const* object, double* sizes) {
  return guarded([&] {
    auto const& screen = *object->screen;
    sizes[0] = screen.open_fraction();
    sizes[1] = screen.hole();
    sizes[2] = screen.web();
  });
}

// Patterns in closed form, tiles by ScreenTransmittance.
GPU_SHADING_CALL int gpu_shading_screen_tau(ScreenObject const* object, double const* thetas,
                                            double const* phis, std::size_t count,
                                            double* results) {
  return guarded([&] {
    auto const& screen = *object->screen;
    for (std::size_t i = 0; i < count; ++i) {
      results[i] = screen.pattern() ? tau_of_pattern(*screen.pattern(), screen.sheet().thickness,
                                                     thetas[i], phis[i])
                                    : screen.transmittance()(thetas[i], phis[i]);
    }
  });
}

GPU_SHADING_CALL void gpu_shading_screen_release(ScreenObject* object) { release(object); }

}  // namespace gpu_shading::python

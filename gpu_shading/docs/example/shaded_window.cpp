// Sunlit fractions of a window below an opaque overhang, and behind a transparent shade; what the
// shade lets pass of a single ray.
//
//   shaded_window AZIMUTH ALTITUDE    of the sun, in degrees

#include <gpu_shading/rays.h>
#include <gpu_shading/renderer.h>
#include <gpu_shading/transmittance.h>

#include <cstdlib>
#include <exception>
#include <glm/geometric.hpp>
#include <iostream>
#include <memory>
#include <numbers>

namespace {

using namespace gpu_shading;

// x east, y north, z up, in metres; counterclockwise as seen from outside, which is south.
Polygon const window{{{0, 0, 1}, {2, 0, 1}, {2, 0, 2}, {0, 0, 2}}, {}};
Polygon const overhang{{{-9, -0.5, 2}, {11, -0.5, 2}, {11, 0, 2}, {-9, 0, 2}}, {}};
Polygon const pane{{{-9, -0.5, 0}, {11, -0.5, 0}, {11, -0.5, 3}, {-9, -0.5, 3}}, {}};

// The fraction of the window that `caster` leaves sunlit.
double sunlit_fraction(Surface const& caster, SunDirection sun) {
  Scene scene;
  SurfaceId const receiver = scene.add({"window", window});
  scene.add(caster);
  Renderer renderer(scene, {});  // on the first GPU, otherwise on the CPU
  double const lit = renderer.projected_sunlit_areas(sun, {&receiver, 1}).front().projected_area;
  double const projected = area(window) * glm::dot(normal(window), to_vector(sun));
  return projected > 0.0 ? lit / projected : 0.0;
}

// The fraction of a ray from the window's middle to the sun that `caster` lets pass.
double transmittance_of_ray(Surface const& caster, SunDirection sun) {
  Scene scene;
  scene.add(caster);
  RayScene const rays(scene);
  return rays.transmittance({{1, 0, 1.5}, to_vector(sun)});
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 3) throw std::runtime_error("expected the sun's azimuth and altitude in degrees");
  constexpr double degree = std::numbers::pi / 180.0;
  SunDirection const sun{std::atof(arguments[1]) * degree, std::atof(arguments[2]) * degree};
  // 0.7 at normal incidence, 0 at grazing incidence.
  auto const glass =
      std::make_shared<Transmittance const>(Transmittance::polynomial_in_cosine({0.0, 1.1, -0.4}));
  Surface shade{"pane", pane};
  shade.filter.set(AngularTransmittance{glass});
  std::cout << "overhang " << sunlit_fraction({"overhang", overhang}, sun) << '\n'
            << "glass " << sunlit_fraction(shade, sun) << '\n'
            << "ray " << transmittance_of_ray(shade, sun) << '\n';
  return EXIT_SUCCESS;
} catch (std::exception const& error) {
  std::cerr << "shaded_window: " << error.what() << '\n';
  return EXIT_FAILURE;
}

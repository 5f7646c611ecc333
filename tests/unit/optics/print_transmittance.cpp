// Prints tau at 0, 1, .. 90 degrees. Arguments: "simple U SHGC", or
// "layers T Rf Rb [T Rf Rb ..]" from the pane towards the sun.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "gpu_shading/transmittance.h"

namespace {

using gpu_shading::Transmittance;

Transmittance model(std::vector<std::string> const& arguments) {
  auto const number = [&](std::size_t i) { return std::stod(arguments.at(i)); };
  if (arguments.at(0) == "simple") {
    return Transmittance::glazing(gpu_shading::SimpleGlazing{number(1), number(2)});
  }
  std::vector<gpu_shading::GlassLayer> layers;
  for (std::size_t i = 1; i < arguments.size(); i += 3) {
    layers.push_back({number(i), number(i + 1), number(i + 2)});
  }
  return Transmittance::glazing(layers);
}

}  // namespace

int main(int count, char** values) try {
  Transmittance const tau = model({values + 1, values + count});
  for (int angle = 0; angle <= 90; ++angle) {
    std::printf("%d %.9f\n", angle, tau(angle * std::numbers::pi / 180.0));
  }
  return EXIT_SUCCESS;
} catch (std::exception const& error) {
  std::fprintf(stderr, "print_transmittance: %s\n", error.what());
  return EXIT_FAILURE;
}

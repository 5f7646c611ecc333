#include "routes/penumbra/drop_in/penumbra_implementation.h"

#include <numeric>
#include <string>

#include "routes/penumbra/drop_in/surface_content.h"

namespace Penumbra {

PenumbraImplementation::PenumbraImplementation(unsigned int pixels,
                                               std::shared_ptr<Courierr::Courierr> to)
    : size(pixels), logger(std::move(to)) {
  renew();
}

void PenumbraImplementation::renew() {
  names.clear();
  started = false;
  calculation = guarded([this] {
    return std::make_unique<gpu_shading::answers::Calculation>(
        size, gpu_shading::answers::Log{[this](const std::string& line) { logger->warning(line); },
                                        [this](const std::string& line) { logger->info(line); }});
  });
}

unsigned int PenumbraImplementation::add(Surface const& surface) {
  auto content = surface.content->surface;
  if (content.name.empty()) content.name = "Surface " + std::to_string(names.size());
  names.push_back(content.name);
  return guarded([&] { return calculation->add(std::move(content)); });
}

void PenumbraImplementation::set_model() {
  if (names.empty()) {
    logger->warning("There are no surfaces: add_surface() must come before set_model().");
    return;
  }
  guarded([this] {
    calculation->start({simulation.latitude, simulation.schedule, simulation.schedule_range,
                        simulation.schedule_value, simulation.initialization});
    calculation->set_sun(azimuth, altitude);
  });
  started = true;
}

void PenumbraImplementation::check(std::vector<unsigned int> const& surfaces,
                                   std::string_view what) const {
  for (auto const surface : surfaces) {
    if (surface >= names.size()) throw SurfaceException(surface, what, *logger);
  }
}

std::vector<unsigned int> PenumbraImplementation::all() const {
  std::vector<unsigned int> surfaces(names.size());
  std::iota(surfaces.begin(), surfaces.end(), 0u);
  return surfaces;
}

}  // namespace Penumbra

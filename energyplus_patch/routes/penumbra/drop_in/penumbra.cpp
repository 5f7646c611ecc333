#include <penumbra/penumbra.h>

#include <string>
#include <utility>

#include "routes/penumbra/drop_in/penumbra_implementation.h"

namespace Penumbra {
namespace {

constexpr unsigned int default_size = 512;

VendorType vendor_of(std::string const& name) {
  const std::pair<char const*, VendorType> vendors[] = {{"NVIDIA", VendorType::nvidia},
                                                        {"AMD", VendorType::amd},
                                                        {"Advanced Micro Devices", VendorType::amd},
                                                        {"ATI", VendorType::amd},
                                                        {"Intel", VendorType::intel},
                                                        {"INTEL", VendorType::intel},
                                                        {"VMware", VendorType::vmware},
                                                        {"Mesa", VendorType::mesa}};
  for (auto const& [beginning, vendor] : vendors) {
    if (name.rfind(beginning, 0) == 0) return vendor;
  }
  return VendorType::unknown;
}

std::string area_line(std::string const& surface, float area) {
  return surface + ": " + std::to_string(area) + " m2 normal to the beam are sunlit";
}

}  // namespace

Penumbra::Penumbra(unsigned int size, std::shared_ptr<Courierr::Courierr> const& logger)
    : penumbra(std::make_unique<PenumbraImplementation>(size, logger)) {}

Penumbra::Penumbra(std::shared_ptr<Courierr::Courierr> const& logger)
    : Penumbra(default_size, logger) {}

Penumbra::~Penumbra() = default;

bool Penumbra::is_valid_context() { return true; }

unsigned int Penumbra::add_surface(Surface const& surface) { return penumbra->add(surface); }

unsigned int Penumbra::get_number_of_surfaces() {
  return static_cast<unsigned int>(penumbra->names.size());
}

void Penumbra::set_model() { penumbra->set_model(); }

void Penumbra::clear_model() { penumbra->renew(); }

void Penumbra::set_sun_position(float azimuth, float altitude) {
  penumbra->azimuth = azimuth;
  penumbra->altitude = altitude;
  if (!penumbra->started) return;
  penumbra->guarded([&] { penumbra->calculation->set_sun(azimuth, altitude); });
}

float Penumbra::get_sun_azimuth() { return penumbra->azimuth; }

float Penumbra::get_sun_altitude() { return penumbra->altitude; }

void Penumbra::submit_pssa(unsigned int surface_index) { penumbra->check({surface_index}); }

void Penumbra::submit_pssa(std::vector<unsigned int> const& surface_indices) {
  penumbra->check(surface_indices);
}

void Penumbra::submit_pssa() {}

float Penumbra::retrieve_pssa(unsigned int surface_index) {
  penumbra->check({surface_index});
  return penumbra->guarded([&] { return penumbra->calculation->sunlit_area(surface_index); });
}

std::vector<float> Penumbra::retrieve_pssa(std::vector<unsigned int> const& surface_indices) {
  penumbra->check(surface_indices);
  return penumbra->guarded([&] { return penumbra->calculation->sunlit_areas(surface_indices); });
}

std::vector<float> Penumbra::retrieve_pssa() { return retrieve_pssa(penumbra->all()); }

float Penumbra::calculate_pssa(unsigned int surface_index) { return retrieve_pssa(surface_index); }

std::vector<float> Penumbra::calculate_pssa(std::vector<unsigned int> const& surface_indices) {
  return retrieve_pssa(surface_indices);
}

std::vector<float> Penumbra::calculate_pssa() { return retrieve_pssa(); }

std::unordered_map<unsigned int, float> Penumbra::calculate_interior_pssas(
    std::vector<unsigned int> const& transparent_surface_indices,
    std::vector<unsigned int> const& interior_surface_indices) {
  if (transparent_surface_indices.empty()) {
    throw PenumbraException("Interior areas need at least one transparent surface.",
                            *penumbra->logger);
  }
  penumbra->check(transparent_surface_indices, "Transparent surface");
  penumbra->check(interior_surface_indices, "Interior surface");
  std::unordered_map<unsigned int, float> areas;
  for (auto const window : transparent_surface_indices) {
    auto const lit = penumbra->guarded(
        [&] { return penumbra->calculation->interior_areas(window, interior_surface_indices); });
    for (std::size_t i = 0; i < lit.size(); ++i) areas[interior_surface_indices[i]] += lit[i];
  }
  return areas;
}

void Penumbra::render_scene(unsigned int surface_index) {
  penumbra->check({surface_index});
  float const area = retrieve_pssa(surface_index);
  penumbra->logger->info(area_line(penumbra->names[surface_index], area));
}

void Penumbra::render_interior_scene(std::vector<unsigned int> const& transparent_surface_indices,
                                     std::vector<unsigned int> const& interior_surface_indices) {
  for (auto const& [surface, area] :
       calculate_interior_pssas(transparent_surface_indices, interior_surface_indices)) {
    penumbra->logger->info(area_line(penumbra->names[surface], area));
  }
}

VendorType Penumbra::get_vendor_name() {
  return vendor_of(penumbra->guarded([&] { return penumbra->calculation->vendor(); }));
}

std::shared_ptr<Courierr::Courierr> Penumbra::get_logger() { return penumbra->logger; }

void Penumbra::set_simulation(Simulation simulation) {
  penumbra->simulation = std::move(simulation);
}

int Penumbra::add_mirrored_surface(unsigned int original_index) {
  penumbra->check({original_index});
  int const index =
      penumbra->guarded([&] { return penumbra->calculation->add_mirrored(original_index); });
  if (index >= 0) penumbra->names.push_back("Mir-" + penumbra->names[original_index]);
  return index;
}

void Penumbra::set_time(int hour, int timestep) {
  penumbra->guarded([&] { penumbra->calculation->set_time(hour, timestep); });
}

double Penumbra::ray_transmittance(std::array<double, 3> const& origin,
                                   std::array<double, 3> const& direction, int hour) {
  return penumbra->guarded([&] {
    return penumbra->calculation->ray_transmittance({origin, direction, hour});
  });
}

void Penumbra::begin_daylighting() {
  penumbra->guarded([&] { penumbra->calculation->begin_daylighting(); });
}

void Penumbra::finish() {
  try {
    penumbra->calculation->finish();
  } catch (std::exception const& error) {
    penumbra->logger->warning(error.what());
  }
}

}  // namespace Penumbra

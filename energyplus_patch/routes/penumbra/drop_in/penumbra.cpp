#include <gpu_shading_answers.h>
#include <penumbra/penumbra.h>
#include <penumbra/simulation.h>
#include <penumbra/surface.h>

#include <exception>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Penumbra {

namespace answers = gpu_shading::answers;

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

struct SurfaceContent {
  answers::PlainSurface surface;
};

Surface::Surface() : content(std::make_shared<SurfaceContent>()) {}

Surface::Surface(Polygon const& polygon, std::string const& name)
    : content(std::make_shared<SurfaceContent>(SurfaceContent{{name, polygon, {}}})) {}

Surface::Surface(Surface const& surface) = default;

Surface& Surface::operator=(Surface const& surface) = default;

Surface::~Surface() = default;

void Surface::add_hole(Polygon const& hole) { content->surface.holes.push_back(hole); }

class PenumbraImplementation {
 public:
  PenumbraImplementation(unsigned int size, std::shared_ptr<Courierr::Courierr> logger);

  // Calls `action`; an exception of gpu_shading becomes one of Penumbra's.
  template <typename Action>
  auto guarded(Action const& action) -> decltype(action()) {
    try {
      return action();
    } catch (PenumbraException const&) {
      throw;
    } catch (std::exception const& error) {
      throw PenumbraException(error.what(), *logger);
    }
  }

  void renew();  // without surfaces
  unsigned int add(Surface const& surface);
  void set_model();
  void check(std::vector<unsigned int> const& surfaces, std::string_view what = "Surface") const;
  std::vector<unsigned int> all() const;

  unsigned int size;
  std::shared_ptr<Courierr::Courierr> logger;
  std::unique_ptr<answers::Calculation> calculation;
  Simulation simulation;
  std::vector<std::string> names;  // of surfaces
  bool started = false;            // set_model() was called
  float azimuth = 0.0f;
  float altitude = 0.0f;
};

PenumbraImplementation::PenumbraImplementation(unsigned int pixels,
                                               std::shared_ptr<Courierr::Courierr> to)
    : size(pixels), logger(std::move(to)) {
  renew();
}

void PenumbraImplementation::renew() {
  names.clear();
  started = false;
  calculation = guarded([this] {
    return std::make_unique<answers::Calculation>(
        size, answers::Log{[this](const std::string& line) { logger->warning(line); },
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

std::vector<std::string> take_options(std::vector<std::string> const& arguments) {
  return answers::take_options(arguments);
}

std::string options_help() { return answers::options_help(); }

bool is_wanted() { return answers::is_wanted(); }

std::string read_idf(std::string const& text, std::string const& path, std::string const& version) {
  return answers::read_model(text, answers::Format::idf, path, version);
}

std::string read_epjson(std::string const& text, std::string const& path,
                        std::string const& version) {
  return answers::read_model(text, answers::Format::epjson, path, version);
}

}  // namespace Penumbra

#include "gpu_shading/sampled_sunlit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gpu_shading/sun_position.h"
#include "solar/azimuth_splines.h"
#include "solar/sunlit_splines.h"

namespace gpu_shading {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

double azimuth_step(Sampling::Density density) {
  switch (density) {
    case Sampling::Density::fine:
      return 10.0 * degree;
    case Sampling::Density::coarse:
      return 20.0 * degree;
    case Sampling::Density::medium:
      break;
  }
  return 15.0 * degree;
}

void sample(std::vector<HourDirection> const& wanted, double latitude, SunlitSource const& source,
            SunlitTable& table) {
  if (wanted.empty()) return;
  std::vector<SunDirection> directions;
  directions.reserve(wanted.size());
  for (auto const direction : wanted) directions.push_back(to_direction(direction, latitude));
  table.add(directions, source(directions));
}

void sample_paper_grid(Sampling::Density density, double latitude, SunlitSource const& source,
                       SunlitTable& table) {
  for (auto const& day : sample_azimuths(latitude, azimuth_step(density))) {
    sample(day.directions, latitude, source, table);
  }
}

void sample_arcs(std::size_t most, double latitude, SunlitSource const& source,
                 SunlitTable& table) {
  constexpr std::size_t rounds = 3;
  sample(spread_on_arcs(latitude, most * 6 / 10), latitude, source, table);
  for (std::size_t left = rounds; left > 0; --left) {
    std::size_t const count = (most - table.directions().size()) / left;
    auto const misses = SunlitSplines(table).misses(table);
    sample(where_samples_disagree(table, misses, latitude, count), latitude, source, table);
  }
}

}  // namespace

std::size_t most_directions(Sampling::Density density) {
  switch (density) {
    case Sampling::Density::fine:
      return 480;
    case Sampling::Density::coarse:
      return 238;
    case Sampling::Density::medium:
      break;
  }
  return 320;
}

class SampledSunlit::Implementation {
 public:
  Implementation(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers,
                 SunlitSource const& source)
      : sampling_(sampling), latitude_(latitude), table_(std::move(receivers)) {
    if (sampling.paper_grid) {
      sample_paper_grid(sampling.density, latitude, source, table_);
    } else {
      sample_arcs(most_directions(sampling.density), latitude, source, table_);
    }
    interpolate();
  }

  Implementation(Implementation const& other, std::vector<glm::dvec3> receivers,
                 SunlitSource const& source)
      : sampling_(other.sampling_), latitude_(other.latitude_), table_(std::move(receivers)) {
    auto const& directions = other.table_.directions();
    table_.add(directions, source(directions));
    interpolate();
  }

  SunlitTable const& table() const { return table_; }

  std::vector<Sunlit> at(SunDirection direction) const {
    return table_.compose(splines_->at(direction), to_vector(direction));
  }

 private:
  void interpolate() {
    if (sampling_.paper_grid) {
      double const step = azimuth_step(sampling_.density);
      splines_ = std::make_unique<AzimuthSplines>(table_, sample_azimuths(latitude_, step),
                                                  latitude_, step);
    } else {
      splines_ = std::make_unique<SunlitSplines>(table_);
    }
  }

  Sampling sampling_;
  double latitude_;
  SunlitTable table_;
  std::unique_ptr<Interpolant> splines_;
};

SampledSunlit::SampledSunlit(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
SampledSunlit::SampledSunlit(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers,
                             SunlitSource const& source)
    : implementation_(
          std::make_unique<Implementation>(sampling, latitude, std::move(receivers), source)) {}
SampledSunlit::~SampledSunlit() = default;
SampledSunlit::SampledSunlit(SampledSunlit&&) noexcept = default;
SampledSunlit& SampledSunlit::operator=(SampledSunlit&&) noexcept = default;

SampledSunlit SampledSunlit::with(std::vector<glm::dvec3> receivers,
                                  SunlitSource const& source) const {
  return SampledSunlit(
      std::make_unique<Implementation>(*implementation_, std::move(receivers), source));
}

std::vector<Sunlit> SampledSunlit::at(SunDirection direction) const {
  return implementation_->at(direction);
}

bool SampledSunlit::knows(std::size_t receiver) const {
  auto const& lit = implementation_->table().lit(receiver);
  return std::find(lit.begin(), lit.end(), true) != lit.end();
}

std::vector<SunDirection> const& SampledSunlit::directions() const {
  return implementation_->table().directions();
}

bool in_suns_range(SunDirection direction, double latitude) {
  constexpr double margin = 0.1 * degree;
  double const declination = to_hour_direction(direction, latitude).declination;
  return direction.altitude >= 0.0 && std::abs(declination) <= most_declination + margin;
}

}  // namespace gpu_shading

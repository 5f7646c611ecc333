#include "gpu_shading/sampled_sunlit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu_shading/sun_position.h"
#include "sun/sampling/azimuth_splines.h"
#include "sun/sampling/disagreement.h"
#include "sun/sampling/sunlit_splines.h"

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

std::vector<SunDirection> directions_at(std::vector<HourDirection> const& wanted, double latitude) {
  std::vector<SunDirection> directions;
  directions.reserve(wanted.size());
  for (auto const direction : wanted) directions.push_back(to_direction(direction, latitude));
  return directions;
}

std::vector<HourDirection> papers_grid(Sampling::Density density, double latitude) {
  std::vector<HourDirection> directions;
  for (auto const& day : sample_azimuths(latitude, azimuth_step(density))) {
    directions.insert(directions.end(), day.directions.begin(), day.directions.end());
  }
  return directions;
}

}  // namespace

std::size_t usual_directions(Sampling::Density density) {
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

std::size_t max_directions(Sampling::Density density) { return usual_directions(density) * 2; }

double error_goal(Sampling::Density density) {
  constexpr double of_medium = 4e-3;
  auto const medium = static_cast<double>(usual_directions(Sampling::Density::medium));
  return of_medium * medium / static_cast<double>(usual_directions(density));
}

class SampleRounds::Implementation {
 public:
  Implementation(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers)
      : sampling_(sampling), latitude_(latitude), table_(std::move(receivers)) {
    if (sampling.paper_grid) {
      directions_ = directions_at(papers_grid(sampling.density, latitude), latitude);
    } else {
      std::size_t const max_count = usual_directions(sampling.density) * 6 / 10;
      directions_ = directions_at(spread_on_arcs(latitude, max_count), latitude);
    }
    if (directions_.empty()) refine();
  }

  Sampling sampling() const { return sampling_; }
  double latitude() const { return latitude_; }
  SunlitTable& table() { return table_; }
  std::vector<double>& expected_errors() { return expected_errors_; }
  std::vector<SunDirection> const& directions() const { return directions_; }

  void add(std::vector<std::vector<Sunlit>> const& answers) {
    table_.add(directions_, answers);
    directions_.clear();
    refine();
  }

 private:
  void refine() {
    if (sampling_.paper_grid) return;
    while (directions_.empty() && start_round()) {
    }
  }

  // This round's share of the directions that are left. False after the last round, and once no
  // receiver is expected to be less accurate than the goal.
  bool start_round() {
    SunlitSplines const splines(table_, SunlitSplines::Purpose::refinement);
    Disagreement const disagreement(table_, splines, latitude_);
    expected_errors_ = disagreement.expected_errors();
    bool const usual = refined_ < usual_refinements;
    int const last = usual ? usual_refinements : usual_refinements + further_refinements;
    double const wanted = usual ? 0.0 : error_goal(sampling_.density);
    bool const needed =
        std::ranges::any_of(expected_errors_, [&](double error) { return error >= wanted; });
    if (refined_ == last || !needed) return false;
    ++refined_;
    auto const max_count =
        usual ? usual_directions(sampling_.density) : max_directions(sampling_.density);
    auto const count =
        (max_count - table_.directions().size()) / static_cast<std::size_t>(last - refined_ + 1);
    directions_ = directions_at(disagreement.further_directions(count, wanted), latitude_);
    return true;
  }

  static constexpr int usual_refinements = 4;
  static constexpr int further_refinements = 5;

  Sampling sampling_;
  double latitude_;
  SunlitTable table_;
  int refined_ = 0;
  std::vector<double> expected_errors_;
  std::vector<SunDirection> directions_;
};

SampleRounds::SampleRounds(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers)
    : implementation_(std::make_unique<Implementation>(sampling, latitude, std::move(receivers))) {}
SampleRounds::~SampleRounds() = default;
SampleRounds::SampleRounds(SampleRounds&&) noexcept = default;
SampleRounds& SampleRounds::operator=(SampleRounds&&) noexcept = default;

std::vector<SunDirection> const& SampleRounds::directions() const {
  return implementation_->directions();
}

void SampleRounds::add(std::vector<std::vector<Sunlit>> const& answers) {
  implementation_->add(answers);
}

class SampledSunlit::Implementation {
 public:
  Implementation(Sampling sampling, double latitude, SunlitTable table,
                 std::vector<double> expected_errors)
      : sampling_(sampling),
        latitude_(latitude),
        table_(std::move(table)),
        expected_errors_(std::move(expected_errors)) {
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
  std::vector<double> const& expected_errors() const { return expected_errors_; }

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
      splines_ = std::make_unique<SunlitSplines>(table_, SunlitSplines::Purpose::answers);
    }
  }

  Sampling sampling_;
  double latitude_;
  SunlitTable table_;
  std::vector<double> expected_errors_;
  std::unique_ptr<Interpolant> splines_;
};

SampledSunlit::SampledSunlit(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
SampledSunlit::SampledSunlit(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers,
                             SunlitSource const& source)
    : SampledSunlit([&] {
        SampleRounds rounds(sampling, latitude, std::move(receivers));
        while (!rounds.directions().empty()) rounds.add(source(rounds.directions()));
        return rounds;
      }()) {}
SampledSunlit::SampledSunlit(SampleRounds rounds) {
  auto& of = *rounds.implementation_;
  implementation_ = std::make_unique<Implementation>(
      of.sampling(), of.latitude(), std::move(of.table()), std::move(of.expected_errors()));
}
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
  return std::ranges::find(lit, true) != lit.end();
}

std::vector<SunDirection> const& SampledSunlit::directions() const {
  return implementation_->table().directions();
}

std::vector<SampledFractions> const& SampledSunlit::fractions() const {
  return implementation_->table().columns();
}

std::vector<bool> const& SampledSunlit::lit(std::size_t receiver) const {
  return implementation_->table().lit(receiver);
}

std::vector<double> const& SampledSunlit::expected_errors() const {
  return implementation_->expected_errors();
}

bool in_suns_range(SunDirection direction, double latitude) {
  constexpr double margin = 0.1 * degree;
  double const declination = to_hour_direction(direction, latitude).declination;
  return direction.altitude >= 0.0 && std::abs(declination) <= max_declination + margin;
}

}  // namespace gpu_shading

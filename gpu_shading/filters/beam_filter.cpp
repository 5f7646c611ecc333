#include "gpu_shading/beam_filter.h"

#include <utility>

#include "filters/crown/crown_filter.h"
#include "filters/perforation/perforation_filter.h"
#include "filters/transmittance/transmittance_filter.h"

// Every kind has add_values(); a flat one has factor_at(), others have faces_of() and look_of().
namespace gpu_shading {
namespace {

template <typename Kind>
concept Flat = Kind::is_flat;

BeamFilter::Faces faces_of(Flat auto const& /*kind*/) { return {}; }

bool flat(FilterFactor const& factor) {
  return std::visit([](auto const& kind) { return kind.is_flat; }, factor);
}

}  // namespace

void BeamFilter::set(FilterFactor factor) {
  auto const same = [&](FilterFactor const& other) { return other.index() == factor.index(); };
  auto const found = std::find_if(factors.begin(), factors.end(), same);
  if (found != factors.end()) {
    *found = std::move(factor);
  } else {
    factors.push_back(std::move(factor));
  }
}

bool BeamFilter::is_flat() const {
  return schedule >= 0 || factors.empty() || std::any_of(factors.begin(), factors.end(), flat);
}

BeamFilter::Faces BeamFilter::faces() const {
  Faces all;
  for (FilterFactor const& factor : factors) {
    Faces const faces = std::visit([](auto const& kind) { return faces_of(kind); }, factor);
    all = {std::min(all.inside, faces.inside), std::max(all.outside, faces.outside),
           all.fills || faces.fills};
  }
  return all;
}

FilterLook BeamFilter::look() const {
  constexpr double unknown = 0.5;
  if (!transmits()) return {};
  FilterLook look{FilterLook::Kind::glass, factors.empty() ? unknown : flat_factor(1.0)};
  for (FilterFactor const& factor : factors) {
    std::visit(
        [&]<typename Kind>(Kind const& kind) {
          if constexpr (!Kind::is_flat) look = look_of(kind);
        },
        factor);
  }
  return look;
}

void BeamFilter::add_to(FilterDigest& digest) const {
  digest.add(static_cast<double>(schedule));
  digest.add(static_cast<double>(factors.size()));
  for (FilterFactor const& factor : factors) {
    digest.add(static_cast<double>(factor.index()));
    std::visit([&](auto const& kind) { add_values(digest, kind); }, factor);
  }
}

double BeamFilter::flat_factor(double cosine) const {
  double product = 1.0;
  for (FilterFactor const& factor : factors) {
    std::visit(
        [&]<typename Kind>(Kind const& kind) {
          if constexpr (Kind::is_flat) product *= factor_at(kind, cosine);
        },
        factor);
  }
  return product;
}

}  // namespace gpu_shading

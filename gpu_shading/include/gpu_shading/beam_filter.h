#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "gpu_shading/crown.h"
#include "gpu_shading/hole_pattern.h"
#include "gpu_shading/screen_placement.h"

namespace gpu_shading {

class PerforatedScreen;  // gpu_shading/perforated_screen.h
class Transmittance;     // gpu_shading/transmittance.h

// Kinds of filter. Each has a folder in filters/ with the functions that filters/beam_filter.cpp
// lists. A flat kind dims all of its surface alike, by one number for each direction.

// A flat sheet that transmits the beam straight through, equally through both faces. The angle of
// incidence is taken from the Newell normal of the surface's outline. Because the sun's rays are
// parallel, it is one number for each surface and direction; it is computed in double precision for
// surfaces in view, with no table between the model and the answer.
struct AngularTransmittance {
  static constexpr bool is_flat = true;
  std::shared_ptr<Transmittance const> model;
};

struct PerforatedSheet {
  static constexpr bool is_flat = false;
  std::shared_ptr<PerforatedScreen const> screen;
  ScreenPlacement placement = {};
  // Index of the deployed fraction of the sheet (Renderer::set_deployments); -1: always fully
  // deployed.
  int deployment = -1;
};

using FilterFactor = std::variant<AngularTransmittance, PerforatedSheet, Crown>;

// How a surface looks to people.
struct FilterLook {
  enum class Kind { opaque, glass, holes, foliage };

  Kind kind = Kind::opaque;
  double passes = 0.0;                              // of the beam at normal incidence, 0 .. 1
  std::optional<Perforation> holes = std::nullopt;  // of a pattern
};

// Receives everything that the answers of a filter depend on.
class FilterDigest {
 public:
  FilterDigest() = default;
  virtual ~FilterDigest() = default;
  FilterDigest(FilterDigest const&) = delete;
  FilterDigest& operator=(FilterDigest const&) = delete;
  FilterDigest(FilterDigest&&) = delete;
  FilterDigest& operator=(FilterDigest&&) = delete;

  virtual void add(double value) = 0;
  virtual void add(std::span<std::uint16_t const> values) = 0;
  // Values of an object that filters share: once for each object is enough.
  virtual void add_shared(void const* object,
                          std::function<void(FilterDigest&)> const& add_values) = 0;
};

// What a caster does to the beam: the product of factors of different kinds and of a schedule.
// Without any of them, it is opaque.
//
//     surface.filter.set(AngularTransmittance{glass});
//     surface.filter.schedule = 0;
struct BeamFilter {
  // Replaces the factor of the same kind.
  void set(FilterFactor factor);
  template <typename Kind>
  void remove() {
    std::erase_if(factors,
                  [](FilterFactor const& factor) { return std::holds_alternative<Kind>(factor); });
  }

  // nullptr if there is no factor of a kind.
  template <typename Kind>
  Kind const* find() const {
    auto const found = std::find_if(factors.begin(), factors.end(), [](FilterFactor const& factor) {
      return std::holds_alternative<Kind>(factor);
    });
    return found == factors.end() ? nullptr : &std::get<Kind>(*found);
  }

  bool transmits() const { return !factors.empty() || schedule >= 0; }
  // Whether it acts on its polygon as a whole, if only by stopping the beam.
  bool is_flat() const;

  // The product of the flat factors at a cosine of the angle of incidence, 0 .. 1.
  double flat_factor(double cosine) const;

  // Positions of the faces of a body, in metres along the polygon's normal; both 0 for a flat one.
  struct Faces {
    double inside = 0.0;
    double outside = 0.0;
    // It fills the space between, and a receiver's plane cuts through it. Other bodies are in front
    // of the plane where their polygon or the middle of them is.
    bool fills = false;
  };
  Faces faces() const;

  FilterLook look() const;
  void add_to(FilterDigest& digest) const;

  std::vector<FilterFactor> factors;
  // Index of a factor, 0 .. 1, that varies with time; -1: none. Surfaces may share one. Answers
  // store separately what passed each schedule (Sunlit), so they hold for any factors.
  int schedule = -1;
};

}  // namespace gpu_shading

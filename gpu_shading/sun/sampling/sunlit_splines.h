#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sun/sampling/radial_spline.h"
#include "sun/sampling/sunlit_table.h"

namespace gpu_shading {

// The position on a receiver's plane of the shadow of a point one metre in front of it: the
// distance along the plane's horizontal line and the distance across it, each as its inverse
// hyperbolic sine, in metres.
//
// Behind horizontal slats, the sunlit fraction depends on the second value alone, behind vertical
// ones on the first, and linearly while shadows are short. At grazing incidence, shadows grow
// without bound, which the inverse hyperbolic sine reduces to a few metres.
//
// `normal`, pointing outside, and `towards_sun` are unit vectors; the cosine of the angle between
// them is limited to min_cosine or more.
glm::dvec2 shadow_fall(glm::dvec3 const& normal, glm::dvec3 const& towards_sun);

// By receiver and sampled direction: the error of predicting a receiver's fraction from its other
// samples; 0 if the sun does not face it.
using Misses = std::vector<std::vector<double>>;

// Splines through a table. Each column is cut at its fraction_levels() into layers. Each layer has
// four splines, rough and smooth ones over the position of shadows on a receiver's plane and over
// the sun direction; the one that predicts its samples best from one another answers. One fit
// serves all receivers that face the same way.
class SunlitSplines : public Interpolant {
 public:
  // Splines that only answer take less memory, and have no uncertainty.
  enum class Purpose { answers, refinement };
  SunlitSplines(SunlitTable const& table, Purpose purpose);

  std::vector<double> at(SunDirection direction) const override;

  Misses misses(SunlitTable const& table) const;

  // By receiver: by how much the splines that do not answer differ from the answer there. Those
  // that predict samples better count more. 0 without Purpose::refinement.
  std::vector<float> uncertainty(SunDirection direction) const;

 private:
  struct Layer {
    std::size_t column;
    double from;    // the lower of its two levels
    double height;  // the distance to the other
    bool lowest;
  };
  struct Splines {
    std::optional<glm::dvec3> normal;  // over the position of shadows on it; empty: over directions
    RadialFunctions functions;
  };
  struct Answering {
    Splines splines;
    std::vector<Eigen::Index> layers;
  };
  struct Group {
    std::vector<std::size_t> samples;
    std::vector<Layer> layers;
    std::vector<Answering> answering;  // each layer once
    Eigen::MatrixXd missed;            // by sample and layer, of the splines that answer
    std::vector<Splines> all;          // each kind, for all layers; empty without refinement
    Eigen::MatrixXd weights;           // of the kinds' uncertainty, by kind and layer
  };

  Group make_group(SunlitTable const& table, std::vector<std::size_t> const& columns) const;
  void fit(Group& group, glm::dvec3 const& normal, std::vector<glm::dvec3> const& suns,
           Eigen::MatrixXd const& values) const;
  // 0 .. 1, by layer.
  static Eigen::VectorXd answers_of(Group const& group, glm::dvec3 const& sun);

  Purpose purpose_;
  std::size_t receivers_count_;
  std::vector<std::size_t> receivers_;  // by column
  std::vector<double> lowest_level_;    // the lowest level, by column
  std::vector<Group> groups_;
};

}  // namespace gpu_shading

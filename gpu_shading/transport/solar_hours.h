#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "gpu_shading/transport.h"

namespace gpu_shading {

// The hours with sun of a request.
struct SolarHours {
  explicit SolarHours(TransportRequest const& request);

  std::vector<TransportHour> hours;
  std::vector<glm::dvec3> suns;  // unit vectors
};

// An hour at whose sun the error of interpolation is measured.
struct Probe {
  std::size_t hour = 0;
  double hours = 1.0;  // for which it stands
};

// What the errors of a receiver's light are relative to.
struct ReceiverHours {
  std::vector<double> direct;  // of a beam of 1 W/m2, without a reflection, by hour
  std::vector<double> least;   // W/m2, by hour
  std::vector<Probe> probes;   // as choose_probes() has them
};

// Half of them by their beam, and half by what a given gap costs, the beam's square by the total: a
// sun that goes behind the receiver's plane is seldom, and its light small.
std::vector<Probe> choose_probes(SolarHours const& year, ReceiverHours const& receiver);

// One of several independent answers.
struct Replicate {
  std::vector<LightByGround> beam;    // by sun of the table
  std::vector<LightByGround> lights;  // by light of the request
  std::vector<double> hourly;         // by the table, of a beam of 1 W/m2
  std::vector<double> gaps;           // of the probes' own answers to the table's
  LightByGround sky;
  double sky_direct = 0.0;
  std::size_t rays = 0;
};

struct Errors {
  double noise = 0.0;
  double annual_noise = 0.0;
  double interpolation = 0.0;
  double annual_interpolation = 0.0;
  bool needs_finer_table = false;
};

// As in Transported, from the spread of two or more replicates.
Errors errors_of(std::vector<Replicate> const& replicates, SolarHours const& year,
                 ReceiverHours const& receiver, TransportRequest const& request);

}  // namespace gpu_shading

#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace gpu_shading {

// A glass pane's solar properties at normal incidence, each 0 .. 1; transmittance plus either
// reflectance at most 1. Thickness does not enter: only its product with the absorption coefficient
// does, and that follows from these. Dirt on a pane is a factor on its transmittance, the caller's.
struct GlassLayer {
  double transmittance = 0.0;
  double front_reflectance = 0.0;  // of the face towards the sun
  double back_reflectance = 0.0;
};

// A window known by its rating alone.
struct SimpleGlazing {
  double u_factor = 0.0;  // W/(m2 K) with film coefficients, above 0, at most 7
  double shgc = 0.0;      // solar heat gain coefficient at normal incidence, between 0 and 1
};

// Beam solar transmittance of a flat shade over the angle of incidence, the same through both
// faces: tau(angle), 0 .. 1, the angle in radians from the normal, 0 .. pi/2. What lies outside
// that is taken at its nearest end, so that rounding does no harm; at grazing incidence a model
// gives its own value. A value: cheap to copy, safe to share between threads.
//
// Each function below throws Error when the model it makes is not one: the message begins with the
// field, as in "transmittance is 1.3 at 40 degrees, expected 0 to 1".
class Transmittance {
 public:
  // 0: opaque.
  Transmittance();

  double operator()(double angle) const;

  static Transmittance constant(double value);

  // `model` times a factor, 0 .. 1, at every angle: dirt, or a fixed share of holes.
  static Transmittance product(Transmittance const& model, double factor);

  // c[0] + c[1] x + ... + c[8] x^8 at most, x the angle in degrees, or its cosine. Has to lie in
  // 0 .. 1 at every tenth of a degree, within 1e-9.
  static Transmittance polynomial_in_degrees(std::vector<double> coefficients);
  static Transmittance polynomial_in_cosine(std::vector<double> coefficients);

  // Through two points or more; angles in degrees, increasing, 0 .. 90. Between them monotone cubic
  // (PCHIP; Fritsch & Carlson 1980), so that it never leaves the range of its neighbours, or
  // straight where there are fewer than four; beyond the first and last, constant.
  static Transmittance table(std::vector<double> angles, std::vector<double> values);

  // Panes from the one towards the sun to the innermost, with inter-reflection between them, after
  // the EnergyPlus Engineering Reference, "Window Calculation Module": "Glazing System Properties"
  // and "Calculation of Angular Properties". As in EnergyPlus, a pane is uncoated where the
  // interface reflectivities that its front and its back reflectance imply differ by less than 0.1
  // % of their sum (Fresnel, for each polarisation, averaged), and coated otherwise (regressions on
  // clear glass above 0.645 of transmittance, on bronze glass to there).
  static Transmittance glazing(std::span<GlassLayer const> layers);

  // The same reference, "Simple Window Model", steps 4 and 7: the transmittance at normal incidence
  // and the angular curves that U-factor and SHGC select.
  static Transmittance glazing(SimpleGlazing const& window);

 private:
  explicit Transmittance(std::function<double(double)> model);

  std::function<double(double)> model_;
};

// A table of angle and transmittance from a text file, separated by commas, semicolons, tabs or
// blanks. One of
//  - two columns, angle in degrees and transmittance, with or without a line of headings;
//  - several columns whose headings name an angle (Angle, Theta) and a transmittance (Tsol,
//    Transmittance, Tau);
//  - a line "Angle 0 10 20 ... 90 Hemis" and below it a line "Tsol ...", as in the reports of LBNL
//    WINDOW, whose other lines are passed over; of several glazing systems the first is taken.
// Throws Error, with the file and the line.
Transmittance read_angular_csv(std::filesystem::path const& path);

// A model as a texture: samples at equal steps of u = sqrt(1 - sqrt(cos(angle))), from 0 at normal
// to 1 at grazing incidence, to be interpolated linearly. u runs with the angle near the normal, as
// models in degrees do, and is dense near grazing, where glass bends over a degree or less; a
// shader has it at the cost of two roots, without acos. Texture filtering keeps 8 bits of the place
// between two texels on most devices: fetch both and mix.
//
// Throws Error when there are fewer than two samples.
std::vector<float> sample(Transmittance const& model, int samples);

// Largest difference between the model and its samples, interpolated linearly.
double sampling_error(Transmittance const& model, std::span<float const> samples);

// The smallest 2^k + 1 samples that are within `tolerance`, 2 .. 4097; 4097 where that is not
// enough.
int samples_within(Transmittance const& model, double tolerance);

}  // namespace gpu_shading

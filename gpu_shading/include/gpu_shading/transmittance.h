#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace gpu_shading {

// Solar properties of a glass pane at normal incidence, each 0 .. 1; transmittance plus either
// reflectance at most 1. Thickness is not needed: only its product with the absorption coefficient
// matters, which follows from these.
struct GlassLayer {
  double transmittance = 0.0;
  double front_reflectance = 0.0;  // of the face that faces the sun
  double back_reflectance = 0.0;
};

// A window described by its rating alone.
struct SimpleGlazing {
  double u_factor = 0.0;  // W/(m2 K) with film coefficients, above 0, at most 7
  double shgc = 0.0;      // solar heat gain coefficient at normal incidence, between 0 and 1
};

// Beam solar transmittance of a flat shade by angle of incidence, the same through both faces:
// tau(angle), 0 .. 1, for angles in radians from the normal, 0 .. pi/2. Angles outside this range
// are clamped, so that rounding is harmless; at grazing incidence, a model returns its own value.
// Value type: cheap to copy, safe to share between threads.
//
// Each function below throws Error for an invalid model: the message begins with the field, as in
// "transmittance is 1.3 at 40 degrees, expected 0 to 1".
class Transmittance {
 public:
  // The default is 0, opaque.
  Transmittance();

  double operator()(double angle) const;

  static Transmittance constant(double value);

  // `model` times a factor, 0 .. 1, at every angle: dirt, or a constant open fraction.
  static Transmittance product(Transmittance const& model, double factor);

  // `model`'s angular curve with another value at normal incidence, 0 .. 1; limited to 0 .. 1.
  // Throws Error if the model is opaque there and the value is not.
  static Transmittance with_normal(Transmittance const& model, double normal);

  // The polynomial c[1] x + ... + c[6] x^6 in the cosine that is nearest, in least squares, to a
  // model at 0, 10, .. 90 degrees, limited to 0 .. 1: what EnergyPlus keeps of a window's angular
  // transmittance (Engineering Reference, "Window Calculation Module").
  static Transmittance fitted_in_cosine(Transmittance const& model);

  // c[0] + c[1] x + ... + c[8] x^8 at most, where x is the angle in degrees, or its cosine. Must be
  // within 0 .. 1 at every tenth of a degree, to within 1e-9.
  static Transmittance polynomial_in_degrees(std::vector<double> coefficients);
  static Transmittance polynomial_in_cosine(std::vector<double> coefficients);

  // Interpolates two or more points; angles in degrees, increasing, 0 .. 90. Between points it is
  // monotone cubic (PCHIP; Fritsch & Carlson 1980), so that it never leaves the range of its
  // neighbours, or linear if there are fewer than four points; beyond the first and last point it
  // is constant.
  static Transmittance table(std::vector<double> angles, std::vector<double> values);

  // Panes from the one facing the sun to the innermost, with inter-reflection between them, after
  // the EnergyPlus Engineering Reference, "Window Calculation Module": "Glazing System Properties"
  // and "Calculation of Angular Properties". As in EnergyPlus, a pane is uncoated if the interface
  // reflectivities that its front and back reflectance imply differ by less than 0.1 % of their sum
  // (Fresnel equations, averaged over both polarisations), and coated otherwise (regressions for
  // clear glass above a transmittance of 0.645, and for bronze glass up to it).
  static Transmittance glazing(std::span<GlassLayer const> layers);

  // After "Simple Window Model" in the same reference, steps 4 and 7: the transmittance at normal
  // incidence and the angular curves that U-factor and SHGC select.
  static Transmittance glazing(SimpleGlazing const& window);

 private:
  explicit Transmittance(std::function<double(double)> model);

  std::function<double(double)> model_;
};

// Solar reflectance, 0 .. 1, at normal incidence of the outermost pane with what lies behind it, or
// of a rated window ("Simple Window Model", step 5). They throw Error as Transmittance::glazing()
// does.
double normal_reflectance(std::span<GlassLayer const> layers);
double normal_reflectance(SimpleGlazing const& window);

// A table of angle and transmittance from a text file, separated by commas, semicolons, tabs or
// blanks. One of
//  - two columns, angle in degrees and transmittance, with or without a line of headings;
//  - several columns whose headings name an angle (Angle, Theta) and a transmittance (Tsol,
//    Transmittance, Tau);
//  - a line "Angle 0 10 20 ... 90 Hemis" and below it a line "Tsol ...", as in the reports of LBNL
//    WINDOW, whose other lines are passed over; of several glazing systems the first is taken.
// Throws Error, with the file and the line.
Transmittance read_angular_csv(std::filesystem::path const& path);

}  // namespace gpu_shading

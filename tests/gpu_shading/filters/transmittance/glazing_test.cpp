#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "filters/transmittance/pane.h"
#include "gpu_shading/transmittance.h"
#include "support/degree.h"
#include "support/refusal.h"

namespace gpu_shading {
namespace {

GlassLayer const clear{0.775, 0.071, 0.071};
GlassLayer const low_e{0.6, 0.17, 0.22};

Transmittance glazing(std::vector<GlassLayer> const& layers) {
  return Transmittance::glazing(layers);
}

// Reflectivities of one interface for both polarisations, by Snell and Fresnel in angles; not for
// normal incidence.
std::pair<double, double> interface(double index, double angle) {
  double const inside = std::asin(std::sin(angle) / index);
  auto const squared = [](double x) { return x * x; };
  return {squared(std::sin(inside - angle) / std::sin(inside + angle)),
          squared(std::tan(inside - angle) / std::tan(inside + angle))};
}

double normal_reflectivity(double index) { return std::pow((index - 1.0) / (index + 1.0), 2.0); }

// Duffie & Beckman, Solar Engineering of Thermal Processes, section 5.1: glass of index 1.526
// reflects 0.0434 at normal incidence and 0.093 at 60 degrees at each interface; a pane that
// absorbs nothing lets (1 - r) / (1 + r) of each polarisation through.
TEST(Uncoated, ThatAbsorbsNothingIsFresnels) {
  double const index = 1.526;
  double const at_normal = normal_reflectivity(index);
  EXPECT_NEAR(at_normal, 0.0434, 5e-5);
  double const t = (1.0 - at_normal) / (1.0 + at_normal);
  auto const tau = glazing({{t, 1.0 - t, 1.0 - t}});
  EXPECT_NEAR(tau(0.0), t, 1e-12);
  for (double const angle : {30.0, 60.0, 80.0}) {
    auto const [s, p] = interface(index, angle * degree);
    if (angle == 60.0) {
      EXPECT_NEAR(0.5 * (s + p), 0.093, 5e-4);
    }
    EXPECT_NEAR(tau(angle * degree), 0.5 * ((1 - s) / (1 + s) + (1 - p) / (1 + p)), 1e-9);
    Pane const pane({t, 1.0 - t, 1.0 - t});
    PaneProperties const properties = pane.at(std::cos(angle * degree));
    EXPECT_NEAR(properties.transmittance + properties.front_reflectance, 1.0, 1e-9);
  }
}

TEST(Uncoated, ThatAbsorbsKeepsItsIndexAndItsPathLength) {
  double const index = 1.526;
  double const passage = 0.85;  // of one passage straight through
  auto const through = [&](double r, double x) {
    return (1 - r) * (1 - r) * x / (1 - r * r * x * x);
  };
  double const r = normal_reflectivity(index);
  double const t = through(r, passage);
  double const reflectance = r * (1.0 + t * passage);
  auto const tau = glazing({{t, reflectance, reflectance}});
  for (double const angle : {20.0, 60.0, 85.0}) {
    auto const [s, p] = interface(index, angle * degree);
    double const path = 1.0 / std::cos(std::asin(std::sin(angle * degree) / index));
    double const x = std::pow(passage, path);
    EXPECT_NEAR(tau(angle * degree), 0.5 * (through(s, x) + through(p, x)), 1e-9);
  }
}

TEST(Uncoated, FallsSteadilyToNothingAtGrazing) {
  for (std::size_t panes = 1; panes <= 4; ++panes) {
    auto const tau = glazing(std::vector<GlassLayer>(panes, clear));
    for (int tenths = 0; tenths < 900; ++tenths) {
      EXPECT_GT(tau(tenths / 10.0 * degree), tau((tenths + 1) / 10.0 * degree));
    }
    EXPECT_EQ(tau(90.0 * degree), 0.0);
  }
}

TEST(Uncoated, WithoutReflectionIsAbsorptionAlone) {
  auto const tau = glazing({{0.5, 0.0, 0.0}});
  EXPECT_NEAR(tau(60.0 * degree), 0.25, 1e-12);
  EXPECT_EQ(tau(90.0 * degree), 0.0);
}

// At 60 degrees the bronze curve is -0.002 + 2.813/2 - 2.341/4 - 0.05725/8 + 0.599/16 = 0.84953125,
// the clear one -0.0015 + 3.355/2 - 3.840/4 + 1.460/8 + 0.0288/16 = 0.9003.
TEST(Coated, FollowsBronzeGlassUpTo0645AndClearGlassAbove) {
  EXPECT_NEAR(glazing({low_e})(60.0 * degree), 0.6 * 0.84953125, 1e-12);
  EXPECT_NEAR(glazing({{0.645, 0.17, 0.22}})(60.0 * degree), 0.645 * 0.84953125, 1e-12);
  EXPECT_NEAR(glazing({{0.646, 0.17, 0.22}})(60.0 * degree), 0.646 * 0.9003, 1e-12);
}

TEST(Coated, IsItselfAtNormalIncidenceAndNothingAtGrazing) {
  for (double const t : {0.05, 0.4, 0.6, 0.7, 0.78}) {
    auto const tau = glazing({{t, 0.17, 0.22}});
    EXPECT_NEAR(tau(0.0), t, 1e-12);
    EXPECT_EQ(tau(90.0 * degree), 0.0);
  }
}

TEST(Coated, HasNoStepWhereItsCurveSetsIn) {
  auto const tau = glazing({low_e});
  double const slope_below = tau(10.0 * degree) - tau(9.99 * degree);
  double const slope_above = tau(10.01 * degree) - tau(10.0 * degree);
  EXPECT_NEAR(slope_below, slope_above, 1e-6);
}

TEST(Glazing, TakesPanesForCoatedWhereTheirFacesDiffer) {
  double const uncoated = glazing({{0.6, 0.17, 0.17}})(70.0 * degree);
  EXPECT_NEAR(glazing({{0.6, 0.17, 0.1701}})(70.0 * degree), uncoated, 1e-3);
  EXPECT_NEAR(glazing({{0.6, 0.17, 0.172}})(70.0 * degree), glazing({low_e})(70.0 * degree), 1e-12);
}

// The panes of N. L. Jones & D. P. Greenberg (2012), "Hardware accelerated computation of direct
// solar radiation through transparent shades and screens", SimBuild. 34 % through three says that
// each reflects 0.09 or more: with 0.07 they let 33 % through.
TEST(Glazing, OfOneTwoAndThreePanes) {
  std::vector<GlassLayer> panes;
  for (double const expected : {0.69, 0.48, 0.34}) {
    panes.push_back({0.69, 0.1, 0.1});
    EXPECT_NEAR(glazing(panes)(0.0), expected, 0.005);
  }
}

TEST(Glazing, OfTwoLikePanesIsTheSumOfTheirReflections) {
  for (GlassLayer const& layer : {clear, GlassLayer{0.69, 0.1, 0.1}, GlassLayer{0.3, 0.5, 0.5}}) {
    for (double const angle : {0.0, 40.0, 70.0, 89.0}) {
      PaneProperties const p = Pane(layer).at(std::cos(angle * degree));
      double const expected =
          p.transmittance * p.transmittance / (1.0 - p.front_reflectance * p.front_reflectance);
      EXPECT_NEAR(glazing({layer, layer})(angle * degree), expected, 1e-12);
    }
  }
}

// Stokes's relations: either way round, a stack lets the same through.
TEST(Glazing, IsTheSameThroughBothFaces) {
  GlassLayer const turned{low_e.transmittance, low_e.back_reflectance, low_e.front_reflectance};
  for (int angle = 0; angle <= 90; angle += 10) {
    EXPECT_NEAR(glazing({low_e, clear, {0.5, 0.06, 0.06}})(angle * degree),
                glazing({{0.5, 0.06, 0.06}, clear, turned})(angle * degree), 1e-12);
  }
}

TEST(Glazing, BehindAnOpaquePaneIsDark) { EXPECT_EQ(glazing({clear, {0.0, 1.0, 0.2}})(0.3), 0.0); }

TEST(Glazing, OfAnyPanesStaysInRange) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anything(0.0, 1.0);
  auto const extreme = [&] {
    double const x = anything(random);
    return x < 0.1 ? 0.0 : x > 0.9 ? 1.0 : x < 0.2 ? 1e-12 : anything(random);
  };
  for (int round = 0; round < 2000; ++round) {
    std::vector<GlassLayer> panes(1 + random() % 3);
    for (GlassLayer& pane : panes) {
      pane.transmittance = extreme();
      pane.front_reflectance = (1.0 - pane.transmittance) * extreme();
      pane.back_reflectance =
          anything(random) < 0.5 ? pane.front_reflectance : (1.0 - pane.transmittance) * extreme();
      Pane const single(pane);
      for (double const cosine : {0.0, 1e-9, 0.1, 0.5, 0.99, 1.0}) {
        PaneProperties const p = single.at(cosine);
        EXPECT_GE(p.front_reflectance, 0.0);
        EXPECT_LE(p.transmittance + p.front_reflectance, 1.0 + 1e-9);
        EXPECT_LE(p.transmittance + p.back_reflectance, 1.0 + 1e-9);
      }
    }
    auto const tau = glazing(panes);
    for (int angle = 0; angle <= 90; angle += 5) {
      EXPECT_TRUE(tau(angle * degree) >= 0.0 && tau(angle * degree) <= 1.0);
    }
  }
}

TEST(Glazing, NamesThePaneAndTheFieldThatAreWrong) {
  EXPECT_EQ(refusal_of([] { glazing({}); }), "glazing has no panes, expected 1 or more");
  EXPECT_EQ(refusal_of([] {
              glazing({clear, {1.1, 0.0, 0.0}});
            }),
            "pane 2: transmittance is 1.1, expected 0 to 1");
  EXPECT_EQ(refusal_of([] {
              glazing({{0.5, 0.1, -0.1}});
            }),
            "pane 1: back reflectance is -0.1, expected 0 to 1");
  EXPECT_EQ(
      refusal_of([] {
        glazing({{0.9, 0.2, 0.1}});
      }),
      "pane 1: transmittance 0.9 and front reflectance 0.2 add up to 1.1, expected at most 1");
}

// By hand from the Engineering Reference, "Simple Window Model". U = 2.0, SHGC = 0.4:
// step 4, U < 3.4 and SHGC > 0.15: T = 0.085775 x 0.16 + 0.963954 x 0.4 - 0.084958 = 0.3143476;
// step 7, bin 13: the mean of F, G, H and I, 1.0175 c + 3.61 c^2 - 6.8 c^3 + 3.185 c^4, which is
// 0.7603125 at 60 degrees.
TEST(SimpleGlazing, OfOneBinFollowsItsCurve) {
  auto const tau = Transmittance::glazing(SimpleGlazing{2.0, 0.4});
  EXPECT_NEAR(tau(0.0), 0.3143476, 1e-7);
  EXPECT_NEAR(tau(60.0 * degree), 0.3143476 * 0.7603125, 1e-7);
  EXPECT_NEAR(tau(90.0 * degree), 0.0, 1e-12);
}

// U half-way from 1.4195 to 1.7034, SHGC half-way from 0.35 to 0.45 (bin 7): J is 0.67375 at 60
// degrees, E 0.82375; their mean 0.74875 meets F, G, H and I half-way.
TEST(SimpleGlazing, BetweenBinsBlendsTheirCurves) {
  auto const tau = Transmittance::glazing(SimpleGlazing{1.56145, 0.4});
  EXPECT_NEAR(tau(60.0 * degree), 0.3143476 * 0.5 * (0.74875 + 0.7603125), 1e-7);
}

// Step 4 above U = 4.5: 1.30415 x 0.8 - 0.30515 = 0.73817 from SHGC = 0.7206, below it 0.939998 x
// 0.25 + 0.20332 x 0.5 = 0.3366595. At U = 3.95 half-way to U = 3.4: 0.085775 x 0.25 + 0.963954 x
// 0.5
// - 0.084958 = 0.41846275. At SHGC = 0.1, U = 2: 0.04104.
TEST(SimpleGlazing, HasTheTransmittanceOfStepFourAtNormalIncidence) {
  EXPECT_NEAR(Transmittance::glazing(SimpleGlazing{5.8, 0.8})(0.0), 0.73817, 1e-9);
  EXPECT_NEAR(Transmittance::glazing(SimpleGlazing{5.8, 0.5})(0.0), 0.3366595, 1e-9);
  EXPECT_NEAR(Transmittance::glazing(SimpleGlazing{3.95, 0.5})(0.0), 0.5 * (0.3366595 + 0.41846275),
              1e-9);
  EXPECT_NEAR(Transmittance::glazing(SimpleGlazing{2.0, 0.1})(0.0), 0.04104, 1e-9);
}

TEST(SimpleGlazing, OfAnyRatingStaysInRangeAndEndsInTheDark) {
  for (int tenths = 2; tenths <= 70; ++tenths) {
    for (int percent = 1; percent < 100; percent += 3) {
      auto const tau = Transmittance::glazing(SimpleGlazing{tenths / 10.0, percent / 100.0});
      for (int angle = 0; angle <= 90; angle += 5) {
        EXPECT_GE(tau(angle * degree), 0.0);
        EXPECT_LE(tau(angle * degree), 1.02 * tau(0.0) + 1e-12);
      }
      EXPECT_NEAR(tau(90.0 * degree), 0.0, 1e-12);
    }
  }
}

TEST(SimpleGlazing, NamesTheRatingThatIsWrong) {
  EXPECT_EQ(refusal_of([] {
              Transmittance::glazing(SimpleGlazing{7.5, 0.4});
            }),
            "U-factor is 7.5 W/(m2 K), expected above 0 and at most 7");
  EXPECT_EQ(refusal_of([] {
              Transmittance::glazing(SimpleGlazing{2.0, 1.0});
            }),
            "SHGC is 1, expected between 0 and 1");
}

// As EnergyPlus lists them in its .eio file, also for U between both ranges.
TEST(NormalReflectance, OfARatingIsEnergyPlusS) {
  struct Rated {
    SimpleGlazing window;
    double reflectance;
  };
  for (auto const& [window, expected] : std::vector<Rated>{{{5.8, 0.8}, 4.53258e-2},
                                                           {{5.8, 0.5}, 0.11669},
                                                           {{6.5, 0.3}, 0.33375},
                                                           {{3.95, 0.5}, 0.27188},
                                                           {{3.6, 0.6}, 0.24462},
                                                           {{4.4, 0.45}, 0.22930},
                                                           {{2.0, 0.4}, 0.48237},
                                                           {{1.4, 0.6}, 0.30517},
                                                           {{2.0, 0.1}, 0.81796},
                                                           {{0.9, 0.9}, 4.41711e-2}}) {
    EXPECT_NEAR(normal_reflectance(window), expected, 6e-6) << window.u_factor << window.shgc;
  }
}

// Light that is followed from pane to pane until none is left.
double returned(std::vector<GlassLayer> const& layers) {
  std::vector<double> inwards(layers.size(), 0.0);  // that meets a pane
  std::vector<double> outwards(layers.size(), 0.0);
  inwards.front() = 1.0;
  double returned = 0.0;
  for (int step = 0; step < 1000; ++step) {
    std::vector<double> next_in(layers.size(), 0.0);
    std::vector<double> next_out(layers.size(), 0.0);
    for (std::size_t i = 0; i < layers.size(); ++i) {
      auto const& [transmittance, front, back] = layers[i];
      double const from_front = front * inwards[i] + transmittance * outwards[i];
      (i == 0 ? returned : next_out[i - 1]) += from_front;
      if (i + 1 < layers.size()) next_in[i + 1] += transmittance * inwards[i] + back * outwards[i];
    }
    inwards = next_in;
    outwards = next_out;
  }
  return returned;
}

TEST(NormalReflectance, OfPanesIsTheLightThatComesBack) {
  GlassLayer const solar_control{0.2, 0.4, 0.3};
  EXPECT_NEAR(normal_reflectance(std::vector{clear}), 0.071, 1e-12);
  for (auto const& layers :
       {std::vector{low_e, clear}, {solar_control, clear}, {clear, low_e, solar_control}}) {
    EXPECT_NEAR(normal_reflectance(layers), returned(layers), 1e-12);
  }
}

Transmittance polynomial(std::vector<double> const& coefficients) {
  return Transmittance::polynomial_in_cosine(coefficients);
}

TEST(FittedInCosine, KeepsPolynomialsOfItsDegree) {
  auto const model = polynomial({0.0, 0.9, -0.3, 0.5, -0.4, 0.25, -0.1});
  auto const fitted = Transmittance::fitted_in_cosine(model);
  for (double angle = 0.0; angle <= 90.0; angle += 0.5) {
    EXPECT_NEAR(fitted(angle * degree), model(angle * degree), 1e-12) << angle;
  }
}

// The least squares are reached where what is left over is orthogonal to every power.
TEST(FittedInCosine, IsTheNearestAtStepsOfTenDegrees) {
  auto const model = glazing({{0.3, 0.6, 0.6}});
  auto const fitted = Transmittance::fitted_in_cosine(model);
  double left_over = 0.0;
  for (int power = 1; power <= 6; ++power) {
    double sum = 0.0;
    for (int k = 0; k < 9; ++k) {
      double const angle = 10.0 * k * degree;
      double const difference = fitted(angle) - model(angle);
      sum += difference * std::pow(std::cos(angle), power);
      left_over = std::max(left_over, std::abs(difference));
    }
    EXPECT_NEAR(sum, 0.0, 1e-12) << power;
  }
  EXPECT_GT(left_over, 1e-4);
}

TEST(FittedInCosine, StaysWithinItsRange) {
  auto const clear_air = Transmittance::fitted_in_cosine(Transmittance::constant(1.0));
  auto const dark = Transmittance::fitted_in_cosine(
      glazing({{0.69, 0.1, 0.1}, {0.69, 0.1, 0.1}, {0.69, 0.1, 0.1}}));
  for (double angle = 0.0; angle <= 90.0; angle += 0.5) {
    EXPECT_LE(clear_air(angle * degree), 1.0);
    EXPECT_GE(dark(angle * degree), 0.0);
  }
  EXPECT_NEAR(clear_air(90.0 * degree), 0.0, 1e-12);
}

}  // namespace
}  // namespace gpu_shading

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/perforated_screen.h"
#include "support/degree.h"
#include "support/millimetre.h"
#include "support/refusal.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;
using std::numbers::sqrt3;

HolePattern pattern(Hole hole, Arrangement arrangement, double size, double pitch) {
  return HolePattern(
      {.hole = hole, .arrangement = arrangement, .size = size * mm, .pitch = pitch * mm});
}

// Slots of 4 x 20 mm in staggered rows.
HolePattern slots() {
  return HolePattern({.hole = Hole::Slotted,
                      .arrangement = Arrangement::Staggered60,
                      .size = 4 * mm,
                      .length = 20 * mm,
                      .pitch = 25 * mm,
                      .row_pitch = 7 * mm});
}

std::vector<HolePattern> patterns() {
  std::vector<HolePattern> all{slots()};
  for (Hole const hole : {Hole::Round, Hole::Square, Hole::Hexagonal}) {
    for (Arrangement const arrangement :
         {Arrangement::Straight, Arrangement::Staggered45, Arrangement::Staggered60}) {
      all.push_back(pattern(hole, arrangement, 5, 8));
    }
  }
  return all;
}

// One point in each of cells x cells.
template <typename Visit>
void visit_jittered(HolePattern const& holes, int cells, Visit const& visit) {
  std::mt19937 random(20260601);
  std::uniform_real_distribution<double> within(0.0, 1.0);
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      double const u = (column + within(random)) / cells * holes.width();
      double const v = (row + within(random)) / cells * holes.height();
      visit(u, v);
    }
  }
}

// By following rays through the sheet in steps far shorter than a web.
double followed(HolePattern const& holes, double shift, double phi, int cells) {
  int passed = 0;
  int const steps = 1 + static_cast<int>(std::ceil(20.0 * shift / holes.web()));
  visit_jittered(holes, cells, [&](double u, double v) {
    bool open =
        holes.is_open(u, v) && holes.is_open(u + shift * std::cos(phi), v + shift * std::sin(phi));
    for (int step = 1; open && step < steps; ++step) {
      double const way = shift * step / steps;
      open = holes.is_open(u + way * std::cos(phi), v + way * std::sin(phi));
    }
    passed += open ? 1 : 0;
  });
  return static_cast<double>(passed) / (cells * cells);
}

TEST(HolePattern, HasTheOpenFractionsThatMakersPublish) {
  double const share = 25.0 / 64.0;  // (D/P)^2
  EXPECT_NEAR(pattern(Hole::Round, Arrangement::Staggered60, 5, 8).open_fraction(), 0.9069 * share,
              1e-5);
  for (Arrangement const arrangement : {Arrangement::Straight, Arrangement::Staggered45}) {
    EXPECT_NEAR(pattern(Hole::Round, arrangement, 5, 8).open_fraction(), pi / 4 * share, 1e-12);
    EXPECT_NEAR(pattern(Hole::Square, arrangement, 5, 8).open_fraction(), share, 1e-12);
  }
  EXPECT_NEAR(pattern(Hole::Square, Arrangement::Staggered60, 5, 8).open_fraction(),
              2 / sqrt3 * share, 1e-12);
  EXPECT_NEAR(pattern(Hole::Hexagonal, Arrangement::Staggered60, 5, 8).open_fraction(), share,
              1e-12);
  EXPECT_NEAR(slots().open_fraction(), (4 * pi + 4 * 16) / (25 * 7), 1e-12);
}

TEST(HolePattern, IsOpenOverItsOpenFraction) {
  for (HolePattern const& holes : patterns()) {
    int open = 0;
    visit_jittered(holes, 500, [&](double u, double v) { open += holes.is_open(u, v) ? 1 : 0; });
    EXPECT_NEAR(open / 250000.0, holes.open_fraction(), 3e-4);
    EXPECT_NEAR(holes.transmittance(0.0, 0.0), holes.open_fraction(), 1e-12);
  }
}

TEST(HolePattern, RepeatsWithAHoleAtTheOrigin) {
  HolePattern const holes = pattern(Hole::Round, Arrangement::Staggered60, 5, 8);
  EXPECT_NEAR(holes.width(), 8 * mm, 1e-12);
  EXPECT_NEAR(holes.height(), 8 * sqrt3 * mm, 1e-12);
  for (double const tiles : {-3.0, 0.0, 2.0}) {
    double const u = tiles * holes.width();
    double const v = tiles * holes.height();
    EXPECT_TRUE(holes.is_open(u + 2.49 * mm, v));
    EXPECT_FALSE(holes.is_open(u + 2.51 * mm, v));
    EXPECT_TRUE(holes.is_open(u + holes.width() / 2, v + holes.height() / 2));
    EXPECT_FALSE(holes.is_open(u, v + holes.height() / 2));
  }
  HolePattern const diagonal = pattern(Hole::Square, Arrangement::Staggered45, 5, 8);
  EXPECT_NEAR(diagonal.width(), 8 * sqrt2 * mm, 1e-12);
  EXPECT_NEAR(diagonal.height(), 8 * sqrt2 * mm, 1e-12);
}

TEST(HolePattern, KnowsItsNarrowestWeb) {
  for (Arrangement const arrangement :
       {Arrangement::Straight, Arrangement::Staggered45, Arrangement::Staggered60}) {
    EXPECT_NEAR(pattern(Hole::Round, arrangement, 5, 8).web(), 3 * mm, 1e-12);
  }
  EXPECT_NEAR(pattern(Hole::Square, Arrangement::Straight, 5, 8).web(), 3 * mm, 1e-12);
  // From corner to corner.
  EXPECT_NEAR(pattern(Hole::Square, Arrangement::Staggered45, 5, 8).web(), (8 - 5 * sqrt2) * mm,
              1e-12);
  EXPECT_NEAR(pattern(Hole::Square, Arrangement::Staggered60, 5, 8).web(), (4 * sqrt3 - 5) * mm,
              1e-12);
  EXPECT_NEAR(pattern(Hole::Hexagonal, Arrangement::Staggered60, 5, 8).web(), 3 * mm, 1e-12);
  // Corners towards the next row, 5 x 2 / sqrt(3) across.
  EXPECT_NEAR(pattern(Hole::Hexagonal, Arrangement::Straight, 5, 8).web(), (8 - 10 / sqrt3) * mm,
              1e-12);
  // The ends of two slots in neighbouring rows overlap by 16 - 12.5 mm.
  EXPECT_NEAR(slots().web(), 3 * mm, 1e-12);
}

// Two circles' lens, as the literature writes it.
TEST(HolePattern, LetsALensThroughRoundHoles) {
  HolePattern const holes = pattern(Hole::Round, Arrangement::Staggered60, 5, 8);
  double const cell = 64 * sqrt3 / 2;
  double const r = 2.5;
  for (int tenths = 0; tenths < 50; ++tenths) {
    double const d = tenths / 10.0;
    double const lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
    for (int i = 0; i < 22; ++i) {
      double const phi = 0.37 * i - 4.0;
      EXPECT_NEAR(holes.transmittance(d * mm * std::cos(phi), d * mm * std::sin(phi)), lens / cell,
                  1e-12);
    }
  }
  EXPECT_EQ(holes.transmittance(5 * mm, 0.0), 0.0);
  EXPECT_EQ(holes.transmittance(-3 * mm, 5 * mm), 0.0);
}

// The sun in a sheet's normal is there but for rounding: shifts of 1e-18 m.
TEST(HolePattern, LetsItsOpenFractionThroughAtNextToNormalIncidence) {
  for (Hole const hole : {Hole::Round, Hole::Slotted, Hole::Square, Hole::Hexagonal}) {
    HolePattern const holes({.hole = hole,
                             .arrangement = Arrangement::Straight,
                             .size = 5 * mm,
                             .length = hole == Hole::Slotted ? 7 * mm : 0.0,
                             .pitch = 8 * mm});
    for (double const shift : {1e-20, 1e-18, 1e-16, 1e-12}) {
      for (double const phi : {0.0, 0.3, 1.0, 1.57, 2.0}) {
        EXPECT_NEAR(holes.transmittance(shift * std::cos(phi), shift * std::sin(phi)),
                    holes.open_fraction(), 1e-9)
            << static_cast<int>(hole) << " " << shift << " " << phi;
      }
    }
  }
}

TEST(HolePattern, LetsAHexagonThroughHexagonalHoles) {
  HolePattern const holes = pattern(Hole::Hexagonal, Arrangement::Straight, 5, 8);
  // Half-way from side to side: the hexagon loses the parallelogram and the two triangles that
  // its sides sweep; half-way from corner to corner a rhombus is left.
  double const side = 5 / sqrt3;
  EXPECT_NEAR(holes.transmittance(0.0, side * mm), side * side * sqrt3 / 2 / 64, 1e-12);
  EXPECT_NEAR(holes.transmittance(2.5 * mm, 0.0), 2.5 * (side + side / 4) / 64, 1e-12);
  EXPECT_EQ(holes.transmittance(5 * mm, 0.0), 0.0);
  EXPECT_NEAR(holes.longest_chord(), 2 * side * mm, 1e-12);
}

TEST(HolePattern, LetsThroughWhatRaysDoThatAreFollowed) {
  for (HolePattern const& holes : patterns()) {
    for (double const share : {0.1, 0.3, 0.6, 0.85}) {
      for (double const phi : {0.0, 0.4, pi / 4, pi / 2, 2.2}) {
        double const shift = share * holes.longest_chord();
        EXPECT_NEAR(holes.transmittance(shift * std::cos(phi), shift * std::sin(phi)),
                    followed(holes, shift, phi, 250), 1e-3)
            << "shift " << shift << ", phi " << phi;
      }
    }
  }
}

// 6.35 mm thick, 6.35 mm holes in a hexagonal pattern, 50 % open.
TEST(HolePattern, OfThePaperIsFollowedToTwoThousandths) {
  double const pitch = 6.35 * std::sqrt(pi / (2 * sqrt3) / 0.5);
  HolePattern const holes = pattern(Hole::Round, Arrangement::Staggered60, 6.35, pitch);
  EXPECT_NEAR(holes.open_fraction(), 0.5, 1e-12);
  EXPECT_NEAR(holes.web(), 2.2021 * mm, 1e-7);
  for (double const theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0}) {
    double const shift = 6.35 * mm * std::tan(theta * degree);
    for (double const phi : {0.0, 15.0 * degree, 30.0 * degree}) {
      EXPECT_NEAR(holes.transmittance(shift * std::cos(phi), shift * std::sin(phi)),
                  followed(holes, shift, phi, 400), 1e-3);
    }
    EXPECT_LE(layers_for(shift, holes.web(), holes.longest_chord()), 4);
  }
}

std::string complaint(Perforation const& perforation) {
  return refusal_of([&] { HolePattern{perforation}; });
}

TEST(HolePattern, NamesTheFieldThatIsWrong) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint({.size = 0.0, .pitch = 0.008}), "hole size is 0 m, expected 1e-06 to 100000");
  EXPECT_EQ(complaint({.size = nan, .pitch = 0.008}),
            "hole size is nan m, expected 1e-06 to 100000");
  EXPECT_EQ(complaint({.size = 0.005, .pitch = 0.0}), "pitch is 0 m, expected 1e-06 to 100000");
  EXPECT_EQ(complaint({.size = 0.005, .pitch = 0.008, .row_pitch = -1.0}),
            "row pitch is -1 m, expected 1e-06 to 100000");
  EXPECT_EQ(complaint({.size = 0.008, .pitch = 0.005}),
            "hole size is 0.008 m, expected less than the pitch, 0.005 m");
  EXPECT_EQ(complaint({.size = 0.005, .length = 0.02, .pitch = 0.03}),
            "hole length is 0.02 m, but only slots have one");
  EXPECT_EQ(complaint({.hole = Hole::Slotted, .size = 0.005, .length = 0.005, .pitch = 0.03}),
            "hole length is 0.005 m, expected more than the hole size, 0.005 m");
  EXPECT_EQ(complaint({.hole = Hole::Slotted, .size = 0.005, .length = 0.04, .pitch = 0.03}),
            "hole length is 0.04 m, expected less than the pitch, 0.03 m");
}

TEST(HolePattern, RefusesLengthsWhoseSquaresOverflowOrVanish) {
  for (double const scale : {1e-300, 1e-7, 1e6, 1e300}) {
    EXPECT_EQ(complaint({.size = 0.5, .pitch = scale}),
              fmt::format("pitch is {:.9g} m, expected 1e-06 to 100000", scale));
    EXPECT_EQ(complaint({.size = 0.005, .pitch = 0.008, .row_pitch = scale}),
              fmt::format("row pitch is {:.9g} m, expected 1e-06 to 100000", scale));
  }
  HolePattern const widest({.arrangement = Arrangement::Straight, .size = 1e-6, .pitch = 1e5});
  EXPECT_NEAR(widest.open_fraction(), std::numbers::pi / 4 * 1e-22, 1e-30);
}

TEST(HolePattern, RefusesHolesThatOverlap) {
  EXPECT_EQ(complaint({.hole = Hole::Square,
                       .arrangement = Arrangement::Staggered45,
                       .size = 0.006,
                       .pitch = 0.008}),
            "pitch is 0.008 m, so holes overlap or touch; expected more");
  EXPECT_EQ(complaint({.hole = Hole::Hexagonal,
                       .arrangement = Arrangement::Straight,
                       .size = 0.0075,
                       .pitch = 0.008}),
            "pitch is 0.008 m, so holes overlap or touch; expected more");
  EXPECT_EQ(complaint({.hole = Hole::Slotted,
                       .arrangement = Arrangement::Straight,
                       .size = 0.004,
                       .length = 0.02,
                       .pitch = 0.03,
                       .row_pitch = 0.004}),
            "row pitch is 0.004 m, so holes overlap or touch; expected more");
}

}  // namespace
}  // namespace gpu_shading

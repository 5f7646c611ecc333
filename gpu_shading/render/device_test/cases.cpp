#include "render/device_test/cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "gpu_shading/hole_pattern.h"
#include "gpu_shading/opacity_tile.h"
#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"

namespace gpu_shading {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// The building's south is turned by this, so that nothing lies along the axes.
constexpr double turn = 23.0 * degree;

// The sun as a facade sees it: azimuth from the facade's normal, positive towards the right as seen
// from outside, and altitude.
struct FacadeSun {
  double azimuth;
  double altitude;

  double cosine() const { return std::cos(azimuth) * std::cos(altitude); }
  // Slope of the rays across the facade's normal: sideways and up, per metre outwards.
  double sideways() const { return std::tan(azimuth); }
  double upwards() const { return std::tan(altitude) / std::cos(azimuth); }
  SunDirection direction() const { return {std::numbers::pi - azimuth + turn, altitude}; }
};

constexpr std::array<double, 4> azimuths{-50.0 * degree, -20.0 * degree, 10.0 * degree,
                                         35.0 * degree};
constexpr std::array<double, 4> altitudes{8.0 * degree, 25.0 * degree, 40.0 * degree,
                                          60.0 * degree};

template <typename Use>
void each_sun(Use use) {
  for (double const azimuth : azimuths) {
    for (double const altitude : altitudes) use(FacadeSun{azimuth, altitude});
  }
}

// Places a building, whose x is to the right along its facade, y inwards and z up, m.
class Site {
 public:
  explicit Site(double east) : origin_(east, -70.0, 12.0) {}

  glm::dvec3 operator()(double x, double y, double z) const {
    return origin_ + glm::dvec3(std::cos(turn) * x + std::sin(turn) * y,
                                -std::sin(turn) * x + std::cos(turn) * y, z);
  }
  Polygon facade(double x, double y, double z, double width, double height) const {
    return {{at(x, y, z), at(x + width, y, z), at(x + width, y, z + height), at(x, y, z + height)},
            {}};
  }
  Polygon level(double x, double y, double z, double width, double depth) const {
    return {{at(x, y, z), at(x + width, y, z), at(x + width, y + depth, z), at(x, y + depth, z)},
            {}};
  }
  Polygon side(double x, double y, double z, double depth, double height) const {
    return {{at(x, y, z), at(x, y + depth, z), at(x, y + depth, z + height), at(x, y, z + height)},
            {}};
  }

 private:
  glm::dvec3 at(double x, double y, double z) const { return (*this)(x, y, z); }

  glm::dvec3 origin_;
};

constexpr int buildings = 8;
constexpr double apart = 200.0;

// ASHRAE 1052-RP: a window below an overhang and between two fins that reach past it.
ClosedForm overhangs_and_fins() {
  ClosedForm made{"opaque casters", {}, {}, {}};
  constexpr double width = 3.0;
  constexpr double height = 2.0;
  for (int i = 0; i < buildings; ++i) {
    double const overhang = 0.3 + 0.1 * i;
    double const fin = 0.2 + 0.15 * i;
    Site const site(apart * i);
    SurfaceId const window = made.scene.add({"window", site.facade(0, 0, 0, width, height)});
    made.scene.add({"overhang", site.level(-30, -overhang, height, 63, overhang)});
    for (double const x : {0.0, width}) {
      made.scene.add({"fin", site.side(x, -fin, -30, fin, 63)});
    }
    each_sun([&](FacadeSun const& sun) {
      double const wide = std::max(0.0, width - fin * std::abs(sun.sideways()));
      double const tall = std::max(0.0, height - overhang * sun.upwards());
      made.views.push_back({window,
                            sun.direction(),
                            width * height * sun.cosine(),
                            {},
                            {wide * tall * sun.cosine()}});
    });
  }
  return made;
}

// Transmittance of two panes over the cosine of the angle of incidence.
constexpr std::array<double, 5> two_panes{0.0, 0.61, 1.07, -2.28, 1.08};

double through_panes(double cosine) {
  double tau = 0.0;
  for (std::size_t i = two_panes.size(); i-- > 0;) tau = tau * cosine + two_panes.at(i);
  return tau;
}

std::shared_ptr<Transmittance const> panes() {
  return std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({two_panes.begin(), two_panes.end()}));
}

double overlap(double begin, double end, double length) {
  return std::max(0.0, std::min(end, length) - std::max(begin, 0.0));
}

// Jones & Greenberg: a pane as large as the window in front of it, whose shadow is the window's
// rectangle, shifted.
ClosedForm panes_before_windows() {
  ClosedForm made{"transparent shades", {}, {}, {}};
  constexpr double side = 1.5;
  for (int i = 0; i < buildings; ++i) {
    double const distance = 0.1 + 0.1 * i;
    Site const site(apart * i);
    SurfaceId const window = made.scene.add({"window", site.facade(0, 0, 0, side, side)});
    Surface pane{"pane", site.facade(0, -distance, 0, side, side)};
    pane.filter.set(AngularTransmittance{panes()});
    made.scene.add(pane);
    each_sun([&](FacadeSun const& sun) {
      // Rays from the pane go down, and away from the sun.
      double const across = -distance * sun.sideways();
      double const down = -distance * sun.upwards();
      double const shaded = overlap(across, across + side, side) * overlap(down, down + side, side);
      double const whole = side * side * sun.cosine();
      made.views.push_back({window,
                            sun.direction(),
                            whole,
                            {},
                            {whole - shaded * sun.cosine() * (1.0 - through_panes(sun.cosine()))}});
    });
  }
  return made;
}

// Sheets of square holes before windows of a whole number of holes, so that it does not matter
// where these begin: half of them have their holes drawn, and half only their effect.
ClosedForm perforated_sheets() {
  ClosedForm made{"perforated screens", {}, {}, {}};
  constexpr double hole = 0.06;
  constexpr double pitch = 0.1;
  constexpr double thickness = 0.02;
  HolePattern const holes(
      {.hole = Hole::Square, .arrangement = Arrangement::Straight, .size = hole, .pitch = pitch});
  for (int i = 0; i < buildings; ++i) {
    Site const site(apart * i);
    double const width = pitch * (8 + i);
    double const height = pitch * 10;
    SurfaceId const window = made.scene.add({"window", site.facade(0, 0, 0, width, height)});
    Sheet sheet{.thickness = thickness};
    sheet.detail = i % 2 == 0 ? ScreenDetail::holes : ScreenDetail::effective;
    Surface screen{"screen", site.facade(-4, -0.2, -4, 9, 9)};
    screen.filter.set(PerforatedSheet{std::make_shared<PerforatedScreen const>(holes, sheet)});
    made.scene.add(screen);
    each_sun([&](FacadeSun const& sun) {
      double const wide = std::max(0.0, hole - thickness * std::abs(sun.sideways()));
      double const tall = std::max(0.0, hole - thickness * sun.upwards());
      double const whole = width * height * sun.cosine();
      made.views.push_back(
          {window, sun.direction(), whole, {}, {whole * wide * tall / (pitch * pitch)}});
    });
  }
  return made;
}

// Images of one open bar, across or along, in a sheet without thickness.
ClosedForm images() {
  ClosedForm made{"screens by images", {}, {}, {}};
  constexpr double pitch = 0.1;
  constexpr int texels = 32;
  for (int i = 0; i < buildings; ++i) {
    Site const site(apart * i);
    int const open = 4 + 3 * i;
    bool const across = i % 2 == 0;
    std::vector<float> opacity;
    for (int row = 0; row < texels; ++row) {
      for (int column = 0; column < texels; ++column) {
        opacity.push_back((across ? row : column) < open ? 0.0F : 1.0F);
      }
    }
    SurfaceId const window = made.scene.add({"window", site.facade(0, 0, 0, 8 * pitch, 8 * pitch)});
    Surface screen{"screen", site.facade(-4, -0.2, -4, 9, 9)};
    screen.filter.set(PerforatedSheet{std::make_shared<PerforatedScreen const>(
        OpacityTile(pitch, pitch, texels, texels, opacity), Sheet{.thickness = 0.0})});
    made.scene.add(screen);
    each_sun([&](FacadeSun const& sun) {
      double const whole = 64 * pitch * pitch * sun.cosine();
      made.views.push_back({window, sun.direction(), whole, {}, {whole * open / texels}});
    });
  }
  return made;
}

// A blind from the left and one from above, which each have a schedule.
ClosedForm scheduled_blinds() {
  ClosedForm made{"transmittance schedules", {}, {0.3, 0.7}, {}};
  constexpr double side = 2.0;
  constexpr double distance = 0.15;
  for (int i = 0; i < buildings; ++i) {
    Site const site(apart * i);
    double const right = 0.4 + 0.15 * i;
    double const bottom = 1.6 - 0.12 * i;
    SurfaceId const window = made.scene.add({"window", site.facade(0, 0, 0, side, side)});
    Surface from_left{"left", site.facade(-20, -distance, -20, right + 20, 60)};
    from_left.filter.schedule = 0;
    Surface from_above{"above", site.facade(-20, -2 * distance, bottom, 60, 60)};
    from_above.filter.schedule = 1;
    made.scene.add(from_left);
    made.scene.add(from_above);
    each_sun([&](FacadeSun const& sun) {
      double const left = overlap(0.0, right - distance * sun.sideways(), side) / side;
      double const above = overlap(bottom - 2 * distance * sun.upwards(), side, side) / side;
      double const whole = side * side * sun.cosine();
      double const lit =
          (1.0 - left * (1.0 - made.factors[0])) * (1.0 - above * (1.0 - made.factors[1]));
      made.views.push_back({window, sun.direction(), whole, {}, {whole * lit}});
    });
  }
  return made;
}

// Spheres of leaves before walls that take all of their shadows: the mean over the chords of a
// disc, whatever the direction.
ClosedForm crowns() {
  ClosedForm made{"tree crowns", {}, {}, {}};
  for (int i = 0; i < buildings; ++i) {
    double const radius = 1.0 + 0.2 * i;
    double const density = 0.3 + 0.2 * i;
    Site const site(apart * i);
    SurfaceId const wall = made.scene.add(
        {"wall", site.facade(-6 * radius, 0, -9 * radius, 12 * radius, 14 * radius)});
    Surface crown{"crown", site.level(-radius, -2.3 * radius, -radius, 2.0 * radius, 2.0 * radius)};
    crown.filter.set(Crown{.height = 2.0 * radius, .leaf_density = density});
    made.scene.add(crown);
    double const k = density * radius;
    double const stopped = std::numbers::pi * radius * radius *
                           (1.0 - 2.0 * (1.0 - (1.0 + k) * std::exp(-k)) / (k * k));
    each_sun([&](FacadeSun const& sun) {
      double const whole = 12.0 * 14.0 * radius * radius * sun.cosine();
      made.views.push_back({wall, sun.direction(), whole, {}, {whole - stopped}});
    });
  }
  return made;
}

// A room, and a window in its facade.
struct Room {
  double width = 4.0;
  double depth = 5.0;
  double height = 3.0;
  double left = 0.5;  // of the window
  double right = 3.0;
  double sill = 0.8;
  double head = 2.6;

  // Window areas through which the sun falls on the floor, the back wall, and the walls on the left
  // and on the right. On each vertical line of the window, the floor is hit below a height, and
  // above it the wall that the line's rays meet first.
  std::array<double, 4> patches(FacadeSun const& sun) const {
    // Inwards, rays go down, and away from the sun.
    double const slope = -sun.sideways();
    std::array<double, 4> areas{};
    auto const add = [&](double begin, double end, std::size_t wall) {
      // The midpoint rule, with 1e-6 of the window where the height has a bend.
      constexpr int lines = 4000;
      double const step = (end - begin) / lines;
      for (int i = 0; i < lines; ++i) {
        double const x = begin + (i + 0.5) * step;
        double const reach = wall == 1 ? depth : (slope < 0.0 ? x : width - x) / std::abs(slope);
        double const limit = std::clamp(reach * sun.upwards(), sill, head);
        areas[0] += (limit - sill) * step;
        areas.at(wall) += (head - limit) * step;
      }
    };
    // Rays from one side of the corner's line reach the back wall, and the others a side wall.
    if (slope < 0.0) {
      double const corner = std::clamp(-slope * depth, left, right);
      add(left, corner, 2);
      add(corner, right, 1);
    } else {
      double const corner = std::clamp(width - slope * depth, left, right);
      add(left, corner, 1);
      add(corner, right, 3);
    }
    return areas;
  }
};

// Rooms of several depths, whose windows may be behind a pane.
ClosedForm rooms(bool glazed) {
  ClosedForm made{glazed ? "interiors behind shades" : "interiors", {}, {}, {}};
  for (int i = 0; i < buildings / 2; ++i) {
    Site const site(apart * i);
    Room const room{.depth = 3.0 + i};
    double const wide = room.right - room.left;
    double const tall = room.head - room.sill;
    SurfaceId const window =
        made.scene.add({"window", site.facade(room.left, 0, room.sill, wide, tall)});
    std::vector<SurfaceId> const inside{
        made.scene.add({"floor", site.level(0, 0, 0, room.width, room.depth)}),
        made.scene.add({"back", site.facade(0, room.depth, 0, room.width, room.height)}),
        made.scene.add({"left", site.side(0, 0, 0, room.depth, room.height)}),
        made.scene.add({"right", site.side(room.width, 0, 0, room.depth, room.height)}),
    };
    if (glazed) {
      Surface pane{"pane", site.facade(-20, -0.05, -20, 60, 60)};
      pane.filter.set(AngularTransmittance{panes()});
      made.scene.add(pane);
    }
    each_sun([&](FacadeSun const& sun) {
      double const tau = glazed ? through_panes(sun.cosine()) : 1.0;
      std::vector<double> exact;
      for (double const patch : room.patches(sun)) exact.push_back(patch * sun.cosine() * tau);
      made.views.push_back(
          {window, sun.direction(), wide * tall * sun.cosine(), inside, std::move(exact)});
    });
  }
  return made;
}

}  // namespace

std::vector<ClosedForm> closed_forms() {
  return {overhangs_and_fins(), panes_before_windows(),
          perforated_sheets(),  images(),
          scheduled_blinds(),   crowns(),
          rooms(false),         rooms(true)};
}

}  // namespace gpu_shading

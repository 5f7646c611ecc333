#include "support/regular_shades.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "gpu_shading/transmittance.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

// Of a blade, in pitches: its depth away from the receiver, and how far its outer edge is up or to
// the left.
constexpr double depth = 0.6;
constexpr double rise = 0.25;
// Of the blades' inner edges from the receiver, in widths of it.
constexpr double distance = 0.05;

}  // namespace

Scene RegularShades::scene() const {
  Scene scene;
  scene.add({"receiver", south_facing(0, 0, 0, width(), height())});
  double const reach = size;
  double const y = -distance * size;
  for (int i = 0; i < count; ++i) {
    double const place = (i + 0.5) * pitch();
    Polygon const blade = upright ? parallelogram({place, y, -reach}, {0, 0, height() + 2 * reach},
                                                  {-rise * pitch(), -depth * pitch(), 0})
                                  : parallelogram({-reach, y, place}, {width() + 2 * reach, 0, 0},
                                                  {0, -depth * pitch(), rise * pitch()});
    Surface surface{"blade", blade};
    if (transmittance > 0.0) {
      surface.filter.set(AngularTransmittance{
          std::make_shared<Transmittance const>(Transmittance::constant(transmittance))});
    }
    scene.add(surface);
  }
  return scene;
}

double RegularShades::sunlit_fraction(SunDirection sun) const {
  // Towards the sun: east, south, up.
  double const east = std::sin(sun.azimuth) * std::cos(sun.altitude);
  double const south = -std::cos(sun.azimuth) * std::cos(sun.altitude);
  double const across = (upright ? east : std::sin(sun.altitude)) / south;
  double const whole = upright ? width() : height();
  // Positions of their edges, and whether a shadow begins there.
  std::vector<std::pair<double, int>> edges;
  for (int i = 0; i < count; ++i) {
    double const inner = (i + 0.5) * pitch() - across * distance * size;
    double const outer = inner + (upright ? -rise : rise) * pitch() - across * depth * pitch();
    edges.emplace_back(std::clamp(std::min(inner, outer), 0.0, whole), 1);
    edges.emplace_back(std::clamp(std::max(inner, outer), 0.0, whole), -1);
  }
  std::sort(edges.begin(), edges.end());
  double lit = 0.0;
  double from = 0.0;
  int over = 0;
  for (auto const& [place, change] : edges) {
    if (place > from) lit += (place - from) * std::pow(transmittance, over);
    from = place;
    over += change;
  }
  return (lit + whole - from) / whole;
}

std::vector<SunDirection> spread_suns(int count) {
  // By powers of the plastic number (Roberts' R2 sequence).
  std::vector<SunDirection> suns;
  for (int i = 1; i <= count; ++i) {
    double const azimuth = std::fmod(0.7548776662466927 * i, 1.0);
    double const altitude = std::fmod(0.5698402909980532 * i, 1.0);
    suns.push_back(sun_at(115 + 130 * azimuth, 5 + 65 * altitude));
  }
  return suns;
}

std::vector<int> blade_counts(int least, int most, double step, bool hundreds) {
  std::set<int> counts;
  for (double count = least; count <= most; count *= step) counts.insert(static_cast<int>(count));
  for (int power = 1; power <= most; power *= 2) {
    if (power >= least) counts.insert(power);
  }
  for (int count = 100; hundreds && count <= most; count += 100) {
    if (count >= least) counts.insert(count);
  }
  return {counts.begin(), counts.end()};
}

}  // namespace gpu_shading

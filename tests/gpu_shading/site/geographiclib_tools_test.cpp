// Against GeographicLib's own command-line tools, run as programs.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "gpu_shading/local_axes.h"
#include "gpu_shading/map_coordinates.h"

namespace gpu_shading {
namespace {

// The numbers that a command prints.
std::vector<double> output_of(std::string const& command) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> const pipe(popen(command.c_str(), "r"), &pclose);
  std::string text;
  std::array<char, 4096> buffer{};
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) {
    text += buffer.data();
  }
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double value = 0.0; stream >> value;) numbers.push_back(value);
  return numbers;
}

template <typename... Values>
std::string line(Values... values) {
  std::ostringstream text;
  text.precision(17);
  ((text << values << ' '), ...);
  return text.str();
}

TEST(GeographicLibTools, CartConvertHasTheSameLocalAxes) {
  if (std::string(CART_CONVERT).empty()) GTEST_SKIP() << "CartConvert is not installed";
  std::mt19937 random(1);
  auto const draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<GeographicPoint> origins{{40.0, -105.25, 1600.0},
                                       {-16.8, 179.9999, 3.0},
                                       {90.0, 30.0, 0.0},
                                       {-89.9999, -170.0, 2800.0},
                                       {0.0, 0.0, 0.0}};
  for (auto const& origin : origins) {
    LocalAxes const axes(origin);
    std::vector<GeographicPoint> places;
    std::string input;
    for (int i = 0; i < 50; ++i) {
      // Within 40 km, on whichever side of the antimeridian or of the pole.
      places.push_back(axes.to_geographic({draw(-3e4, 3e4), draw(-3e4, 3e4), draw(-200.0, 3e3)}));
      auto const& place = places.back();
      input += line(place.latitude, place.longitude, place.elevation) + "\\n";
    }
    auto const expected = output_of("printf '%b' '" + input + "' | " CART_CONVERT " -p 9 -l " +
                                    line(origin.latitude, origin.longitude, origin.elevation));
    ASSERT_EQ(expected.size(), 3 * places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      glm::dvec3 const there(expected[3 * i], expected[3 * i + 1], expected[3 * i + 2]);
      EXPECT_NEAR(glm::distance(axes.to_local(places[i]), there), 0.0, 1e-6);
      // Within 40 km of the origin at all: the way there was right too.
      EXPECT_LT(glm::length(there), 5e4);
    }
  }
}

TEST(GeographicLibTools, GeoConvertHasTheSameUtmAndConvergence) {
  if (std::string(GEO_CONVERT).empty()) GTEST_SKIP() << "GeoConvert is not installed";
  std::vector<std::pair<char const*, MapPoint>> const points{
      {"33N", {700000.0, 5600000.0}}, {"33N", {500000.0, 0.0}},      {"60S", {833000.0, 8142000.0}},
      {"1S", {167000.0, 8142000.0}},  {"32V", {0.0, 0.0}},           {"18N", {583960.0, 4507523.0}},
      {"31N", {166021.4, 9300000.0}}, {"56S", {334000.0, 6252000.0}}};
  for (auto const& [zone, point] : points) {
    if (std::string(zone) == "32V") {  // a latitude band is no hemisphere
      EXPECT_ANY_THROW(MapCoordinates::parse(zone));
      continue;
    }
    auto const utm = MapCoordinates::parse(std::string("UTM ") + zone);
    auto const input =
        std::string("echo '") + zone + " " + line(point.x, point.y) + "' | " GEO_CONVERT;
    auto const degrees = output_of(input + " -g -p 9");
    ASSERT_EQ(degrees.size(), 2U) << zone;
    auto const place = utm.to_geographic(point);
    EXPECT_NEAR(place.latitude, degrees[0], 1e-12);
    EXPECT_NEAR(place.longitude, degrees[1], 1e-12);
    auto const convergence = output_of(input + " -c -p 5");
    ASSERT_EQ(convergence.size(), 2U) << zone;  // convergence and scale
    EXPECT_NEAR(utm.convergence(point), convergence[0], 1e-8);
  }
}

}  // namespace
}  // namespace gpu_shading

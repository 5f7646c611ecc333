#include "gpu_shading/map_coordinates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gpu_shading/error.h"
#include "support/degree.h"

namespace gpu_shading {
namespace {

TEST(MapCoordinates, NamesOfWhatTheyAre) {
  for (char const* text : {"WGS84", "wgs 84", "EPSG:4326", "urn:ogc:def:crs:OGC:1.3:CRS84"}) {
    EXPECT_EQ(MapCoordinates::parse(text).name(), "WGS84") << text;
  }
  for (char const* text :
       {"UTM 33N", "utm33n", "33N", "EPSG:32633", "urn:ogc:def:crs:EPSG::32633"}) {
    EXPECT_EQ(MapCoordinates::parse(text).name(), "UTM 33N") << text;
  }
  EXPECT_EQ(MapCoordinates::parse("EPSG:32760").name(), "UTM 60S");
  EXPECT_EQ(MapCoordinates::parse("EPSG:32661").name(), "UPS N");
  for (char const* text :
       {"", "33", "UTM 61N", "EPSG:3857", "EPSG:25833", "Gauss-Krueger", "EPSG:"}) {
    EXPECT_THROW(MapCoordinates::parse(text), Error) << text;
  }
}

TEST(MapCoordinates, CentralMeridianOfAZone) {
  // Zone 33 has its middle at 15 E, 500 km east; there grid north is true north, and metres are
  // 0.9996 of metres (Snyder 1987, Map Projections, p. 57).
  auto const zone = MapCoordinates::parse("UTM 33N");
  auto const middle = zone.to_geographic({500000.0, 5000000.0}, 12.0);
  EXPECT_NEAR(middle.longitude, 15.0, 1e-12);
  EXPECT_EQ(middle.elevation, 12.0);
  EXPECT_NEAR(zone.convergence({500000.0, 5000000.0}), 0.0, 1e-12);
  EXPECT_NEAR(zone.to_geographic({500000.0, 0.0}).latitude, 0.0, 1e-12);
  LocalAxes const axes(zone.to_geographic({500000.0, 0.0}));
  EXPECT_NEAR(axes.to_local(zone.to_geographic({501000.0, 0.0})).x, 1000.0 / 0.9996, 1e-3);
}

TEST(MapCoordinates, ConvergenceTurnsTheGrid) {
  auto const zone = MapCoordinates::parse("UTM 33N");
  MapPoint const origin{700000.0, 5600000.0};
  auto const place = zone.to_geographic(origin);
  // On the sphere tan(convergence) = tan(longitude from the middle) sin(latitude) (Snyder 1987, eq.
  // 8-9); the ellipsoid changes it by less than 0.01 degrees.
  double const expected =
      std::atan(std::tan((place.longitude - 15.0) * degree) * std::sin(place.latitude * degree)) /
      degree;
  EXPECT_NEAR(zone.convergence(origin), expected, 0.01);
  EXPECT_GT(expected, 2.0);
  // 1 km along grid north goes east of true north by as much.
  LocalAxes const axes(place);
  auto const north = axes.to_local(zone.to_geographic({origin.x, origin.y + 1000.0}));
  EXPECT_NEAR(std::atan2(north.x, north.y) / degree, zone.convergence(origin), 1e-3);
  EXPECT_EQ(MapCoordinates().convergence({15.0, 50.0}), 0.0);
}

TEST(MapCoordinates, BackToTheMap) {
  auto const zone = MapCoordinates::parse("UTM 1S");
  MapPoint const point{312345.0, 6123456.0};
  auto const back = zone.from_geographic(zone.to_geographic(point));
  EXPECT_NEAR(back.x, point.x, 1e-6);
  EXPECT_NEAR(back.y, point.y, 1e-6);
  // A zone goes on across the equator, southern northings beyond 10,000 km.
  auto const across = zone.from_geographic({0.5, -177.0});
  EXPECT_GT(across.y, 10000000.0);
  EXPECT_NEAR(zone.to_geographic(across).latitude, 0.5, 1e-9);

  auto const turned = MapCoordinates().from_geographic({10.0, -179.5, 0.0}, 179.9);
  EXPECT_EQ(turned.x, 180.5);
  EXPECT_EQ(turned.y, 10.0);
}

TEST(MapCoordinates, RefusesWhatIsNotOnTheMap) {
  EXPECT_THROW(MapCoordinates().to_geographic({450000.0, 5200000.0}), Error);
  EXPECT_THROW(MapCoordinates().to_geographic({8.5, 90.5}), Error);
  EXPECT_THROW(MapCoordinates().to_geographic({std::nan(""), 5.0}), Error);
  auto const zone = MapCoordinates::parse("UTM 33N");
  EXPECT_THROW(zone.to_geographic({15.0e6, 48.0}), Error);
  EXPECT_THROW(zone.to_geographic({std::nan(""), 48.0}), Error);
}

}  // namespace
}  // namespace gpu_shading

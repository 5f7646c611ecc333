#include "gpu_shading/map_coordinates.h"

#include <fmt/format.h>

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

using GeographicLib::UTMUPS;

constexpr double turn = 360.0;

std::string without_blanks(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0 || c == '_'; });
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

// The number at the end of "EPSG:32633" or "URN:OGC:DEF:CRS:EPSG::32633".
std::optional<int> epsg_code(std::string_view text) {
  if (text.find("EPSG") == std::string_view::npos) return std::nullopt;
  auto const digits = text.substr(text.find_last_not_of("0123456789") + 1);
  int code = 0;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code);
  return error == std::errc{} ? std::optional(code) : std::nullopt;
}

}  // namespace

MapCoordinates MapCoordinates::parse(std::string const& text) {
  auto const plain = without_blanks(text);
  auto const refuse = [&] {
    return Error(fmt::format(
        "\"{}\", expected WGS84, a UTM zone (UTM 33N) or its EPSG code (EPSG:32633)", text));
  };
  if (plain == "WGS84" || plain.ends_with("CRS84")) return {};
  Zone zone;
  if (auto const code = epsg_code(plain)) {
    constexpr int wgs84 = 4326;
    if (*code == wgs84) return {};
    UTMUPS::DecodeEPSG(*code, zone.number, zone.north);
    if (zone.number == UTMUPS::INVALID) throw refuse();
  } else {
    try {
      UTMUPS::DecodeZone(plain.starts_with("UTM") ? plain.substr(3) : plain, zone.number,
                         zone.north);
    } catch (GeographicLib::GeographicErr const&) {
      throw refuse();
    }
    if (zone.number == UTMUPS::INVALID) throw refuse();
  }
  MapCoordinates coordinates;
  coordinates.zone_ = zone;
  return coordinates;
}

std::string MapCoordinates::name() const {
  if (!zone_) return "WGS84";
  char const hemisphere = zone_->north ? 'N' : 'S';
  if (zone_->number == UTMUPS::UPS) return fmt::format("UPS {}", hemisphere);
  return fmt::format("UTM {}{}", zone_->number, hemisphere);
}

GeographicPoint MapCoordinates::to_geographic(MapPoint const& point, double elevation) const {
  if (zone_) {
    GeographicPoint position{0.0, 0.0, elevation};
    try {
      UTMUPS::Reverse(zone_->number, zone_->north, point.x, point.y, position.latitude,
                      position.longitude);
    } catch (GeographicLib::GeographicErr const&) {
      throw Error(
          fmt::format("easting {} m, northing {} m are not in {}", point.x, point.y, name()));
    }
    // It returns NaN for NaN.
    if (std::isfinite(position.latitude)) return position;
  } else if (std::abs(point.y) <= 90.0 && std::abs(point.x) <= 2.0 * turn) {
    return {point.y, point.x, elevation};
  }
  if (zone_) {
    throw Error(fmt::format("easting {} m, northing {} m are not in {}", point.x, point.y, name()));
  }
  throw Error(fmt::format(
      "longitude {}, latitude {} are not WGS84 degrees (UTM coordinates need their zone)", point.x,
      point.y));
}

MapPoint MapCoordinates::from_geographic(GeographicPoint const& point, double near_x) const {
  if (!zone_) {
    return {point.longitude + turn * std::round((near_x - point.longitude) / turn), point.latitude};
  }
  MapPoint position;
  int zone = 0;
  bool north = false;
  double convergence = 0.0;
  double scale = 0.0;
  try {
    UTMUPS::Forward(point.latitude, point.longitude, zone, north, position.x, position.y,
                    convergence, scale, zone_->number);
  } catch (GeographicLib::GeographicErr const&) {
    throw Error(fmt::format("latitude {}, longitude {} is too far from {}", point.latitude,
                            point.longitude, name()));
  }
  // Across the equator, northings continue in the file's own hemisphere.
  if (north != zone_->north) position.y += (north ? 1.0 : -1.0) * UTMUPS::UTMShift();
  return position;
}

double MapCoordinates::convergence(MapPoint const& point) const {
  if (!zone_) return 0.0;
  double latitude = 0.0;
  double longitude = 0.0;
  double gamma = 0.0;
  double scale = 0.0;
  UTMUPS::Reverse(zone_->number, zone_->north, point.x, point.y, latitude, longitude, gamma, scale);
  return gamma;
}

}  // namespace gpu_shading

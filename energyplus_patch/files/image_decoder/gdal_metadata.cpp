#include "files/image_decoder/gdal_metadata.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "files/decoding/fail.h"

namespace gpu_shading::decoding {
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  auto const first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// The value of an attribute, as in <Item name="SCALE" sample="0" role="scale">.
std::optional<std::string_view> attribute(std::string_view tag, std::string_view name) {
  std::size_t at = tag.find_first_of(blanks);
  while (at != std::string_view::npos) {
    auto const equals = tag.find('=', at);
    if (equals == std::string_view::npos) break;
    auto const quote = tag.find_first_of("\"'", equals);
    if (quote == std::string_view::npos) break;
    auto const end = tag.find(tag[quote], quote + 1);
    if (end == std::string_view::npos) break;
    if (trimmed(tag.substr(at, equals - at)) == name) {
      return tag.substr(quote + 1, end - quote - 1);
    }
    at = end + 1;
  }
  return std::nullopt;
}

double finite(std::string const& field, std::string_view text) {
  double const value = parse_gdal_number(field, text);
  if (!std::isfinite(value)) fail("its " + field + " is not finite");
  return value;
}

}  // namespace

double parse_gdal_number(std::string const& field, std::string_view text) {
  auto number = trimmed(text);
  // from_chars does not accept a plus sign.
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0.0;
  auto const* const end = number.data() + number.size();
  auto const [stop, error] = std::from_chars(number.data(), end, value);
  if (number.empty() || error != std::errc{} || stop != end) {
    constexpr std::size_t most_shown = 40;
    fail("its " + field + " is \"" + std::string(text.substr(0, most_shown)) +
         "\", expected a number");
  }
  return value;
}

GdalMetadata parse_gdal_metadata(std::string_view xml) {
  GdalMetadata metadata;
  constexpr std::string_view start = "<Item";
  for (auto at = xml.find(start); at != std::string_view::npos; at = xml.find(start, at + 1)) {
    auto const end = xml.find('>', at);
    if (end == std::string_view::npos) fail("its GDAL_METADATA is cut off");
    auto const tag = xml.substr(at, end - at);
    auto const role = attribute(tag, "role");
    if (!role || attribute(tag, "sample") != "0") continue;
    auto const text = xml.substr(end + 1, xml.find('<', end) - end - 1);
    if (role == "scale") metadata.scale = finite("GDAL SCALE", text);
    if (role == "offset") metadata.offset = finite("GDAL OFFSET", text);
    if (role == "unittype") metadata.unit = trimmed(text);
  }
  if (metadata.scale == 0.0) fail("its GDAL SCALE is 0, expected a number other than 0");
  return metadata;
}

}  // namespace gpu_shading::decoding

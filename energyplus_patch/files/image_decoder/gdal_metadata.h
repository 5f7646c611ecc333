#pragma once

#include <string>
#include <string_view>

namespace gpu_shading::decoding {

// What GDAL's tag GDAL_METADATA (42112) says of the first channel: its value is
// scale * stored + offset, in the unit.
struct GdalMetadata {
  double scale = 1.0;
  double offset = 0.0;
  std::string unit;  // as written; "": not stated
};

// Parses XML as GDAL writes it. Throws std::runtime_error if SCALE or OFFSET is not a finite number
// or SCALE is 0.
GdalMetadata parse_gdal_metadata(std::string_view xml);

// A number and nothing else but blanks: "-9999", "nan", "-inf". Throws std::runtime_error with the
// name of the field.
double parse_gdal_number(std::string const& field, std::string_view text);

}  // namespace gpu_shading::decoding

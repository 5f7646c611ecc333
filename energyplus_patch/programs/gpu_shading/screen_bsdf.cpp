#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/text.h"
#include "programs/gpu_shading/screen_files.h"

namespace gpu_shading::energyplus {
namespace {

constexpr double full_turn = 360.0;

// Patches between two angles from the normal, degrees.
struct PatchRow {
  double theta;
  double lower;
  double upper;
  int patches;
};

constexpr std::array<PatchRow, 9> klems_full{{{0.0, 0.0, 5.0, 1},
                                              {10.0, 5.0, 15.0, 8},
                                              {20.0, 15.0, 25.0, 16},
                                              {30.0, 25.0, 35.0, 20},
                                              {40.0, 35.0, 45.0, 24},
                                              {50.0, 45.0, 55.0, 24},
                                              {60.0, 55.0, 65.0, 24},
                                              {70.0, 65.0, 75.0, 16},
                                              {82.5, 75.0, 90.0, 12}}};

std::size_t patch_count() {
  std::size_t count = 0;
  for (auto const& row : klems_full) count += static_cast<std::size_t>(row.patches);
  return count;
}

double squared_sine(double degrees) {
  double const sine = std::sin(glm::radians(degrees));
  return sine * sine;
}

// In steradians.
double projected_solid_angle(PatchRow const& row) {
  return std::numbers::pi * (squared_sine(row.upper) - squared_sine(row.lower)) / row.patches;
}

// Mean of tau over the projected solid angle of a patch: evenly over azimuths and squared sines.
double mean_transmittance(PerforatedScreen const& screen, double rotation, PatchRow const& row,
                          int patch) {
  constexpr int polar = 24;
  constexpr int around = 192;  // samples of a whole circle
  int const azimuths = std::max(around / row.patches, 8);
  double const low = squared_sine(row.lower);
  double const step = (squared_sine(row.upper) - low) / polar;
  double sum = 0.0;
  for (int i = 0; i < polar; ++i) {
    double const theta = glm::degrees(std::asin(std::sqrt(low + step * (i + 0.5))));
    for (int k = 0; k < azimuths; ++k) {
      double const azimuth = full_turn / row.patches * (patch - 0.5 + (k + 0.5) / azimuths);
      constexpr double half = full_turn / 2.0;
      sum += transmittance(screen, theta, half - azimuth - rotation);
    }
  }
  return sum / (polar * azimuths);
}

// The diagonal of the scattering matrix, 1/sr.
std::vector<double> diagonal(PerforatedScreen const& screen, double rotation) {
  std::vector<double> values;
  for (auto const& row : klems_full) {
    for (int patch = 0; patch < row.patches; ++patch) {
      values.push_back(mean_transmittance(screen, rotation, row, patch) /
                       projected_solid_angle(row));
    }
  }
  return values;
}

// The matrix with the values of a function of row and column.
template <typename Value>
std::string matrix_text(std::size_t size, Value const& value) {
  std::string text;
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column < size; ++column) {
      fmt::format_to(std::back_inserter(text), "{:.6g},", value(row, column));
    }
    text += '\n';
  }
  return text;
}

std::string transmission_text(PerforatedScreen const& screen, double rotation) {
  auto const values = diagonal(screen, rotation);
  return matrix_text(values.size(), [&](std::size_t row, std::size_t column) {
    return row == column ? values[row] : 0.0;
  });
}

std::string reflection_text(PerforatedScreen const& screen, double reflectance) {
  double const value = reflectance * (1.0 - screen.open_fraction()) / std::numbers::pi;
  return matrix_text(patch_count(), [&](std::size_t, std::size_t) { return value; });
}

void write_basis(std::ostream& xml) {
  xml << "<AngleBasis>\n<AngleBasisName>LBNL/Klems Full</AngleBasisName>\n";
  for (auto const& row : klems_full) {
    xml << fmt::format(
        "<AngleBasisBlock><Theta>{:g}</Theta><nPhis>{}</nPhis><ThetaBounds><LowerTheta>{:g}"
        "</LowerTheta><UpperTheta>{:g}</UpperTheta></ThetaBounds></AngleBasisBlock>\n",
        row.theta, row.patches, row.lower, row.upper);
  }
  xml << "</AngleBasis>\n";
}

void write_block(std::string_view wavelength, std::string const& direction,
                 std::string const& matrix, std::ostream& xml) {
  auto const* const type = direction.starts_with("Reflection") ? "BRDF" : "BTDF";
  xml << fmt::format(
      "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n"
      "<Wavelength unit=\"Integral\">{}</Wavelength>\n"
      "<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>\n"
      "<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>\n<WavelengthDataBlock>\n"
      "<WavelengthDataDirection>{}</WavelengthDataDirection>\n"
      "<ColumnAngleBasis>LBNL/Klems Full</ColumnAngleBasis>\n"
      "<RowAngleBasis>LBNL/Klems Full</RowAngleBasis>\n"
      "<ScatteringDataType>{}</ScatteringDataType>\n<ScatteringData>\n",
      wavelength, direction, type);
  xml << matrix << "</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>\n";
}

void write_head(PerforatedScreen const& screen, SheetReflectance const& reflectance,
                std::string const& name, std::string const& description, std::ostream& xml) {
  constexpr double millimetres = 1000.0;
  xml << fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- By gpu_shading screen.\n"
      "     Transmission: the beam that passes the holes straight on, away from the edges of the "
      "sheet.\n"
      "     Reflection: diffuse, of the solid share of the faces, {:.4f}, times their reflectance, "
      "{:g} (solar) and {:g} (visible).\n"
      "     Not included: light that the walls of holes reflect, and infrared properties. -->\n",
      1.0 - screen.open_fraction(), reflectance.solar, reflectance.visible);
  xml << "<WindowElement xmlns=\"http://windows.lbl.gov\" "
         "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
         "xsi:schemaLocation=\"http://windows.lbl.gov/BSDF-v1.7.xsd\">\n"
         "<WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n"
         "<Optical>\n<Layer>\n";
  xml << fmt::format(
      "<Material>\n<Name>{}</Name>\n<Manufacturer>{}</Manufacturer>\n"
      "<Thickness unit=\"Millimeter\">{:g}</Thickness>\n<DeviceType>Other</DeviceType>\n"
      "</Material>\n",
      markup_text(name), markup_text(description), millimetres * screen.sheet().thickness);
}

}  // namespace

void write_bsdf(PerforatedScreen const& screen, double rotation,
                SheetReflectance const& reflectance, std::string const& name,
                std::string const& description, std::ostream& xml) {
  write_head(screen, reflectance, name, description, xml);
  xml << "<DataDefinition>\n<IncidentDataStructure>Columns</IncidentDataStructure>\n";
  write_basis(xml);
  xml << "</DataDefinition>\n";
  auto const passed = transmission_text(screen, rotation);
  for (auto const& [wavelength, share] :
       {std::pair("Solar", reflectance.solar), std::pair("Visible", reflectance.visible)}) {
    auto const reflected = reflection_text(screen, share);
    for (auto const* const side : {"Front", "Back"}) {
      write_block(wavelength, fmt::format("Transmission {}", side), passed, xml);
      write_block(wavelength, fmt::format("Reflection {}", side), reflected, xml);
    }
  }
  xml << "</Layer>\n</Optical>\n</WindowElement>\n";
}

}  // namespace gpu_shading::energyplus

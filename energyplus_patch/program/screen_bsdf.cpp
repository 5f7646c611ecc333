#include "program/screen_bsdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <numbers>
#include <string_view>
#include <vector>

#include "base/markup_text.h"
#include "program/screen_optics.h"

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

double squared_sine(double degrees) {
  double const sine = std::sin(glm::radians(degrees));
  return sine * sine;
}

// Steradians, times the cosine.
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

// Of scattering, 1/sr, by patch.
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

std::string matrix_text(std::vector<double> const& values) {
  std::string text;
  for (std::size_t row = 0; row < values.size(); ++row) {
    for (std::size_t column = 0; column < values.size(); ++column) {
      if (column > 0) text += ',';
      if (row == column) {
        fmt::format_to(std::back_inserter(text), "{:.6g}", values[row]);
      } else {
        text += '0';
      }
    }
    text += ",\n";
  }
  return text;
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

void write_block(std::string_view wavelength, std::string_view direction, std::string const& matrix,
                 std::ostream& xml) {
  xml << fmt::format(
      "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n"
      "<Wavelength unit=\"Integral\">{}</Wavelength>\n"
      "<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>\n"
      "<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>\n<WavelengthDataBlock>\n"
      "<WavelengthDataDirection>{}</WavelengthDataDirection>\n"
      "<ColumnAngleBasis>LBNL/Klems Full</ColumnAngleBasis>\n"
      "<RowAngleBasis>LBNL/Klems Full</RowAngleBasis>\n"
      "<ScatteringDataType>BTDF</ScatteringDataType>\n<ScatteringData>\n",
      wavelength, direction);
  xml << matrix << "</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>\n";
}

}  // namespace

void write_bsdf(PerforatedScreen const& screen, double rotation, std::string const& name,
                std::string const& description, std::ostream& xml) {
  constexpr double millimetres = 1000.0;
  xml << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<!-- By gpu_shading screen. In it: the beam that passes the holes straight on, away from "
         "the edges of the sheet.\n     Not in it: what the sheet reflects, light that the walls "
         "of holes reflect, and the visible or infrared\n     properties of a material. -->\n"
         "<WindowElement xmlns=\"http://windows.lbl.gov\" "
         "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
         "xsi:schemaLocation=\"http://windows.lbl.gov/BSDF-v1.7.xsd\">\n"
         "<WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n"
         "<Optical>\n<Layer>\n<Material>\n";
  xml << fmt::format(
      "<Name>{}</Name>\n<Manufacturer>{}</Manufacturer>\n"
      "<Thickness unit=\"Millimeter\">{:g}</Thickness>\n<DeviceType>Other</DeviceType>\n",
      markup_text(name), markup_text(description), millimetres * screen.sheet().thickness);
  xml << "</Material>\n<DataDefinition>\n<IncidentDataStructure>Columns</IncidentDataStructure>\n";
  write_basis(xml);
  xml << "</DataDefinition>\n";
  auto const matrix = matrix_text(diagonal(screen, rotation));
  for (auto const* const wavelength : {"Solar", "Visible"}) {
    for (auto const* const direction : {"Transmission Front", "Transmission Back"}) {
      write_block(wavelength, direction, matrix, xml);
    }
  }
  xml << "</Layer>\n</Optical>\n</WindowElement>\n";
}

}  // namespace gpu_shading::energyplus

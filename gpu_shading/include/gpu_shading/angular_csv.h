#pragma once

#include <filesystem>

#include "gpu_shading/transmittance.h"

namespace gpu_shading {

// A table of angle and transmittance from a text file, separated by commas, semicolons, tabs or
// blanks. One of
//  - two columns, angle in degrees and transmittance, with or without a line of headings;
//  - several columns whose headings name an angle (Angle, Theta) and a transmittance (Tsol,
//    Transmittance, Tau);
//  - a line "Angle 0 10 20 ... 90 Hemis" and below it a line "Tsol ...", as in the reports of LBNL
//    WINDOW, whose other lines are passed over; of several glazing systems the first is taken.
// Throws Error, with the file and the line.
Transmittance read_angular_csv(std::filesystem::path const& path);

}  // namespace gpu_shading

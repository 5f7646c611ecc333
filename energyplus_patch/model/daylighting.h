#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// The types of objects for which EnergyPlus traces rays of daylighting.
inline constexpr std::array<std::string_view, 4> daylighting_types{
    "Daylighting:Controls", "Daylighting:DELight:ComplexFenestration", "DaylightingDevice:Tubular",
    "DaylightingDevice:Shelf"};

// Whether the model has any of them.
bool has_daylighting(std::vector<InputObject> const& objects);

// Whether all rays of daylighting go through functions that this module can answer: not with
// DElight, which is a program of its own, nor with complex fenestration, whose rays EnergyPlus
// traces once when it starts.
bool daylighting_can_be_answered(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus

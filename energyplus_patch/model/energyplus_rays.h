#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

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

// EnergyPlus's own rays treat TransparentShades and PerforatedScreens as opaque, except for their
// Transmittance Schedules, which rays of solar reflections ignore too, and do not see Geometry and
// SiteContext. One warning for each pair of a user of rays (daylighting, solar reflections, complex
// fenestration) and a type of shade in the model, naming the objects. `opaque_to_daylight`: where
// rays of daylighting are answered, the surfaces of shades that are nevertheless in EnergyPlus's
// input, which one warning names.
std::vector<std::string> warn_of_rays(
    std::vector<InputObject> const& objects, ShadingInput const& input,
    std::optional<std::vector<std::string>> const& opaque_to_daylight = std::nullopt);

}  // namespace gpu_shading::energyplus

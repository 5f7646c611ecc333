#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/idf/placeholders.h"
#include "model/input/shading_input.h"
#include "model/options/options.h"

namespace gpu_shading::energyplus {

// EnergyPlus spends minutes on thousands of shading surfaces, whatever renders them. Those that it
// needs only for their shadows are removed from the input that it reads, and passed to the renderer
// directly from the model.
struct LeanInput {
  Names left_out;                // Shading:...:Detailed objects
  std::vector<Surface> casters;  // the same, with all vertices that the model gives them
  std::vector<Placeholder> placeholders;
  bool follows_sky = false;  // one of them is that of add_sky_placeholder()
  std::string remark;  // message for the user: what is left out, or why nothing is; "": no message

  bool active() const { return !left_out.empty(); }
  // Whether a surface is a placeholder or the mirrored copy of one.
  bool is_placeholder(std::string const& surface) const;
};

// With Lean::automatic, all surfaces are left out from this number on. Each costs EnergyPlus about
// 5 ms in a year's run, and the placeholders cost about as much as this many. Of fewer surfaces,
// only those are left out that EnergyPlus would simplify or refuse (Outline), or whose
// transmittance its rays would not see (EnergyPlusRays).
inline constexpr std::size_t fewest_left_out = 100;
// With EnergyPlus's own solar reflections, it takes as long for 20 surfaces as for the
// placeholders, and for each more of them longer.
inline constexpr std::size_t fewest_with_reflections = 20;

// Whether so many surfaces may be left out that EnergyPlus's own solar reflections take too long.
bool has_many_for_reflections(std::vector<InputObject> const& objects, Lean lean);

// Effects of EnergyPlus's own rays on lean input.
struct EnergyPlusRays {
  // Whether rays of daylighting are also shaded by surfaces that are left out of EnergyPlus's
  // input.
  bool daylighting_answered = false;
  // Surfaces to leave out in any case, because the rays would treat them as opaque. Upper case.
  Names transmitting = {};
};

// A surface is kept if another object or output names it, or if one of its fields cannot be
// interpreted. All are kept if the model needs the surfaces themselves (complex fenestration, the
// external shading file, plugins, EnergyPlus's solar reflections, daylighting unless its rays are
// answered), or if its geometry is changed in ways that are not supported here
// (reason_against_outlines).
LeanInput plan_lean_input(std::vector<InputObject> const& objects, ShadingInput const& input,
                          Options const& options, EnergyPlusRays const& rays,
                          MentionFinder const& find_mentions);

// Adds placeholders for casters that EnergyPlus does not know, unless there are some already.
void ensure_placeholders(LeanInput& lean, ShadingInput const& input);

// Adds the placeholder that makes EnergyPlus follow moving screens (make_sky_placeholder).
void add_sky_placeholder(LeanInput& lean, ShadingInput const& input);

}  // namespace gpu_shading::energyplus

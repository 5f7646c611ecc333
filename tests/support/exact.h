#pragma once

#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

// Sunlit areas by exact polygon clipping (polyclipping, a Vatti clipper on 64-bit integers of 10
// nm), independent of the library: polygons are clipped at the receiver's plane, projected along
// the sun in double precision, and combined there.
namespace gpu_shading::exact {

// The receiver's area that no other surface of the scene hides, m2 normal to the beam, each part
// times the transmittance of the shades over it, with schedules by their factors: an overlay of all
// shades.
double projected_sunlit_area(Scene const& scene, SunDirection sun, SurfaceId receiver,
                             std::span<double const> factors = {});

// The same without any caster, from its area: 0 if it faces away.
double projected_area(Scene const& scene, SunDirection sun, SurfaceId receiver);

// The area of each of `interiors` that the sun lights through the window, m2 normal to the beam.
// They must be in order from the nearest, none in front of an earlier one. Surfaces behind the
// window's plane cast nothing on it.
std::vector<double> interior_areas(Scene const& scene, SunDirection sun, SurfaceId window,
                                   std::vector<SurfaceId> const& interiors,
                                   std::span<double const> factors = {});

// The area of the shadow that one caster throws on the receiver, m2 normal to the beam.
double shadow_area(Scene const& scene, SunDirection sun, SurfaceId receiver, SurfaceId caster);

}  // namespace gpu_shading::exact

#pragma once

#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

// Sunlit areas by exact polygon clipping (polyclipping, a Vatti clipper on 64-bit integers of 10
// nm), written apart from the library: polygons are cut at the receiver's plane, projected along
// the sun in double precision and combined there.
namespace gpu_shading::exact {

// m2 normal to the beam of the receiver that no other surface of the scene hides, each part of it
// times what the shades over it let through, schedules by their factors: an overlay of them all.
double projected_sunlit_area(Scene const& scene, SunDirection sun, SurfaceId receiver,
                             std::span<double const> factors = {});

// The same before anything shades it, from its area: 0 where it is turned away.
double projected_area(Scene const& scene, SunDirection sun, SurfaceId receiver);

// m2 normal to the beam that each of `interiors` gets through the window. They come nearest first:
// no one may stand in front of one before it. Surfaces behind the window's plane cast nothing on
// it.
std::vector<double> interior_areas(Scene const& scene, SunDirection sun, SurfaceId window,
                                   std::vector<SurfaceId> const& interiors,
                                   std::span<double const> factors = {});

// m2 normal to the beam of the shadow that one caster throws on the receiver.
double shadow_area(Scene const& scene, SunDirection sun, SurfaceId receiver, SurfaceId caster);

}  // namespace gpu_shading::exact

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/transmittance.h"

// What the functions share that libgpu_shading_python.so exports, for the Python package beside
// this file: a C interface, so that one library serves every version of Python. Units and axes are
// those of the public headers: metres, radians, x east, y north, z up.
//
// Functions return a Status; after any but `ok`, gpu_shading_message() says why in one line. Arrays
// are dense and row by row, and must outlive the call. The caller has checked that numbers are
// finite. Functions that create an object set their argument `made` to it; it is given back to
// those that release it, which take a null pointer too.

#define GPU_SHADING_CALL extern "C" __attribute__((visibility("default")))

namespace gpu_shading::python {

enum Status : int {
  ok = 0,
  invalid = 1,     // an Error: a value that is refused
  device = 2,      // a DeviceError
  memory = 3,      // no memory is left
  unforeseen = 4,  // any other exception
  closed = 5       // the call came after gpu_shading_close()
};

struct FilterObject {
  FilterFactor factor;
};

struct ScreenObject {
  std::shared_ptr<PerforatedScreen const> screen;
};

struct SceneObject {
  Scene scene;
};

// Enumerators are passed by their numbers, in the order of the public headers.
struct SurfaceRecord {
  char const* name;
  double const* vertices;         // x, y, z of all rings: first the outline, then the holes
  std::size_t const* ring_sizes;  // vertices of each ring
  std::size_t rings;              // 1 or more
  int casting;                    // of Casting
  FilterObject const* filter;     // or null
  int schedule;                   // or -1
  ScreenObject const* screen;     // or null
  double origin_u;
  double origin_v;
  double rotation;
  int deployment;  // or -1
};

struct SheetRecord {
  double thickness;
  int plane;   // of SheetPlane
  int layers;  // 0: as many as needed
  int detail;  // of ScreenDetail
};

// What varies with time: rows x columns, where there is one row for all directions, or one for
// each.
struct FactorTable {
  double const* values;
  std::size_t rows;
  std::size_t columns;
};

struct RayRecord {
  double const* origins;     // rays x 3
  double const* directions;  // rays x 3
  double const* lengths;     // rays, or null: infinite
  std::size_t rays;
  std::int64_t receiver;  // or -1
  std::uint32_t const* excluded;
  std::size_t excluded_count;
  double const* factors;
  std::size_t factor_count;
  double const* deployments;
  std::size_t deployment_count;
};

}  // namespace gpu_shading::python

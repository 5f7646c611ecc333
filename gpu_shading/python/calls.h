#pragma once

#include <cstddef>
#include <cstdint>

// The functions that libgpu_shading_python.so exports, for the Python package beside this file: a C
// interface, so that one library serves every version of Python. Units and axes are those of the
// public headers: metres, radians, x east, y north, z up.
//
// Functions return a Status; after any but `ok`, gpu_shading_message() says why in one line. Arrays
// are dense and row by row, and must outlive the call. The caller has checked that numbers are
// finite. Objects come from the functions that create them and are given back to those that release
// them, which take a null pointer too.

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

struct FilterObject;
struct ScreenObject;
struct SceneObject;
struct RendererObject;
struct RaysObject;

// Enumerators are passed by their numbers, in the order of the public headers.
struct SurfaceRecord {
  char const* name;
  double const* vertices;         // x, y, z of all rings: first the outline, then the holes
  std::size_t const* ring_sizes;  // vertices of each ring
  std::size_t rings;              // 1 or more
  int casting;                    // of Casting
  FilterObject const* filter;     // a flat one, or null
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

// From the last function on this thread that failed, or that says that it leaves text here.
GPU_SHADING_CALL char const* gpu_shading_message();
// Waits until no function runs on any thread; from now on they return `closed`. A process that ends
// meanwhile would destroy what they use. A single call of gpu_shading_rays_... stops early.
GPU_SHADING_CALL void gpu_shading_close();
GPU_SHADING_CALL char const* gpu_shading_version();
GPU_SHADING_CALL int gpu_shading_limit_threads(int count);

// `made`, below, gets the new object.
GPU_SHADING_CALL int gpu_shading_transmittance_constant(double value, FilterObject** made);
GPU_SHADING_CALL int gpu_shading_transmittance_polynomial(double const* coefficients,
                                                          std::size_t count, int in_cosine,
                                                          FilterObject** made);
// Angles in degrees.
GPU_SHADING_CALL int gpu_shading_transmittance_table(double const* angles, double const* values,
                                                     std::size_t count, FilterObject** made);
// Layers: transmittance, front and back reflectance of each.
GPU_SHADING_CALL int gpu_shading_transmittance_glazing(double const* layers, std::size_t count,
                                                       FilterObject** made);
GPU_SHADING_CALL int gpu_shading_transmittance_simple_glazing(double u_factor, double shgc,
                                                              FilterObject** made);
GPU_SHADING_CALL int gpu_shading_transmittance_at(FilterObject const* object, double const* angles,
                                                  std::size_t count, double* results);
GPU_SHADING_CALL void gpu_shading_filter_release(FilterObject* object);

// Lengths: size, length, pitch, row pitch.
GPU_SHADING_CALL int gpu_shading_screen_pattern(int hole, int arrangement, double const* lengths,
                                                SheetRecord const* sheet, ScreenObject** made);
// Opacity: rows x columns of 0 .. 65535; a threshold that is not a number: none.
GPU_SHADING_CALL int gpu_shading_screen_tile(double width, double height, int columns, int rows,
                                             std::uint16_t const* opacity, double threshold,
                                             SheetRecord const* sheet, ScreenObject** made);
// Open fraction, size of a hole, width of a web.
GPU_SHADING_CALL int gpu_shading_screen_sizes(ScreenObject const* object, double* sizes);
// Patterns in closed form, tiles by ScreenTransmittance.
GPU_SHADING_CALL int gpu_shading_screen_tau(ScreenObject const* object, double const* thetas,
                                            double const* phis, std::size_t count, double* results);
GPU_SHADING_CALL void gpu_shading_screen_release(ScreenObject* object);

GPU_SHADING_CALL int gpu_shading_scene_new(SceneObject** made);
// Keeps what it needs of the transmittance and the screen.
GPU_SHADING_CALL int gpu_shading_scene_add(SceneObject* scene, SurfaceRecord const* surface);
// Roles: wall, zone, shades and target of each surface; zone_shades: zones x zones.
GPU_SHADING_CALL int gpu_shading_scene_set_rule(SceneObject* scene, std::uint32_t const* roles,
                                                std::size_t surfaces,
                                                std::uint8_t const* zone_shades, std::size_t zones);
// Net area (m2) times unit normal of each surface: surfaces x 3.
GPU_SHADING_CALL int gpu_shading_scene_areas(SceneObject const* scene, double* results);
// The corners of a surface's triangles: triangles x 3 x 3; nullptr: only their number.
GPU_SHADING_CALL int gpu_shading_scene_triangles(SceneObject const* scene, std::size_t surface,
                                                 double* corners, std::size_t* triangles);
GPU_SHADING_CALL void gpu_shading_scene_release(SceneObject* scene);

// Device: as parse_device_choice() reads it. Resolution 0: by the error. The scene is copied.
GPU_SHADING_CALL int gpu_shading_renderer_new(SceneObject const* scene, char const* device,
                                              int resolution, double error, RendererObject** made);
// Leaves the device's description in gpu_shading_message().
GPU_SHADING_CALL int gpu_shading_renderer_device(RendererObject const* renderer);
// Leaves the warnings since the last call in gpu_shading_message(), one a line.
GPU_SHADING_CALL int gpu_shading_renderer_warnings(RendererObject* renderer);
GPU_SHADING_CALL int gpu_shading_renderer_set_deployments(RendererObject* renderer,
                                                          double const* shares, std::size_t count);
// Suns: azimuth and altitude of each; results: projected areas (m2), directions x receivers.
GPU_SHADING_CALL int gpu_shading_renderer_sunlit(RendererObject* renderer, double const* suns,
                                                 std::size_t directions,
                                                 std::uint32_t const* receivers, std::size_t count,
                                                 FactorTable const* factors, double* results);
// The same of interior surfaces behind one window.
GPU_SHADING_CALL int gpu_shading_renderer_interior(RendererObject* renderer, double const* suns,
                                                   std::size_t directions, std::uint32_t window,
                                                   std::uint32_t const* interiors,
                                                   std::size_t count, FactorTable const* factors,
                                                   double* results);
GPU_SHADING_CALL void gpu_shading_renderer_release(RendererObject* renderer);

// Faces: of RayFaces; screens: of ScreenDetail.
GPU_SHADING_CALL int gpu_shading_rays_new(SceneObject const* scene, int faces, int screens,
                                          RaysObject** made);
GPU_SHADING_CALL int gpu_shading_rays_transmittance(RaysObject const* object, RayRecord const* rays,
                                                    double* results);
// Surface -1 and an infinite distance where nothing is met. `opaque`: only surfaces that let
// nothing of the ray pass.
GPU_SHADING_CALL int gpu_shading_rays_nearest(RaysObject const* object, RayRecord const* rays,
                                              int opaque, std::int64_t* surfaces,
                                              double* distances);
GPU_SHADING_CALL void gpu_shading_rays_release(RaysObject* object);

}  // namespace gpu_shading::python

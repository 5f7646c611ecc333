#pragma once

#include <cstddef>
#include <cstdint>

#include "backends/opengl/gl/buffer.h"

namespace gpu_shading::gl {

// Draws of the bound vertex array, and the state that they need. Every pass sets the state that it
// uses and relies on no earlier pass.

enum class Test { always, less };
enum class OnPass { keep, replace };

// Fragments that pass `test` of `reference` against the stencil (and the depth test) apply
// `on_pass` to it.
void stencil(Test test, std::uint8_t reference, OnPass on_pass);
void no_stencil();

void depth(Test test, bool write);
void no_depth();

void write_colour(bool on);

// How a fragment (R, G, B, A) changes the existing colour (r, g, b, a).
enum class Blend {
  replace,
  multiply,          // multiplies all by A
  multiply_and_add,  // multiplies a by A; adds R, G and B
};
void blend(Blend how);

void cut_at_plane(bool on);  // by gl_ClipDistance[0]

// Depth 0 is nearest and clip space z is 0 .. 1; z outside this range is not clipped.
void set_depth_convention();

// Draws instance `record` of the array's instance data.
void draw_indexed(std::size_t first, std::size_t count, std::uint32_t record);
void draw_indexed_fours(std::size_t first, std::size_t count,
                        std::uint32_t record);  // for a geometry stage
void draw_vertices(std::size_t first, std::size_t count);

// An indexed indirect draw command, in OpenGL's layout.
struct Command {
  std::uint32_t count = 0;
  std::uint32_t instances = 1;
  std::uint32_t first = 0;
  std::int32_t base_vertex = 0;
  std::uint32_t record = 0;
};
void draw_commands(Buffer const& commands, std::size_t first, std::size_t count);

void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z);  // groups of a compute program

// Memory barrier between programs that write and read the same storage blocks, and clears of these.
void share_between_programs();

// Memory barrier: makes buffer writes of programs visible in mapped memory after a later Fence.
void share_written();

}  // namespace gpu_shading::gl

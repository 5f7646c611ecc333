#pragma once

#include <cstddef>
#include <cstdint>

#include "gl/buffer.h"

namespace gpu_shading::gl {

// Draws of the bound vertex array, and the few pieces of state that they need. Every pass sets what
// it uses; nothing is left to the pass before.

enum class Test { always, equal, not_equal, less };
enum class OnPass { keep, replace };

// What passes `test` of `reference` against the stencil (and the depth test) does `on_pass` to it.
void stencil(Test test, std::uint8_t reference, OnPass on_pass);
void no_stencil();

void depth(Test test, bool write);
void no_depth();

void write_colour(bool on);

// What a fragment (R, G, B, A) does to the colour (r, g, b, a) that is there.
enum class Blend {
  replace,
  multiply,          // by A, all of them
  multiply_and_add,  // a by A; R, G and B are added to theirs
};
void blend(Blend how);

void cut_at_plane(bool on);  // by gl_ClipDistance[0]

// Depth 0 is nearest and clip space z runs from 0 to 1; z outside is not cut.
void set_depth_convention();

// Instance `record` of what the array has for each instance.
void draw_indexed(std::size_t first, std::size_t count, std::uint32_t record);
void draw_indexed_fours(std::size_t first, std::size_t count,
                        std::uint32_t record);  // for a geometry stage
void draw_vertices(std::size_t first, std::size_t count);

// An indexed draw of the draws' buffer, as OpenGL has it there.
struct Command {
  std::uint32_t count = 0;
  std::uint32_t instances = 1;
  std::uint32_t first = 0;
  std::int32_t base_vertex = 0;
  std::uint32_t record = 0;
};
void draw_commands(Buffer const& commands, std::size_t first, std::size_t count);

void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z);  // groups of a compute program

// For what programs wrote to a buffer, to be seen in its shared memory after a Fence from here on.
void share_written();

}  // namespace gpu_shading::gl

#include "backends/opengl/gl/draw.h"

#include <epoxy/gl.h>

namespace gpu_shading::gl {
namespace {

GLenum function_of(Test test) { return test == Test::less ? GL_LESS : GL_ALWAYS; }

GLenum operation_of(OnPass on_pass) { return on_pass == OnPass::replace ? GL_REPLACE : GL_KEEP; }

// GL takes offsets into bound buffers as pointers.
void const* as_pointer(std::size_t offset) {
  return reinterpret_cast<void const*>(offset);  // NOLINT(performance-no-int-to-ptr)
}

void draw_elements(GLenum mode, std::size_t first, std::size_t count, std::uint32_t record) {
  glDrawElementsInstancedBaseInstance(mode, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                                      as_pointer(first * sizeof(std::uint32_t)), 1, record);
}

}  // namespace

void stencil(Test test, std::uint8_t reference, OnPass on_pass) {
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(function_of(test), reference, 0xFF);
  glStencilOp(GL_KEEP, GL_KEEP, operation_of(on_pass));
}

void no_stencil() { glDisable(GL_STENCIL_TEST); }

void depth(Test test, bool write) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(function_of(test));
  glDepthMask(write ? GL_TRUE : GL_FALSE);
}

void no_depth() { glDisable(GL_DEPTH_TEST); }

void write_colour(bool on) {
  GLboolean const mask = on ? GL_TRUE : GL_FALSE;
  glColorMask(mask, mask, mask, mask);
}

void blend(Blend how) {
  if (how == Blend::replace) {
    glDisable(GL_BLEND);
    return;
  }
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  if (how == Blend::multiply) {
    glBlendFunc(GL_ZERO, GL_SRC_ALPHA);
  } else {
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_SRC_ALPHA);
  }
}

void cut_at_plane(bool on) {
  if (on) {
    glEnable(GL_CLIP_DISTANCE0);
  } else {
    glDisable(GL_CLIP_DISTANCE0);
  }
}

void set_depth_convention() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_CLAMP);
}

void draw_indexed(std::size_t first, std::size_t count, std::uint32_t record) {
  draw_elements(GL_TRIANGLES, first, count, record);
}

void draw_indexed_fours(std::size_t first, std::size_t count, std::uint32_t record) {
  draw_elements(GL_LINES_ADJACENCY, first, count, record);
}

void draw_commands(Buffer const& commands, std::size_t first, std::size_t count) {
  if (count == 0) return;
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.name());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, as_pointer(first * sizeof(Command)),
                              static_cast<GLsizei>(count), sizeof(Command));
}

void draw_vertices(std::size_t first, std::size_t count) {
  glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first), static_cast<GLsizei>(count));
}

void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) { glDispatchCompute(x, y, z); }

void share_between_programs() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void share_written() { glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT); }

}  // namespace gpu_shading::gl

#include "gl/query.h"

#include <epoxy/gl.h>

namespace gpu_shading::gl {

void destroy_query(std::uint32_t name) { glDeleteQueries(1, &name); }

Query Query::create() {
  GLuint name = 0;
  glCreateQueries(GL_SAMPLES_PASSED, 1, &name);
  return Query(name);
}

// llvmpipe sorts triangles into bins and counts some pixels twice where memory for these runs out
// during a query (Mesa 22.3.6): a query begins with empty ones.
void Query::begin() const {
  glFlush();
  glBeginQuery(GL_SAMPLES_PASSED, name());
}

// Samples are counted for one query at a time.
void Query::end() const { glEndQuery(GL_SAMPLES_PASSED); }

std::uint64_t Query::wait_for_result() const {
  GLuint64 samples = 0;
  glGetQueryObjectui64v(name(), GL_QUERY_RESULT, &samples);
  return samples;
}

}  // namespace gpu_shading::gl

#include "gl/program.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <string>

#include "gpu_shading/error.h"

namespace gpu_shading::gl {
namespace {

void destroy_shader(std::uint32_t name) { glDeleteShader(name); }

class Shader : public Object<destroy_shader> {
 public:
  Shader(GLenum stage, char const* source) : Object(glCreateShader(stage)) {
    glShaderSource(name(), 1, &source, nullptr);
    glCompileShader(name());
  }

  std::string log() const {
    GLint length = 0;
    glGetShaderiv(name(), GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(length), '\0');
    glGetShaderInfoLog(name(), length, nullptr, text.data());
    return text;
  }
};

std::string program_log(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string text(static_cast<std::size_t>(length), '\0');
  glGetProgramInfoLog(program, length, nullptr, text.data());
  return text;
}

}  // namespace

void destroy_program(std::uint32_t name) { glDeleteProgram(name); }

Program Program::link(char const* label, char const* vertex, char const* fragment) {
  Shader const vertex_shader(GL_VERTEX_SHADER, vertex);
  Shader const fragment_shader(GL_FRAGMENT_SHADER, fragment);
  Program program(glCreateProgram());
  glAttachShader(program.name(), vertex_shader.name());
  glAttachShader(program.name(), fragment_shader.name());
  glLinkProgram(program.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    throw Error(fmt::format("the driver cannot build the shader program '{}': {}{}{}", label,
                            vertex_shader.log(), fragment_shader.log(),
                            program_log(program.name())));
  }
  glDetachShader(program.name(), vertex_shader.name());
  glDetachShader(program.name(), fragment_shader.name());
  return program;
}

void Program::use() const { glUseProgram(name()); }

void Program::set(int location, glm::vec4 const& value) {
  glProgramUniform4f(name(), location, value.x, value.y, value.z, value.w);
}

}  // namespace gpu_shading::gl

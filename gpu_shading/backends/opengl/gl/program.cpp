#include "backends/opengl/gl/program.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <span>
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

void link_stages(char const* label, GLuint program, std::span<Shader const> stages) {
  for (Shader const& stage : stages) glAttachShader(program, stage.name());
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    std::string logs;
    for (Shader const& stage : stages) logs += stage.log();
    throw Error(fmt::format("the driver cannot build the shader program '{}': {}{}", label, logs,
                            program_log(program)));
  }
  for (Shader const& stage : stages) glDetachShader(program, stage.name());
}

}  // namespace

void destroy_program(std::uint32_t name) { glDeleteProgram(name); }

Program Program::link(char const* label, char const* vertex, char const* fragment) {
  std::array<Shader, 2> const stages{Shader(GL_VERTEX_SHADER, vertex),
                                     Shader(GL_FRAGMENT_SHADER, fragment)};
  Program program(glCreateProgram());
  link_stages(label, program.name(), stages);
  return program;
}

Program Program::link(char const* label, char const* vertex, char const* geometry,
                      char const* fragment) {
  std::array<Shader, 3> const stages{Shader(GL_VERTEX_SHADER, vertex),
                                     Shader(GL_GEOMETRY_SHADER, geometry),
                                     Shader(GL_FRAGMENT_SHADER, fragment)};
  Program program(glCreateProgram());
  link_stages(label, program.name(), stages);
  return program;
}

Program Program::link_compute(char const* label, char const* source) {
  std::array<Shader, 1> const stage{Shader(GL_COMPUTE_SHADER, source)};
  Program program(glCreateProgram());
  link_stages(label, program.name(), stage);
  return program;
}

void Program::use() const { glUseProgram(name()); }

void Program::set(int location, glm::vec4 const& value) {
  glProgramUniform4f(name(), location, value.x, value.y, value.z, value.w);
}

void Program::set(int location, std::int32_t value) { glProgramUniform1i(name(), location, value); }

void Program::set(int location, std::uint32_t value) {
  glProgramUniform1ui(name(), location, value);
}

}  // namespace gpu_shading::gl

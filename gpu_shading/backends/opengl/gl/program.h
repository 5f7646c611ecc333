#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "backends/opengl/gl/object.h"

namespace gpu_shading::gl {

void destroy_program(std::uint32_t name);

class Program : public Object<destroy_program> {
 public:
  Program() = default;
  // Throws Error with the driver's log if it does not compile or link; `label` names it there.
  static Program link(char const* label, char const* vertex, char const* fragment);
  static Program link(char const* label, char const* vertex, char const* geometry,
                      char const* fragment);

  static Program link_compute(char const* label, char const* source);

  void use() const;
  void set(int location, glm::vec4 const& value);
  void set(int location, std::int32_t value);
  void set(int location, std::uint32_t value);

 private:
  using Object::Object;
};

}  // namespace gpu_shading::gl

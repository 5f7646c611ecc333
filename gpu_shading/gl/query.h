#pragma once

#include <cstdint>

#include "gl/object.h"

namespace gpu_shading::gl {

void destroy_query(std::uint32_t name);

// Counts the samples that pass all tests of the draws between begin() and end().
class Query : public Object<destroy_query> {
 public:
  Query() = default;
  static Query create();

  void begin() const;
  void end() const;
  std::uint64_t wait_for_result() const;

 private:
  using Object::Object;
};

}  // namespace gpu_shading::gl

#pragma once

#include <stdexcept>
#include <string>

namespace gpu_shading::decoding {

[[noreturn]] inline void fail(std::string const& why) {
  throw std::runtime_error(why.empty() ? "no reason is given" : why);
}

}  // namespace gpu_shading::decoding

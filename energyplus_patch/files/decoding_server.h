#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// When decoding a file must be complete.
class DecodingDeadline {
 public:
  explicit DecodingDeadline(std::chrono::seconds wait);

  bool is_over() const;
  int milliseconds_left() const;  // for poll()

  // Throws Error.
  [[noreturn]] void fail() const;

 private:
  std::chrono::seconds wait_;
  std::chrono::steady_clock::time_point end_;
};

// Starts decoding a file, from `input` to `output`, in a process of its own, a child of this one,
// whose number is returned. `program` is one beside this module or program; it is started once for
// each thread (files/decoding/decoder.h). Throws Error with the reason in one line.
pid_t start_decoding(char const* program, std::vector<std::string> const& words, int input,
                     int output, DecodingDeadline const& deadline);

}  // namespace gpu_shading::energyplus

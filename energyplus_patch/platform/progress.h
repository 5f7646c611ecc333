#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>

namespace gpu_shading::energyplus {

// Progress of long work on standard error: a bar on a terminal, otherwise a line at every tenth.
// Silent for work that takes less than a second, and with set_quiet().
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  // Into a duplicate of this file descriptor; negative: standard error.
  Progress(std::string work, std::size_t total, int descriptor = -1);
  // For tests.
  Progress(std::string work, std::size_t total, std::FILE* out, bool terminal,
           Clock::duration patience);
  ~Progress();
  Progress(Progress const&) = delete;
  Progress& operator=(Progress const&) = delete;

  void at(std::size_t done);

 private:
  void draw_bar(int percent) const;

  std::string work_;
  std::size_t total_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> own_{nullptr, &std::fclose};
  std::FILE* out_ = stderr;
  bool terminal_ = false;
  Clock::duration patience_ = std::chrono::seconds(1);
  Clock::time_point start_ = Clock::now();
  int shown_ = 0;       // percent
  bool drawn_ = false;  // a bar that has no line break yet
};

}  // namespace gpu_shading::energyplus

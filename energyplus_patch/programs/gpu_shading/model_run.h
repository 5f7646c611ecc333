#pragma once

#include <unistd.h>

#include <filesystem>
#include <optional>

#include "model/options/options.h"
#include "tasks/task.h"

namespace gpu_shading::energyplus {

// The model to run, and how.
struct ModelRun {
  std::filesystem::path model;                                  // IDF or epJSON
  std::optional<std::filesystem::path> weather = std::nullopt;  // empty: one of EnergyPlus's own
  Choices choices;
};

// Has EnergyPlus, in a process of its own, read a model and hand over its surfaces, and a task done
// with them. Throws Error: an error of the model, why the task could not be done, or how
// EnergyPlus's process ended without a reply.
TaskReply run_task(ModelRun const& run, Task const& task);

// A duplicate of standard error, which a child process inherits; none on Windows, where programs
// inherit no descriptors.
class StandardError {
 public:
#ifdef _WIN32
  StandardError() = default;
#else
  StandardError() : descriptor_(dup(STDERR_FILENO)) {}
#endif
  ~StandardError() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  StandardError(StandardError const&) = delete;
  StandardError& operator=(StandardError const&) = delete;

  int descriptor() const { return descriptor_; }  // -1: none

 private:
  int descriptor_ = -1;
};

}  // namespace gpu_shading::energyplus

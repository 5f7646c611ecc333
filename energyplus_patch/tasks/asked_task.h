#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "tasks/task_file.h"

namespace gpu_shading::energyplus {

// A task of the gpu_shading program that EnergyPlus is run for (--gpu-shading-task), and the reply
// to it as it comes about.
class AskedTask {
 public:
  // Throws Error if the file cannot be read.
  explicit AskedTask(std::filesystem::path const& file) : request_(read_request(file)) {}

  Task const& task() const { return request_.task; }

  void warn(std::string const& line) { reply_.warnings.push_back(line); }

  // Either ends it, by writing the reply; only the first does. finish() throws Error if that cannot
  // be written.
  void finish(std::string text);
  void fail(std::string const& why) noexcept;

 private:
  TaskRequest request_;
  TaskReply reply_;
  bool replied_ = false;
};

// Thrown when the task that EnergyPlus is run for is done.
class TaskDone : public std::exception {};

}  // namespace gpu_shading::energyplus

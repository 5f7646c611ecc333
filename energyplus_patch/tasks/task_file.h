#pragma once

#include <filesystem>
#include <optional>

#include "tasks/task.h"

namespace gpu_shading::energyplus {

// A task on its way to the process that runs EnergyPlus (--gpu-shading-task), and the reply on its
// way back. The files are CBOR: numbers come back to the last bit, text to the last byte.

struct TaskRequest {
  Task task;
  std::filesystem::path reply;  // the file that the reply is to be written to
};

// Throw Error if the file cannot be read or written.
void write_request(std::filesystem::path const& file, TaskRequest const& request);
TaskRequest read_request(std::filesystem::path const& file);

// The file is written as a whole: nothing is found if the process ended before its reply.
void write_reply(std::filesystem::path const& file, TaskReply const& reply);
std::optional<TaskReply> find_reply(std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus

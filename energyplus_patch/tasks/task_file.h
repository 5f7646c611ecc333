#pragma once

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

// Results of a task that are no text for the user. Throw Error if the file cannot be read or
// written.
void write_maps(std::filesystem::path const& file, std::vector<ReceiverMap> const& maps);
std::vector<ReceiverMap> read_maps(std::filesystem::path const& file);
void write_fractions(std::filesystem::path const& file,
                     std::vector<ReceiverFractions> const& receivers);
std::vector<ReceiverFractions> read_fractions(std::filesystem::path const& file);
void write_masks(std::filesystem::path const& file, std::vector<ReceiverMask> const& masks);
std::vector<ReceiverMask> read_masks(std::filesystem::path const& file);
void write_module_fields(std::filesystem::path const& file, std::vector<ModuleField> const& fields);
std::vector<ModuleField> read_module_fields(std::filesystem::path const& file);

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

#include "tasks/asked_task.h"

#include <cstdio>
#include <exception>
#include <utility>

#include "platform/error_line.h"

namespace gpu_shading::energyplus {

void AskedTask::finish(std::string text) {
  reply_.text = std::move(text);
  write_reply(request_.reply, reply_);
  replied_ = true;
}

void AskedTask::fail(std::string const& why) noexcept {
  if (std::exchange(replied_, true)) return;
  try {
    reply_.error = why;
    write_reply(request_.reply, reply_);
  } catch (std::exception const& error) {
    // The program that waits reads it here.
    std::fprintf(stderr, "gpu_shading: error: %s\n", error_line(error).c_str());
  }
}

}  // namespace gpu_shading::energyplus

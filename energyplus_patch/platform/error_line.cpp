#include "platform/error_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>

#include "platform/ending_signals.h"
#include "platform/process.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

std::terminate_handler usual_end = nullptr;

void end() {
  auto const thrown = std::current_exception();
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (std::bad_alloc const& error) {
    std::fprintf(stderr, "gpu_shading: error: %s\n", error_line(error).c_str());
    clean_up_now();
    _exit(EXIT_FAILURE);
  } catch (...) {  // NOLINT(bugprone-empty-catch): the usual end says what it was
  }
  usual_end();
}

}  // namespace

void catch_lack_of_memory() { usual_end = std::set_terminate(end); }

std::string error_line(std::exception const& error) {
  if (dynamic_cast<std::bad_alloc const*>(&error) != nullptr) return describe_lack_of_memory();
  auto const* const failed = dynamic_cast<std::filesystem::filesystem_error const*>(&error);
  if (failed == nullptr) return one_line(error.what());
  auto const why = failed->code().message();
  if (failed->path1().empty()) return one_line(why);
  return one_line(fmt::format("{}: {}", failed->path1().string(), why));
}

}  // namespace gpu_shading::energyplus

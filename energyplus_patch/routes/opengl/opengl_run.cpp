#include "routes/opengl/opengl_run.h"

#include <cstdlib>
#include <exception>
#include <utility>

#include "answers/cache_folder.h"
#include "model/options/report_folder.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "platform/process.h"
#include "routes/hosted_run.h"
#include "routes/opengl/opengl_answers.h"

namespace gpu_shading::energyplus {
namespace {

constexpr char const* method_line =
    "sunlit fractions are passed to EnergyPlus through its calls of OpenGL";

}  // namespace

int run_by_opengl(std::filesystem::path const& library, std::filesystem::path const& program,
                  CommandLine const& line, std::vector<std::string> arguments, HostedText read) {
  auto const& options = read.model.options;
  if (options.cache) prepare_cache_folder(*options.cache);
  if (options.report && !read.task) prepare_report(*options.report);
  TemporaryFolder const folder;
  auto hosted = prepare_hosted(
      std::move(read),
      {program, *line.model, line.weather, line.expand, line.annual, line.design_days},
      folder.path());
  if (line.model_at) {
    arguments[*line.model_at] = hosted.path.string();
  } else {
    arguments.push_back(hosted.path.string());
  }
  if (!hosted.input.named.empty()) {
    print_line(method_line);
    hosted.messages.remarks.emplace_back(method_line);
    answer_with(std::move(hosted.input));
  }
  int const status = run_hosted(library, arguments, hosted.messages);
  try {
    finish_answers();
  } catch (std::exception const& error) {
    // EnergyPlus has written its results: this is no run that was refused.
    print_line("error: " + error_line(error));
    return EXIT_FAILURE;
  }
  return status;
}

}  // namespace gpu_shading::energyplus

// gpu_shading: devices, checks, pictures, maps, screens, samples and exports.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/options/option_table.h"
#include "platform/console.h"
#include "platform/ending_signals.h"
#include "platform/error_line.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"

namespace gpu_shading::energyplus {
namespace {

std::vector<std::string> names_of(std::vector<CLI::App const*> const& commands) {
  std::vector<std::string> names(commands.size());
  std::ranges::transform(commands, names.begin(),
                         [](CLI::App const* command) { return command->get_name(); });
  return names;
}

void refuse_mistyped_subcommand(CLI::App const& app, std::vector<std::string> const& arguments) {
  if (arguments.empty() || arguments.front().starts_with("-")) return;
  auto const& word = arguments.front();
  auto const names = names_of(app.get_subcommands({}));
  if (std::ranges::find(names, word) != names.end()) return;
  constexpr std::string_view run = "to run a model, type energyplus --gpu-shading -w WEATHER.epw ";
  if (is_idf(word) || is_epjson(word)) {
    throw Error(fmt::format("{0}: expected a subcommand before it, such as check {0}; {1}{0}",
                            printable(word), run));
  }
  auto const near = did_you_mean(word, names);
  auto const model = std::ranges::find_if(
      arguments, [](std::string const& each) { return is_idf(each) || is_epjson(each); });
  throw Error(fmt::format(
      "{}: no such subcommand{}", printable(word),
      !near.empty() ? near
                    : fmt::format("; {}{}", run,
                                  model == arguments.end() ? "MODEL.idf" : printable(*model))));
}

// Names the first argument that no subcommand accepts.
[[noreturn]] void refuse_extras(CLI::App const& app) {
  std::vector<std::string> flags;
  for (auto const* const command : app.get_subcommands()) {
    for (auto const* const option : command->get_options()) {
      for (auto const& name : option->get_lnames()) flags.push_back("--" + name);
    }
  }
  auto const extras = app.remaining(true);
  auto const flag = extras.empty() ? "" : extras.front().substr(0, extras.front().find('='));
  auto const* const kind = flag.starts_with("-") ? "no such flag" : "not expected";
  throw Error(fmt::format("{}: {}{}", printable(flag), kind, did_you_mean(flag, flags)));
}

void add_version(CLI::App& app) {
  auto const text = "gpu_shading " GPU_SHADING_VERSION;
  app.set_version_flag("--version", text);
  for (auto* const command : app.get_subcommands({})) command->set_version_flag("--version", text);
}

void add_help(Program const& program) {
  auto* const command = program.app.add_subcommand(
      "help", "Print the options of shading (help options), or the help of a command");
  auto const topic = std::make_shared<std::string>();
  auto const table = std::make_shared<bool>(false);
  command->add_option("topic", *topic, "options, or a command")->required()->type_name("TOPIC");
  command->add_flag("--markdown", *table, "Print all options as the table of the manual");
  command->set_help_all_flag("--help-all", "With the options for special cases");
  command->callback([topic, table, all = program.help_all] {
    if (*topic != "options") {
      throw Error(fmt::format("help {}: expected options or a command", printable(*topic)));
    }
    print_text(*table ? options_table() : options_help(all));
  });
}

// `help COMMAND` is `COMMAND --help`, and so is `COMMAND --help-all` with another footer.
void translate_help(CLI::App const& app, std::vector<std::string>& arguments) {
  bool const all = std::erase(arguments, "--help-all") > 0;
  bool const asks = !arguments.empty() && arguments.front() == "help";
  auto const names = names_of(app.get_subcommands({}));
  if (asks && (arguments.size() == 1 || std::ranges::find(names, arguments[1]) != names.end())) {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  } else if (all && !asks) {
    arguments.emplace_back("--help");
  }
}

int run(std::vector<std::string> arguments) {
  auto given = arguments;
  auto const flags = take_flags(arguments);
  auto choices = flags;
  choices.fill_from(read_environment());
  apply_to_process(choices);
  CLI::App app{
      "List devices, check, draw and map models, describe screens, sample and export sunlit "
      "fractions for EnergyPlus with GPU shading",
      "gpu_shading"};
  app.require_subcommand(1);
  bool const help_all = std::ranges::find(arguments, "--help-all") != arguments.end();
  Program const program{app, flags, choices, help_all};
  bool right = true;
  add_devices(program, right);
  add_check(program);
  add_view(program);
  add_map(program);
  add_mask(program);
  add_modules(program);
  add_screen(program);
  add_sample(program);
  add_export(program);
  add_city(program);
  add_python_commands(program);
  add_docs(program);
  add_example(program);
  add_help(program);
  add_version(app);
  app.footer(help_all ? options_help(true) : "Options of shading: gpu_shading help options");
  translate_help(app, arguments);
  if (!arguments.empty() && is_python_command(arguments.front())) {
    auto const name = arguments.front();
    if (given.front() == "help") run_python_command(name, {"--help"});
    given.erase(std::ranges::find(given, name));
    run_python_command(name, given);
  }
  refuse_mistyped_subcommand(app, arguments);
  // CLI11 expects them in reverse order.
  std::ranges::reverse(arguments);
  try {
    app.parse(std::move(arguments));
  } catch (CLI::ExtrasError const&) {
    refuse_extras(app);
  } catch (CLI::RequiredError const& error) {
    // The missing argument may be there, but mistyped.
    if (!app.remaining(true).empty()) refuse_extras(app);
    throw Error(error.what());
  } catch (CLI::ParseError const& error) {
    // --help and --version are such errors too.
    if (error.get_exit_code() == EXIT_SUCCESS) return app.exit(error);
    throw Error(error.what());
  }
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace gpu_shading::energyplus

int main(int argc, char** argv) {
  gpu_shading::energyplus::catch_lack_of_memory();
  gpu_shading::energyplus::take_file_limit_as_error();
  gpu_shading::energyplus::clean_up_at_signals();
  gpu_shading::energyplus::occupy_standard_descriptors();
  try {
    int const status =
        gpu_shading::energyplus::run(gpu_shading::energyplus::arguments_of(argc, argv));
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw gpu_shading::Error("standard output: cannot be written");
    }
    return status;
  } catch (gpu_shading::energyplus::Interrupted const& interrupted) {
    interrupted.raise();
    return EXIT_FAILURE;
  } catch (std::exception const& error) {
    std::fprintf(stderr, "gpu_shading: error: %s\n",
                 gpu_shading::energyplus::error_line(error).c_str());
    return EXIT_FAILURE;
  }
}

#include "programs/gpu_shading/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <system_error>
#include <utility>

#include "gpu_shading/error.h"
#include "model/options/option_table.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// With those of groups.
std::vector<CLI::Option const*> options_of(CLI::App const& app) {
  auto options = app.get_options();
  for (auto const* const group : app.get_subcommands([](CLI::App const*) { return true; })) {
    auto const more = group->get_options();
    options.insert(options.end(), more.begin(), more.end());
  }
  return options;
}

bool contains(OptionNames const& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string help_of(OptionNames const& names, bool all) {
  if (!all) return "Options of shading: gpu_shading help options";
  std::string text = "Options of shading:\n";
  for (auto const& row : option_rows()) {
    if (row.audience <= Audience::experts && contains(names, row.name)) text += help_of(row);
  }
  return text;
}

}  // namespace

CLI::Validator folder_name() {
  return {[](std::string& text) -> std::string {
            constexpr std::array<std::string_view, 8> endings{".txt", ".csv", ".png",  ".jpg",
                                                              ".svg", ".pdf", ".html", ".json"};
            std::filesystem::path const path(text);
            auto const ending = path.extension().string();
            bool const is_file = std::ranges::any_of(
                endings, [&](std::string_view known) { return same_name(known, ending); });
            if (!is_file || std::filesystem::is_directory(path)) return {};
            return fmt::format("{}: expected the name of a folder, which gets several files", text);
          },
          ""};
}

Command::Command(Program const& program, std::string const& name, std::string const& description,
                 OptionNames options)
    : app_(program.app.add_subcommand(name, description)),
      program_(program),
      options_(std::move(options)) {
  app_->set_help_all_flag("--help-all", "Print this help with the options of shading");
  app_->footer(help_of(options_, program.help_all));
}

std::shared_ptr<ModelRun> Command::add_model(std::string const& weather) const {
  auto run = std::make_shared<ModelRun>();
  run->choices = program_.choices;
  app_->add_option_function<std::string>(
          "model", [run](std::string const& text) { run->model = text; }, "IDF or epJSON file")
      ->required()
      ->type_name("FILE");
  app_->add_option_function<std::string>(
          "-w,--weather",
          [run](std::string const& text) {
            require_weather(text);
            run->weather = text;
          },
          weather)
      ->type_name("FILE");
  return run;
}

void Command::add_folder(std::filesystem::path& folder, std::string const& contents) const {
  app_->add_option(
          "-o,--output", folder,
          fmt::format("Folder for the {0}: new, empty, or with earlier {0}, which are replaced",
                      contents))
      ->required()
      ->check(folder_name())
      ->type_name("DIR");
}

void Command::add_receivers(std::string const& flag, std::string& pattern,
                            std::string const& which) const {
  app_->add_option(flag, pattern,
                   "Name of a surface, or a pattern in which * stands for any characters" + which)
      ->type_name("PATTERN");
}

CLI::Option* Command::add_spacing(std::string const& flag, double& spacing,
                                  std::string const& meaning) const {
  constexpr double min_spacing = 0.001;
  constexpr double max_spacing = 1000.0;
  return app_->add_option(flag, spacing, meaning)
      ->check(CLI::Range(min_spacing, max_spacing))
      ->type_name("M");
}

void Command::refuse_ignored_flags() const {
  for (auto const& row : option_rows()) {
    if (row.audience > Audience::experts || contains(options_, row.name)) continue;
    if (!row.text(program_.flags, row.value)) continue;
    throw Error(fmt::format("{0}: not an option of gpu_shading {1}; see gpu_shading {1} --help-all",
                            row.flag(), app_->get_name()));
  }
}

void Command::refuse_blank_words() const {
  for (auto const* const option : options_of(*app_)) {
    for (auto const& text : option->results()) {
      if (!text.empty()) continue;
      throw Error(fmt::format("{} is blank; expected {} (see gpu_shading {} --help)",
                              option->get_name(), option->get_type_name(), app_->get_name()));
    }
  }
}

void Command::refuse_same_files() const {
  std::map<std::filesystem::path, std::string> named;
  for (auto const* const option : options_of(*app_)) {
    if (option->get_type_name() != "FILE") continue;
    for (auto const& text : option->results()) {
      std::error_code error;
      auto const file = std::filesystem::canonical(text, error);
      if (error) continue;
      auto const& other = named.try_emplace(file, option->get_name()).first->second;
      if (other == option->get_name()) continue;
      throw Error(fmt::format("{} {}: {} names this file, too; expected another",
                              option->get_name(), text, other));
    }
  }
}

void Command::run(std::function<void()> const& action) const {
  app_->callback([command = *this, action] {
    command.refuse_ignored_flags();
    command.refuse_blank_words();
    command.refuse_same_files();
    action();
  });
}

OptionNames model_options(std::initializer_list<std::string_view> more) {
  OptionNames names{"",      "error", "resolution", "device", "file",     "threads",
                    "quiet", "lean",  "method",     "assets", "positions"};
  names.insert(names.end(), more);
  return names;
}

}  // namespace gpu_shading::energyplus

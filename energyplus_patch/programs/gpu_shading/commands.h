#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "programs/gpu_shading/model_run.h"

namespace gpu_shading::energyplus {

// The program's command line.
struct Program {
  CLI::App& app;
  Choices flags;    // of the user
  Choices choices;  // the flags, then the environment
  bool help_all = false;
};

// Names of options of shading (OptionRow::name).
using OptionNames = std::vector<std::string_view>;

// Refuses the name of a file for a folder: -o o.txt.
CLI::Validator folder_name();

// A subcommand that is being added to the program.
class Command {
 public:
  // `options`: those of shading that it uses. Its help lists them for --help-all; run() refuses
  // the flags of others.
  Command(Program const& program, std::string const& name, std::string const& description,
          OptionNames options);

  CLI::App* operator->() const { return app_; }

  // Adds the arguments that name a model and its weather file. The result is complete when the
  // command runs.
  std::shared_ptr<ModelRun> add_model(
      std::string const& weather = "Weather file (default: one that comes with EnergyPlus)") const;

  // -o: a folder that later calls may use again. `contents`: "maps"
  void add_folder(std::filesystem::path& folder, std::string const& contents) const;
  // A pattern of names. `which`: what it may also name, and the default.
  void add_receivers(std::string const& flag, std::string& pattern, std::string const& which) const;
  // m
  CLI::Option* add_spacing(std::string const& flag, double& spacing,
                           std::string const& meaning) const;

  void run(std::function<void()> const& action) const;

 private:
  void refuse_ignored_flags() const;
  // A blank name of a folder would be the current one.
  void refuse_blank_words() const;
  // A result would replace what is read.
  void refuse_same_files() const;

  CLI::App* app_;
  Program const& program_;
  OptionNames options_;
};

// Options of shading that commands on a model use, and others.
OptionNames model_options(std::initializer_list<std::string_view> more = {});

// `right`: set to whether all tested devices are.
void add_devices(Program const& program, bool& right);
void add_check(Program const& program);
void add_view(Program const& program);
void add_map(Program const& program);
void add_mask(Program const& program);
void add_modules(Program const& program);
void add_screen(Program const& program);
void add_sample(Program const& program);
// For `sample --sky`: renders the sunlit fraction of every receiver for each patch of three
// divisions of the sky, and writes sky.csv and sky_view.csv, with view factors to the sky.
void sample_sky(ModelRun const& run, std::filesystem::path const& folder);
void add_export(Program const& program);
void add_city(Program const& program);
// Commands of the Python package.
void add_python_commands(Program const& program);
bool is_python_command(std::string const& name);
// Becomes the command of the Python package. Throws Error where there is none.
[[noreturn]] void run_python_command(std::string const& name,
                                     std::vector<std::string> const& arguments);
void add_docs(Program const& program);
void add_example(Program const& program);

}  // namespace gpu_shading::energyplus

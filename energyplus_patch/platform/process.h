#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/held_folder.h"

namespace gpu_shading::energyplus {

// The arguments in UTF-8, without the program's name; of main().
std::vector<std::string> arguments_of(int argc, char const* const* argv);

// Opens those of the descriptors 0, 1 and 2 that are closed, so that no file that is opened later
// gets the number, and with it what is meant for a terminal. Reading and writing them still fails.
void occupy_standard_descriptors();

// The folder of the running program: a patched EnergyPlus, for the launcher and the gpu_shading
// program.
std::filesystem::path own_folder();

// A folder for one command, in the system's folder for temporary files: a HeldFolder.
class TemporaryFolder {
 public:
  static constexpr std::string_view prefix = "gpu_shading-";  // of its name

  TemporaryFolder();

  std::filesystem::path const& path() const { return path_; }  // empty at first

 private:
  HeldFolder folder_;
  std::filesystem::path path_;
};

// An environment variable of this process, in UTF-8; empty where it is not set.
std::string get_variable(char const* name);
// Sets one.
void set_variable(char const* name, std::string const& value);

// A signal that asks this program to end, and came while another program ran for it. Caught where
// nothing is left to clear away, by raise().
class Interrupted : public Error {
 public:
  explicit Interrupted(int signal);

  // Ends this process as the signal would have.
  void raise() const;

 private:
  int signal_;
};

// Runs a program to its end, its output into a file; `environment` ("NAME=value") is added to ours.
// `folder`: where it starts; empty: here. Returns its exit status, 128 + the signal where one ended
// it. Throws Error when it cannot be started. If this process is killed, so is the program. A
// signal that asks us to end (SIGINT, SIGTERM, SIGHUP) goes to the program, and is thrown as
// Interrupted once it has ended.
int run_process(std::vector<std::string> const& command,
                std::vector<std::string> const& environment, std::filesystem::path const& output,
                std::filesystem::path const& folder = {});

// What run_process() returned, in words: "exit status 1", "ended by signal 9 (Killed)".
std::string describe_status(int status);

// That memory has run out, how much is in use and how much may be, as far as the system says.
std::string describe_lack_of_memory();

}  // namespace gpu_shading::energyplus

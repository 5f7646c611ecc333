#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/options/command_line.h"
#include "platform/process.h"

namespace gpu_shading::energyplus {

// The current folder of this process while EnergyPlus runs ExpandObjects (-x), which writes in.idf,
// Energy+.idd and expanded.idf into the current folder and deletes whatever has their names. A
// temporary folder leaves the user's files alone and keeps runs apart.
class ExpansionFolder {
 public:
  // Makes the file names in EnergyPlus's arguments absolute.
  ExpansionFolder(std::vector<std::string>& arguments, CommandLine const& line);
  ExpansionFolder(ExpansionFolder const&) = delete;
  ExpansionFolder& operator=(ExpansionFolder const&) = delete;
  ~ExpansionFolder();  // where the user was

  std::filesystem::path const& start() const { return start_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path start_;
};

}  // namespace gpu_shading::energyplus

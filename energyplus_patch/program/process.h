#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// A folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;

  std::filesystem::path const& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Runs a program to its end, its output into a file; `environment` ("NAME=value") is added to ours.
// Returns its exit status, 128 + the signal where one ended it. Throws Error when it cannot be
// started.
int run_process(std::vector<std::string> const& command,
                std::vector<std::string> const& environment, std::filesystem::path const& output);

}  // namespace gpu_shading::energyplus

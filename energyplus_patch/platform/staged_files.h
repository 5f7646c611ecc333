#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

class HeldFolder;

// Replaces files of one folder as a whole. They are written into a hidden folder beside them, then
// flushed to disk and renamed: a full disk, an error or a kill leaves every file as it was before
// or complete. Hidden folders of processes that were killed are deleted by the next object for the
// same folder. Every function throws Error: "PATH: cannot be written (why)".
class StagedFiles {
 public:
  static constexpr std::string_view prefix = ".gpu_shading-";  // of the hidden folder's name

  // Creates the folder if it does not exist.
  explicit StagedFiles(std::filesystem::path folder);
  StagedFiles(StagedFiles const&) = delete;
  StagedFiles& operator=(StagedFiles const&) = delete;
  ~StagedFiles();  // deletes what was not committed

  // Where to write the file `name`, or an empty folder `name`. The name must be new here, and must
  // not be that of a link, device or non-empty folder: none of these is replaced.
  std::filesystem::path add(std::string const& name);

  // Adds a file and writes it.
  void write(std::string const& name, std::function<void(std::ostream&)> const& write);
  void write(std::string const& name, std::string_view bytes);
  void copy(std::string const& name, std::filesystem::path const& from);

  // Puts the files in place, in the order in which they were added.
  void commit();

 private:
  std::filesystem::path folder_;
  std::unique_ptr<HeldFolder> stage_;
  std::vector<std::string> names_;
};

}  // namespace gpu_shading::energyplus

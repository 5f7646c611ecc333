#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "platform/staged_files.h"

namespace gpu_shading::energyplus {

// A folder of related files, with an index file that lists them with their hashes.
// Only files that it lists and that are unchanged are replaced, or deleted by commit() if they were
// not written again. Functions throw Error.
class ListedFolder {
 public:
  // The folder must be missing or empty, or have a file `about` of this `format`.
  ListedFolder(std::filesystem::path folder, std::string about, std::string format);

  void write(std::string const& name, std::string const& bytes);
  void write(std::string const& name, std::function<void(std::ostream&)> const& write);

  // Adds the file about them, with `facts`, and puts all in place.
  void commit(nlohmann::ordered_json const& facts);

 private:
  // Hashes of the files that an earlier object wrote, by name.
  std::map<std::string, std::string> read_list() const;

  std::filesystem::path folder_;
  std::string about_;
  std::string format_;
  std::map<std::string, std::string> before_;
  std::map<std::string, std::string> written_;
  StagedFiles files_;
};

}  // namespace gpu_shading::energyplus

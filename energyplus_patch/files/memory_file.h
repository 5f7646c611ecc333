#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// A file in memory with a path, for libraries that write to a path and do not check every write.
// Throws Error if there is no memory for it.
class MemoryFile {
 public:
  MemoryFile();
  MemoryFile(MemoryFile const&) = delete;
  MemoryFile& operator=(MemoryFile const&) = delete;
  ~MemoryFile();

  std::filesystem::path path() const;  // valid in this process
  std::string contents() const;

 private:
  int descriptor_;
};

}  // namespace gpu_shading::energyplus

#pragma once

#include <cstddef>
#include <filesystem>

namespace gpu_shading::energyplus {

// For main() of our programs: a signal that would end this process first ends the programs that it
// runs and deletes its temporary folders, then ends it as before. Signals that are ignored or
// handled already stay so. In a process that did not call this, such as a host of EnergyPlus, no
// signal is touched.
void clean_up_at_signals();

// The same without a signal, for an end that calls no destructors.
void clean_up_now() noexcept;

// For main() of a program in which EnergyPlus does not run: writing past the limit of a file's size
// (ulimit -f) is an error and no signal. Programs that it runs get the signal as before.
void take_file_limit_as_error();
bool takes_file_limit_as_error() noexcept;

// A folder that this process is about to make, and that is deleted if a signal ends it: with all
// that is in it once it is made, and before only if it is empty. Not on Windows.
class FolderAtSignals {
 public:
  explicit FolderAtSignals(std::filesystem::path const& folder);
  FolderAtSignals(FolderAtSignals const&) = delete;
  FolderAtSignals& operator=(FolderAtSignals const&) = delete;
  ~FolderAtSignals();

  void is_made() noexcept;

 private:
  std::size_t slot_;
};

// A process that is ended if a signal ends this one. Not on Windows.
class ProcessAtSignals {
 public:
  explicit ProcessAtSignals(int process);
  ProcessAtSignals(ProcessAtSignals const&) = delete;
  ProcessAtSignals& operator=(ProcessAtSignals const&) = delete;
  ~ProcessAtSignals();

 private:
  std::size_t slot_;
};

// Deletes a folder with all that is in it; links are not followed. Makes only system calls and
// needs one file descriptor, so that it works in a signal handler and where memory or descriptors
// have run out. What others write into it meanwhile is deleted too, within reason. Returns whether
// the folder is gone.
bool delete_folder(char const* path) noexcept;

}  // namespace gpu_shading::energyplus

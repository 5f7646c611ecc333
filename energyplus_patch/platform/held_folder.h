#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "platform/ending_signals.h"

namespace gpu_shading::energyplus {

// A new folder of this process's own, deleted with the object, or by clean_up_at_signals(). If the
// process is killed, the next object with the same parent and prefix deletes it: it holds a file
// that says whose it is, locked for as long as the process lives. Folders without that file, of
// other users or under other names are left alone.
class HeldFolder {
 public:
  // In an existing folder, under `prefix` and eight hexadecimal digits. Throws Error: "PARENT:
  // cannot be written (why)".
  HeldFolder(std::filesystem::path const& parent, std::string_view prefix);
  HeldFolder(HeldFolder const&) = delete;
  HeldFolder& operator=(HeldFolder const&) = delete;
  ~HeldFolder();

  std::filesystem::path const& path() const { return path_; }

  static constexpr char const* lock_name = ".lock";

 private:
  // By platform: makes the folder at path_ and holds it. Returns false if there is one already, or
  // another process has deleted it meanwhile.
  bool make(std::filesystem::path const& parent);
  // By platform: deletes a folder with our name if no process holds it.
  static void delete_if_abandoned(std::filesystem::path const& path);
  [[noreturn]] static void fail(std::filesystem::path const& parent, std::error_code const& why);

  std::filesystem::path path_;
  std::optional<FolderAtSignals> at_signals_;
  std::shared_ptr<void> held_;  // what this platform locks
};

}  // namespace gpu_shading::energyplus

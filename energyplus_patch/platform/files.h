#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <unordered_set>

namespace gpu_shading::energyplus {

// Throws Error: "FILE: no such file", "FILE: is a link to a file that does not exist", or "FILE: is
// not a file", as folders are and pipes and devices, which may never come to an end.
void require_file(std::filesystem::path const& path);

// The contents of a file. Throws Error like require_file(), "FILE: cannot be read" or "FILE: is
// larger than 1 GiB".
inline constexpr std::uintmax_t max_text_bytes = std::uintmax_t{1} << 30U;
std::string read_text_file(std::filesystem::path const& path);

// Replaces a file as a whole: see StagedFiles. Throws Error: "FILE: cannot be written (why)".
void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write);

// Throws Error if nothing can be written to a temporary folder: programs that do not say why they
// failed may have failed of that.
void require_room(std::filesystem::path const& folder);

// Names for files in one folder, from text such as the names of surfaces.
class FileNames {
 public:
  // `text` followed by `ending`, in which letters and digits of any script, '-' and '.' are kept
  // and everything else is replaced by '_'; text that is not UTF-8 likewise. Long text is cut. If
  // the name has been given before, "_2", "_3", ... goes before the ending.
  std::string add(std::string_view text, std::string_view ending);

 private:
  std::unordered_set<std::string> given_;
};

// These return 0, or the errno of what failed.

// Whether entries of a folder can be read, written and made.
int find_access(std::filesystem::path const& folder);

// Puts what was written on the disk. Some file systems have nothing to flush, and say so: that is
// no failure.
int flush_file(std::filesystem::path const& file);
int flush_folder(std::filesystem::path const& folder);

// Renames a file, which replaces another in one step, or a folder, which may replace an empty one.
int replace_file(std::filesystem::path const& file, std::filesystem::path const& replaced);

}  // namespace gpu_shading::energyplus

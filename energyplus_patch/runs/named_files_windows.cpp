#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "gpu_shading/error.h"
#include "platform/text.h"
#include "runs/named_files.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

bool is_ascii(std::string const& text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

class Copies {
 public:
  Copies(Path const& from, Path const& to) : from_(from), to_(to) {}

  // EnergyPlus reads names in the system's code page, so that a copy has a name in ASCII.
  void bring(std::string& text) {
    if (text.empty() || parse_number(text)) return;
    Path const named(text);
    bool const rooted = named.has_root_path();
    if (!named.has_extension() || (rooted && is_ascii(text))) return;
    auto const source = from_ / named;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(source, ignored)) return;
    auto const within = named.lexically_normal();
    if (!rooted && *within.begin() != ".." && is_ascii(text)) {
      copy(source, to_ / within);
    } else {
      text = renamed(source.lexically_normal());
    }
  }

 private:
  std::string const& renamed(Path const& source) {
    auto& name = renamed_[source];
    if (name.empty()) {
      auto const extension = source.extension().string();
      name = fmt::format("named_file_{}{}", renamed_.size(), is_ascii(extension) ? extension : "");
      copy(source, to_ / name);
    }
    return name;
  }

  static void copy(Path const& source, Path const& target) {
    std::error_code failure;
    std::filesystem::create_directories(target.parent_path(), failure);
    if (std::filesystem::exists(target, failure)) return;
    std::filesystem::copy_file(source, target, failure);
    if (failure) {
      throw Error(fmt::format("{}: cannot be copied to {} ({})", source.string(),
                              target.parent_path().string(), failure.message()));
    }
  }

  Path from_;
  Path to_;
  std::map<Path, std::string> renamed_;
};

}  // namespace

void bring_named_files(ModelEditor& model, Path const& original, Path const& folder) {
  Copies copies(original.parent_path(), folder);
  model.edit_texts([&](std::string& text) { copies.bring(text); });
}

}  // namespace gpu_shading::energyplus

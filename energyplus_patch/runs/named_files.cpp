#include "runs/named_files.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "platform/staged_files.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// As EnergyPlus reads a file name that was written on Windows.
Path native(std::string text) {
  std::ranges::replace(text, '\\', '/');
  return text;
}

// Makes a path absolute that names an existing file through "..".
void anchor(std::string& value, Path const& folder) {
  if (value.find("..") == std::string::npos) return;
  auto const named = native(value);
  if (named.is_absolute()) return;
  std::error_code ignored;
  if (std::filesystem::exists(folder / named, ignored)) {
    value = std::filesystem::weakly_canonical(folder / named).string();
  }
}

bool has_object(ModelEditor& model, std::string_view type) {
  bool found = false;
  model.edit(type, [&](EditedObject const&) { found = true; });
  return found;
}

// May be imported: a module, or a folder with one.
bool is_for_python(Path const& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) {
    return path.extension() == ".py" || path.extension() == ".so";
  }
  if (path.filename().string().starts_with(StagedFiles::prefix)) return false;
  auto const entries = std::filesystem::directory_iterator(path, ignored);
  return std::any_of(begin(entries), end(entries),
                     [](auto const& entry) { return entry.path().extension() == ".py"; });
}

class Links {
 public:
  Links(Path from, Path to) : from_(std::move(from)), to_(std::move(to)) {
    for (auto const& entry : std::filesystem::directory_iterator(from_)) {
      entries_.insert(entry.path().filename().string());
    }
  }

  // A file by its name, relative to the folder.
  void bring(Path const& name) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(from_ / name, ignored)) link(name);
  }

  // A file that a field of the model may name; many fields are looked up.
  void bring_named(std::string const& text) {
    if (auto const name = named_here(text); !name.empty()) bring(name);
  }

  // Whatever a plugin may import: which modules these are is not in the model.
  void bring_python(ModelEditor& model) {
    for (auto const& entry : entries_) {
      if (is_for_python(from_ / entry)) link(entry);
    }
    // PythonPlugin:SearchPaths
    model.edit_texts([&](std::string const& text) {
      std::error_code ignored;
      auto const name = named_here(text);
      if (!name.empty() && std::filesystem::is_directory(from_ / name, ignored)) link(name);
    });
  }

 private:
  Path named_here(std::string const& text) const {
    if (text.empty()) return {};
    auto name = native(text).lexically_normal();
    return entries_.contains(name.begin()->string()) ? name : Path();
  }

  void link(Path const& name) {
    std::error_code exists;
    std::filesystem::create_directories((to_ / name).parent_path(), exists);
    std::filesystem::create_symlink(from_ / name, to_ / name, exists);
  }

  Path from_;
  Path to_;
  std::unordered_set<std::string> entries_;
};

}  // namespace

void bring_named_files(ModelEditor& model, Path const& original, Path const& folder) {
  auto const source = original.parent_path();
  model.edit_texts([&](std::string& text) { anchor(text, source); });
  Links links(source, folder);
  if (has_object(model, "PythonPlugin:Instance")) links.bring_python(model);
  model.edit_texts([&](std::string const& text) { links.bring_named(text); });
  // Files that EnergyPlus looks for without being told their names.
  if (has_object(model, "Construction:WindowDataFile")) links.bring("Window5DataFile.dat");
  for (auto const* const choice_of_outputs : {".rvi", ".mvi"}) {
    links.bring(original.stem() += choice_of_outputs);
  }
}

}  // namespace gpu_shading::energyplus

#include "programs/gpu_shading/listed_folder.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "scene/digest.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;
using Json = nlohmann::ordered_json;

std::string hash_of_bytes(std::string const& bytes) {
  Digest digest;
  digest.add(std::string_view(bytes));
  return to_text(digest.result());
}

}  // namespace

ListedFolder::ListedFolder(Path folder, std::string about, std::string format)
    : folder_(std::move(folder)),
      about_(std::move(about)),
      format_(std::move(format)),
      before_(read_list()),
      files_(folder_) {}

std::map<std::string, std::string> ListedFolder::read_list() const {
  if (!std::filesystem::is_directory(folder_) || std::filesystem::is_empty(folder_)) return {};
  auto const about = folder_ / about_;
  if (!std::filesystem::exists(about)) {
    throw Error(fmt::format("{}: is not empty and has no {}: choose another folder",
                            folder_.string(), about_));
  }
  auto const json = Json::parse(read_text_file(about), nullptr, false);
  if (!json.is_object() || json.value("format", Json()) != Json(format_) ||
      !json.value("files", Json()).is_object()) {
    throw Error(
        fmt::format("{}: is not a list of \"{}\": choose another folder", about.string(), format_));
  }
  std::map<std::string, std::string> list;
  for (auto const& [name, hash] : json["files"].items()) {
    // Names of files in this folder alone.
    if (hash.is_string() && !name.empty() && Path(name).filename() == name) {
      list[name] = hash.get<std::string>();
    }
  }
  return list;
}

void ListedFolder::write(std::string const& name, std::string const& bytes) {
  auto const path = folder_ / name;
  if (std::filesystem::exists(std::filesystem::symlink_status(path))) {
    auto const known = before_.find(name);
    if (known == before_.end() || !std::filesystem::is_regular_file(path) ||
        hash_of_bytes(read_text_file(path)) != known->second) {
      throw Error(fmt::format(
          "{}: exists and is not an unchanged file that {} lists: choose another folder",
          path.string(), about_));
    }
  }
  files_.write(name, bytes);
  written_[name] = hash_of_bytes(bytes);
}

void ListedFolder::write(std::string const& name,
                         std::function<void(std::ostream&)> const& write_to) {
  std::ostringstream out;
  write_to(out);
  write(name, out.str());
}

void ListedFolder::commit(Json const& facts) {
  Json json{{"format", format_}};
  json.update(facts);
  json["files"] = written_;
  files_.write(about_, json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
  files_.commit();
  for (auto const& [name, hash] : before_) {
    auto const path = folder_ / name;
    std::error_code ignored;
    if (written_.contains(name) || std::filesystem::is_symlink(path, ignored) ||
        !std::filesystem::is_regular_file(path, ignored)) {
      continue;
    }
    if (hash_of_bytes(read_text_file(path)) == hash) std::filesystem::remove(path, ignored);
  }
}

}  // namespace gpu_shading::energyplus

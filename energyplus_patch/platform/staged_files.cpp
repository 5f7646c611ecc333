#include "platform/staged_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/held_folder.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

[[noreturn]] void fail(Path const& path, std::string const& why) {
  throw Error(fmt::format("{}: cannot be written ({})", path.string(), why));
}

[[noreturn]] void fail(Path const& path, int error) {
  fail(path, std::generic_category().message(error == 0 ? EIO : error));
}

void require_replaceable(Path const& path) {
  std::error_code failure;
  auto const status = std::filesystem::symlink_status(path, failure);
  using enum std::filesystem::file_type;
  if (status.type() == not_found || status.type() == regular) return;
  if (status.type() == directory) {
    if (std::filesystem::is_empty(path, failure)) return;
    fail(path, "it is a folder");
  }
  fail(path, status.type() == symlink ? "it is a link: give the file itself" : "it is not a file");
}

}  // namespace

StagedFiles::StagedFiles(Path folder) : folder_(std::move(folder)) {
  if (folder_.empty()) folder_ = ".";
  std::error_code failure;
  std::filesystem::create_directories(folder_, failure);
  if (failure) fail(folder_, failure.message());
  stage_ = std::make_unique<HeldFolder>(folder_, prefix);
}

StagedFiles::~StagedFiles() = default;

Path StagedFiles::add(std::string const& name) {
  auto const path = folder_ / name;
  if (name == HeldFolder::lock_name || Path(name).has_parent_path() || name.empty() ||
      name == "." || name == "..") {
    fail(path, "it is not the name of a file");
  }
  if (std::ranges::find(names_, name) != names_.end()) {
    fail(path, "it is written twice");
  }
  require_replaceable(path);
  names_.push_back(name);
  return stage_->path() / name;
}

void StagedFiles::write(std::string const& name, std::function<void(std::ostream&)> const& write) {
  errno = 0;
  std::ofstream file(add(name), std::ios::binary);
  if (file) write(file);
  file.close();
  if (!file) fail(folder_ / name, errno);
}

void StagedFiles::write(std::string const& name, std::string_view bytes) {
  write(name, [&](std::ostream& file) {
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

void StagedFiles::copy(std::string const& name, Path const& from) {
  std::error_code failure;
  std::filesystem::copy_file(from, add(name), failure);
  if (failure) fail(folder_ / name, failure.message());
}

void StagedFiles::commit() {
  for (auto const& name : names_) {
    auto const path = stage_->path() / name;
    if (int const error = flush_file(path); error != 0) fail(path, error);
  }
  for (auto const& name : names_) {
    auto const path = folder_ / name;
    // The name may have been taken since.
    require_replaceable(path);
    if (int const error = replace_file(stage_->path() / name, path); error != 0) fail(path, error);
  }
  names_.clear();
  if (int const error = flush_folder(folder_); error != 0) fail(folder_, error);
}

}  // namespace gpu_shading::energyplus

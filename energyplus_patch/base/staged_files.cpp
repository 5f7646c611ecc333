#include "base/staged_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/file_descriptor.h"
#include "base/held_folder.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

[[noreturn]] void fail(Path const& path, std::string const& why) {
  throw Error(fmt::format("{}: cannot be written ({})", path.string(), why));
}

[[noreturn]] void fail(Path const& path, int error) {
  fail(path, std::generic_category().message(error == 0 ? EIO : error));
}

int open_file(Path const& path, int flags) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  return open(path.c_str(), flags | O_CLOEXEC, 0600);
}

void flush(Path const& path) {
  FileDescriptor const file(open_file(path, O_RDONLY | O_NOFOLLOW));
  // Some file systems have nothing to flush, and say so.
  if (!file.is_open() || (fsync(file.get()) != 0 && errno != EINVAL)) fail(path, errno);
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
  if (std::find(names_.begin(), names_.end(), name) != names_.end()) {
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
  for (auto const& name : names_) flush(stage_->path() / name);
  for (auto const& name : names_) {
    auto const path = folder_ / name;
    // The name may have been taken since.
    require_replaceable(path);
    if (rename((stage_->path() / name).c_str(), path.c_str()) != 0) fail(path, errno);
  }
  names_.clear();
  FileDescriptor const folder(open_file(folder_, O_RDONLY));
  if (folder.is_open() && fsync(folder.get()) != 0 && errno != EINVAL) fail(folder_, errno);
}

}  // namespace gpu_shading::energyplus

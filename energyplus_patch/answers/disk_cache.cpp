#include "answers/disk_cache.h"

#include <fmt/format.h>

#include <utility>

#include "answers/cache_file.h"
#include "answers/cache_folder.h"
#include "gpu_shading/error.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// Returns no answers if there is no file. Throws Error, without the file's name, if it cannot be
// used.
SceneAnswers read_answers(Path const& path, Hash const& scene, AnswerLimits const& limits) {
  auto const bytes = read_cache_file(path, AnswerStore::default_max_bytes);
  if (!bytes) return SceneAnswers();
  auto answers = decode(*bytes, scene);
  check_answers(answers, limits);
  return answers;
}

void write_file(Path const& path, std::vector<std::byte> const& bytes) {
  try {
    write_whole_file(path, [&](std::ostream& out) {
      out.write(reinterpret_cast<char const*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
    });
  } catch (Error const& error) {
    throw Error(
        fmt::format("--gpu-shading-cache: {}; this run's answers are not kept", error.what()));
  }
}

}  // namespace

DiskCache::DiskCache(CacheFolder folder, Hash const& scene, AnswerLimits limits,
                     std::function<void(std::string const&)> const& remark)
    : folder_(std::move(folder)),
      file_(folder_.path / cache_file_name(to_text(scene))),
      scene_(scene),
      limits_(std::move(limits)) {
  try {
    known_ = read_answers(file_, scene_, limits_);
  } catch (Error const& error) {
    remark(fmt::format("--gpu-shading-cache: {} {}: it is ignored{}", file_.string(), error.what(),
                       folder_.read_only ? "" : ", and replaced at the end of the run"));
    return;
  }
  for (ReceiverNumber number = 0; number < known_.receivers.size(); ++number) {
    numbers_[known_.receivers[number]] = number;
  }
  if (folder_.read_only) return;
  // The most recently used files are removed last.
  std::error_code ignored;
  std::filesystem::last_write_time(file_, std::filesystem::file_time_type::clock::now(), ignored);
}

AnswerStore::Direction const* DiskCache::find(SceneAnswers const& run,
                                              AnswerStore::Direction const& direction) const {
  auto const state = known_.states.find(run.states[direction.state]);
  return state ? known_.answers.find(direction.sun, *state) : nullptr;
}

void DiskCache::note_recalled(AnswerStore::Direction& direction) {
  if (!direction.recalled) ++directions_recalled_;
  direction.recalled = true;
}

void DiskCache::recall(SceneAnswers& run, AnswerStore::Direction& direction) {
  auto const* const found = find(run, direction);
  if (found == nullptr) return;
  for (ReceiverNumber receiver = 0; receiver < run.receivers.size(); ++receiver) {
    if (direction.knows(receiver)) continue;
    auto const number = numbers_.find(run.receivers[receiver]);
    if (number == numbers_.end() || !found->knows(number->second)) continue;
    run.answers.copy(*found, number->second, direction, receiver);
    note_recalled(direction);
  }
}

AnswerStore::Direction::Interior* DiskCache::recall_interior(SceneAnswers& run,
                                                             AnswerStore::Direction& direction,
                                                             std::uint64_t window_and_list) {
  auto const* const found = find(run, direction);
  if (found == nullptr) return nullptr;
  auto const answers = found->interior.find(window_and_list);
  if (answers == found->interior.end()) return nullptr;
  note_recalled(direction);
  return &run.answers.keep_interior(direction, window_and_list, found->sunlit(answers->second));
}

void DiskCache::store(SceneAnswers const& run) {
  if (folder_.read_only) return;
  known_ = SceneAnswers();
  numbers_.clear();
  CacheLock const lock(folder_.path / cache_lock_name);
  SceneAnswers all;
  try {
    all = read_answers(file_, scene_, limits_);
  } catch (Error const&) {
    // It cannot be used; the user has been told, or will be when it happens again.
    all = SceneAnswers();
  }
  // When it is full, it is cleared and filled again, as in memory.
  if (all.answers.bytes() + run.answers.bytes() > AnswerStore::default_max_bytes)
    all = SceneAnswers();
  add_answers(run, all);
  write_file(file_, encode(all, scene_));
  bound_cache_folder(folder_.path, folder_.max_bytes, file_);
}

}  // namespace gpu_shading::energyplus

#include "cache/answer_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "base/file_descriptor.h"
#include "base/files.h"
#include "cache/cache_folder.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// Returns no answers if there is no file. Throws Error, without the file's name, if it cannot be
// used.
AnswerSet read_answers(Path const& path, Hash const& scene, AnswerLimits const& limits) {
  // Opened only once, because another file may replace it at any moment; a pipe is not waited for.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  FileDescriptor const file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.is_open() && errno == ENOENT) return AnswerSet();
  struct stat found {};
  if (!file.is_open() || fstat(file.get(), &found) != 0 || !S_ISREG(found.st_mode)) {
    throw Error("cannot be read");
  }
  auto const size = static_cast<std::size_t>(found.st_size);
  if (size > Answers::default_most_bytes) throw Error("is too large");
  std::vector<std::byte> bytes(size);
  for (std::size_t done = 0; done < size;) {
    auto const count = read(file.get(), bytes.data() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Error("cannot be read");
    done += static_cast<std::size_t>(count);
  }
  auto answers = decode(bytes, scene);
  check_answers(answers, limits);
  return answers;
}

// A lock on the folder for the lifetime of this object. If another process holds it, or the file
// system has no locks, the cache works without it; at worst, answers stored at the same moment are
// lost.
class Lock {
 public:
  explicit Lock(Path const& folder) : file_(open_lock(folder / cache_lock_name)) {
    constexpr int tries = 200;
    constexpr std::chrono::milliseconds pause(10);
    for (int i = 0; file_.is_open() && i < tries; ++i) {
      if (flock(file_.get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
      std::this_thread::sleep_for(pause);
    }
  }

 private:
  static int open_lock(Path const& path) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
    return open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  }

  FileDescriptor file_;
};

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

AnswerCache::AnswerCache(Path const& folder, Hash const& scene, AnswerLimits limits,
                         std::function<void(std::string const&)> const& remark,
                         std::uint64_t most_bytes)
    : folder_(folder),
      file_(folder / cache_file_name(to_text(scene))),
      scene_(scene),
      limits_(std::move(limits)),
      most_bytes_(most_bytes) {
  try {
    known_ = read_answers(file_, scene_, limits_);
  } catch (Error const& error) {
    remark(
        fmt::format("--gpu-shading-cache: {} {}: it is ignored, and replaced at the end of the run",
                    file_.string(), error.what()));
    return;
  }
  for (ReceiverNumber number = 0; number < known_.receivers.size(); ++number) {
    numbers_[known_.receivers[number]] = number;
  }
  // The most recently used files are removed last.
  std::error_code ignored;
  std::filesystem::last_write_time(file_, std::filesystem::file_time_type::clock::now(), ignored);
}

Answers::Direction const* AnswerCache::find(AnswerSet const& run,
                                            Answers::Direction const& direction) const {
  auto const state = known_.states.find(run.states[direction.state]);
  return state ? known_.answers.find(direction.sun, *state) : nullptr;
}

void AnswerCache::note_recalled(Answers::Direction& direction) {
  if (!direction.recalled) ++directions_recalled_;
  direction.recalled = true;
}

void AnswerCache::recall(AnswerSet& run, Answers::Direction& direction) {
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

std::vector<Sunlit> const* AnswerCache::recall_interior(AnswerSet& run,
                                                        Answers::Direction& direction,
                                                        std::uint64_t window_and_list) {
  auto const* const found = find(run, direction);
  if (found == nullptr) return nullptr;
  auto const answers = found->interior.find(window_and_list);
  if (answers == found->interior.end()) return nullptr;
  note_recalled(direction);
  return &run.answers.keep_interior(direction, window_and_list, answers->second);
}

void AnswerCache::store(AnswerSet const& run) {
  known_ = AnswerSet();
  numbers_.clear();
  Lock const lock(folder_);
  AnswerSet all;
  try {
    all = read_answers(file_, scene_, limits_);
  } catch (Error const&) {
    // It cannot be used; the user has been told, or will be when it happens again.
    all = AnswerSet();
  }
  // When it is full, it is cleared and filled again, as in memory.
  if (all.answers.bytes() + run.answers.bytes() > Answers::default_most_bytes) all = AnswerSet();
  add_answers(run, all);
  write_file(file_, encode(all, scene_));
  bound_cache_folder(folder_, most_bytes_, file_);
}

}  // namespace gpu_shading::energyplus

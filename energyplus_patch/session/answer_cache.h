#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "session/answer_file.h"

namespace gpu_shading::energyplus {

// Answers of one scene that outlast the run: in a folder, a file for each scene, by its hash. Safe
// with any number of processes: a file is replaced in one step, after what others have stored in
// the meantime was added to it, and one that is damaged counts as none.
class AnswerCache {
 public:
  static constexpr std::uint64_t default_most_bytes = std::uint64_t{1} << 30U;  // of the folder

  // Reads what there is. A file that is of no use gives a remark, and is replaced by store().
  AnswerCache(std::filesystem::path const& folder, Hash const& scene,
              std::function<void(std::string const&)> const& remark,
              std::uint64_t most_bytes = default_most_bytes);

  // Gives a direction of the run's what it lacks of the run's receivers, and is known here.
  void recall(AnswerSet& run, Answers::Direction& direction);

  // The same of an interior's question; nullptr where it is not known.
  std::vector<Sunlit> const* recall_interior(AnswerSet& run, Answers::Direction& direction,
                                             std::uint64_t window_and_list);

  // How many directions of the run were given something.
  std::size_t directions_recalled() const { return directions_recalled_; }

  // Adds the run's answers to the file, and keeps the folder within its bound. To be called once,
  // at the end: what was read is forgotten. Throws Error when the file cannot be written, and
  // leaves no part of it.
  void store(AnswerSet const& run);

 private:
  Answers::Direction const* find(AnswerSet const& run, Answers::Direction const& direction) const;
  void note_recalled(Answers::Direction& direction);

  std::filesystem::path folder_;
  std::filesystem::path file_;
  Hash scene_;
  std::uint64_t most_bytes_;
  std::size_t directions_recalled_ = 0;
  AnswerSet known_;
  std::unordered_map<SurfaceId, ReceiverNumber> numbers_;  // of known_.receivers
};

}  // namespace gpu_shading::energyplus

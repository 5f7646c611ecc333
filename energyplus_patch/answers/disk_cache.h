#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "answers/cache_encoding.h"
#include "model/options/options.h"

namespace gpu_shading::energyplus {

// Answers of one scene that are kept after the run, in a folder with one file per scene, named by
// its hash. Safe with any number of processes: a file is replaced in one step, after answers that
// others have stored meanwhile are added; a damaged file counts as missing.
class DiskCache {
 public:
  // Reads the file if there is one. A file that cannot be used gives a remark and is replaced by
  // store(), unless the cache is only read.
  DiskCache(CacheFolder folder, Hash const& scene, AnswerLimits limits,
            std::function<void(std::string const&)> const& remark);

  // Adds known answers for the run's receivers to a direction of the run.
  void recall(SceneAnswers& run, AnswerStore::Direction& direction);

  // The same for a question about interior surfaces; nullptr if it is not known.
  AnswerStore::Direction::Interior* recall_interior(SceneAnswers& run,
                                                    AnswerStore::Direction& direction,
                                                    std::uint64_t window_and_list);

  // Number of directions of the run that received an answer.
  std::size_t directions_recalled() const { return directions_recalled_; }

  // Adds the run's answers to the file and keeps the folder within its size limit. Call it once, at
  // the end: the answers that were read are discarded. Throws Error if the file cannot be written,
  // and leaves no partial file.
  void store(SceneAnswers const& run);

 private:
  AnswerStore::Direction const* find(SceneAnswers const& run,
                                     AnswerStore::Direction const& direction) const;
  void note_recalled(AnswerStore::Direction& direction);

  CacheFolder folder_;
  std::filesystem::path file_;
  Hash scene_;
  AnswerLimits limits_;
  std::size_t directions_recalled_ = 0;
  SceneAnswers known_;
  std::unordered_map<SurfaceId, ReceiverNumber> numbers_;  // of known_.receivers
};

}  // namespace gpu_shading::energyplus

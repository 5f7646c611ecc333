#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/renderer.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

struct SampledReceiver {
  std::string name;
  glm::dvec3 area{};  // unit normal times net area, m2

  bool operator==(SampledReceiver const&) const = default;
};

// What samples are of: the same for all parts of them.
struct SampledScene {
  std::string asked;     // in the asker's words: what differs there is other samples
  std::string hash;      // of geometry, optics, fineness and build: hash_scene() of no device
  std::string fineness;  // "error 0.001", "512 x 512 pixels"
  std::vector<SampledReceiver> receivers;
  std::vector<std::string> schedules;  // whose numbers answers have

  std::vector<glm::dvec3> areas() const;  // of the receivers

  bool operator==(SampledScene const&) const = default;
};

// One of `shards` equal shares of the samples: every so many-th direction of each round, from the
// number-th on; from 1.
struct Shard {
  int number = 1;
  int shards = 1;

  bool has(std::size_t direction) const {
    return direction % static_cast<std::size_t>(shards) == static_cast<std::size_t>(number - 1);
  }
  bool operator==(Shard const&) const = default;
};

// What a shard has rendered of a round.
struct SamplePart {
  SampledScene scene;
  std::string device;  // "RENDERER (VERSION)"
  int round = 1;
  Shard shard;
  std::vector<SunDirection> directions;      // of the whole round
  std::vector<std::vector<Sunlit>> answers;  // at the shard's, of every receiver
};

// A folder of parts, a file for each: written whole or not at all, by any number of processes.
// Numbers come back to the last digit.
class SampleParts {
 public:
  // Of so many shards.
  SampleParts(std::filesystem::path folder, int shards);

  std::filesystem::path file(int round, int shard) const;

  // Nothing where there is no such file. Throws Error where it is something else.
  std::optional<SamplePart> find(int round, int shard) const;

  // Makes the folder where it is missing. Throws Error where that or the file cannot be written.
  void write(SamplePart const& part) const;

  int shards() const { return shards_; }

 private:
  std::filesystem::path folder_;
  int shards_;
};

// What the shards have rendered of a round of a scene.
struct RenderedRound {
  std::vector<int> missing;                  // shards; parts of other scenes count as missing
  std::vector<std::string> devices;          // each once
  std::vector<std::vector<Sunlit>> answers;  // by direction, where no shard is missing
};

// Throws Error where a shard has rendered other directions.
RenderedRound find_round(SampleParts const& parts, SampledScene const& scene, int round,
                         std::vector<SunDirection> const& directions);

// "1, 5": for messages.
std::string list_shards(std::vector<int> const& shards);

}  // namespace gpu_shading::energyplus

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

// The scene of the samples, which is the same for all parts.
struct SampledScene {
  // The caller's description; a different one means different samples.
  std::string asked;
  // Of geometry, optics, resolution and build: hash_scene() without a device.
  std::string hash;
  std::string fineness;  // "error 0.001", "512 x 512 pixels"
  std::vector<SampledReceiver> receivers;
  std::vector<std::string> schedules;  // which answers refer to by index

  std::vector<glm::dvec3> areas() const;  // of the receivers

  bool operator==(SampledScene const&) const = default;
};

// One of `shards` equal shares of the samples: every shards-th direction of each round, starting
// with the number-th, counted from 1.
struct Shard {
  int number = 1;
  int shards = 1;

  bool has(std::size_t direction) const {
    return direction % static_cast<std::size_t>(shards) == static_cast<std::size_t>(number - 1);
  }
  bool operator==(Shard const&) const = default;
};

// The answers of one shard in one round.
struct SamplePart {
  SampledScene scene;
  std::string device;  // "RENDERER (VERSION)"
  int round = 1;
  Shard shard;
  std::vector<SunDirection> directions;      // of the whole round
  std::vector<std::vector<Sunlit>> answers;  // at the shard's directions, for every receiver
};

// A folder with one file per part. Each is written completely or not at all, by any number of
// processes. Numbers are read back to the last digit.
class SampleParts {
 public:
  // The folder's parts for this number of shards.
  SampleParts(std::filesystem::path folder, int shards);

  std::filesystem::path file(int round, int shard) const;

  // Empty if there is no such file. Throws Error if the file is not such a part.
  std::optional<SamplePart> find(int round, int shard) const;

  // Creates the folder if it is missing. Throws Error if the folder or the file cannot be written.
  void write(SamplePart const& part) const;

  int shards() const { return shards_; }

 private:
  std::filesystem::path folder_;
  int shards_;
};

// The answers of all shards in a round of a scene.
struct RenderedRound {
  std::vector<int> missing;          // missing shards; parts of other scenes count as missing
  std::vector<std::string> devices;  // each once
  std::vector<std::vector<Sunlit>> answers;  // by direction, if no shard is missing
};

// Throws Error if a shard has rendered other directions.
RenderedRound find_round(SampleParts const& parts, SampledScene const& scene, int round,
                         std::vector<SunDirection> const& directions);

// "1, 5": for messages.
std::string list_shards(std::vector<int> const& shards);

}  // namespace gpu_shading::energyplus

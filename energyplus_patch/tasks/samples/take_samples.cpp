#include "tasks/samples/take_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "platform/progress.h"

namespace gpu_shading::energyplus {
namespace {

// Rendered in batches, each of which reports progress; this does not change an answer.
std::vector<std::vector<Sunlit>> render(std::vector<SunDirection> const& directions,
                                        SunlitSource const& source, std::string const& work,
                                        int descriptor) {
  constexpr std::size_t lot = 32;
  Progress progress(work, directions.size(), descriptor);
  std::vector<std::vector<Sunlit>> rows;
  for (std::size_t begin = 0; begin < directions.size(); begin += lot) {
    auto const count = std::min(lot, directions.size() - begin);
    for (auto& row : source(std::span(directions).subspan(begin, count))) {
      rows.push_back(std::move(row));
    }
    progress.at(rows.size());
  }
  return rows;
}

std::vector<SunDirection> share(std::vector<SunDirection> const& directions, Shard const& shard) {
  std::vector<SunDirection> own;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (shard.has(i)) own.push_back(directions[i]);
  }
  return own;
}

// Until all shares of the round are there, or as long as the request allows.
RenderedRound wait_for_round(SampleRequest const& request, SampleParts const& parts,
                             SampledScene const& scene, int round,
                             std::vector<SunDirection> const& directions) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds pause(50);
  auto const end = Clock::now() + std::chrono::duration<double>(request.wait);
  auto found = find_round(parts, scene, round, directions);
  while (!found.missing.empty() && Clock::now() < end) {
    std::this_thread::sleep_for(pause);
    if (std::filesystem::exists(parts.file(round, found.missing.front()))) {
      found = find_round(parts, scene, round, directions);
    }
  }
  return found;
}

bool lacks(RenderedRound const& found, int shard) {
  return std::find(found.missing.begin(), found.missing.end(), shard) != found.missing.end();
}

}  // namespace

std::string take_samples(SampleRequest const& request, Sampling sampling, SampledScene const& scene,
                         std::string const& device, SunlitSource const& source) {
  SampleParts const parts(request.parts, request.shard.shards);
  SampleRounds rounds(sampling, request.latitude, scene.areas());
  std::size_t rendered = 0;
  int round = 1;
  for (; !rounds.directions().empty(); ++round) {
    auto const& directions = rounds.directions();
    auto found = find_round(parts, scene, round, directions);
    if (lacks(found, request.shard.number)) {
      auto const own = share(directions, request.shard);
      auto const work = fmt::format("rendering samples, round {}", round);
      auto answers = render(own, source, work, request.progress);
      parts.write({scene, device, round, request.shard, directions, answers});
      rendered += own.size();
      if (request.shard.shards > 1 && request.wait == 0.0) {
        return fmt::format("round {}: {} directions rendered, {} of {} shards left", round,
                           rendered, found.missing.size() - 1, request.shard.shards);
      }
      found.answers = std::move(answers);
      found.missing.clear();
    }
    if (request.shard.shards > 1) found = wait_for_round(request, parts, scene, round, directions);
    if (!found.missing.empty()) {
      auto const done =
          rendered == 0 ? "nothing to render" : fmt::format("{} directions rendered", rendered);
      return fmt::format("round {}: {}, waiting for shards {}", round, done,
                         list_shards(found.missing));
    }
    rounds.add(found.answers);
  }
  return fmt::format("{} directions rendered, all {} rounds are complete", rendered, round - 1);
}

}  // namespace gpu_shading::energyplus

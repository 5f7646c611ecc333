#include "tasks/samples/take_samples.h"

#include <fmt/format.h>

#include <algorithm>
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
      if (request.shard.shards > 1) {
        return fmt::format("round {}: {} directions rendered, {} of {} shards left", round,
                           rendered, found.missing.size() - 1, request.shard.shards);
      }
      found.answers = std::move(answers);
      found.missing.clear();
    }
    if (!found.missing.empty()) {
      return fmt::format("round {}: nothing to render, waiting for shards {}", round,
                         list_shards(found.missing));
    }
    rounds.add(found.answers);
  }
  return fmt::format("{} directions rendered, all {} rounds are complete", rendered, round - 1);
}

}  // namespace gpu_shading::energyplus

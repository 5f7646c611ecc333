#include "tasks/samples/sample_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "answers/answer_store.h"
#include "gpu_shading/error.h"
#include "platform/files.h"
#include "scene/digest.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

constexpr int format = 3;

// A plain number if nothing is scheduled, which is nearly always.
Json to_json(Sunlit const& answer) {
  if (answer.scheduled.empty()) return answer.projected_area;
  Json parts = Json::array();
  for (auto const& part : answer.scheduled) parts.push_back({part.powers, part.projected_area});
  return {answer.projected_area, std::move(parts)};
}

// Conversion by the library is undefined for a fraction or an exponent that no int holds.
int whole_number(Json const& json) {
  bool const fits = json.is_number_unsigned()
                        ? std::in_range<int>(json.get<std::uint64_t>())
                        : json.is_number_integer() && std::in_range<int>(json.get<std::int64_t>());
  if (!fits) throw Error("holds numbers that are not possible");
  return json.get<int>();
}

Sunlit answer_from(Json const& json) {
  Sunlit answer;
  if (json.is_number()) {
    answer.projected_area = json.get<double>();
    return answer;
  }
  answer.projected_area = json.at(0).get<double>();
  for (auto const& part : json.at(1)) {
    auto& scheduled = answer.scheduled.emplace_back();
    for (auto const& power : part.at(0)) {
      scheduled.powers.emplace_back(whole_number(power.at(0)), whole_number(power.at(1)));
    }
    scheduled.projected_area = part.at(1).get<double>();
  }
  return answer;
}

Json to_json(SamplePart const& part) {
  Json json{{"format", format},
            {"asked", part.scene.asked},
            {"scene", part.scene.hash},
            {"fineness", part.scene.fineness},
            {"schedules", part.scene.schedules},
            {"device", part.device},
            {"round", part.round},
            {"shard", part.shard.number},
            {"shards", part.shard.shards},
            {"receivers", Json::array()},
            {"directions", Json::array()},
            {"answers", Json::array()}};
  for (auto const& [name, area] : part.scene.receivers) {
    json["receivers"].push_back({name, area.x, area.y, area.z});
  }
  for (auto const& sun : part.directions) {
    json["directions"].push_back({sun.azimuth, sun.altitude});
  }
  for (auto const& answers : part.answers) {
    auto row = Json::array();
    for (auto const& answer : answers) row.push_back(to_json(answer));
    json["answers"].push_back(std::move(row));
  }
  return json;
}

std::string checksum(std::string_view contents) {
  Digest digest;
  digest.add(contents);
  return to_text(digest.result());
}

// A JSON object of which the first member is the checksum of the others, to the end of the line.
constexpr std::string_view checksum_key = "{\"xxh128\":\"";
constexpr std::string_view checksum_end = "\",";

std::string with_checksum(Json const& json) {
  auto const contents = json.dump().substr(1);
  return fmt::format("{}{}{}{}\n", checksum_key, checksum(contents), checksum_end, contents);
}

Json without_checksum(std::string_view text) {
  auto const digits = 2 * sizeof(Hash);
  auto const head = checksum_key.size() + digits + checksum_end.size();
  if (text.starts_with("{") && !text.starts_with(checksum_key)) throw Error("has another version");
  if (text.size() <= head || !text.starts_with(checksum_key) || text.back() != '\n') {
    throw Error("is damaged");
  }
  auto const contents = text.substr(head, text.size() - head - 1);
  if (text.substr(checksum_key.size(), digits) != checksum(contents) ||
      text.substr(head - checksum_end.size(), checksum_end.size()) != checksum_end) {
    throw Error("is damaged");
  }
  return Json::parse(fmt::format("{{{}", contents));
}

// What no renderer answers is not believed, even with the right checksum.
void check_part(SamplePart const& part) {
  auto const refuse = [] { throw Error("holds answers that are not possible"); };
  AnswerLimits limits{{}, part.scene.schedules.size()};
  for (auto const& receiver : part.scene.receivers) {
    limits.areas.push_back(glm::length(receiver.area));
    if (!std::isfinite(limits.areas.back())) refuse();
  }
  for (auto const& sun : part.directions) {
    if (!std::isfinite(sun.azimuth) || !std::isfinite(sun.altitude)) refuse();
  }
  for (auto const& row : part.answers) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!limits.allow(row[i], limits.areas[i])) refuse();
    }
  }
}

SamplePart part_from(Json const& json) {
  SamplePart part;
  if (json.at("format") != format) throw Error("has another version");
  part.scene = {json.at("asked"), json.at("scene"), json.at("fineness"), {}, json.at("schedules")};
  part.device = json.at("device");
  part.round = whole_number(json.at("round"));
  part.shard = {whole_number(json.at("shard")), whole_number(json.at("shards"))};
  for (auto const& receiver : json.at("receivers")) {
    part.scene.receivers.push_back(
        {receiver.at(0), {receiver.at(1), receiver.at(2), receiver.at(3)}});
  }
  for (auto const& sun : json.at("directions")) {
    part.directions.push_back({sun.at(0), sun.at(1)});
  }
  for (auto const& row : json.at("answers")) {
    auto& answers = part.answers.emplace_back();
    for (auto const& answer : row) answers.push_back(answer_from(answer));
    if (answers.size() != part.scene.receivers.size()) throw Error("lacks receivers");
  }
  check_part(part);
  return part;
}

std::size_t share(std::size_t directions, Shard const& shard) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < directions; ++i) count += shard.has(i) ? 1 : 0;
  return count;
}

}  // namespace

std::vector<glm::dvec3> SampledScene::areas() const {
  std::vector<glm::dvec3> areas;
  areas.reserve(receivers.size());
  for (auto const& receiver : receivers) areas.push_back(receiver.area);
  return areas;
}

SampleParts::SampleParts(Path folder, int shards) : folder_(std::move(folder)), shards_(shards) {}

Path SampleParts::file(int round, int shard) const {
  return folder_ / fmt::format("round{}-shard{}of{}.json", round, shard, shards_);
}

std::optional<SamplePart> SampleParts::find(int round, int shard) const {
  auto const path = file(round, shard);
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    auto part = part_from(without_checksum(read_text_file(path)));
    if (part.round != round || !(part.shard == Shard{shard, shards_}) ||
        part.answers.size() != share(part.directions.size(), part.shard)) {
      throw Error("belongs to another round or shard");
    }
    return part;
  } catch (std::bad_alloc const&) {
    throw;
  } catch (std::exception const& error) {
    throw Error(
        fmt::format("{}: is not a part of samples ({}); delete it", path.string(), error.what()));
  }
}

void SampleParts::write(SamplePart const& part) const {
  std::error_code failure;
  std::filesystem::create_directories(folder_, failure);
  write_whole_file(file(part.round, part.shard.number),
                   [&](std::ostream& out) { out << with_checksum(to_json(part)); });
}

RenderedRound find_round(SampleParts const& parts, SampledScene const& scene, int round,
                         std::vector<SunDirection> const& directions) {
  RenderedRound found;
  found.answers.resize(directions.size());
  for (int number = 1; number <= parts.shards(); ++number) {
    auto part = parts.find(round, number);
    if (!part || !(part->scene == scene)) {
      found.missing.push_back(number);
      continue;
    }
    if (part->directions != directions) {
      throw Error(
          fmt::format("{}: does not match the earlier rounds (another CPU model?); delete it",
                      parts.file(round, number).string()));
    }
    auto& devices = found.devices;
    if (std::find(devices.begin(), devices.end(), part->device) == devices.end()) {
      devices.push_back(part->device);
    }
    auto answers = part->answers.begin();
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (part->shard.has(i)) found.answers[i] = std::move(*answers++);
    }
  }
  return found;
}

std::string list_shards(std::vector<int> const& shards) {
  return fmt::format("{}", fmt::join(shards, ", "));
}

}  // namespace gpu_shading::energyplus

#include "tasks/task_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "gpu_shading/error.h"
#include "platform/error_line.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

void write(Path const& file, Json const& json) {
  auto const bytes = Json::to_cbor(json);
  write_whole_file(file, [&](std::ostream& out) {
    out.write(reinterpret_cast<char const*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  });
}

template <typename Parse>
auto read(Path const& file, Parse const& parse) {
  auto const bytes = read_text_file(file);
  try {
    return parse(Json::from_cbor(bytes));
  } catch (Json::exception const& error) {
    throw Error(
        fmt::format("{}: is not a file of gpu_shading's own ({})", file.string(), error.what()));
  }
}

Json to_json(ListingTask const& task) {
  return {{"kind", "listing"}, {"vertices", task.vertices}, {"json", task.json}};
}

Json to_json(ViewsTask const& task) {
  Json views = Json::array();
  for (auto const& [picture, sun, receiver, camera] : task.views) {
    views.push_back(Json::array({picture, sun.azimuth, sun.altitude, receiver}));
    if (!camera) continue;
    views.back().push_back(camera->azimuth);
    views.back().push_back(camera->altitude);
  }
  return {{"kind", "views"},
          {"views", std::move(views)},
          {"folder", task.folder.string()},
          {"size", task.size},
          {"range", task.range}};
}

Json to_json(SamplesTask const& task) {
  return {{"kind", "samples"},          {"asked", task.asked},
          {"latitude", task.latitude},  {"parts", task.parts.string()},
          {"shard", task.shard.number}, {"shards", task.shard.shards},
          {"progress", task.progress},  {"wait", task.wait}};
}

Json run_to_json(RunTimes const& run) {
  Json times = Json::array();
  for (auto const& time : run.times) {
    times.push_back({time.month, time.day, time.hour, time.timestep, time.sun.azimuth,
                     time.sun.altitude, Json(time.schedules), time.beam, time.wind});
  }
  return {{"steps", run.steps_per_hour}, {"schedules", run.schedules}, {"times", std::move(times)}};
}

RunTimes run_of(Json const& json) {
  RunTimes run{json.at("steps"), {}, json.at("schedules")};
  for (auto const& time : json.at("times")) {
    RunTime added{time.at(0), time.at(1), time.at(2), time.at(3), {time.at(4), time.at(5)},
                  time.at(6), time.at(7)};
    added.wind = time.at(8);
    run.times.push_back(std::move(added));
  }
  return run;
}

Json to_json(MapTask const& task) {
  return {{"kind", "maps"},
          {"receivers", task.receivers},
          {"spacing", task.spacing},
          {"rays", task.rays_per_cell},
          {"run", run_to_json(task.run)},
          {"file", task.file.string()},
          {"progress", task.progress}};
}

Json to_json(ModulesTask const& task) {
  return {{"kind", "modules"},
          {"run", run_to_json(task.run)},
          {"folder", task.folder.string()},
          {"file", task.file.string()},
          {"progress", task.progress}};
}

Json directions_to_json(std::vector<SunDirection> const& directions) {
  Json json = Json::array();
  for (auto const& direction : directions) {
    json.push_back({direction.azimuth, direction.altitude});
  }
  return json;
}

std::vector<SunDirection> directions_of(Json const& json) {
  std::vector<SunDirection> directions;
  for (auto const& direction : json) directions.push_back({direction.at(0), direction.at(1)});
  return directions;
}

Json to_json(DirectionsTask const& task) {
  return {{"kind", "directions"},
          {"directions", directions_to_json(task.directions)},
          {"file", task.file.string()}};
}

Json to_json(MaskTask const& task) {
  return {{"kind", "masks"},
          {"receivers", task.receivers},
          {"step", task.step},
          {"rays", task.rays},
          {"spacing", task.spacing},
          {"suns", directions_to_json(task.suns)},
          {"file", task.file.string()},
          {"progress", task.progress}};
}

Json to_json(SurroundingsTask const& task) {
  return {{"kind", "surroundings"},
          {"rays", task.rays},
          {"file", task.file.string()},
          {"table", task.table.string()},
          {"progress", task.progress}};
}

Task to_task(Json const& json) {
  auto const kind = json.at("kind").get<std::string>();
  if (kind == "listing") return ListingTask{json.at("vertices"), json.at("json")};
  if (kind == "maps") {
    return MapTask{json.at("receivers"),
                   json.at("spacing"),
                   json.at("rays"),
                   run_of(json.at("run")),
                   json.at("file").get<std::string>(),
                   json.at("progress")};
  }
  if (kind == "modules") {
    return ModulesTask{run_of(json.at("run")), json.at("folder").get<std::string>(),
                       json.at("file").get<std::string>(), json.at("progress")};
  }
  if (kind == "directions") {
    return DirectionsTask{directions_of(json.at("directions")), json.at("file").get<std::string>()};
  }
  if (kind == "surroundings") {
    return SurroundingsTask{json.at("rays"), json.at("file").get<std::string>(),
                            json.at("table").get<std::string>(), json.at("progress")};
  }
  if (kind == "masks") {
    return MaskTask{json.at("receivers"),
                    json.at("step"),
                    json.at("rays"),
                    json.at("spacing"),
                    directions_of(json.at("suns")),
                    json.at("file").get<std::string>(),
                    json.at("progress")};
  }
  if (kind == "samples") {
    return SamplesTask{json.at("asked"),
                       json.at("latitude"),
                       json.at("parts").get<std::string>(),
                       {json.at("shard"), json.at("shards")},
                       json.at("progress"),
                       json.at("wait")};
  }
  ViewsTask task{{}, json.at("folder").get<std::string>(), json.at("size"), json.at("range")};
  for (auto const& view : json.at("views")) {
    task.views.push_back({view.at(0), {view.at(1), view.at(2)}, view.at(3)});
    constexpr std::size_t with_camera = 6;
    if (view.size() == with_camera) {
      task.views.back().camera = SunDirection{view.at(4), view.at(5)};
    }
  }
  return task;
}

Json ring_to_json(Ring const& ring) {
  Json json = Json::array();
  for (auto const& point : ring) json.push_back({point.x, point.y, point.z});
  return json;
}

Ring ring_of(Json const& json) {
  Ring ring;
  for (auto const& point : json) ring.emplace_back(point.at(0), point.at(1), point.at(2));
  return ring;
}

Json polygon_to_json(Polygon const& polygon) {
  Json rings = Json::array({ring_to_json(polygon.outline)});
  for (auto const& hole : polygon.holes) rings.push_back(ring_to_json(hole));
  return rings;
}

Polygon polygon_of(Json const& json) {
  Polygon polygon{ring_of(json.at(0)), {}};
  for (std::size_t i = 1; i < json.size(); ++i) polygon.holes.push_back(ring_of(json[i]));
  return polygon;
}

Json map_to_json(ReceiverMap const& map) {
  Json values = Json::array();
  for (auto const& value : map.values) values.push_back({value.hours, value.energy});
  return {
      {"name", map.name}, {"polygon", polygon_to_json(map.polygon)}, {"values", std::move(values)}};
}

ReceiverMap map_of(Json const& json) {
  ReceiverMap map{json.at("name"), polygon_of(json.at("polygon")), {}};
  for (auto const& value : json.at("values")) map.values.push_back({value.at(0), value.at(1)});
  return map;
}

// Many: as bytes.
Json shares_to_json(std::vector<BeamShare> const& shares) {
  std::vector<std::uint8_t> bytes(shares.size() * sizeof(BeamShare));
  std::ranges::copy(std::as_bytes(std::span{shares}),
                    std::as_writable_bytes(std::span{bytes}).begin());
  return Json::binary(std::move(bytes));
}

std::vector<BeamShare> shares_of(Json const& json) {
  static_assert(std::is_trivially_copyable_v<BeamShare>);
  auto const& bytes = json.get_binary();
  std::vector<BeamShare> shares(bytes.size() / sizeof(BeamShare));
  auto const read = std::as_writable_bytes(std::span{shares});
  std::ranges::copy(std::as_bytes(std::span{bytes}).first(read.size()), read.begin());
  return shares;
}

ReceiverMask mask_of(Json const& json) {
  ReceiverMask mask{{json.at("name"), ring_of(json.at("area")).front()},
                    std::nullopt,
                    shares_of(json.at("sky")),
                    shares_of(json.at("suns")),
                    json.at("horizon")};
  auto const point = ring_of(json.at("point"));
  if (!point.empty()) mask.point = point.front();
  return mask;
}

}  // namespace

void write_request(Path const& file, TaskRequest const& request) {
  auto json = std::visit([](auto const& task) { return to_json(task); }, request.task);
  json["reply"] = request.reply.string();
  write(file, json);
}

TaskRequest read_request(Path const& file) {
  return read(file, [](Json const& json) {
    return TaskRequest{to_task(json), json.at("reply").get<std::string>()};
  });
}

void write_reply(Path const& file, TaskReply const& reply) {
  write(file, {{"text", reply.text}, {"warnings", reply.warnings}, {"error", reply.error}});
}

std::optional<TaskReply> find_reply(Path const& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  return read(file, [](Json const& json) {
    return TaskReply{json.at("text"), json.at("warnings"), json.at("error")};
  });
}

void write_maps(Path const& file, std::vector<ReceiverMap> const& maps) {
  Json json = Json::array();
  for (auto const& map : maps) json.push_back(map_to_json(map));
  write(file, json);
}

std::vector<ReceiverMap> read_maps(Path const& file) {
  return read(file, [](Json const& json) {
    std::vector<ReceiverMap> maps;
    for (auto const& map : json) maps.push_back(map_of(map));
    return maps;
  });
}

void write_fractions(Path const& file, std::vector<ReceiverFractions> const& receivers) {
  Json json = Json::array();
  for (auto const& [receiver, fractions] : receivers) {
    auto const& area = receiver.area;
    json.push_back({receiver.name, area.x, area.y, area.z, Json(fractions)});
  }
  write(file, json);
}

std::vector<ReceiverFractions> read_fractions(Path const& file) {
  return read(file, [](Json const& json) {
    std::vector<ReceiverFractions> receivers;
    for (auto const& row : json) {
      receivers.push_back({{row.at(0), {row.at(1), row.at(2), row.at(3)}}, row.at(4)});
    }
    return receivers;
  });
}

void write_masks(Path const& file, std::vector<ReceiverMask> const& masks) {
  Json json = Json::array();
  for (auto const& [receiver, point, sky, suns, horizon] : masks) {
    json.push_back({{"name", receiver.name},
                    {"area", ring_to_json({receiver.area})},
                    {"point", ring_to_json(point ? Ring{*point} : Ring{})},
                    {"sky", shares_to_json(sky)},
                    {"suns", shares_to_json(suns)},
                    {"horizon", horizon}});
  }
  write(file, json);
}

std::vector<ReceiverMask> read_masks(Path const& file) {
  return read(file, [](Json const& json) {
    std::vector<ReceiverMask> masks;
    for (auto const& mask : json) masks.push_back(mask_of(mask));
    return masks;
  });
}

void write_module_fields(Path const& file, std::vector<ModuleField> const& fields) {
  Json json = Json::array();
  for (auto const& [object, surface, polygon, sky] : fields) {
    Json views = Json::array();
    for (auto const& [view, unshaded] : sky) views.push_back({view, unshaded});
    json.push_back({object, surface, polygon_to_json(polygon), std::move(views)});
  }
  write(file, json);
}

std::vector<ModuleField> read_module_fields(Path const& file) {
  return read(file, [](Json const& json) {
    std::vector<ModuleField> fields;
    for (auto const& row : json) {
      fields.push_back({row.at(0), row.at(1), polygon_of(row.at(2)), {}});
      for (auto const& view : row.at(3)) fields.back().sky.push_back({view.at(0), view.at(1)});
    }
    return fields;
  });
}

void AskedTask::finish(std::string text) {
  reply_.text = std::move(text);
  write_reply(request_.reply, reply_);
  replied_ = true;
}

void AskedTask::fail(std::string const& why) noexcept {
  if (std::exchange(replied_, true)) return;
  try {
    reply_.error = why;
    write_reply(request_.reply, reply_);
  } catch (std::exception const& error) {
    // The program that waits reads it here.
    std::fprintf(stderr, "gpu_shading: error: %s\n", error_line(error).c_str());
  }
}

}  // namespace gpu_shading::energyplus

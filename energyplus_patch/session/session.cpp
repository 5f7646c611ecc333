#include "session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <numeric>
#include <set>
#include <string_view>

#include "files/whole_file.h"
#include "gpu_shading/error.h"
#include "samples/take_samples.h"
#include "session/build_id.h"
#include "session/cache_folder.h"
#include "session/draw_views.h"
#include "session/listing.h"
#include "session/report.h"
#include "session/scene_hash.h"
#include "session/shading_rule.h"
#include "site/own_building.h"

namespace gpu_shading::energyplus {
namespace {

constexpr int default_view_size = 800;

std::uint64_t hash_of(InteriorQuestion const& question) {
  // FNV-1a
  std::uint64_t hash = 0xcbf29ce484222325;
  auto const mix = [&](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3; };
  mix(question.window);
  for (auto const id : question.interiors) mix(id);
  return hash;
}

// Leaves the `limit` largest as they are and sets the others to 0; EnergyPlus spreads the beam that
// no surface takes as diffuse.
void keep_largest(std::vector<float>& areas, std::size_t limit) {
  auto const lit = static_cast<std::size_t>(
      std::count_if(areas.begin(), areas.end(), [](float area) { return area > 0.0F; }));
  if (lit <= limit) return;
  std::vector<std::size_t> order(areas.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  for (std::size_t i = limit; i < order.size(); ++i) areas[order[i]] = 0.0F;
}

std::string describe_fineness(Options const& options) {
  return options.resolution
             ? fmt::format("{} x {} pixels", *options.resolution, *options.resolution)
             : fmt::format("error {}", options.error);
}

// Each position of a screen would take samples of its own.
void refuse_moving_screens(
    std::vector<std::string> const& deployments,
    std::function<std::pair<double, double>(std::string const&)> const& range) {
  for (auto const& name : deployments) {
    auto const [least, most] = range(name);
    if (least < most) {
      throw Error(fmt::format(
          "GPUShading:PerforatedScreen: Deployment Schedule Name {}: has values from {} to {}; "
          "expected one value all the time, for samples",
          name, least, most));
    }
  }
}

}  // namespace

SurfaceId Session::add(Surface surface) {
  if (model_.lean.is_placeholder(surface.name)) surface.casting = Casting::never;
  if (surface.casting != Casting::never) surface.casting = model_.shading.casting(surface.name);
  return scene_.add(std::move(surface));
}

std::vector<SurfaceId> Session::shading_surfaces() const {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < scene_.size(); ++id) {
    if (model_.shading.shading_surfaces.contains(scene_[id].name)) ids.push_back(id);
  }
  return ids;
}

void Session::start(Messages messages, Schedules schedules, std::function<double()> latitude) {
  messages_ = std::move(messages);
  latitude_ = std::move(latitude);
  surfaces_ = scene_.size();
  auto const& input = model_.shading;
  areas_.clear();
  unshaded_.assign(surfaces_, false);
  numbers_.assign(surfaces_, std::nullopt);
  asked_.assign(surfaces_, false);
  std::vector<bool> wanted(surfaces_, true);
  for (SurfaceId id = 0; id < surfaces_; ++id) {
    auto const& name = scene_[id].name;
    auto const& polygon = scene_[id].polygon;
    areas_.push_back(area(polygon) * normal(polygon));
    wanted[id] = input.receives(name) && !is_reveal(name) && !model_.lean.is_placeholder(name);
    if (wanted[id]) {
      // All of them are rendered at the first question, at one go.
      if (area(polygon) > 0.0) number_of(id);
    } else if (input.shading_surfaces.contains(name) || model_.lean.is_placeholder(name)) {
      unshaded_[id] = true;
    }
  }
  add_outside_casters();
  auto const range = schedules.range;
  optics_ = ShadeOptics(model_, std::move(schedules));
  if (char const* const listing = std::getenv(listing_variable)) {
    bool const vertices = std::getenv(vertices_variable) != nullptr;
    std::ofstream(listing) << (vertices ? list_vertices(scene_, model_)
                                        : list_surfaces(scene_, model_, wanted));
    std::_Exit(EXIT_SUCCESS);
  }
  if (char const* const folder = std::getenv(views_variable)) {
    char const* const size = std::getenv(view_size_variable);
    draw(folder, size == nullptr ? default_view_size : std::atoi(size), std::move(wanted));
    std::_Exit(EXIT_SUCCESS);
  }
  if (model_.options.report) prepare_report(*model_.options.report);
  if (model_.options.cache) prepare_cache_folder(*model_.options.cache);
  if (char const* const request = std::getenv(samples_variable)) {
    refuse_moving_screens(optics_.deployment_names(), range);
    take_samples(request);
    std::_Exit(EXIT_SUCCESS);
  }
  add_walls_without_openings();
  open_renderer();
  check_device();
  describe_surfaces();
}

void Session::draw(std::filesystem::path const& folder, int size, std::vector<bool> wanted) {
  auto const views = read_views(folder / views_list);
  std::vector<SurfaceId> shown;
  for (SurfaceId id = 0; id < scene_.size(); ++id) {
    // Terrain and a town, which shade all the same, would make a dot of the model.
    if (!model_.lean.is_placeholder(scene_[id].name) && !is_site_context(id)) shown.push_back(id);
  }
  wanted.resize(scene_.size(), false);  // what was left out of EnergyPlus's input only casts
  model_.options.cache.reset();         // nothing is answered
  add_walls_without_openings();
  open_renderer();
  optics_.update({});
  renderer_->set_deployments(optics_.deployments());
  draw_views(
      views, folder,
      {*renderer_, model_.options.device, shown, std::move(wanted), optics_.factors(), size});
}

void Session::take_samples(std::filesystem::path const& request) {
  auto const wanted = read_sample_request(request);
  add_walls_without_openings();
  open_renderer();
  check_device();
  describe_surfaces();
  optics_.update({});
  deploy_screens();
  auto const& device = renderer_->device();
  auto const line = energyplus::take_samples(
      wanted, model_.options.update.sampling.value(), sampled_scene(wanted.asked),
      fmt::format("{} ({})", device.renderer, device.version),
      [this](auto directions) { return sample(directions, run_.receivers); });
  store_answers();
  write_whole_file(wanted.done, [&](std::ostream& out) { out << line << '\n'; });
}

SampledScene Session::sampled_scene(std::string const& asked) const {
  SampledScene sampled;
  sampled.asked = asked;
  sampled.hash = to_text(hash_of_scene({}));
  sampled.fineness = describe_fineness(model_.options);
  sampled.schedules = optics_.factor_names();
  for (auto const id : run_.receivers) {
    sampled.receivers.push_back({scene_[id].name, areas_[id]});
  }
  return sampled;
}

void Session::add_outside_casters() {
  for (auto& caster : model_.lean.casters) scene_.add(std::move(caster));
  model_.lean.casters.clear();
  model_.surroundings.first = static_cast<SurfaceId>(scene_.size());
  for (auto& caster : model_.surroundings.casters) scene_.add(std::move(caster.surface));
}

bool Session::is_site_context(SurfaceId id) const {
  auto const type = model_.surroundings.types.find(scene_[id].name);
  return type != model_.surroundings.types.end() && type->second == "GPUShading:SiteContext";
}

void Session::open_renderer() {
  store_answers();
  std::vector<std::string> names;
  names.reserve(scene_.size());
  Scene scene;
  casters_ = 0;
  for (SurfaceId id = 0; id < scene_.size(); ++id) {
    auto surface = scene_[id];
    names.push_back(surface.name);
    optics_.apply(surface, model_.surroundings.texture_of(id));
    if (surface.casting != Casting::never) ++casters_;
    scene.add(std::move(surface));
  }
  scene.set_rule(make_shading_rule(model_.shading, names));
  if (renderer_) earlier_ += renderer_->statistics();
  if (cache_) recalled_earlier_ += cache_->directions_recalled();
  renderer_.emplace(std::move(scene), renderer_options());
  run_.answers = Answers();
  if (auto const& folder = model_.options.cache) {
    cache_.emplace(*folder, hash_of_scene(renderer_->device()), messages_.remark);
  }
  open_samples();
  deploy_screens();
}

RendererOptions Session::renderer_options() const {
  RendererOptions options;
  options.device = model_.options.device;
  options.resolution = model_.options.resolution;
  options.error = model_.options.error;
  return options;
}

Hash Session::hash_of_scene(DeviceInfo const& device) const {
  std::vector<std::string> names;
  names.reserve(scene_.size());
  for (SurfaceId id = 0; id < scene_.size(); ++id) names.push_back(scene_[id].name);
  auto const rule = describe_shading_rule(model_.shading, names);
  return hash_scene(renderer_->scene(), {renderer_options(), device, rule, build_id()});
}

void Session::open_samples() {
  auto const& sampling = model_.options.update.sampling;
  if (!sampling) return;
  samples_.emplace(*sampling, areas_);
}

void Session::store_answers() {
  if (!cache_ || !to_store_) return;
  to_store_ = false;
  try {
    cache_->store(run_);
  } catch (Error const& error) {
    messages_.warning(error.what());
  }
}

void Session::deploy_screens() {
  state_ = run_.states.number_of(optics_.deployments());
  renderer_->set_deployments(optics_.deployments());
}

void Session::check_device() const {
  auto const& options = model_.options;
  auto const& device = renderer_->device();
  if (!device.software) return;
  if (options.mode == Mode::require) {
    throw DeviceError(fmt::format(
        "--gpu-shading=require: only {} can be had, which is no GPU; see gpu_shading devices",
        device.renderer));
  }
  if (options.device.kind == DeviceChoice::Kind::automatic) {
    messages_.warning(
        fmt::format("no GPU can be had, shading is rendered in software ({}); see gpu_shading "
                    "devices",
                    device.renderer));
  }
}

void Session::add_walls_without_openings() {
  for (SurfaceId id = 0; id < surfaces_; ++id) {
    auto const& wall = scene_[id];
    if (wall.polygon.holes.empty() || wall.casting == Casting::never) continue;
    Surface closed;
    closed.name = without_openings(wall.name);
    closed.polygon.outline = wall.polygon.outline;
    closed.casting = wall.casting;
    scene_.add(std::move(closed));
  }
}

void Session::describe_surfaces() {
  for (auto const& warning : model_.shades.warnings) messages_.warning(warning);
  for (auto const& warning : model_.screens.warnings()) messages_.warning(warning);
  if (auto const& remark = model_.lean.remark; !remark.empty()) {
    messages_.remark(remark);
    messages_.eio(
        fmt::format("! <GPU Shading Lean Input>, Surfaces Left Out, Remark\n"
                    "GPU Shading Lean Input,{},{}\n",
                    model_.lean.left_out.size(), remark));
  }
  describe_surroundings();
  warn_of_actuated_schedules();
  bool first = true;
  std::set<std::string_view> described;  // a mesh's triangles share its name
  for (auto const id : shading_surfaces()) {
    if (described.contains(scene_[id].name)) continue;
    auto optics = describe_optics(model_, scene_[id], model_.surroundings.texture_of(id));
    if (optics == "opaque") continue;
    described.insert(scene_[id].name);
    if (first) messages_.eio("! <GPU Shading Surface>, Surface Name, Transmittance\n");
    first = false;
    // Commas part the file's fields.
    std::replace(optics.begin(), optics.end(), ',', ';');
    messages_.eio(fmt::format("GPU Shading Surface,{},{}\n", scene_[id].name, optics));
  }
}

void Session::describe_surroundings() {
  auto const& surroundings = model_.surroundings;
  if (surroundings.empty()) return;
  for (auto const& warning : surroundings.warnings) messages_.warning(warning);
  for (auto const& line : warn_of_own_buildings(surroundings.buildings, scene_, model_.shading)) {
    messages_.warning(line);
  }
  messages_.eio("! <GPU Shading Surroundings>, Remark\n");
  for (auto remark : surroundings.remarks) {
    messages_.remark(remark);
    // Commas part the file's fields.
    std::replace(remark.begin(), remark.end(), ',', ';');
    messages_.eio(fmt::format("GPU Shading Surroundings,{}\n", remark));
  }
}

void Session::warn_of_actuated_schedules() const {
  auto const& input = model_.shading;
  if (input.every_timestep || model_.options.update.every_timestep) return;
  auto const warn = [&](std::string_view field, std::string const& schedule) {
    messages_.warning(fmt::format(
        "{} {} is overridden by an EMS actuator, but shading is calculated for whole periods: the "
        "value at the time counts for all of it; see --gpu-shading-update",
        field, schedule));
  };
  for (auto const& [name, surface] : input.shading_surfaces) {
    if (!input.actuated.contains(surface.transmittance_schedule)) continue;
    warn("Transmittance Schedule", surface.transmittance_schedule);
    break;
  }
  for (auto const& schedule : optics_.deployment_names()) {
    if (input.actuated.contains(schedule)) warn("Deployment Schedule", schedule);
  }
}

void Session::set_sun(SunDirection sun) {
  sun_ = foreseen_.settle(sun, latitude_);
  towards_kept_ = to_vector(sun_);
  towards_sun_ = to_vector(sun);
}

void Session::set_time(Moment moment) {
  if (!renderer_) return;
  if (optics_.update(moment)) {
    messages_.warning(
        "a Transmittance Schedule that had one value all the time has another now (overridden by "
        "an "
        "EMS or a program): it is followed from here on");
    open_renderer();
  } else if (run_.states.number_of(optics_.deployments()) != state_) {
    deploy_screens();
  }
}

ReceiverNumber Session::number_of(SurfaceId receiver) {
  auto& number = numbers_[receiver];
  if (!number) {
    number = static_cast<ReceiverNumber>(run_.receivers.size());
    run_.receivers.push_back(receiver);
  }
  return *number;
}

std::vector<SunDirection> Session::directions_ahead(std::size_t views) const {
  // Where screens move, what is ahead may find them elsewhere.
  bool const days = !samples_ && run_.states.size() == 1;
  auto ahead = days || is_sky_patch(sun_) ? foreseen_.ahead() : std::span<SunDirection const>();
  // More in one call is no faster.
  constexpr std::size_t most_views = std::size_t{1} << 16U;
  ahead = ahead.first(std::min(ahead.size(), most_views / std::max(views, std::size_t{1})));
  std::vector<SunDirection> directions(ahead.begin(), ahead.end());
  directions.push_back(sun_);
  return directions;
}

Answers::Direction& Session::answers_now(ReceiverNumber receiver) {
  auto* direction = &run_.answers.at(sun_, state_);
  if (!direction->knows(receiver) && cache_) cache_->recall(run_, *direction);
  if (!direction->knows(receiver)) {
    sample(directions_ahead(run_.receivers.size()), run_.receivers);
    direction = &run_.answers.at(sun_, state_);
  }
  if (!direction->asked && !direction->recalled) ++directions_;
  direction->asked = true;
  return *direction;
}

std::vector<std::vector<Sunlit>> Session::sample(std::span<SunDirection const> directions,
                                                 std::vector<SurfaceId> const& receivers) {
  std::vector<std::vector<Sunlit>> rows;
  std::vector<SunDirection> unknown;
  std::vector<std::size_t> places;
  std::vector<bool> lacking(receivers.size(), false);
  for (auto const sun : directions) {
    auto& direction = run_.answers.at(sun, state_);
    auto const lacks = [&](SurfaceId receiver) { return !direction.knows(number_of(receiver)); };
    auto const lacks_any = [&] { return std::any_of(receivers.begin(), receivers.end(), lacks); };
    if (cache_ && lacks_any()) cache_->recall(run_, direction);
    if (lacks_any()) {
      unknown.push_back(sun);
      places.push_back(rows.size());
    }
    auto& row = rows.emplace_back(receivers.size());
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      if (lacks(receivers[i])) {
        lacking[i] = true;
      } else {
        row[i] = direction.sunlit(number_of(receivers[i]));
      }
    }
  }
  if (unknown.empty()) return rows;
  to_store_ = true;
  std::vector<SurfaceId> wanted;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (!lacking[i]) continue;
    wanted.push_back(receivers[i]);
    columns.push_back(i);
  }
  auto rendered = renderer_->projected_sunlit_areas(unknown, wanted);
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    auto& direction = run_.answers.at(unknown[i], state_);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      auto const number = number_of(wanted[k]);
      run_.answers.keep(direction, number, std::move(rendered[i][k]));
      // As it is kept, which is how it comes back from the cache.
      rows[places[i]][columns[k]] = direction.sunlit(number);
    }
  }
  return rows;
}

float Session::projected_sunlit_area(SurfaceId receiver) {
  if (!renderer_ || receiver >= surfaces_) {
    throw Error(fmt::format("EnergyPlus asks for surface {} of {}", receiver, surfaces_));
  }
  if (unshaded_[receiver]) {
    return static_cast<float>(std::max(glm::dot(areas_[receiver], towards_sun_), 0.0));
  }
  auto const number = number_of(receiver);
  asked_[receiver] = true;
  auto const* const sampled = find_sampled(receiver);
  double const kept = sampled != nullptr ? sampled->at(optics_.factors())
                                         : answers_now(number).area(number, optics_.factors());
  return static_cast<float>(kept * for_this_sun(receiver));
}

// EnergyPlus divides by the cosine of incidence, so that at grazing incidence the rounding between
// the two directions would count for much.
double Session::for_this_sun(SurfaceId surface) const {
  double const kept = glm::dot(areas_[surface], towards_kept_);
  return kept > 0.0 ? std::max(glm::dot(areas_[surface], towards_sun_) / kept, 0.0) : 1.0;
}

Sunlit const* Session::find_sampled(SurfaceId receiver) {
  if (!samples_) return nullptr;
  number_of(receiver);
  return samples_->find(receiver, {sun_, state_, latitude_()}, run_.receivers,
                        [this](auto directions, auto const& receivers) {
                          auto const before = renderer_->statistics().directions;
                          auto rows = sample(directions, receivers);
                          directions_ += renderer_->statistics().directions - before;
                          return rows;
                        });
}

std::vector<Sunlit> const* Session::find_interior(SunDirection sun,
                                                  InteriorQuestion const& question) {
  auto& direction = run_.answers.at(sun, state_);
  auto const hash = hash_of(question);
  auto const known = direction.interior.find(hash);
  if (known != direction.interior.end()) return &known->second;
  return cache_ ? cache_->recall_interior(run_, direction, hash) : nullptr;
}

std::vector<std::vector<Sunlit>> Session::sample_interior(
    std::span<SunDirection const> directions, std::span<InteriorQuestion const> questions) {
  std::vector<std::vector<Sunlit>> rows;
  std::vector<SunDirection> unknown;
  std::vector<std::size_t> places;
  for (auto const sun : directions) {
    auto const* const row = find_interior(sun, questions.front());
    rows.push_back(row == nullptr ? std::vector<Sunlit>() : *row);
    if (row != nullptr) continue;
    unknown.push_back(sun);
    places.push_back(rows.size() - 1);
  }
  if (unknown.empty()) return rows;
  to_store_ = true;
  std::vector<InteriorQuestion> wanted;
  std::copy_if(questions.begin(), questions.end(), std::back_inserter(wanted),
               [&](InteriorQuestion const& question) {
                 return std::any_of(unknown.begin(), unknown.end(), [&](SunDirection sun) {
                   return find_interior(sun, question) == nullptr;
                 });
               });
  auto rendered = renderer_->interior_sunlit_areas(unknown, wanted);
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    auto& direction = run_.answers.at(unknown[i], state_);
    rows[places[i]] = rendered[i].front();
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      auto const hash = hash_of(wanted[k]);
      if (direction.interior.contains(hash)) continue;
      run_.answers.keep_interior(direction, hash, std::move(rendered[i][k]));
    }
  }
  return rows;
}

std::vector<Sunlit> Session::interior_now(InteriorQuestion const& question) {
  interiors_[question.window] = question;
  if (auto const* const known = find_interior(sun_, question)) return *known;
  std::vector<InteriorQuestion> questions{question};
  for (auto const& [window, other] : interiors_) {
    if (window != question.window) questions.push_back(other);
  }
  return std::move(sample_interior(directions_ahead(questions.size()), questions).back());
}

std::vector<float> Session::sampled_interior_areas(InteriorQuestion const& question) {
  auto const* const through = find_sampled(question.window);
  if (through == nullptr) return {};
  double const most = through->at(optics_.factors());
  auto const source = [&](std::span<SunDirection const> directions) {
    return sample_interior(directions, {&question, 1});
  };
  auto const* const row =
      samples_->find_interior(question.window, hash_of(question), question.interiors.size(),
                              {sun_, state_, latitude_()}, source);
  if (row == nullptr) return {};
  auto areas = areas_of(*row);
  // Each is interpolated by itself: together they get no more than the window does.
  double const sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (sum > most) {
    for (auto& area : areas) area = static_cast<float>(area * most / sum);
  }
  return areas;
}

std::vector<float> Session::areas_of(std::vector<Sunlit> const& answers) const {
  std::vector<float> areas;
  areas.reserve(answers.size());
  for (auto const& sunlit : answers) {
    areas.push_back(static_cast<float>(sunlit.at(optics_.factors())));
  }
  return areas;
}

std::vector<float> Session::interior_areas(SurfaceId window,
                                           std::vector<SurfaceId> const& interiors) {
  if (!renderer_) {
    throw Error("EnergyPlus asks for interior areas before its surfaces are complete");
  }
  InteriorQuestion const question{window, interiors};
  auto areas = sampled_interior_areas(question);
  if (areas.empty()) areas = areas_of(interior_now(question));
  auto const factor = static_cast<float>(for_this_sun(window));
  for (float& area : areas) area *= factor;
  keep_largest(areas, max_back_surfaces);
  return areas;
}

void Session::finish() {
  if (!renderer_) return;
  auto const& device = renderer_->device();
  auto did = earlier_;
  did += renderer_->statistics();
  auto const asked = std::count(asked_.begin(), asked_.end(), true);
  if (asked == 0 && directions_ == 0) return;  // ended before the first question
  auto const from_cache = cache_ ? fmt::format(" rendered, {} from the cache",
                                               recalled_earlier_ + cache_->directions_recalled())
                                 : "";
  messages_.remark(fmt::format(
      "shading rendered by {} ({}), {}: {} receivers, {} casters, {} directions{}, {} "
      "views drawn, {} clear, {:.2f} s",
      device.renderer, device.version, describe_fineness(model_.options), asked, casters_,
      directions_, from_cache, did.receivers_drawn, did.receivers_clear, did.seconds));
  if (samples_) {
    messages_.remark(
        fmt::format("{} directions of the sun answered from samples at {}, --gpu-shading-update {}",
                    samples_->answered(), samples_->sampled(), name_of(model_.options.update)));
  }
  store_answers();
  auto const stages = stages_of(did);
  if (char const* const file = std::getenv(stages_variable)) write_stages(file, stages);
  if (model_.options.report) {
    std::string line;
    for (auto const& [stage, seconds] : stages) {
      line += fmt::format("{}{} {:.2f} s", line.empty() ? "" : ", ", stage, seconds);
    }
    messages_.remark("where the time went: " + line);
    write_stages(*model_.options.report / stages_table, stages);
    auto const left_out =
        write_report(*model_.options.report, *renderer_, run_.receivers, asked_, run_.answers,
                     optics_.factors(), {optics_.deployment_names(), run_.states});
    if (left_out > 0) {
      messages_.remark(
          fmt::format("--gpu-shading-report: the first {} pictures are drawn, {} more are not; "
                      "gpu_shading view "
                      "draws any",
                      max_report_pictures, left_out));
    }
  }
}

}  // namespace gpu_shading::energyplus

#include "calculation/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "answers/cache_folder.h"
#include "answers/cached_renderer.h"
#include "gpu_shading/error.h"
#include "gpu_shading/sun_direction.h"
#include "model/options/report_folder.h"
#include "platform/naming.h"
#include "reports/remarks.h"
#include "reports/report.h"
#include "reports/run_report.h"
#include "runs/run_times.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

// The deployments, then the factors, as RunRecord has them.
std::vector<float> shares_of(ShadeOptics const& optics) {
  std::vector<float> shares(optics.deployments().begin(), optics.deployments().end());
  shares.insert(shares.end(), optics.factors().begin(), optics.factors().end());
  return shares;
}

std::string list(Stages const& stages) {
  std::string line;
  for (auto const& [stage, seconds] : stages) {
    line += fmt::format("{}{} {:.2f} s", line.empty() ? "" : ", ", stage, seconds);
  }
  return line;
}

}  // namespace

SurfaceId Session::add(Surface surface) {
  if (scene_.model().lean.is_placeholder(surface.name)) {
    added_.emplace_back(std::move(surface));
  } else {
    added_.emplace_back(scene_.add(std::move(surface)));
  }
  return static_cast<SurfaceId>(added_.size() - 1);
}

bool Session::wants_mirrored() const { return input().reflections || input().mirrored_shown(); }

SurfaceId Session::add_mirrored(SurfaceId original) {
  if (auto const* const placeholder = std::get_if<Surface>(&added_.at(original))) {
    added_.emplace_back(mirrored(*placeholder));
  } else {
    added_.emplace_back(scene_.add_mirrored(in_scene(original)));
  }
  return static_cast<SurfaceId>(added_.size() - 1);
}

Surface const& Session::surface(SurfaceId id) const {
  auto const* const placeholder = std::get_if<Surface>(&added_[id]);
  return placeholder != nullptr ? *placeholder : scene_.surfaces()[in_scene(id)];
}

std::vector<SurfaceId> Session::shading_surfaces() const {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < size(); ++id) {
    auto const& name = surface(id).name;
    if (is_placeholder(id) ? !is_mirrored(name) : input().shading_surfaces.contains(name)) {
      ids.push_back(id);
    }
  }
  return ids;
}

SurfaceId Session::in_scene(SurfaceId id) const {
  if (id >= size()) throw Error(fmt::format("EnergyPlus asks for surface {} of {}", id, size()));
  auto const* const found = std::get_if<SurfaceId>(&added_[id]);
  if (found == nullptr) throw Error("EnergyPlus asks for what a placeholder receives indoors");
  return *found;
}

void Session::start(Simulation simulation) {
  if (answers_) throw Error("the surfaces of a model can be set once");
  messages_ = std::move(simulation.messages);
  latitude_ = std::move(simulation.latitude);
  scene_.complete(std::move(simulation.schedules));
  auto const& options = scene_.model().options;
  if (options.report) {
    prepare_report(*options.report);
    prepare_page(*options.report);
  }
  if (scene_.model().records_light()) {
    record_.emplace(scene_.areas(), scene_.shown_receivers());
  }
  if (auto const& shades = scene_.model().moving_shades; !shades.empty()) {
    control_.emplace(scene_);
    step_error_.emplace();
    add_outputs(simulation);
  }
  if (scene_.model().options.weighs_sky_patches()) {
    if (!simulation.takes_sky_multipliers) {
      throw Error(
          "--gpu-shading-sky: perez-patches needs --gpu-shading-method patched, which this "
          "EnergyPlus does not allow; expected energyplus");
    }
    sky_multipliers_.emplace(scene_.areas());
  }
  if (!scene_.model().pv_reductions.empty()) pv_loss_.emplace(scene_);
  if (reflects_light()) {
    reflected_.emplace(scene_, latitude_(), messages_);
    add_reflected_outputs(simulation);
  }
  if (options.cache) prepare_cache_folder(*options.cache);
  answers_.emplace(SunQuestions::Site{scene_.areas(), options.update.sampling, latitude_});
  answers_->open(open_renderer(scene_, scene_.receivers(), options.device, messages_));
  check_device(answers_->rendered().renderer().device(), options, messages_);
  describe_scene(scene_, messages_);
}

SceneAssembly& Session::complete(Schedules schedules) {
  scene_.complete(std::move(schedules));
  return scene_;
}

SunQuestions& Session::answers() {
  if (!answers_) throw Error("EnergyPlus asks for shading before its surfaces are complete");
  return *answers_;
}

void Session::add_outputs(Simulation const& simulation) {
  auto const& shades = scene_.model().moving_shades;
  outputs_.resize(shades.size());
  if (!simulation.add_output) return;
  for (std::size_t i = 0; i < shades.size(); ++i) {
    auto const unit = shades[i].unit();
    simulation.add_output("GPU Shading Moving Shade Position", unit == "share" ? "" : unit,
                          shades[i].name, outputs_[i].position);
    simulation.add_output("GPU Shading Moving Shade Control State", "", shades[i].name,
                          outputs_[i].state);
  }
}

void Session::add_reflected_outputs(Simulation const& simulation) {
  auto const& receivers = scene_.model().reflected_light.receivers;
  reflected_now_.resize(receivers.size());
  if (!simulation.add_output) return;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    auto& now = reflected_now_[i];
    for (auto const& [by, value] :
         {std::pair("Ground", &now.by_ground), {"Shades", &now.by_shades}}) {
      simulation.add_output(
          fmt::format("GPU Shading Solar Radiation Reflected by {} Rate per Area", by), "W/m2",
          receivers[i].surface, *value);
    }
  }
}

void Session::begin_day(RunDay const& day, RunRecord::Beam const& beam,
                        RunRecord::Beam const& wind) {
  if (record_) record_->begin_day(day, beam);
  bool const same = day.environment == day_.environment && day.month == day_.month &&
                    day.day == day_.day && day.warm_up == day_.warm_up;
  if (!same) beam_.clear();
  if (!same) wind_.clear();
  day_ = day;
  beam_of_day_ = beam;
  wind_of_day_ = wind;
}

double Session::now(std::vector<double>& day, RunRecord::Beam const& of_day) const {
  if (day.empty() && of_day) day = of_day();
  auto const index =
      static_cast<std::size_t>((moment_.hour - 1) * day_.steps_per_hour + moment_.timestep - 1);
  return index < day.size() ? day[index] : 0.0;
}

// Decides where the moving shades stand at this time.
void Session::move_shades(std::optional<SunDirection> sun) {
  undecided_ = false;
  std::vector<double> positions;
  std::vector<double> exact;
  std::vector<PositionRecord::Entry> entries;
  for (auto const& each : control_->decide(sun, {[this] { return now(beam_, beam_of_day_); },
                                                 [this] { return now(wind_, wind_of_day_); }})) {
    positions.push_back(each.position);
    exact.push_back(each.exact);
    entries.push_back({each.position, name_of(each.state)});
    outputs_[entries.size() - 1] = {each.position, static_cast<double>(each.state)};
  }
  if (moment_.timestep > 0) position_record_.note(day_, moment_, std::move(entries));
  corners_ = around(scene_.model().moving_shades, positions, exact);
  if (sun && !day_.warm_up) step_error_->note(*sun, corners_, exact);
  bool const moved = positions != scene_.positions();
  stand(positions);
  if (moved && scene_.hides_moving_shades()) obstructions_.reset();
}

void Session::stand(std::vector<double> const& positions) {
  scene_.set_positions(positions);
  answers_->deploy(scene_.optics().deployments(), scene_.positions());
}

template <typename Function>
void Session::interpolate(Function const& function) {
  if (corners_.size() < 2 || sky_patch_) {
    function(1.0);
    return;
  }
  for (auto const& [positions, weight] : corners_) {
    stand(positions);
    function(weight);
  }
  stand(corners_.front().positions);
}

void Session::end_time() {
  if (undecided_) move_shades(std::nullopt);  // the sun is down
}

// "12-21, hour 13, timestep 2", as far as it is known.
std::string Session::describe_time() const {
  if (moment_.timestep == 0) return "the whole simulation";
  auto const day = day_.month > 0 ? fmt::format("{:02}-{:02}, ", day_.month, day_.day) : "";
  return fmt::format("{}hour {}, timestep {}", day, moment_.hour, moment_.timestep);
}

void Session::set_time(Moment moment) {
  if (!answers_) return;
  moment_ = moment;
  naming(describe_time(), [&] { read_schedules(); });
  if (record_) record_->begin_step(moment, shares_of(scene_.optics()));
  if (!control_) return;
  undecided_ = moment.timestep > 0;
  if (!undecided_) move_shades(std::nullopt);  // for the whole simulation
}

void Session::read_schedules() {
  if (control_) control_->set_time(moment_);
  if (scene_.optics().update(moment_)) {
    messages_.warning(
        "a Transmittance Schedule with a constant value has changed, by an EMS or another program: "
        "its new values are used from now on");
    write_cache(answers_->rendered(), messages_);
    auto const receivers = answers_->rendered().known().receivers;
    // The CPU also if it took over from a GPU.
    DeviceChoice const device{answers_->rendered().renderer().device().id};
    obstructions_.reset();
    if (control_) control_->renew();
    answers_->close();
    answers_->open(open_renderer(scene_, receivers, device, messages_));
  } else {
    answers_->deploy(scene_.optics().deployments(), scene_.positions());
  }
}

void Session::set_sun(SunDirection sun) {
  answers().set_sun(sun);
  sun_ = sun;
  sky_patch_ = is_sky_patch(sun);
  if (undecided_ && !sky_patch_) move_shades(sun);
  if (record_) record_->set_sun(sun);
}

double Session::projected_sunlit_area(SurfaceId receiver) {
  auto& answers = this->answers();
  if (receiver < size() && is_placeholder(receiver)) {
    auto const& polygon = surface(receiver).polygon;
    double const facing = glm::dot(normal(polygon), answers.towards_sun());
    return static_cast<float>(area(polygon) * std::max(facing, 0.0));
  }
  auto const id = in_scene(receiver);
  double rendered = 0.0;
  interpolate([&](double weight) { rendered += weight * rendered_area(id); });
  if (pv_loss_ && !sky_patch_) rendered = with_pv_loss(id, rendered);
  if (record_) record_->note(id, rendered);
  return static_cast<float>(rendered * scene_.area_ratio(id));
}

double Session::rendered_area(SurfaceId id) {
  if (scene_.unshaded()[id]) return answers_->unshaded_area(id);
  double const rendered = answers_->area(id, scene_.optics().factors());
  return scene_.moving_shade_of(id) ? of_drawn(id, rendered) : rendered;
}

std::vector<double> Session::sky_multipliers(SkyWeather const& weather) {
  auto const& optics = scene_.optics();
  auto shades = optics.factors();
  for (auto const& more : {optics.deployments(), scene_.positions()}) {
    shades.insert(shades.end(), more.begin(), more.end());
  }
  if (!sky_multipliers_->knows(shades)) {
    // EnergyPlus does not ask about surfaces that nothing shades.
    auto const asked = answers_->asked();
    sky_multipliers_->renew(std::move(shades), [&](std::size_t patch, SurfaceId id) {
      if (!asked[id]) return std::optional<double>();
      answers_->set_sun(sky_patches()[patch]);
      return std::optional(rendered_area(id));
    });
    answers_->set_sun(sun_);
  }
  auto const by_surface = sky_multipliers_->at(weather);
  std::vector<double> by_id;
  for (auto const& added : added_) {
    auto const* const id = std::get_if<SurfaceId>(&added);
    by_id.push_back(id == nullptr ? -1.0 : by_surface[*id]);
  }
  return by_id;
}

std::vector<double> Session::ground_reflectances(ReflectedIrradiance::Time const& time) {
  auto const& weather = time.weather;
  double const open = weather.open_ground();
  bool const lit = weather.towards_sun.z > min_cosine && open > 0.0;  // as EnergyPlus has it
  if (!reflected_ || !lit) {
    std::ranges::fill(reflected_now_, Reflected{});
    return {};
  }
  std::vector<WeightedPositions> const standing{{scene_.positions()}};
  auto const all = reflected_->at(time, corners_.empty() ? standing : corners_);
  std::ranges::copy(all, reflected_now_.begin());  // which EnergyPlus's outputs point to
  auto const& receivers = scene_.model().reflected_light.receivers;
  std::vector<double> reflectances;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    reflectances.push_back(ground_reflectance(all[i].sum(), open, receivers[i].ground_view));
  }
  return reflectances;
}

std::vector<std::string> Session::recorded_receivers() const {
  std::vector<std::string> names;
  for (auto const id : record_->receivers()) names.push_back(scene_.surfaces()[id].name);
  return names;
}

void Session::note_diffuse(int hour, std::vector<DiffuseLight> light) {
  // EnergyPlus takes all that was traced for light from the ground.
  for (std::size_t i = 0; i < reflected_now_.size(); ++i) {
    auto const id = reflected_->surface(i);
    auto const place = id ? record_->place_of(*id) : std::nullopt;
    if (!place) continue;
    light[*place].by_ground = reflected_now_[i].by_ground;
    light[*place].by_shades = reflected_now_[i].by_shades;
  }
  record_->note_diffuse(hour, light);
}

double Session::with_pv_loss(SurfaceId id, double projected_area) {
  double const all = answers_->unshaded_area(id);
  if (all <= 0.0) return projected_area;
  return all * pv_loss_->reduced(id, day_, moment_, projected_area / all);
}

// EnergyPlus takes the fraction of a moving shade as that of the surface as it is drawn.
double Session::of_drawn(SurfaceId id, double projected_area) const {
  auto const moved = scene_.placed(id).polygon;
  double const all = area(moved) * glm::dot(normal(moved), answers_->towards_sun());
  if (all <= 0.0) return 0.0;
  return std::min(projected_area / all, 1.0) * answers_->unshaded_area(id);
}

std::vector<double> Session::projected_sunlit_areas(std::span<SurfaceId const> receivers) {
  std::vector<double> areas;
  areas.reserve(receivers.size());
  for (auto const receiver : receivers) areas.push_back(projected_sunlit_area(receiver));
  return areas;
}

std::vector<double> Session::interior_areas(SurfaceId window,
                                            std::vector<SurfaceId> const& interiors) {
  auto& answers = this->answers();
  std::vector<SurfaceId> ids(interiors.size());
  std::transform(interiors.begin(), interiors.end(), ids.begin(),
                 [&](SurfaceId interior) { return in_scene(interior); });
  InteriorKey const key({in_scene(window), std::move(ids)});
  std::vector<double> areas(interiors.size(), 0.0);
  interpolate([&](double weight) {
    auto const there = answers.interior_areas(key, scene_.optics().factors());
    for (std::size_t i = 0; i < areas.size(); ++i) areas[i] += weight * there[i];
  });
  keep_largest(areas);
  return areas;
}

double Session::daylight_transmittance(Ray const& ray, int hour) {
  if (!answers_) throw Error("EnergyPlus asks for daylight before its surfaces are complete");
  if (!obstructions_) obstructions_.emplace(scene_);
  return obstructions_->transmittance(ray, hour);
}

void Session::begin_daylighting() {
  if (obstructions_) obstructions_->renew();
}

std::string Session::vendor() {
  return answers_ ? answers_->rendered().renderer().device().vendor : "";
}

void Session::finish() {
  if (!answers_) return;
  auto const& asked = answers_->asked();
  bool const any = std::find(asked.begin(), asked.end(), true) != asked.end();
  if (!any && answers_->counts().directions == 0)
    return;  // the run ended before the first question
  auto const errors = answers_->errors();
  describe_answers(*answers_, errors, scene_.model().options, messages_);
  position_record_.describe(scene_.model().moving_shades, messages_);
  if (pv_loss_) pv_loss_->describe(messages_);
  if (reflected_) reflected_->describe();
  write_cache(answers_->rendered(), messages_);
  if (failed_) return;
  if (record_) record_->end();
  if (scene_.model().reflected_light.undimmed) {
    warn_of_ground_light(
        scene_.surfaces(), *record_,
        [this](auto const& ids) { return undimmed_to_traced(scene_, latitude_(), ids); },
        messages_);
  }
  write_reports(errors);
  if (step_error_) describe_step_error();
}

void Session::describe_step_error() {
  auto const& asked = answers_->asked();
  std::vector<SurfaceId> receivers;
  for (auto const id : scene_.shown_receivers()) {
    if (asked[id] && !scene_.moving_shade_of(id)) receivers.push_back(id);
  }
  auto const found = step_error_->estimate([&](SunDirection sun, auto const& positions) {
    answers_->set_sun(sun);
    answers_->deploy(scene_.optics().deployments(), positions);
    std::vector<double> fractions;
    for (auto const id : receivers) {
      double const all = answers_->unshaded_area(id);
      fractions.push_back(all > 0.0 ? answers_->area(id, scene_.optics().factors()) / all : 0.0);
    }
    return fractions;
  });
  if (!found) return;
  messages_.remark(fmt::format(
      "interpolating between steps of moving shades changes the sunlit fraction of the surface "
      "most affected by about {:.2g} on average, {:.2g} at most; estimated at {} timesteps",
      found->mean, found->most, found->timesteps));
}

void Session::write_reports(AnswerErrors const& errors) {
  auto const& options = scene_.model().options;
  auto const stages = stages_of(answers_->counts().rendering);
  if (options.stages) write_stages(*options.stages, stages);
  if (options.verbose) messages_.remark("time by stage: " + list(stages));
  if (!options.report) return;
  auto& rendered = answers_->rendered();
  auto const& known = rendered.known();
  auto const& optics = scene_.optics();
  std::vector<std::string> heads;
  for (auto const& schedule : optics.deployment_names()) heads.push_back("share by " + schedule);
  for (auto const& shade : scene_.model().moving_shades) {
    heads.push_back(fmt::format("position of {} [{}]", shade.name, shade.unit()));
  }
  auto const left_out =
      write_report(*options.report, rendered, known.receivers, answers_->asked(),
                   scene_.shown_receivers(), known.answers, optics.factors(),
                   {std::move(heads), optics.deployment_names().size(), known.states}, stages,
                   [&](StagedFiles& files) {
                     write_run(files, *options.report, scene_, rendered.renderer().device(), errors,
                               *record_, position_record_);
                     auto const& shades = scene_.model().moving_shades;
                     if (!shades.empty()) position_record_.write(files, shades);
                   });
  if (left_out > 0) {
    messages_.remark(
        fmt::format("--gpu-shading-report: the first {} pictures are drawn, {} more are not; "
                    "draw these with gpu_shading view",
                    max_report_pictures, left_out));
  }
}

}  // namespace gpu_shading::energyplus

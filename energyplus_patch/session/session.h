#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "gpu_shading/renderer.h"
#include "input/model_reader.h"
#include "samples/sample_parts.h"
#include "session/answer_cache.h"
#include "session/foreseen_directions.h"
#include "session/sampled_answers.h"
#include "session/schedules.h"
#include "session/shade_optics.h"

namespace gpu_shading::energyplus {

// The shading calculation of one EnergyPlus run, from the surfaces it adds to the areas it asks
// for. Every function throws gpu_shading::Error.
class Session {
 public:
  // Where lines for the user go.
  struct Messages {
    std::function<void(std::string const&)> warning;  // to EnergyPlus's .err
    std::function<void(std::string const&)> remark;   // to EnergyPlus's .err, plain
    std::function<void(std::string const&)> eio;      // to EnergyPlus's .eio
  };

  // EnergyPlus's WindowComplexManager keeps this many lit back surfaces a window; more would
  // overrun.
  static constexpr std::size_t max_back_surfaces = 20;

  // Set by `gpu_shading check` alone: start() writes the listing of surfaces to this file and ends
  // the process.
  static constexpr char const* listing_variable = "GPU_SHADING_CHECK";
  // Set with it: the vertices instead.
  static constexpr char const* vertices_variable = "GPU_SHADING_CHECK_VERTICES";

  // Set by `gpu_shading view` alone: start() draws what the folder's list of views says into that
  // folder, by shades of the least transmittance and screens all in place, and ends the process.
  static constexpr char const* views_variable = "GPU_SHADING_VIEW";
  static constexpr char const* views_list = "views.txt";
  // Set with it: pixels on a picture's longer side.
  static constexpr char const* view_size_variable = "GPU_SHADING_VIEW_SIZE";

  // Set by `gpu_shading sample` alone: start() renders what the request in this file asks for (see
  // samples/sample_request.h), and ends the process.
  static constexpr char const* samples_variable = "GPU_SHADING_SAMPLES";
  // Set by compare_shading alone: finish() writes where the time went to this file.
  static constexpr char const* stages_variable = "GPU_SHADING_STAGES";

  explicit Session(Model model) : model_(std::move(model)) {}

  SurfaceId add(Surface surface);
  std::size_t size() const { return renderer_ ? surfaces_ : scene_.size(); }

  Surface const& surface(SurfaceId id) const { return scene_[id]; }
  ShadingInput const& input() const { return model_.shading; }

  // Ids of the model's shading surfaces, in order.
  std::vector<SurfaceId> shading_surfaces() const;

  // All surfaces are there: reads what they let through and opens the device. `latitude`: of the
  // site, radians; asked for where the sun's positions are sampled.
  void start(Messages messages, Schedules schedules, std::function<double()> latitude = {});

  // The time whose schedules count from here on.
  void set_time(Moment moment);
  void set_sun(SunDirection sun);

  // m2 normal to the beam. The first call for a direction renders for every receiver that was asked
  // for before, in one go, and with it the directions that EnergyPlus will ask for next.
  float projected_sunlit_area(SurfaceId receiver);

  // The same of interior surfaces that the sun reaches through a window, in order; at most
  // max_back_surfaces of them are not 0 (the largest).
  std::vector<float> interior_areas(SurfaceId window, std::vector<SurfaceId> const& interiors);

  // The run is over: says what rendered, writes the report.
  void finish();

 private:
  ReceiverNumber number_of(SurfaceId receiver);
  void add_outside_casters();
  bool is_site_context(SurfaceId id) const;
  // The sun's direction, last, and before it those that follow, as many as are worth one call to
  // the renderer with so many views of each.
  std::vector<SunDirection> directions_ahead(std::size_t views) const;
  // With the receiver known. Valid until the next call.
  Answers::Direction& answers_now(ReceiverNumber receiver);
  // By direction; rendered where they are not known.
  std::vector<std::vector<Sunlit>> sample(std::span<SunDirection const> directions,
                                          std::vector<SurfaceId> const& receivers);
  // nullptr where it has to be rendered.
  Sunlit const* find_sampled(SurfaceId receiver);
  std::vector<Sunlit> interior_now(InteriorQuestion const& question);
  // nullptr where they are not known. Valid until the next call.
  std::vector<Sunlit> const* find_interior(SunDirection sun, InteriorQuestion const& question);
  // Of the first question, by direction; rendered where it is not known, with those of the others
  // that are not either.
  std::vector<std::vector<Sunlit>> sample_interior(std::span<SunDirection const> directions,
                                                   std::span<InteriorQuestion const> questions);
  // Empty where they have to be rendered.
  std::vector<float> sampled_interior_areas(InteriorQuestion const& question);
  // What the sun as it was handed over gives a surface that gets 1 from where answers are kept.
  double for_this_sun(SurfaceId surface) const;
  std::vector<float> areas_of(std::vector<Sunlit> const& answers) const;
  void describe_surfaces();
  void draw(std::filesystem::path const& folder, int size, std::vector<bool> wanted);
  void take_samples(std::filesystem::path const& request);
  SampledScene sampled_scene(std::string const& asked) const;
  void describe_surroundings();
  void warn_of_actuated_schedules() const;
  void add_walls_without_openings();
  void open_renderer();
  RendererOptions renderer_options() const;
  Hash hash_of_scene(DeviceInfo const& device) const;
  void store_answers();
  void open_samples();
  void deploy_screens();
  void check_device() const;

  Model model_;
  Messages messages_;
  Scene scene_;  // as EnergyPlus gave it; the renderer's has optics as well
  ShadeOptics optics_;
  std::size_t surfaces_ = 0;
  std::size_t casters_ = 0;
  std::optional<Renderer> renderer_;
  RendererStatistics earlier_;                          // of renderers before it
  std::vector<glm::dvec3> areas_;                       // unit normal x net area, by surface
  std::vector<bool> unshaded_;                          // whose own fraction has no use, by surface
  std::vector<std::optional<ReceiverNumber>> numbers_;  // of receivers, by surface
  std::vector<bool> asked_;                             // for by EnergyPlus, by surface
  SunDirection sun_;                                    // that answers are kept by
  glm::dvec3 towards_kept_{0.0, 0.0, 1.0};
  glm::dvec3 towards_sun_{0.0, 0.0, 1.0};  // as EnergyPlus hands it over
  AnswerSet run_;
  std::uint32_t state_ = 0;  // which is set
  std::function<double()> latitude_;
  ForeseenDirections foreseen_;
  std::unordered_map<SurfaceId, InteriorQuestion> interiors_;  // asked last, by window
  std::size_t directions_ = 0;  // rendered: samples, and of others those asked for
  std::optional<SampledAnswers> samples_;
  std::optional<AnswerCache> cache_;
  bool to_store_ = false;             // something was rendered that the cache lacks
  std::size_t recalled_earlier_ = 0;  // directions, from caches before it
};

}  // namespace gpu_shading::energyplus

#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "answers/answer_errors.h"
#include "answers/disk_cache.h"
#include "answers/moved_renderers.h"
#include "gpu_shading/renderer.h"
#include "platform/messages.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// A direction of the sun that answers are wanted for, and the directions expected after it.
struct AskedSun {
  SunDirection sun;
  std::span<SunDirection const> ahead;
};

// A window and its interior surfaces, and a hash of both that answers are kept by.
struct InteriorKey {
  explicit InteriorKey(InteriorQuestion asked);

  InteriorQuestion question;
  std::uint64_t hash;
};

// What EnergyPlus asked about one window so far. It lists the surfaces whose inside faces the sun,
// so the list changes when the sun passes the plane of one of them.
class AskedWindow {
 public:
  explicit AskedWindow(Scene const& scene, SurfaceId window);

  void ask(Scene const& scene, InteriorKey const& key, glm::dvec3 const& towards_sun);
  // What it will probably ask at a direction: what it asked last with the sun on the same sides of
  // all surfaces. nullptr where it did not, and where the sun is behind the window.
  InteriorKey const* foresee(glm::dvec3 const& towards_sun) const;

 private:
  struct Asked {
    InteriorKey key;
    glm::dvec3 towards_sun;
    std::uint64_t sides;
  };
  struct Listed {
    SurfaceId surface;
    glm::dvec3 normal;
  };

  // A bit for each of the first surfaces: whether the sun is in front of it.
  std::uint64_t sides(glm::dvec3 const& towards_sun) const;

  glm::dvec3 normal_;
  std::vector<Listed> listed_;
  std::vector<Asked> asked_;  // the last at the end
};

// Answers of one scene. Each is kept from an earlier question, recalled from the cache of earlier
// runs, or rendered; then it is kept, with its projected area in single precision. Functions throw
// gpu_shading::Error.
class CachedRenderer {
 public:
  struct Counts {
    std::size_t directions = 0;  // rendered: samples, and of others those that were asked for
    std::size_t recalled = 0;    // directions that the cache gave something for
    RendererStatistics rendering;

    Counts& operator+=(Counts const& other);
  };

  // `receivers` are rendered together at the first question, others from the first question about
  // them on. `cache`: of this scene. `rest`, `open_moved`: for a scene with moving shades.
  CachedRenderer(Renderer renderer, std::optional<DiskCache> cache,
                 std::span<SurfaceId const> receivers, MovedRenderers::Positions rest = {},
                 MovedRenderers::Open open_moved = {});

  // Sets the shares of screens in place (Renderer::set_deployments) and the positions of moving
  // shades. Together they are the state that answers are kept by.
  void deploy(std::vector<double> const& shares, std::vector<double> const& positions = {});
  std::uint32_t state() const { return state_; }
  // A surface's unit normal times its net area (m2), with the shades as they are now; 0 if it is
  // rolled up.
  glm::dvec3 area_vector(SurfaceId id) const;

  // The renderer of a state, for pictures. Valid until the next call of this or of deploy().
  Renderer& renderer_in(std::uint32_t state);

  // Projected sunlit area of a receiver (m2 normal to the beam), with factors[schedule]. What is
  // unknown is rendered for the directions ahead in the same batch, at first for all receivers,
  // then for those that were asked about.
  double area(SurfaceId receiver, AskedSun const& asked, std::span<double const> factors);

  // Areas that the sun lights inside through a window, in the order of the question's surfaces.
  // Unknown ones are rendered with what will probably be asked about all windows at the directions
  // ahead.
  std::vector<float> interior(InteriorKey const& key, AskedSun const& asked,
                              std::span<double const> factors);

  // For samples: answers by direction, in order.
  std::vector<std::vector<Sunlit>> at(std::span<SunDirection const> suns,
                                      std::span<SurfaceId const> receivers);
  std::vector<std::vector<Sunlit>> interior_at(std::span<SunDirection const> suns,
                                               InteriorKey const& key);

  // The receivers so far, after this one was added to them. Valid until the next call.
  std::vector<SurfaceId> const& receivers_with(SurfaceId receiver);

  // Adds what was rendered since to the cache, where there is one.
  void store();

  SceneAnswers const& known() const { return known_; }
  // Of moving shades at rest.
  Renderer& renderer() { return renderers_.at_rest(); }
  Renderer const& renderer() const { return renderers_.at_rest(); }
  bool has_cache() const { return cache_.has_value(); }
  Counts counts() const;
  // Of the answers that EnergyPlus asked for and of samples, where the sun is in front of the
  // receiver.
  AnswerErrors errors() const;

 private:
  using Direction = AnswerStore::Direction;
  using Directions = std::vector<Direction*>;

  ReceiverNumber number_of(SurfaceId receiver);
  void make_room();
  Direction& direction_at(SunDirection sun);
  // The directions of some suns, which follow the last one that was asked about.
  Directions directions_ahead(std::span<SunDirection const> suns);
  void recall(Direction& direction);
  std::size_t render(Directions const& directions, std::span<ReceiverNumber const> receivers);
  Direction::Interior* find_interior(Direction& direction, std::uint64_t hash);
  // Renders these, which are unknown, and keeps their answers.
  void render_interiors(Directions const& directions,
                        std::vector<InteriorKey const*> const& questions);

  MovedRenderers renderers_;
  Renderer* current_;  // of the state
  std::optional<DiskCache> cache_;
  SceneAnswers known_;
  std::uint32_t state_ = 0;
  std::size_t positions_ = 0;  // at the end of a state
  bool deployed_ = false;
  AnswerErrors errors_of_forgotten_;
  Direction* last_ = nullptr;                           // asked about last
  Directions ahead_;                                    // known to follow, the next at the end
  std::vector<std::optional<ReceiverNumber>> numbers_;  // of receivers, by surface
  std::vector<bool> asked_;                             // by receiver's number
  std::unordered_map<SurfaceId, AskedWindow> windows_;
  std::size_t directions_ = 0;  // Counts::directions
  bool to_store_ = false;
};

// renderer_options() with the renderer's warnings. If a GPU is required, they are errors.
RendererOptions watched_options(Options const& options, Messages const& messages);

// Opens a device, and the cache that the model's options name, for the scene as it is now.
// `receivers`: see CachedRenderer. Throws Error.
CachedRenderer open_renderer(SceneAssembly const& scene, std::span<SurfaceId const> receivers,
                             DeviceChoice const& device, Messages const& messages);

// Adds answers to their cache; warns if that cannot be written.
void write_cache(CachedRenderer& answers, Messages const& messages);

}  // namespace gpu_shading::energyplus

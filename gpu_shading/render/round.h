#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gpu_shading/renderer.h"
#include "render/counted_views.h"
#include "render/coverage.h"
#include "render/question.h"
#include "render/receivers.h"
#include "render/schedule_keys.h"
#include "render/submissions.h"
#include "render/transmission.h"
#include "scene/casters.h"

namespace gpu_shading {

// Answers questions: culls, draws what needs it, and makes areas of the sums. Answers are there
// after finish(), and what questions refer to must be until then.
class Round {
 public:
  struct Parts {
    Scene const& scene;
    Casters const& casters;
    Transmission const& transmission;
    Geometry const& geometry;
    Receivers& receivers;
    Submissions& submissions;
    Coverage const* coverage;  // where it counts plain views
    RendererStatistics& statistics;
  };

  // One at a time; what a round before it left under way is forgotten.
  explicit Round(Parts const& parts);

  // Throws Error for unknown surfaces.
  void ask(Question const& question);
  void finish();

 private:
  struct Drawn {
    FacedQuestion faced;
    Tile const* tile;
    std::size_t casters;
    bool opaque;
    std::optional<ScheduleKeys> keys;
    std::size_t view;
  };
  struct Measured {
    SurfaceId receiver;
    std::size_t view;
  };

  // Finds what is in view of all that was asked since, and has it counted or drawn.
  void look();
  void take(FacedQuestion const& faced, InView in_view);
  void draw(FacedQuestion const& faced, Tile& tile, std::span<SurfaceId const> casters);
  // How far the farthest is behind the window's plane, m.
  double reach(Question const& question, PlaneFrame const& frame);
  void measure(SurfaceId receiver, Tile& tile);
  void gather(DrawList& list, int layer, Drawn const& drawn, std::span<SurfaceId const> casters);
  void gather_casters(DrawList& list, int layer, Drawn const& drawn,
                      std::span<SurfaceId const> casters);
  void gather_interiors(DrawList& list, int layer, Drawn const& drawn);
  void answer(Drawn const& drawn);
  Sunlit sunlit(LuminanceByKey const& sums, Drawn const& drawn);

  Parts parts_;
  std::vector<FacedQuestion> asked_;
  std::optional<CountedViews> counted_;  // where plain views are
  std::vector<Drawn> drawn_;
  std::unordered_map<Tile*, Measured> measured_;
};

}  // namespace gpu_shading

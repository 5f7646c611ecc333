#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gpu_shading/renderer.h"
#include "render/coverage.h"
#include "render/receivers.h"
#include "render/schedule_keys.h"
#include "render/submissions.h"
#include "render/transmission.h"
#include "scene/casters.h"

namespace gpu_shading {

// What the sun at one direction sees of a receiver, or of the surfaces behind one.
struct Question {
  SurfaceId receiver = 0;
  glm::dvec3 towards_sun{0.0};
  bool through = false;  // the receiver is a window, and asked for are these:
  std::span<SurfaceId const> interiors;
  std::span<Sunlit> answers;  // the receiver's, or of each of `interiors`; zero when asked
};

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
    Coverage const* coverage;  // where it counts opaque views
    RendererStatistics& statistics;
  };

  // One at a time; what a round before it left under way is forgotten.
  explicit Round(Parts const& parts);

  // Throws Error for unknown surfaces.
  void ask(Question const& question);
  void finish();

 private:
  struct Asked {
    Question question;
    Receiver const* receiver;
    double cosine;
  };
  struct Counted {
    Asked asked;
    Tile const* tile;
    std::vector<SurfaceId> casters;
    std::vector<std::uint64_t> lit;  // once counted, of each answer
  };
  struct Drawn {
    Question question;
    Tile const* tile;
    double cosine;
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
  void take(Asked const& asked, InView in_view);
  void draw(Asked const& asked, Tile& tile, InView const& in_view);
  void count();
  void count(Counted& view, int threads) const;
  // How far the farthest is behind the window's plane, m.
  double reach(Question const& question, PlaneFrame const& frame);
  void measure(SurfaceId receiver, Tile& tile);
  void measure_by_count(SurfaceId receiver, Tile& tile);
  void gather(DrawList& list, int layer, Drawn const& drawn, std::span<SurfaceId const> casters);
  void gather_casters(DrawList& list, int layer, Drawn const& drawn,
                      std::span<SurfaceId const> casters);
  void gather_interiors(DrawList& list, int layer, Drawn const& drawn);
  void answer(Drawn const& drawn);
  Sunlit sunlit(LuminanceByKey const& sums, Drawn const& drawn);
  void set_areas(Sunlit& answer, double lit, std::uint64_t pixels, SurfaceId receiver,
                 Tile const& tile, double cosine);

  Parts parts_;
  std::vector<Asked> asked_;
  std::vector<Counted> counted_;
  std::vector<Drawn> drawn_;
  std::unordered_map<Tile*, Measured> measured_;
};

}  // namespace gpu_shading

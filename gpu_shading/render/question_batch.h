#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "backends/exact/exact_view.h"
#include "backends/interface/view_backend.h"
#include "filters/transmission.h"
#include "gpu_shading/renderer.h"
#include "render/receivers.h"
#include "scene/casters.h"

namespace gpu_shading {

// The sunlit area of a receiver at one sun direction, or of the surfaces behind a window.
struct Question {
  SurfaceId receiver = 0;
  glm::dvec3 towards_sun{0.0};
  bool through = false;  // the receiver is a window, and `interiors` are asked for
  std::span<SurfaceId const> interiors;
  // The receiver's answer, or one for each of `interiors`; zero before.
  std::span<Sunlit> answers;
};

// Answers questions: finds the casters in view, has views rasterised, and computes areas from their
// sums. Answers are complete after finish(); objects that questions refer to must live until then.
class QuestionBatch {
 public:
  struct Parts {
    Scene const& scene;
    Casters const& casters;
    Transmission const& transmission;
    Receivers& receivers;
    ViewBackend& backend;
    RendererStatistics& statistics;
    bool samples_only;  // no view is answered without samples
  };

  // Only one of a back end's at a time.
  explicit QuestionBatch(Parts const& parts);
  // Begins anew, in the memory of before; unfinished work is discarded.
  void start();

  // Throws Error for unknown surfaces.
  void ask(Question const& question);
  void finish();

 private:
  // A question whose receiver faces the sun.
  struct Asked {
    Question question;
    Receiver const* receiver;
    double cosine;                        // of the angle of incidence
    Receiver::InSector const* in_sector;  // casters, if they are known
    std::span<RelativePolygon const> interiors;
  };
  // A question whose view is being rasterised.
  struct Viewed {
    Asked asked;
    int side;    // pixels asked for
    Tile* tile;  // if its pixels are sampled
    std::size_t casters;
    bool transmits;
  };

  // The result of culling for a question.
  struct Found {
    bool answered = false;  // nothing shades the receiver, or exactly for less than samples cost
    std::size_t casters = 0;
    bool transmits = false;
    // If it is not answered:
    InView in_view;                      // of a crowd a sample
    double crowd_count = 0.0;            // of casters; 0: in_view has all
    int side = 0;                        // of the tile, pixels
    double slope = turn_slopes.front();  // of its turn
    ReplicateSlopes slopes = replicate_slopes;
  };
  // A sample of casters in view that repeat, and slopes along them.
  struct Blades {
    Crowd crowd;
    ReplicateSlopes slopes;
  };

  // Whether the back end measures the errors of its samples.
  bool measured() const;
  // Finds the casters in view for all questions since the last call, and has their views
  // rasterised.
  void cull();
  // Answers the question if that costs little. What that takes is free again before the next one,
  // or its memory would be scattered.
  Found find(Asked const& asked) const;
  // Without samples; the number of casters, if it can. Of a sector that is known, all of which are
  // flat, or of these.
  std::optional<std::size_t> answer_in_sector(Asked const& asked) const;
  using Polygons = std::span<RelativePolygon const* const>;
  std::optional<std::size_t> answer_exactly(Asked const& asked, Polygons casters,
                                            double most_steps) const;
  // Valid until the thread's next question.
  Polygons relative(std::span<SurfaceId const> casters, Receiver const& receiver) const;
  // Empty unless all casters in view repeat, and far outnumber the rows that suffice along them.
  std::optional<Blades> blades(Asked const& asked) const;
  // Adds the view, or counts what was answered.
  void enqueue(Asked const& asked, Found found, std::vector<ReceiverView>& views);
  // Replaces the tiles of the last views by stretched ones whose pixels do not alias.
  void stretch_tiles(std::vector<ReceiverView>& views);
  // `whole`: the sum over all of a receiver that is sunlit. `error`: Sunlit::error.
  void answer(Asked const& asked, std::span<LuminanceSums const> parts, double whole,
              std::optional<double> error) const;
  Sunlit sunlit(LuminanceSums const& sums, Asked const& asked, double whole) const;
  void count(std::size_t casters, bool transmits);

  Parts parts_;
  bool may_be_crowd_;
  std::size_t at_once_;  // questions whose casters are searched
  std::vector<Asked> asked_;
  std::vector<Found> found_;  // for each of them
  std::vector<Viewed> viewed_;
};

}  // namespace gpu_shading

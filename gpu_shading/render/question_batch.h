#pragma once

#include <cstddef>
#include <vector>

#include "gpu_shading/renderer.h"
#include "render/question.h"
#include "render/receivers.h"
#include "scene/casters.h"
#include "view/transmission.h"
#include "view/view_backend.h"

namespace gpu_shading {

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
  };

  // Only one at a time; unfinished work of an earlier batch is discarded.
  explicit QuestionBatch(Parts const& parts);

  // Throws Error for unknown surfaces.
  void ask(Question const& question);
  void finish();

 private:
  // A question whose receiver faces the sun.
  struct Asked {
    Question question;
    Receiver const* receiver;
    double cosine;  // of the angle of incidence
  };
  // A question whose view is being rasterised.
  struct Viewed {
    Asked asked;
    int side;  // pixels asked for
    Tile* tile;
    std::size_t casters;
    bool transmits;
  };

  // Finds the casters in view for all questions since the last call, and has their views
  // rasterised.
  void look();
  // Answers immediately if nothing is in view, otherwise adds the view.
  void take(Asked const& asked, InView in_view, std::vector<ReceiverView>& views);
  // Gives the last views tiles whose pixels do not alias with what repeats there.
  void stretch_tiles(std::vector<ReceiverView>& views);
  void answer(Viewed const& viewed, ViewSums const& sums);
  Sunlit sunlit(LuminanceSums const& sums, Viewed const& viewed, std::uint64_t pixels) const;

  Parts parts_;
  std::vector<Asked> asked_;
  std::vector<Viewed> viewed_;
};

}  // namespace gpu_shading

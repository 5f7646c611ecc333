#include "support/pixel_count.h"

#include <utility>
#include <vector>

#include "backends/open_backend.h"
#include "render/renderer_with_backend.h"
#include "support/shapes.h"
#include "view/tile.h"

namespace gpu_shading {
namespace {

// Passes views on, and notes the area of the last one's sunlit pixels.
class CountingBackend : public ViewBackend {
 public:
  CountingBackend(std::unique_ptr<ViewBackend> backend, std::shared_ptr<double> counted)
      : backend_(std::move(backend)), counted_(std::move(counted)) {}

  DeviceInfo const& device() const override { return backend_->device(); }

  void add(std::vector<ReceiverView> views) override {
    for (ReceiverView const& view : views) {
      pixel_area_ = view.tile->pixel_area * view.cosine;
    }
    backend_->add(std::move(views));
  }

  std::vector<ViewSums> finish() override {
    std::vector<ViewSums> sums = backend_->finish();
    if (!sums.empty()) *counted_ = sums.back().parts.front().unscheduled * pixel_area_;
    return sums;
  }

  void forget() override { backend_->forget(); }

 private:
  std::unique_ptr<ViewBackend> backend_;
  std::shared_ptr<double> counted_;
  double pixel_area_ = 0.0;
};

}  // namespace

PixelCount::PixelCount(Scene scene, RendererOptions const& options)
    : counted_(std::make_shared<double>(0.0)),
      renderer_(
          RendererWithBackend::make(std::move(scene), options, [&](BackendInput const& input) {
            return std::make_unique<CountingBackend>(open_backend(input, options.device), counted_);
          })) {}

PixelCount::Areas PixelCount::areas(SunDirection sun, SurfaceId receiver) {
  std::size_t const drawn = renderer_.statistics().receivers_drawn;
  double const answered = sunlit(renderer_, sun, receiver).projected_area;
  bool const has_pixels = renderer_.statistics().receivers_drawn > drawn;
  return {answered, has_pixels ? *counted_ : answered};
}

}  // namespace gpu_shading

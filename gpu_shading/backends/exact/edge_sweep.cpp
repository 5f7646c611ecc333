#include "backends/exact/edge_sweep.h"

namespace gpu_shading {
namespace {

// By which edges may be out of order, in a rectangle of about unit size.
constexpr double rounding = 1e-13;

}  // namespace

void EdgeSweep::start(glm::dvec2 const& low, glm::dvec2 const& high) {
  low_ = low;
  high_ = high;
  edges_.clear();
  heights_.clear();
  inside_.clear();
  strips_ = 1.0;
  crossed_ = 0.0;
}

void EdgeSweep::add(std::span<glm::dvec2 const> ring, std::uint32_t polygon) {
  if (inside_.size() <= polygon) inside_.resize(polygon + 1, 0);
  if (ring.empty()) return;
  glm::dvec2 from = ring.back();
  for (glm::dvec2 const& to : ring) {
    glm::dvec2 const& lower = from.y < to.y ? from : to;
    glm::dvec2 const& upper = from.y < to.y ? to : from;
    // What lies to the right of everything has no effect.
    if (upper.y > low_.y && lower.y < high_.y && lower.y < upper.y &&
        std::min(from.x, to.x) < high_.x) {
      edges_.push_back(
          {lower.y, upper.y, lower.x, (upper.x - lower.x) / (upper.y - lower.y), polygon});
      crossed_ += (std::min(upper.y, high_.y) - std::max(lower.y, low_.y)) / (high_.y - low_.y);
      // An end is that of two edges.
      if (lower.y > low_.y) strips_ += 0.5;
      if (upper.y < high_.y) strips_ += 0.5;
    }
    from = to;
  }
}

void EdgeSweep::prepare() {
  std::sort(edges_.begin(), edges_.end(),
            [](Edge const& a, Edge const& b) { return a.low < b.low; });
  heights_.push_back(low_.y);
  heights_.push_back(high_.y);
  for (Edge const& edge : edges_) {
    if (edge.low > low_.y) heights_.push_back(edge.low);
    if (edge.high < high_.y) heights_.push_back(edge.high);
  }
  std::sort(heights_.begin(), heights_.end());
  heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
}

void EdgeSweep::place(double low, double high) {
  for (Crosser& crosser : crossers_) {
    Edge const& edge = edges_[crosser.edge];
    crosser.low = edge.at(low);
    crosser.high = edge.at(high);
  }
  // Mostly in order from the strip before.
  for (std::size_t i = 1; i < crossers_.size(); ++i) {
    Crosser const moved = crossers_[i];
    std::size_t to = i;
    for (; to > 0 && crossers_[to - 1].middle() > moved.middle(); --to) {
      crossers_[to] = crossers_[to - 1];
    }
    crossers_[to] = moved;
  }
}

bool EdgeSweep::in_order() const {
  double low = low_.x;
  double high = low_.x;
  for (Crosser const& edge : crossers_) {
    // Where edges cross to the left or to the right of the rectangle makes no difference.
    double const at_low = std::clamp(edge.low, low_.x, high_.x);
    double const at_high = std::clamp(edge.high, low_.x, high_.x);
    if (at_low < low - rounding || at_high < high - rounding) return false;
    low = std::max(low, at_low);
    high = std::max(high, at_high);
  }
  return true;
}

void EdgeSweep::find_crossings(double low, double high) {
  crossings_.clear();
  for (std::size_t i = 0; i < crossers_.size(); ++i) {
    for (std::size_t k = i + 1; k < crossers_.size(); ++k) {
      double const at_low = crossers_[k].low - crossers_[i].low;
      double const at_high = crossers_[k].high - crossers_[i].high;
      if (at_low >= 0.0 && at_high >= 0.0) continue;
      if (at_low <= 0.0 && at_high <= 0.0) continue;
      double const share = at_low / (at_low - at_high);
      crossings_.push_back(low + share * (high - low));
    }
  }
  std::sort(crossings_.begin(), crossings_.end());
}

}  // namespace gpu_shading

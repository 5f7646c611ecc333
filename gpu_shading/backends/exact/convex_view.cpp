#include "backends/exact/convex_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <memory>
#include <utility>

#include "backends/exact/depth.h"
#include "geometry/convex_polygon.h"

namespace gpu_shading {
namespace {

constexpr std::size_t most_casters = 10;
constexpr std::size_t most_scheduled = 6;
constexpr int most_cuts = 150;  // a sweep would cost less
// Of the receiver's rectangle: areas that are due to rounding.
constexpr double nothing = 1e-15;

// A polygon as a sum: its outline, and its holes with a negative sign.
struct Piece {
  ConvexPolygon shape;
  double sign = 1.0;
  bool is_all = false;  // of the receiver, or of its rectangle without holes
};

// Polygons in pieces, one after another; memory is kept.
class Pieces {
 public:
  void clear() {
    used_ = 0;
    ends_.clear();
  }
  Piece& add(double sign) {
    if (used_ == pieces_.size()) pieces_.emplace_back();
    Piece& piece = pieces_[used_++];
    piece.sign = sign;
    piece.is_all = false;
    return piece;
  }
  void drop_last_piece() { --used_; }
  // Of a polygon.
  void end() { ends_.push_back(used_); }

  std::size_t polygons() const { return ends_.size(); }
  std::span<Piece const> operator[](std::size_t polygon) const {
    std::size_t const first = polygon == 0 ? 0 : ends_[polygon - 1];
    return {pieces_.data() + first, ends_[polygon] - first};
  }
  std::span<Piece const> unended() const {
    std::size_t const first = ends_.empty() ? 0 : ends_.back();
    return {pieces_.data() + first, used_ - first};
  }

 private:
  std::vector<Piece> pieces_;
  std::size_t used_ = 0;
  std::vector<std::size_t> ends_;
};

// The bounds of a ring's projection, and its first vertices as far as there is room, or all of them
// in reverse.
void project(std::span<glm::dvec3 const> ring, Projection const& projection, bool reverse,
             ConvexPolygon& to) {
  to.low = glm::dvec2(std::numeric_limits<double>::infinity());
  to.high = -to.low;
  to.count = std::min(ring.size(), ConvexPolygon::max_ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec2 const place = projection(ring[reverse ? ring.size() - 1 - i : i]);
    to.low = glm::min(to.low, place);
    to.high = glm::max(to.high, place);
    if (i < to.count) to.vertices[i] = place;
  }
}

class ConvexView {
 public:
  std::optional<ExactAnswer> answer(Scene const& scene, Transmission const& transmission,
                                    ExactQuestion const& question, Projection const& projection);

 private:
  // A caster that lets light pass by a schedule, which has a bit in a set of them.
  struct Scheduled {
    double transmittance;
    std::int32_t schedule;
  };
  // A part of an interior surface that others are in front of.
  struct Hidden {
    std::size_t interior;
    Piece piece;
  };
  static constexpr std::size_t most_sets = std::size_t{1} << most_scheduled;

  // Adds the polygon's parts within another as pieces. False if it cannot.
  bool add_polygon(RelativePolygon const& polygon, ConvexPolygon const* within,
                   Projection const& projection, Pieces& to);
  bool add_casters(Transmission const& transmission, ExactQuestion const& question,
                   Projection const& projection);
  bool add_interiors(Scene const& scene, ExactQuestion const& question,
                     Projection const& projection);
  bool are_disjoint(std::span<Piece const> one, std::span<Piece const> other);
  // Finds what two interior surfaces hide of one another: the earlier and the last one.
  bool order(std::size_t earlier, std::size_t last);
  // Where a sum over casters has come to.
  struct Place {
    std::size_t first = 0;  // of the casters that are left
    std::size_t set = 0;    // of scheduled casters
    bool is_all = false;    // all of the receiver's outline
    double weight = 1.0;
  };
  // Adds what the casters that are left let through to a part of the receiver. False if there are
  // too many.
  bool spread(ConvexPolygon const& part, double area, Place const& at);
  bool spread(Piece const& piece) {
    return spread(piece.shape, piece.shape.area(), {0, 0, piece.is_all, piece.sign});
  }
  LuminanceSums sums_of_sets(double whole);

  ConvexPolygon outline_;
  ConvexPolygon ring_;
  Pieces receiver_;
  bool is_rectangle_ = false;  // the receiver's outline
  Pieces casters_;
  Pieces interiors_;
  std::vector<std::optional<Depth>> depths_;  // of interior surfaces
  std::vector<Hidden> hidden_;
  std::vector<double> changes_;       // by caster: its transmittance less 1
  std::vector<std::size_t> bits_;     // by caster; 0: not scheduled
  std::vector<Scheduled> scheduled_;  // by bit
  std::array<double, most_sets> areas_{};
  std::size_t sets_ = 1;
  bool dark_ = false;
  int cuts_ = 0;
  std::vector<LuminanceSums> sums_;
};

bool ConvexView::add_polygon(RelativePolygon const& polygon, ConvexPolygon const* within,
                             Projection const& projection, Pieces& to) {
  auto const becomes_convex = [&](std::size_t ring, ConvexPolygon& place) {
    if (place.count < 3 || place.count < polygon.ring(ring).size()) return false;
    place.turn_counterclockwise();
    return place.is_convex();
  };
  project(polygon.ring(0), projection, polygon.is_convex() && projection.turns(polygon.normal()),
          outline_);
  if (within == nullptr ? outline_.count == 0 : !outline_.may_meet(*within)) return true;
  if (!polygon.is_convex() && !becomes_convex(0, outline_)) return false;
  Piece& first = to.add(1.0);
  if (within == nullptr) {
    first.shape = outline_;
    first.is_all = true;
  } else {
    Meeting const found = is_rectangle_ ? intersect_rectangle(*within, outline_, first.shape)
                                        : intersect(*within, outline_, first.shape);
    first.is_all = found == Meeting::within;
    if (found == Meeting::apart) {
      to.drop_last_piece();
      return true;
    }
  }
  for (std::size_t hole = 1; hole < polygon.rings(); ++hole) {
    project(polygon.ring(hole), projection, false, ring_);
    if (ring_.count == 0) continue;
    if (!becomes_convex(hole, ring_) || !outline_.contains(ring_)) return false;
    std::size_t const before = to.unended().size();
    Piece& piece = to.add(-1.0);
    if (within == nullptr) {
      piece.shape = ring_;
    } else if (intersect(*within, ring_, piece.shape) == Meeting::apart) {
      to.drop_last_piece();
      continue;
    }
    for (std::size_t i = 1; i < before; ++i) {
      if (!are_disjoint(to.unended().subspan(i, 1), to.unended().last(1))) return false;
    }
  }
  return true;
}

bool ConvexView::are_disjoint(std::span<Piece const> one, std::span<Piece const> other) {
  double common = 0.0;
  ConvexPolygon shape;
  for (Piece const& a : one) {
    for (Piece const& b : other) {
      if (!a.shape.may_meet(b.shape)) continue;
      ++cuts_;
      if (intersect(a.shape, b.shape, shape) != Meeting::apart) {
        common += a.sign * b.sign * shape.area();
      }
    }
  }
  return common < nothing;
}

bool ConvexView::add_casters(Transmission const& transmission, ExactQuestion const& question,
                             Projection const& projection) {
  ConvexPolygon const& receiver = receiver_[0].front().shape;
  for (RelativePolygon const* const caster : question.casters) {
    if (!add_polygon(*caster, &receiver, projection, casters_)) return false;
    if (casters_.unended().empty()) continue;
    casters_.end();
    if (casters_.polygons() > most_casters) return false;
    Shade const shade = transmission.shade(caster->id(), question.towards_sun);
    changes_.push_back(static_cast<double>(shade.transmittance) - 1.0);
    bool const is_scheduled = shade.transmittance > 0.0F && shade.schedule != Shade::unscheduled;
    bits_.push_back(is_scheduled ? std::size_t{1} << scheduled_.size() : 0);
    if (is_scheduled) {
      if (scheduled_.size() == most_scheduled) return false;
      scheduled_.push_back({static_cast<double>(shade.transmittance), shade.schedule});
    }
    auto const pieces = casters_[casters_.polygons() - 1];
    dark_ = shade.transmittance == 0.0F && pieces.size() == 1 && pieces.front().is_all;
    if (dark_) return true;
  }
  return true;
}

bool ConvexView::add_interiors(Scene const& scene, ExactQuestion const& question,
                               Projection const& projection) {
  ConvexPolygon const& window = receiver_[0].front().shape;
  for (RelativePolygon const& interior : question.interiors) {
    if (!add_polygon(interior, &window, projection, interiors_)) return false;
    interiors_.end();
    std::size_t const last = interiors_.polygons() - 1;
    if (interiors_[last].empty()) continue;
    bool is_alone = true;
    for (std::size_t i = 0; i < last; ++i) {
      if (interiors_[i].empty() || are_disjoint(interiors_[i], interiors_[last])) continue;
      if (is_alone) depths_.resize(question.interiors.size());
      is_alone = false;
      for (std::size_t const k : {i, last}) {
        if (depths_[k]) continue;
        Ring const& outline = scene[question.interiors[k].id()].polygon.outline;
        depths_[k] = depth_of(outline, question.frame, question.towards_sun);
        if (!depths_[k]) return false;
      }
      if (!order(i, last)) return false;
    }
  }
  return true;
}

bool ConvexView::order(std::size_t earlier, std::size_t last) {
  std::size_t const first_hidden = hidden_.size();
  bool earlier_is_nearer = true;
  bool last_is_nearer = true;
  for (Piece const& a : interiors_[earlier]) {
    for (Piece const& b : interiors_[last]) {
      Hidden& hidden = hidden_.emplace_back();
      if (intersect(a.shape, b.shape, hidden.piece.shape) == Meeting::apart) {
        hidden_.pop_back();
        continue;
      }
      hidden.piece.sign = -a.sign * b.sign;
      for (glm::dvec2 const& place : hidden.piece.shape.ring()) {
        bool const is_behind = depths_[earlier]->at(place) - depths_[last]->at(place) > same_place;
        (is_behind ? earlier_is_nearer : last_is_nearer) = false;
      }
    }
  }
  if (earlier_is_nearer == last_is_nearer) return false;
  std::size_t const farther = earlier_is_nearer ? last : earlier;
  for (std::size_t i = first_hidden; i < hidden_.size(); ++i) {
    hidden_[i].interior = farther;
    for (std::size_t k = 0; k < first_hidden; ++k) {
      if (hidden_[k].interior == farther && hidden_[k].piece.shape.may_meet(hidden_[i].piece.shape))
        return false;
    }
  }
  return true;
}

bool ConvexView::spread(ConvexPolygon const& part, double area, Place const& at) {
  areas_[at.set] += at.weight * area;
  ConvexPolygon common;
  for (std::size_t caster = at.first; caster < casters_.polygons(); ++caster) {
    Place next{caster + 1, at.set | bits_[caster], false, at.weight};
    if (bits_[caster] == 0) next.weight *= changes_[caster];
    for (Piece const& piece : casters_[caster]) {
      Place here = next;
      here.weight *= piece.sign;
      ConvexPolygon const* shape = &piece.shape;
      if (!at.is_all) {
        if (!part.may_meet(piece.shape)) continue;
        if (++cuts_ > most_cuts) return false;
        Meeting const found = intersect(part, piece.shape, common);
        if (found == Meeting::apart) continue;
        if (found == Meeting::too_many) return false;
        shape = &common;
      }
      double const shared = shape->area();
      if (shared > nothing && !spread(*shape, shared, here)) return false;
    }
  }
  return true;
}

LuminanceSums ConvexView::sums_of_sets(double whole) {
  // From areas behind at least these to areas behind no others.
  for (std::size_t bit = 1; bit < sets_; bit *= 2) {
    for (std::size_t set = 0; set < sets_; ++set) {
      if ((set & bit) == 0) areas_[set] -= areas_[set | bit];
    }
  }
  LuminanceSums sums;
  for (std::size_t set = 0; set < sets_; ++set) {
    if (areas_[set] < nothing) continue;
    double sum = std::min(1.0, areas_[set] / whole);
    std::vector<std::pair<int, int>> powers;
    for (std::size_t i = 0; i < scheduled_.size(); ++i) {
      if ((set >> i & 1U) == 0) continue;
      sum *= scheduled_[i].transmittance;
      auto const place = std::find_if(powers.begin(), powers.end(), [&](auto const& power) {
        return power.first >= scheduled_[i].schedule;
      });
      if (place != powers.end() && place->first == scheduled_[i].schedule) {
        ++place->second;
      } else {
        powers.insert(place, {scheduled_[i].schedule, 1});
      }
    }
    if (powers.empty()) {
      sums.unscheduled = sum;
      continue;
    }
    auto const known =
        std::find_if(sums.scheduled.begin(), sums.scheduled.end(),
                     [&](LuminanceSums::Scheduled const& other) { return other.powers == powers; });
    if (known != sums.scheduled.end()) {
      known->sum += sum;
    } else {
      sums.scheduled.push_back({std::move(powers), sum});
    }
  }
  std::sort(sums.scheduled.begin(), sums.scheduled.end(),
            [](auto const& a, auto const& b) { return a.powers < b.powers; });
  return sums;
}

std::optional<ExactAnswer> ConvexView::answer(Scene const& scene, Transmission const& transmission,
                                              ExactQuestion const& question,
                                              Projection const& projection) {
  receiver_.clear();
  casters_.clear();
  interiors_.clear();
  changes_.clear();
  bits_.clear();
  scheduled_.clear();
  depths_.clear();
  hidden_.clear();
  dark_ = false;
  cuts_ = 0;
  if (!add_polygon(question.receiver, nullptr, projection, receiver_) ||
      receiver_.unended().empty()) {
    return std::nullopt;
  }
  receiver_.end();
  is_rectangle_ = receiver_[0].front().shape.is_rectangle();
  double whole = 0.0;
  for (Piece const& piece : receiver_[0]) whole += piece.sign * piece.shape.area();
  if (whole <= nothing || (question.through && receiver_[0].size() > 1)) return std::nullopt;
  if (!add_casters(transmission, question, projection)) return std::nullopt;
  Pieces& parts = question.through ? interiors_ : receiver_;
  if (dark_) {
    sums_.assign(question.through ? question.interiors.size() : 1, {});
    return ExactAnswer{sums_, casters_.polygons()};
  }
  if (question.through && !add_interiors(scene, question, projection)) return std::nullopt;
  sets_ = std::size_t{1} << scheduled_.size();
  sums_.resize(parts.polygons());
  for (std::size_t i = 0; i < parts.polygons(); ++i) {
    std::fill_n(areas_.begin(), sets_, 0.0);
    for (Piece const& piece : parts[i]) {
      if (!spread(piece)) return std::nullopt;
    }
    for (Hidden const& hidden : hidden_) {
      if (hidden.interior != i) continue;
      if (!spread(hidden.piece)) return std::nullopt;
    }
    sums_[i] = sums_of_sets(whole);
  }
  return ExactAnswer{sums_, casters_.polygons()};
}

}  // namespace

std::optional<ExactAnswer> convex_sums(Scene const& scene, Transmission const& transmission,
                                       ExactQuestion const& question,
                                       Projection const& projection) {
  // Kept from one question to the next, so that memory is asked for but once; behind a pointer, or
  // the address is looked up again wherever it is used.
  static thread_local auto const view = std::make_unique<ConvexView>();
  return view->answer(scene, transmission, question, projection);
}

}  // namespace gpu_shading

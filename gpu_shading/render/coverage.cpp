#include "render/coverage.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <bit>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "render/luminance_tile.h"

namespace gpu_shading {
namespace {

// A convex piece as a view has it.
class Projected {
 public:
  // `pixels` has its x and y in pixels.
  Projected(std::span<glm::dvec3 const> points, glm::uvec4 const& piece, View const& pixels)
      : count_(piece[2] == piece[3] ? 3 : 4) {
    for (std::size_t i = 0; i < count_; ++i) {
      glm::dvec3 const p = points[piece[static_cast<int>(i)]] - pixels.origin;
      corners_[i] = {at(pixels.x, p), at(pixels.y, p)};
      depths_[i] = at(pixels.z, p);
      distances_[i] = at(pixels.cut, p);
    }
  }

  ConvexArea area(int side) const {
    return area_in_front({corners_.data(), count_}, {distances_.data(), count_}, side);
  }

  // x, y: the change of depth by column and row; z: at the corner of the tile.
  glm::dvec3 depth() const {
    glm::dvec2 const a = corners_[1] - corners_[0];
    glm::dvec2 const b = corners_[2] - corners_[0];
    double const twice_area = cross(a, b);
    double const up_a = depths_[1] - depths_[0];
    double const up_b = depths_[2] - depths_[0];
    glm::dvec2 const slope =
        glm::dvec2(up_a * b.y - up_b * a.y, up_b * a.x - up_a * b.x) / twice_area;
    return {slope, depths_[0] - glm::dot(slope, corners_[0])};
  }

 private:
  std::size_t count_;
  std::array<glm::dvec2, 4> corners_;
  std::array<double, 4> depths_;
  std::array<double, 4> distances_;
};

View in_pixels(View view, int side) {
  glm::dvec4 const shift(0.0, 0.0, 0.0, 1.0);
  view.x = 0.5 * side * (view.x + shift);
  view.y = 0.5 * side * (view.y + shift);
  return view;
}

struct InteriorPiece {
  std::size_t surface = 0;  // its place in what was asked
  PixelMask mask;
  glm::dvec3 depth{0.0};
};

// Of pixels that several pieces cover, whose each is.
void share_out(std::span<std::uint64_t const> pixels, std::span<InteriorPiece const> pieces,
               std::vector<std::uint64_t>& counts) {
  for (std::size_t word = 0; word < pixels.size(); ++word) {
    for (std::uint64_t rest = pixels[word]; rest != 0; rest &= rest - 1) {
      std::uint64_t const bit = rest & (~rest + 1);
      InteriorPiece const* nearest = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (InteriorPiece const& piece : pieces) {
        if ((piece.mask.words()[word] & bit) == 0) continue;
        glm::dvec3 const middle(piece.mask.column(word) + std::countr_zero(bit) + 0.5,
                                piece.mask.row(word) + 0.5, 1.0);
        double const depth = glm::dot(piece.depth, middle);
        if (nearest != nullptr && !(depth < least)) continue;
        nearest = &piece;
        least = depth;
      }
      if (nearest != nullptr) ++counts[nearest->surface];
    }
  }
}

// Calls use(first, end) for parts of a tile's rows, on so many threads at most.
template <typename Use>
void in_rows(int side, int threads, Use use) {
  if (threads <= 1) return use(0, side);
  using Rows = tbb::blocked_range<int>;
  auto const share = static_cast<std::size_t>((side + threads - 1) / threads);
  tbb::parallel_for(Rows(0, side, share), [&](Rows const& rows) { use(rows.begin(), rows.end()); });
}

}  // namespace

Coverage::Coverage(std::span<Mesh const> meshes) {
  ranges_.reserve(meshes.size());
  for (Mesh const& mesh : meshes) {
    auto const base = static_cast<std::uint32_t>(points_.size());
    std::vector<glm::uvec4> const pieces = convex_pieces(mesh);
    ranges_.push_back({pieces_.size(), pieces.size()});
    for (glm::uvec4 const& piece : pieces) pieces_.push_back(piece + base);
    points_.insert(points_.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
}

void Coverage::darken(PixelMask& mask, Tile const& tile, View const& view,
                      std::span<SurfaceId const> casters) const {
  View const pixels = in_pixels(view, tile.side);
  for (SurfaceId const id : casters) {
    each_area(id, pixels, tile.side, [&](ConvexArea const& area) { mask.darken(area); });
  }
}

template <typename Use>
void Coverage::each_area(SurfaceId caster, View const& pixels, int side, Use use) const {
  for (glm::uvec4 const& piece : pieces(caster)) {
    use(Projected(points_, piece, pixels).area(side));
  }
}

std::uint64_t Coverage::lit(Tile const& tile, View const& view, std::span<SurfaceId const> casters,
                            int threads) const {
  std::atomic<std::uint64_t> sum = 0;
  in_rows(tile.side, threads, [&](int first, int end) {
    static thread_local PixelMask mask;
    mask.start(tile.side, first, end);
    light(mask, tile);
    darken(mask, tile, view, casters);
    sum += mask.lit();
  });
  return sum;
}

double Coverage::luminance(Tile const& tile, View const& view, std::span<SurfaceId const> casters,
                           std::span<float const> shares, ScreensInView const& screens,
                           int threads) const {
  View const pixels = in_pixels(view, tile.side);
  std::vector<double> sums(static_cast<std::size_t>(tile.side));
  in_rows(tile.side, threads, [&](int first, int end) {
    static thread_local PixelMask mask;
    static thread_local LuminanceTile shaded;
    mask.start(tile.side, first, end);
    light(mask, tile);
    shaded.start(tile.side, first, end);
    for (std::size_t i = 0; i < casters.size(); ++i) {
      each_area(casters[i], pixels, tile.side, [&](ConvexArea const& area) {
        if (shares[i] > 0.0F) {
          shaded.multiply(area, shares[i]);
        } else {
          mask.darken(area);
        }
      });
    }
    shade_by_screens(shaded, mask, pixels, screens);
    shaded.sum_rows(mask, std::span(sums).subspan(static_cast<std::size_t>(first)));
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

std::vector<std::uint64_t> Coverage::lit_inside(Tile const& tile, View const& view,
                                                std::span<SurfaceId const> casters,
                                                View const& behind,
                                                std::span<SurfaceId const> interiors) const {
  PixelMask lit;
  lit.start(tile.side, 0, tile.side);
  light(lit, tile);
  darken(lit, tile, view, casters);
  View const pixels = in_pixels(behind, tile.side);
  std::vector<InteriorPiece> found;
  std::vector<std::uint64_t> covered(lit.words().size());
  std::vector<std::uint64_t> several(lit.words().size());
  for (std::size_t i = 0; i < interiors.size(); ++i) {
    for (glm::uvec4 const& piece : pieces(interiors[i])) {
      Projected const projected(points_, piece, pixels);
      ConvexArea const area = projected.area(tile.side);
      if (area.first_row >= area.end_row) continue;
      InteriorPiece& added = found.emplace_back();
      added.surface = i;
      added.depth = projected.depth();
      added.mask.start(tile.side, 0, tile.side);
      added.mask.light(area);
      std::span<std::uint64_t const> const words = std::as_const(added.mask).words();
      for (std::size_t k = 0; k < words.size(); ++k) {
        several[k] |= covered[k] & words[k];
        covered[k] |= words[k];
      }
    }
  }
  // A closed room has hardly any pixel that two of its surfaces cover.
  std::vector<std::uint64_t> alone(lit.words().size());
  for (std::size_t k = 0; k < alone.size(); ++k) {
    alone[k] = lit.words()[k] & ~several[k];
    several[k] &= lit.words()[k];
  }
  std::vector<std::uint64_t> counts(interiors.size());
  for (InteriorPiece const& piece : found) {
    counts[piece.surface] += count_common(alone, piece.mask.words());
  }
  share_out(several, found, counts);
  return counts;
}

}  // namespace gpu_shading

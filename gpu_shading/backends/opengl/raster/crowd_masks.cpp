#include "backends/opengl/raster/crowd_masks.h"

#include <algorithm>

#include "antialias/antialias.h"
#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/draw.h"
#include "backends/opengl/gl/limits.h"
#include "shaders/sources.h"
#include "view/view.h"

namespace gpu_shading {
namespace {

constexpr std::uint32_t word_bits = 32;
// Of a submission: enough work for the device, and little memory.
constexpr std::size_t max_views = 256;
constexpr std::size_t max_words = std::size_t{8} << 20U;
// Submissions write their counts to places of their own.
constexpr std::size_t places = gl::StorageBuffer::max_in_flight + 1;

std::size_t pieces_of(std::span<Mesh const> meshes) {
  std::size_t pieces = 0;
  for (Mesh const& mesh : meshes) pieces += mesh.indices.size() / 3;
  return pieces;
}

}  // namespace

bool CrowdMasks::fit(std::span<Mesh const> meshes) {
  return gl::query_limits().storage_bytes >= pieces_of(meshes) * sizeof(Piece);
}

CrowdMasks::CrowdMasks(Scene const& scene, std::span<Mesh const> meshes, Casters const& casters,
                       bool parallel)
    : scene_(scene),
      casters_(casters),
      parallel_(parallel),
      cover_(gl::Program::link_compute("covered samples", shaders::cover_comp)),
      count_(gl::Program::link_compute("counts of samples", shaders::count_comp)),
      pieces_(gl::Buffer::create()),
      masks_(gl::Buffer::create()),
      counts_(gl::Buffer::create()) {
  add_pieces(meshes);
  counts_read_ = reinterpret_cast<std::uint32_t const*>(
      counts_.set_shared_size(places * 2 * max_views * sizeof(std::uint32_t)));
}

void CrowdMasks::add_pieces(std::span<Mesh const> meshes) {
  std::vector<Piece> pieces;
  auto const& order = casters_.tree().order();
  for (std::uint32_t position = 0; position < order.size(); ++position) {
    Mesh const& mesh = meshes[order[position]];
    std::vector<glm::uvec4> const corners = convex_pieces(mesh);
    if (corners.size() > 1) several_.push_back(position);
    for (glm::uvec4 const& of : corners) {
      Piece& piece = pieces.emplace_back();
      for (int i = 0; i < 4; ++i) {
        glm::dvec3 const& corner = mesh.vertices[of[i]];
        for (int axis = 0; axis < 3; ++axis) piece.corners[3 * i + axis] = corner[axis];
      }
      piece.caster = position;
      piece.lone = corners.size() == 1 ? 1 : 0;
    }
  }
  pieces_of_scene_ = pieces.size();
  pieces_.set(std::span<Piece const>(pieces));
}

std::size_t CrowdMasks::add(ReceiverView const& view) {
  Tile const& tile = *view.tile;
  View const in_front = view_in_front(*view.frame, tile.map, view.towards_sun);
  TileGrid const grid = sample_grid(tile, in_front, repeats_among(scene_, view.casters));
  View const pixels = in_pixels(in_front, grid);
  Question question{};
  question.x = pixels.x;
  question.y = pixels.y;
  question.cut = pixels.cut;
  question.origin = glm::dvec4(pixels.origin, 0.0);
  question.columns = grid.columns();
  question.rows = grid.rows;
  question.stride =
      static_cast<int>((static_cast<std::uint32_t>(grid.columns()) + word_bits - 1) / word_bits);
  auto const words =
      static_cast<std::size_t>(question.stride) * static_cast<std::size_t>(grid.rows);
  if (questions_.size() == max_views || all_words_ + words > max_words) submit();
  question.first_word = static_cast<std::uint32_t>(all_words_);
  question.pieces = static_cast<std::uint32_t>(pieces_of_scene_);
  question.first_counted = counted(view);
  questions_.push_back(question);
  words_.push_back({question.first_word, static_cast<std::uint32_t>(words)});
  all_words_ += words;
  add_own(tile, grid, question);
  answers_.emplace_back();
  return answers_.size() - 1;
}

std::uint32_t CrowdMasks::counted(ReceiverView const& view) {
  auto const known = counted_for_.find(view.receiver);
  if (known != counted_for_.end()) return known->second;
  Casters::Counted const counts(casters_, scene_, view.receiver, view.towards_sun);
  auto const casters = static_cast<std::uint32_t>(casters_.tree().order().size());
  auto const first = static_cast<std::uint32_t>(counted_.size());
  counted_.resize(first + casters / word_bits + 1);
  std::uint32_t* const bits = counted_.data() + first;
  for (std::uint32_t position = 0; position < casters; ++position) {
    bits[position / word_bits] |= (counts(position) ? 1U : 0U) << position % word_bits;
  }
  for (std::uint32_t const position : several_) {
    if (counts.is_in_front(position, view.frame->origin, view.frame->normal)) continue;
    bits[position / word_bits] &= ~(1U << position % word_bits);
  }
  if (!casters_.any_turned_away()) counted_for_.emplace(view.receiver, first);
  return first;
}

void CrowdMasks::add_own(Tile const& tile, TileGrid const& grid, Question const& question) {
  Question own = question;
  own.x = {1.0, 0.0, 0.0, 0.0};
  own.y = {0.0, 1.0, 0.0, 0.0};
  own.cut = {0.0, 0.0, 0.0, 1.0};
  own.origin = glm::dvec4(0.0);
  own.first_piece = static_cast<std::uint32_t>(own_pieces_.size());
  own.pieces = static_cast<std::uint32_t>(tile.triangles.size() / 3);
  own_questions_.push_back(own);
  for (std::size_t triangle = 0; triangle < own.pieces; ++triangle) {
    Piece& piece = own_pieces_.emplace_back();
    for (std::size_t corner = 0; corner < 4; ++corner) {
      glm::dvec2 const place =
          on_grid(tile.triangles[3 * triangle + std::min<std::size_t>(corner, 2)], grid);
      piece.corners[3 * corner] = place.x;
      piece.corners[3 * corner + 1] = place.y;
    }
  }
}

void CrowdMasks::submit() {
  if (questions_.empty()) return;
  while (in_flight_.size() >= gl::StorageBuffer::max_in_flight) collect();
  constexpr std::uint32_t at_once = 4;  // as in cover.comp
  constexpr std::size_t max_groups = 65535;
  // Few pieces, some of them large, are shared by several groups.
  constexpr std::size_t few_pieces = 10'000;
  auto const shares = [&](std::size_t pieces) {
    return parallel_ && pieces < few_pieces ? 16U : 1U;
  };
  auto const groups = [&](std::size_t pieces) {
    return static_cast<std::uint32_t>(std::min((pieces + at_once - 1) / at_once, max_groups));
  };
  auto const views = static_cast<std::uint32_t>(questions_.size());
  std::size_t most_own = 0;
  for (Question const& own : own_questions_) most_own = std::max<std::size_t>(most_own, own.pieces);
  questions_on_device_.set(std::span<Question const>(questions_));
  own_questions_on_device_.set(std::span<Question const>(own_questions_));
  own_pieces_on_device_.set(std::span<Piece const>(own_pieces_));
  counted_on_device_.set(std::span<std::uint32_t const>(counted_));
  words_on_device_.set(std::span<MaskWords const>(words_));
  if (all_words_ * sizeof(std::uint32_t) > mask_bytes_) {
    while (!in_flight_.empty()) collect();
    mask_bytes_ = all_words_ * sizeof(std::uint32_t);
    masks_.set_size(mask_bytes_);
  }
  masks_.clear(all_words_ * sizeof(std::uint32_t));

  std::size_t const first = answers_.size() - views;
  place_ = (place_ + 1) % places;
  auto const counts = static_cast<std::uint32_t>(2 * max_views * place_);
  auto const count = [&](std::uint32_t from) {
    gl::share_between_programs();
    count_.set(0, from);
    count_.use();
    words_on_device_.bind(0);
    gl::dispatch(views, 1, 1);
    gl::share_between_programs();
  };
  masks_.bind_storage(3);
  counts_.bind_storage(4);
  counted_on_device_.bind(2);
  cover_.set(0, std::uint32_t{1});
  cover_.use();
  own_questions_on_device_.bind(0);
  own_pieces_on_device_.bind(1);
  gl::dispatch(groups(most_own), views, shares(most_own));
  count(counts);
  cover_.set(0, std::uint32_t{0});
  cover_.use();
  questions_on_device_.bind(0);
  pieces_.bind_storage(1);
  gl::dispatch(groups(pieces_of_scene_), views, shares(pieces_of_scene_));
  count(counts + views);
  gl::share_written();
  gl::check("covering samples");
  in_flight_.push_back({first, views, place_, gl::Fence::here()});
  clear_gathered();
}

void CrowdMasks::collect() {
  InFlight const& oldest = in_flight_.front();
  oldest.fence.wait();
  std::uint32_t const* const counts = counts_read_ + 2 * max_views * oldest.place;
  for (std::size_t i = 0; i < oldest.count; ++i) {
    answers_[oldest.first + i] = {counts[i], counts[oldest.count + i]};
  }
  in_flight_.pop_front();
}

void CrowdMasks::finish() {
  submit();
  while (!in_flight_.empty()) collect();
}

void CrowdMasks::clear_gathered() {
  questions_.clear();
  own_questions_.clear();
  own_pieces_.clear();
  counted_.clear();
  counted_for_.clear();
  words_.clear();
  all_words_ = 0;
}

void CrowdMasks::clear() {
  in_flight_.clear();
  answers_.clear();
  clear_gathered();
}

}  // namespace gpu_shading

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <vector>

#include "backends/interface/view_backend.h"
#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/program.h"
#include "backends/opengl/gl/readback.h"
#include "geometry/triangulation.h"
#include "gpu_shading/scene.h"
#include "scene/casters.h"
#include "view/tile.h"

namespace gpu_shading {

// Answers views of opaque casters that are many, without a search: compute programs light a mask of
// the receiver's samples, darken those that casters cover, and count. The samples and what covers
// them are those of the CPU, in double precision; two numbers a view come back. Creating, using
// and destroying it require the current context.
class CrowdMasks {
 public:
  // All must outlive it, except the meshes. `parallel`: the device has thousands of threads.
  CrowdMasks(Scene const& scene, std::span<Mesh const> meshes, Casters const& casters,
             bool parallel);

  // Whether the current context can hold the pieces of these meshes.
  static bool fit(std::span<Mesh const> meshes);

  // Takes a view with a crowd and without interiors, and may start it. Returns its number.
  std::size_t add(ReceiverView const& view);
  // Waits for all views.
  void finish();
  struct Samples {
    std::uint32_t own = 0;  // of the receiver
    std::uint32_t lit = 0;
  };
  // Of a view, after finish().
  Samples const& samples(std::size_t view) const { return answers_[view]; }
  // Discards all views.
  void clear();

 private:
  // As in cover.comp.
  struct Question {
    glm::dvec4 x;
    glm::dvec4 y;
    glm::dvec4 cut;
    glm::dvec4 origin;
    std::uint32_t first_word;
    std::int32_t stride;
    std::int32_t columns;
    std::int32_t rows;
    std::uint32_t first_piece;
    std::uint32_t pieces;
    std::uint32_t first_counted;
    std::uint32_t unused = 0;
  };
  struct Piece {
    double corners[12];
    std::uint32_t caster;  // its position in the tree
    std::uint32_t lone;
  };
  struct MaskWords {
    std::uint32_t first;
    std::uint32_t count;
  };
  struct InFlight {
    std::size_t first;  // of the answers
    std::size_t count;
    std::size_t place;  // of the counts
    gl::Fence fence;
  };

  void add_pieces(std::span<Mesh const> meshes);
  // Returns where the bits of the casters that count for a view are.
  std::uint32_t counted(ReceiverView const& view);
  void add_own(Tile const& tile, TileGrid const& grid, Question const& question);
  void submit();
  void collect();
  void clear_gathered();

  Scene const& scene_;
  Casters const& casters_;
  bool parallel_;
  std::vector<std::uint32_t> several_;  // positions of casters of more than one piece
  std::size_t pieces_of_scene_ = 0;
  gl::Program cover_;
  gl::Program count_;
  gl::Buffer pieces_;
  gl::Buffer masks_;
  std::size_t mask_bytes_ = 0;  // of masks_
  gl::StorageBuffer questions_on_device_;
  gl::StorageBuffer own_questions_on_device_;
  gl::StorageBuffer own_pieces_on_device_;
  gl::StorageBuffer counted_on_device_;
  gl::StorageBuffer words_on_device_;
  gl::Buffer counts_;
  std::uint32_t const* counts_read_ = nullptr;
  std::size_t place_ = 0;  // of the last submission's counts

  // Gathered for the next submission.
  std::vector<Question> questions_;
  std::vector<Question> own_questions_;
  std::vector<Piece> own_pieces_;
  std::vector<std::uint32_t> counted_;
  std::map<SurfaceId, std::uint32_t> counted_for_;  // receivers for which the sun does not matter
  std::vector<MaskWords> words_;
  std::size_t all_words_ = 0;

  std::deque<InFlight> in_flight_;
  std::vector<Samples> answers_;
};

}  // namespace gpu_shading

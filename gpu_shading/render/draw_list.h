#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "render/view.h"

namespace gpu_shading {

struct Range {
  std::size_t first = 0;
  std::size_t count = 0;
};

// The uniform block View of slide.vert, std140.
struct ViewBlock {
  glm::vec4 x;
  glm::vec4 y;
  glm::vec4 z;
  glm::vec4 cut;
  glm::vec4 origin_high;
  glm::vec4 origin_low;
};

// What the draws of one submission read, gathered here to be uploaded at once.
class DrawList {
 public:
  void clear();

  // All surfaces added to one view become one draw.
  std::size_t begin_surfaces() const { return indices_.size(); }
  void add_triangles(std::span<std::uint32_t const> indices);
  Range end_surfaces(std::size_t begin) const { return {begin, indices_.size() - begin}; }

  Range add_tile(std::span<glm::vec2 const> triangles);
  std::size_t add_view(View const& view, glm::dvec3 const& scene_origin);

  std::span<std::uint32_t const> indices() const { return indices_; }
  std::span<glm::vec2 const> tile_vertices() const { return tile_vertices_; }
  std::span<ViewBlock const> views() const { return views_; }

 private:
  std::vector<std::uint32_t> indices_;
  std::vector<glm::vec2> tile_vertices_;
  std::vector<ViewBlock> views_;
};

}  // namespace gpu_shading

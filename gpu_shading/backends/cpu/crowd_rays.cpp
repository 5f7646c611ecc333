#include "backends/cpu/crowd_rays.h"

#include <bit>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "rays/ray_tree.h"

namespace gpu_shading {

CrowdRays::CrowdRays(Scene const& scene, Casters const& casters)
    : scene_(scene), casters_(casters) {
  auto const count = static_cast<std::uint32_t>(casters.tree().order().size());
  for (std::uint32_t position = 0; position < count; ++position) {
    shapes_.add(position, scene[casters.id(position)].polygon);
  }
  shapes_.make_tree();
}

void CrowdRays::darken(PixelMask& mask, View const& pixels, CrowdQuestion const& question) const {
  glm::dvec3 const normal(pixels.cut);
  glm::dmat3 const in_scene =
      glm::inverse(glm::transpose(glm::dmat3(glm::dvec3(pixels.x), glm::dvec3(pixels.y), normal)));
  Casters::Counted const counted(casters_, scene_, question.receiver, question.towards_sun);
  double const cosine = glm::dot(normal, question.towards_sun);
  RayPath path({pixels.origin, question.towards_sun});
  auto const words = mask.words();
  for (std::size_t word = 0; word < words.size(); ++word) {
    for (std::uint64_t rest = words[word]; rest != 0; rest &= rest - 1) {
      double const column = mask.column(word) + std::countr_zero(rest) + 0.5;
      double const row = mask.row(word) + 0.5;
      path.move_to(pixels.origin +
                   in_scene * glm::dvec3(column - pixels.x.w, row - pixels.y.w, clearance));
      double limit = std::numeric_limits<double>::infinity();
      shapes_.search(path, limit, [&](std::uint32_t position, double distance) {
        bool const in_front =
            distance * cosine > coplanar || counted.is_in_front(position, pixels.origin, normal);
        if (in_front && counted(position)) limit = -1.0;
      });
      if (limit < 0.0) words[word] ^= rest & (~rest + 1);
    }
  }
}

}  // namespace gpu_shading

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "routes/opengl/queries/drawn_model.h"

namespace gpu_shading::energyplus {

// The view of Penumbra's matrix, from the sun to a surface's bounding rectangle in parallel
// projection.
struct MatrixView {
  glm::dvec3 towards_sun;  // unit vector
  double width = 0.0;      // of the viewport, m
  double height = 0.0;

  // From OpenGL's matrix, by columns. Empty unless it is one of a parallel projection.
  static std::optional<MatrixView> of(std::array<float, 16> const& matrix);
};

// Understands what Penumbra draws. Nothing is rasterised: it takes down the model, the views and
// the occlusion queries, and computes the count of a query when its result is wanted.
//
// Penumbra passes the triangles of all surfaces once. For each direction of the sun and surface, it
// sets a matrix that fits the surface's bounding rectangle, clears, draws all triangles, and draws
// those of the surface within a query: what it counts are the pixels where the surface is nearest.
// For interior surfaces, it draws all but a window from the window's view, and then each interior
// surface within a query of its own.
class Recorder {
 public:
  using Query = std::uint32_t;  // from 1

  explicit Recorder(std::shared_ptr<DrawnModel> model);

  void set_vertices(std::span<float const> xyz);  // glBufferData
  void set_viewport(int width, int height);
  void set_matrix(std::array<float, 16> const& matrix);  // by columns
  void clear();
  void draw(DrawnRange vertices);

  void create_queries(std::span<Query> queries);
  void delete_queries(std::span<Query const> queries);
  void begin_query(Query query);
  void end_query();

  // The number of pixels that a query counts. Throws Error.
  int result(Query query);

 private:
  // What was drawn since the last clear.
  struct Scene {
    std::optional<MatrixView> view;
    double pixel_area = 0.0;  // m2
    std::vector<DrawnRange> drawn;
    std::vector<Query> queries;
  };
  struct Question {
    std::shared_ptr<Scene> scene;
    DrawnRange surface;
    std::optional<int> count;  // once it is known
  };

  void learn_surfaces(std::optional<DrawnRange> window);
  std::size_t surface_at(DrawnRange range) const;
  bool knows(DrawnRange range) const { return surface_at(range) < surfaces_.size(); }
  bool knows_surfaces_of(Scene const& scene) const;
  std::optional<DrawnRange> hidden(Scene const& scene) const;
  void answer_interiors(Scene const& scene, std::size_t window);

  std::shared_ptr<DrawnModel> model_;
  std::vector<glm::vec3> vertices_;
  std::vector<DrawnRange> surfaces_;  // by their first vertex
  std::map<Query, Question> questions_;
  std::shared_ptr<Scene> scene_ = std::make_shared<Scene>();
  std::optional<MatrixView> view_;
  double pixels_ = 1.0;
  std::optional<Query> counting_;
  Query last_query_ = 0;
};

}  // namespace gpu_shading::energyplus

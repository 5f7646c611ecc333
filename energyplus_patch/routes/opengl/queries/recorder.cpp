#include "routes/opengl/queries/recorder.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

int to_count(double area, double pixel_area) {
  auto const count = std::round(area / pixel_area);
  if (!(count > 0.0)) return 0;
  constexpr int max_count = std::numeric_limits<int>::max();
  return count < max_count ? static_cast<int>(count) : max_count;
}

glm::dvec3 row(std::array<float, 16> const& matrix, std::size_t index) {
  constexpr std::size_t column = 4;
  return {matrix.at(index), matrix.at(column + index), matrix.at(2 * column + index)};
}

}  // namespace

std::optional<MatrixView> MatrixView::of(std::array<float, 16> const& matrix) {
  constexpr double extent = 2.0;  // of what is seen, in OpenGL's coordinates
  auto const across = glm::length(row(matrix, 0));
  auto const up = glm::length(row(matrix, 1));
  // The depth grows away from the sun.
  auto const away = row(matrix, 2);
  auto const depth = glm::length(away);
  bool const usable = std::isfinite(across) && std::isfinite(up) && std::isfinite(depth) &&
                      across > 0.0 && up > 0.0 && depth > 0.0;
  if (!usable || glm::length(row(matrix, 3)) > 0.0) return std::nullopt;
  return MatrixView{-away / depth, extent / across, extent / up};
}

Recorder::Recorder(std::shared_ptr<DrawnModel> model) : model_(std::move(model)) {}

void Recorder::set_vertices(std::span<float const> xyz) {
  constexpr std::size_t axes = 3;
  vertices_.clear();
  vertices_.reserve(xyz.size() / axes);
  for (std::size_t i = 0; i + axes <= xyz.size(); i += axes) {
    vertices_.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  surfaces_.clear();
  questions_.clear();
  scene_ = std::make_shared<Scene>();
}

void Recorder::set_viewport(int width, int height) {
  pixels_ = std::max(1.0, static_cast<double>(width) * height);
}

// Each matrix of one position of the sun has its own rounding: the first one's direction counts for
// all, so that they are answered together.
void Recorder::set_matrix(std::array<float, 16> const& matrix) {
  constexpr double rounding = 2e-6;
  auto view = MatrixView::of(matrix);
  if (view && view_ && glm::distance(view->towards_sun, view_->towards_sun) < rounding) {
    view->towards_sun = view_->towards_sun;
  }
  view_ = view;
}

void Recorder::clear() { scene_ = std::make_shared<Scene>(); }

void Recorder::draw(DrawnRange vertices) {
  if (counting_) {
    questions_[*counting_].surface = vertices;
  } else if (vertices.count > 0) {
    scene_->drawn.push_back(vertices);
  }
}

void Recorder::create_queries(std::span<Query> queries) {
  for (auto& query : queries) query = ++last_query_;
}

void Recorder::delete_queries(std::span<Query const> queries) {
  for (auto const query : queries) questions_.erase(query);
}

void Recorder::begin_query(Query query) {
  scene_->view = view_;
  if (view_) scene_->pixel_area = view_->width * view_->height / pixels_;
  scene_->queries.push_back(query);
  questions_[query] = {scene_, {}, std::nullopt};
  counting_ = query;
}

void Recorder::end_query() { counting_.reset(); }

// Each surface is drawn within a query, or is a window that is left out. Vertices that no query has
// drawn yet are taken triangle by triangle, since it is not known which of them belong together.
void Recorder::learn_surfaces(std::optional<DrawnRange> window) {
  constexpr std::uint32_t corners = 3;
  std::vector<DrawnRange> asked;
  if (window) asked.push_back(*window);
  for (auto const& [query, question] : questions_) {
    if (question.surface.count > 0) asked.push_back(question.surface);
  }
  for (auto const& surface : surfaces_) {
    if (surface.count > corners) asked.push_back(surface);  // known from a query that is gone
  }
  std::ranges::sort(asked);
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  surfaces_.clear();
  std::uint32_t at = 0;
  auto const fill = [&](std::uint32_t end) {
    for (; at + corners <= end; at += corners) surfaces_.push_back({at, corners});
  };
  for (auto const& surface : asked) {
    if (surface.first < at) throw Error("EnergyPlus draws surfaces that overlap in memory");
    fill(surface.first);
    surfaces_.push_back(surface);
    at = surface.end();
  }
  if (at > vertices_.size()) throw Error("EnergyPlus draws more vertices than it has passed");
  fill(static_cast<std::uint32_t>(vertices_.size()));
  model_->set_model(vertices_, surfaces_);
}

std::size_t Recorder::surface_at(DrawnRange range) const {
  auto const found = std::ranges::lower_bound(surfaces_, range);
  bool const known = found != surfaces_.end() && *found == range;
  return known ? static_cast<std::size_t>(found - surfaces_.begin()) : surfaces_.size();
}

bool Recorder::knows_surfaces_of(Scene const& scene) const {
  return std::ranges::all_of(scene.queries, [&](Query query) {
    auto const asked = questions_.find(query);
    return asked == questions_.end() || asked->second.surface.count == 0 ||
           knows(asked->second.surface);
  });
}

// The vertices that a scene leaves out, which are a window's; empty if it leaves out none.
std::optional<DrawnRange> Recorder::hidden(Scene const& scene) const {
  auto drawn = scene.drawn;
  std::ranges::sort(drawn);
  drawn.push_back({static_cast<std::uint32_t>(vertices_.size()), 0});
  std::optional<DrawnRange> gap;
  std::uint32_t at = 0;
  for (auto const& range : drawn) {
    if (range.first > at) {
      if (gap) throw Error("EnergyPlus asks for interior areas of several windows");
      gap = DrawnRange{at, range.first - at};
    }
    at = std::max(at, range.end());
  }
  return gap;
}

void Recorder::answer_interiors(Scene const& scene, std::size_t window) {
  std::vector<Query> queries;
  std::vector<std::size_t> interiors;
  for (auto const query : scene.queries) {
    auto const asked = questions_.find(query);
    if (asked == questions_.end() || asked->second.scene.get() != &scene) continue;
    auto& question = asked->second;
    question.count = 0;
    if (question.surface.count == 0) continue;
    queries.push_back(query);
    interiors.push_back(surface_at(question.surface));
  }
  auto const areas = model_->interior_areas(scene.view->towards_sun, window, interiors);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    questions_[queries[i]].count = to_count(areas[i], scene.pixel_area);
  }
}

int Recorder::result(Query query) {
  auto const asked = questions_.find(query);
  if (asked == questions_.end()) throw Error("EnergyPlus asks for a query that it did not make");
  auto& question = asked->second;
  if (question.count) return *question.count;
  question.count = 0;
  auto const scene = question.scene;
  // A surface without area, or a view without any, whose pixels have no area either.
  if (question.surface.count == 0 || !scene->view) return 0;
  auto const window = hidden(*scene);
  bool const known = knows_surfaces_of(*scene) && (!window || knows(*window));
  if (!known) learn_surfaces(window);
  if (!window) {
    auto const area = model_->sunlit_area(scene->view->towards_sun, surface_at(question.surface));
    question.count = to_count(area, scene->pixel_area);
  } else {
    auto const place = surface_at(*window);
    if (place == surfaces_.size()) {
      throw Error("EnergyPlus asks for interior areas behind what is not one surface");
    }
    answer_interiors(*scene, place);
  }
  return *questions_[query].count;
}

}  // namespace gpu_shading::energyplus

#include "backends/opengl/raster/screen_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <utility>

#include "backends/opengl/gl/check.h"
#include "backends/opengl/gl/draw.h"
#include "backends/opengl/gl/limits.h"
#include "backends/opengl/raster/draw_list.h"
#include "backends/opengl/raster/split_double.h"
#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/error.h"
#include "shaders/sources.h"

namespace gpu_shading {
namespace {

struct Vertex {
  SplitDouble position;
  glm::vec2 corner;
  std::int32_t screen;
};
static_assert(sizeof(Vertex) == sizeof(SplitDouble) + sizeof(glm::vec2) + sizeof(std::int32_t));

// Indices of programs, and the definitions of each for screen.frag.
enum { of_pattern, of_texture, of_regions };
constexpr std::array<char const*, 3> definitions{"#define PATTERN\n", "#define TEXTURE\n",
                                                 "#define TEXTURE\n#define REGIONS\n"};

// Texture memory is allocated in pieces of this size.
constexpr int largest_texture = 4096;

gl::ValueTexture make_texture(OpacityTile const& tile, TextureCells const& cells) {
  auto texture =
      gl::ValueTexture::create(cells.columns + 2, cells.rows + 2, cells.across * cells.up);
  std::vector<std::uint16_t> texels;
  auto const columns = static_cast<std::size_t>(tile.columns());
  for (int layer = 0; layer < cells.across * cells.up; ++layer) {
    texels.clear();
    int const left = layer % cells.across * cells.columns;
    int const bottom = layer / cells.across * cells.rows;
    for (int row = bottom - 1; row <= bottom + cells.rows; ++row) {
      auto const around = static_cast<std::size_t>((row + tile.rows()) % tile.rows());
      for (int column = left - 1; column <= left + cells.columns; ++column) {
        auto const along = static_cast<std::size_t>((column + tile.columns()) % tile.columns());
        texels.push_back(tile.opacity()[around * columns + along]);
      }
    }
    texture.set(layer, texels);
  }
  return texture;
}

}  // namespace

ScreenGeometry::ScreenGeometry(Screens const& screens, glm::dvec3 const& scene_origin,
                               gl::Buffer const& views)
    : screens_(screens),
      max_texels_(std::min(largest_texture, gl::query_limits().max_texture_size)) {
  if (screens_.entries().empty()) return;
  gl::require_vertex_storage("perforated screens");
  vertices_ = gl::Buffer::create();
  draw_indices_ = gl::Buffer::create();
  add_quadrilaterals(scene_origin);
  add_looks();
  quadrilaterals_ = gl::VertexArray::create();
  quadrilaterals_.set_vertices(vertices_, sizeof(Vertex));
  using Of = gl::VertexArray::Of;
  quadrilaterals_.add_floats(Of::vertices, 0, 3, offsetof(SplitDouble, high));
  quadrilaterals_.add_floats(Of::vertices, 1, 3, offsetof(SplitDouble, low));
  quadrilaterals_.add_floats(Of::vertices, 2, 2, offsetof(Vertex, corner));
  quadrilaterals_.add_integers(Of::vertices, 3, 1, offsetof(Vertex, screen));
  add_view_records(quadrilaterals_, views);
  quadrilaterals_.set_indices(draw_indices_);
  gl::check("uploading screens");
}

void ScreenGeometry::add_quadrilaterals(glm::dvec3 const& scene_origin) {
  std::vector<Vertex> vertices;
  for (std::size_t screen = 0; screen < screens_.entries().size(); ++screen) {
    std::size_t const first = indices_.size();
    for (Screens::Quadrilateral const& part : screens_.entries()[screen].parts) {
      for (std::size_t i = 0; i < part.corners.size(); ++i) {
        indices_.push_back(static_cast<std::uint32_t>(vertices.size()));
        vertices.push_back({SplitDouble(part.corners[i] - scene_origin), glm::vec2(part.places[i]),
                            static_cast<std::int32_t>(screen)});
      }
    }
    ranges_.push_back({first, indices_.size() - first});
  }
  vertices_.set(std::span<Vertex const>(vertices));
}

void ScreenGeometry::add_looks() {
  std::map<PerforatedScreen const*, int> textures;
  for (Screens::Entry const& entry : screens_.entries()) {
    PerforatedScreen const& screen = *entry.screen;
    int& texture = texture_of_.emplace_back(-1);
    if (screen.tile()) {
      auto const [place, added] = textures.try_emplace(&screen, static_cast<int>(textures_.size()));
      if (added) {
        textures_.push_back(
            make_texture(*screen.tile(), texture_cells(*screen.tile(), max_texels_)));
      }
      texture = place->second;
      link_program(of_texture);
      link_program(of_regions);
    } else {
      link_program(of_pattern);
    }
  }
}

void ScreenGeometry::link_program(int program) {
  gl::Program& linked = programs_.at(static_cast<std::size_t>(program));
  if (!linked.empty()) return;
  std::string fragment = shaders::screen_frag;
  fragment.insert(fragment.find('\n') + 1, definitions.at(static_cast<std::size_t>(program)));
  linked =
      gl::Program::link("screens", shaders::screen_vert, shaders::screen_geom, fragment.c_str());
}

ScreenLook ScreenGeometry::look_of(int number, bool by_effect) const {
  int const texture = texture_of_[static_cast<std::size_t>(number)];
  if (texture < 0) return {of_pattern, texture};
  return {by_effect && varies(*screens_[number].screen) ? of_regions : of_texture, texture};
}

Range ScreenGeometry::add_to(DrawList& list, DirectionTables& tables, std::uint32_t view,
                             std::span<int const> numbers, double pixel_area) const {
  std::map<ScreenLook, std::vector<int>> by_look;
  for (int const number : numbers) {
    bool const by_effect = may_see_effect(screens_[number], tables.screens.towards_sun, pixel_area);
    tables.screens.add(number, by_effect);
    by_look[look_of(number, by_effect)].push_back(number);
  }
  std::size_t const first = list.screen_draws().size();
  for (auto const& [look, some] : by_look) {
    std::size_t const begin = list.begin_screens();
    for (int const number : some) {
      Range const range = ranges_[static_cast<std::size_t>(number)];
      list.add_quadrilaterals({indices_.data() + range.first, range.count});
    }
    list.end_screens(begin, look, view);
  }
  return {first, list.screen_draws().size() - first};
}

SheetBlocks ScreenGeometry::sheets(DrawList const& list, Transmission const& transmission) const {
  SheetBlocks blocks;
  for (DirectionTables const& direction : list.directions()) {
    std::vector<SheetInBeam> const sheets = transmission.sheets(direction.screens);
    for (std::size_t screen = 0; screen < sheets.size(); ++screen) {
      add_block(blocks, sheets[screen], *screens_.entries()[screen].screen, max_texels_);
    }
  }
  return blocks;
}

void ScreenGeometry::upload(DrawList const& list) {
  draws_.assign(list.screen_draws().begin(), list.screen_draws().end());
  if (draws_.empty()) return;
  SheetBlocks const& blocks = list.sheets();
  draw_indices_.set(list.screen_indices());
  std::span<SheetBlock const> const sheets(blocks.sheets);
  std::span<glm::vec4 const> const regions(blocks.regions);
  gl::require_storage(sheets.size_bytes(), "screens");
  gl::require_storage(regions.size_bytes(), "transmittances of screens");
  sheets_.set(sheets);
  if (!regions.empty()) regions_.set(regions);
}

void ScreenGeometry::draw(Range draws) const {
  if (draws.count == 0) return;
  constexpr std::uint32_t sheets_binding = 2;
  constexpr std::uint32_t regions_binding = 3;
  quadrilaterals_.bind();
  sheets_.bind(sheets_binding);
  for (std::size_t i = draws.first; i < draws.first + draws.count; ++i) {
    auto const& [look, indices, record] = draws_[i];
    programs_.at(static_cast<std::size_t>(look.program)).use();
    if (look.program == of_regions) regions_.bind(regions_binding);
    if (look.texture >= 0) textures_[static_cast<std::size_t>(look.texture)].bind(0);
    gl::draw_indexed_fours(indices.first, indices.count, record);
  }
}

}  // namespace gpu_shading

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "calculation/session.h"
#include "fuzz.h"
#include "gpu_shading/device.h"
#include "gpu_shading/error.h"
#include "gpu_shading/polygon.h"
#include "gpu_shading/sun_position.h"
#include "model/shading_outlines.h"

// What a model's objects say, from their fields to sunlit areas: the values that the reader of the
// text takes as they are.
namespace gpu_shading::energyplus {
namespace {

Choices quick_choices(Lean lean) {
  Choices choices;
  choices.lean = lean;
  choices.mode = Mode::automatic;
  choices.error = 0.05;
  choices.update = Update();
  choices.device = DeviceChoice{DeviceId{}};
  choices.cache = std::filesystem::path();
  choices.quiet = true;
  return choices;
}

// Beside the model, for the objects that name files.
std::filesystem::path write_files() {
  file_of("angle,tau\n0,0.8\n45,0.7\n90,0\n", "glass.csv");
  file_of(R"({"type": "FeatureCollection", "features": [{"type": "Feature", "id": "a",
    "properties": {"height": "9 m"}, "geometry": {"type": "Polygon", "coordinates": [[[8.0001, 47],
    [8.0003, 47], [8.0003, 47.0001], [8.0001, 47.0001], [8.0001, 47]]]}}]})",
          "town.geojson");
  return file_of(
      "ncols 3\nnrows 3\nxllcenter 7.99\nyllcenter 46.99\ncellsize 0.01\n400 410 420\n405 400 "
      "430\n400 400 400\n",
      "hills.asc");
}

Polygon wall() {
  return {{{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 0.0, 3.0}, {0.0, 0.0, 3.0}}, {}};
}

// The model's surfaces as EnergyPlus would hand them over.
void add_surfaces(std::vector<InputObject> const& objects, Names const& left_out,
                  Session& session) {
  session.add({.name = "WALL", .polygon = wall()});
  Names names{"WALL"};
  auto const rules = read_geometry_rules(objects);
  for (auto const& object : objects) {
    if (!is_detailed_shading(object)) continue;
    auto const outline = outline_of(object, session.input(), rules);
    auto const name = upper(object.name);
    if (!names.insert(name).second) throw Error("EnergyPlus refuses two surfaces of one name");
    if (outline && !left_out.contains(name))
      session.add({.name = name, .polygon = {outline->vertices, {}}});
  }
}

bool is_share(double value) { return value >= 0.0 && value <= 1.0; }

void ask_for_areas(Session& session, SunDirection const& sun) {
  session.set_sun(sun);
  for (SurfaceId id = 0; id < session.size(); ++id) {
    auto const& polygon = session.surface(id).polygon;
    double const most = area(polygon) * std::abs(glm::dot(normal(polygon), to_vector(sun)));
    auto const lit = static_cast<double>(session.projected_sunlit_area(id));
    require(lit >= 0.0 && lit <= most * 1.001 + 1e-6);
  }
}

void ask_for_rays(Session& session) {
  constexpr int hour = 9;
  constexpr glm::dvec3 eye{2.0, -0.01, 1.0};
  constexpr glm::dvec3 away{0.0, -1.0, 0.0};
  require(is_share(session.daylight_transmittance({eye, away}, hour)));
}

void render(std::vector<InputObject> const& objects, Model model) {
  auto const left_out = model.lean.left_out;
  Session session(std::move(model));
  add_surfaces(objects, left_out, session);
  Schedules const schedules{[](std::string const&) { return std::pair(0.0, 1.0); },
                            [](std::string const&, Moment moment) { return moment.hour / 24.0; }};
  auto const ignore = [](std::string const&) {};
  session.start({{ignore, ignore, ignore}, schedules, [] { return 0.8; }});
  session.set_time({9, 1});
  for (double const altitude : {0.6, 0.01}) ask_for_areas(session, {2.5, altitude});
  ask_for_rays(session);
  session.finish();
}

}  // namespace
}  // namespace gpu_shading::energyplus

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  gpu_shading::limit_threads(1);
  static auto const folder = write_files().parent_path();
  auto const text = as_text(data, size);
  auto const parsed = parse_idf(text);
  return try_to([&] {
    auto const objects = read_idf(parsed);
    auto const find = [&](Names const& names) { return find_mentions(parsed, names); };
    auto const lean = size % 2 == 0 ? Lean::on : Lean::automatic;
    auto model =
        understand(objects, folder / "model.idf", quick_choices(lean),
                   {.find_mentions = find, .daylight_rays = true, .reflected_light = true});
    rewrite_idf(text, parsed, rewrite_for(model));
    render(objects, std::move(model));
  });
}

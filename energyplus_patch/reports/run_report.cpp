#include "reports/run_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "gpu_shading/error.h"
#include "gpu_shading/rays.h"
#include "model/extensions/extension_fields.h"
#include "model/options/report_folder.h"
#include "platform/naming.h"
#include "platform/text.h"
#include "reports/map_folder.h"
#include "reports/map_grid.h"
#include "reports/module_folder.h"
#include "reports/near_terrain.h"
#include "reports/page/run_page.h"
#include "reports/page_motions.h"
#include "reports/remarks.h"
#include "reports/report.h"
#include "reports/sky_mask.h"

namespace gpu_shading::energyplus {
namespace {

constexpr char const* page_file = "index.html";
// Sunlit fractions that a page has: one byte each, a third more as text.
constexpr std::size_t max_percents = 900000;
constexpr std::size_t max_days = 122;

// Some of many days, evenly spread.
std::vector<RunRecord::Day const*> chosen_days(RunRecord const& record) {
  auto const& all = record.days();
  std::size_t values = 0;
  for (auto const& day : all) values += day.hours.size() * record.receivers().size();
  std::size_t const stride = std::max({std::size_t{1}, (values + max_percents - 1) / max_percents,
                                       (all.size() + max_days - 1) / max_days});
  std::vector<RunRecord::Day const*> days;
  for (std::size_t i = 0; i < all.size(); i += stride) days.push_back(&all[i]);
  return days;
}

// Rounded to whole percents, so that a few styles serve all.
double whole_percents(double share) {
  constexpr double percents = 100.0;
  return std::round(percents * share) / percents;
}

// What changes a shade with time, and what it passes without; `deployments`: how many there are in
// RunRecord::Hour::shares.
void add_share(PageStyle& style, BeamFilter const& filter, std::size_t deployments) {
  auto const* const sheet = filter.find<PerforatedSheet>();
  auto const* const crown = filter.find<Crown>();
  if (sheet != nullptr && sheet->deployment >= 0) {
    style.share = static_cast<std::size_t>(sheet->deployment);
    style.without = 1.0;
  } else if (crown != nullptr && crown->deployment >= 0) {
    style.share = static_cast<std::size_t>(crown->deployment);
    Crown bare = *crown;
    bare.leaf_density = 0.0;
    BeamFilter wood;
    wood.set(bare);
    style.without = wood.look().passes;
  } else if (filter.schedule >= 0) {
    style.share = deployments + static_cast<std::size_t>(filter.schedule);
  }
}

PageStyle style_of(Surface const& surface, std::size_t deployments) {
  constexpr std::array<char const*, 4> holes{"round", "square", "slotted", "hexagonal"};
  constexpr std::array<char const*, 3> arrangements{"straight", "staggered 45", "staggered 60"};
  auto const look = surface.filter.look();
  PageStyle style;
  add_share(style, surface.filter, deployments);
  switch (look.kind) {
    case FilterLook::Kind::opaque:
      break;
    case FilterLook::Kind::glass:
      style.kind = PageStyle::Kind::glass;
      style.passes = surface.filter.factors.empty() ? 1.0 : whole_percents(look.passes);
      break;
    case FilterLook::Kind::foliage:
      style.kind = PageStyle::Kind::foliage;
      // Of one of the two faces that a ray meets.
      style.passes = whole_percents(std::sqrt(look.passes));
      style.without = whole_percents(std::sqrt(style.without));
      break;
    case FilterLook::Kind::holes:
      style.kind = PageStyle::Kind::screen;
      style.passes = look.passes;
      style.hole = "texture";
      if (!look.holes) break;
      style.hole = holes.at(static_cast<std::size_t>(look.holes->hole));
      style.arrangement = arrangements.at(static_cast<std::size_t>(look.holes->arrangement));
      style.size = look.holes->size;
      style.length = look.holes->length;
      style.pitch = look.holes->pitch;
      style.row_pitch = look.holes->row_pitch;
      break;
  }
  return style;
}

class PageStyles {
 public:
  explicit PageStyles(std::size_t deployments) : deployments_(deployments), styles_(2) {
    styles_.front().kind = PageStyle::Kind::receiver;
  }

  std::size_t number_of(Surface const& surface) {
    auto const style = style_of(surface, deployments_);
    auto const found = std::ranges::find(styles_, style);
    if (found != styles_.end()) return static_cast<std::size_t>(found - styles_.begin());
    constexpr std::size_t max_styles = 1000;
    if (styles_.size() == max_styles) return 1;
    styles_.push_back(style);
    return styles_.size() - 1;
  }
  std::vector<PageStyle> const& all() const { return styles_; }

 private:
  std::size_t deployments_;
  std::vector<PageStyle> styles_;  // receivers', opaque casters', others
};

// Of a kind of light that the page shows, kWh/m2 in an hour of a month; beyond them: of all.
double energy_of(ReceivedLight const& light, std::size_t kind, std::size_t month,
                 std::size_t hour) {
  if (kind < ReceivedLight::kinds) {
    return light.at(static_cast<ReceivedLight::Kind>(kind), month, hour);
  }
  double sum = 0.0;
  for (std::size_t one = 0; one < ReceivedLight::kinds; ++one) {
    sum += energy_of(light, one, month, hour);
  }
  return sum;
}

void add_light(PageReceiver& receiver, ReceivedLight const& light, RunRecord const& record) {
  receiver.beam = light.of_run(ReceivedLight::beam);
  std::size_t const kinds = record.has_diffuse() ? ReceivedLight::kinds + 1 : 1;
  receiver.months.resize(kinds);
  if (light.hours() > 1) receiver.mean_days.resize(kinds);
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    for (std::size_t month = 0; month < ReceivedLight::months; ++month) {
      constexpr double watts = 1000.0;
      double const days = std::max(1, record.days_of_months().at(month));
      for (std::size_t hour = 0; hour < light.hours(); ++hour) {
        double const energy = energy_of(light, kind, month, hour);
        receiver.months[kind].at(month) += energy;
        if (light.hours() > 1) {
          receiver.mean_days[kind].at(month).at(hour) = energy * watts / days;
        }
      }
    }
  }
}

PageReceiver receiver_of(Surface const& surface, bool window) {
  auto const facing = facing_of(normal(surface.polygon));
  PageReceiver receiver;
  receiver.area = area(surface.polygon);
  receiver.azimuth = facing.azimuth;
  receiver.tilt = facing.tilt;
  receiver.window = window;
  return receiver;
}

std::uint8_t percent_of(float fraction) {
  constexpr float percents = 100.0F;
  return fraction < 0.0F ? RunPage::turned_away
                         : static_cast<std::uint8_t>(std::lround(fraction * percents));
}

// What is not known at first is what it is later: EMS has changed a constant schedule.
void add_shares(RunPage& page, std::vector<RunRecord::Day const*> const& days) {
  for (auto const* day : days) {
    for (auto const& hour : day->hours) {
      while (page.shares.size() < hour.shares.size()) {
        page.shares.emplace_back(page.shares.empty() ? 0 : page.shares.front().size(),
                                 percent_of(hour.shares[page.shares.size()]));
      }
      for (std::size_t i = 0; i < hour.shares.size(); ++i) {
        page.shares[i].push_back(percent_of(hour.shares[i]));
      }
    }
  }
}

void add_hours(RunPage& page, std::vector<RunRecord::Day const*> const& days) {
  std::vector<std::pair<double, int>> sums(page.receivers.size(), {0.0, 0});
  for (auto const* day : days) {
    for (std::size_t i = 0; i < day->whole.size(); ++i) {
      sums[i].first += double{day->whole[i].sum};
      sums[i].second += day->whole[i].count;
    }
    auto& added = page.days.emplace_back(PageDay{day->month, day->day, {}});
    for (auto const& [hour, sun, fractions, beam, shares] : day->hours) {
      added.hours.push_back({hour, sun, beam});
      for (float const fraction : fractions) page.percents.push_back(percent_of(fraction));
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    auto const [sum, count] = sums[i];
    if (count > 0) page.receivers[i].mean = sum / count;
  }
}

// The extent of the receivers in plan, or of all surfaces.
struct Surrounds {
  glm::dvec2 low{HUGE_VAL};
  glm::dvec2 high{-HUGE_VAL};

  void add(Polygon const& polygon) {
    for (auto const& point : polygon.outline) {
      low = glm::min(low, glm::dvec2(point));
      high = glm::max(high, glm::dvec2(point));
    }
  }
  bool has(Polygon const& polygon) const {
    return std::ranges::all_of(polygon.outline, [&](glm::dvec3 const& point) {
      return point.x >= low.x && point.y >= low.y && point.x <= high.x && point.y <= high.y;
    });
  }
};

// The surroundings of the receivers that are drawn; `reach`: in diagonals of the receivers.
Surrounds surrounds_of(Scene const& scene, RunRecord const& record, double reach) {
  Surrounds near;
  for (auto const id : record.receivers()) near.add(scene[id].polygon);
  double const margin = reach * std::max(glm::distance(near.low, near.high), 1.0);
  near.low -= margin;
  near.high += margin;
  return near;
}

bool is_site_context(Model const& model, std::string const& name) {
  auto const type = model.surroundings.types.find(name);
  return type != model.surroundings.types.end() && type->second == extension::site_context::type;
}

bool is_terrain(Model const& model, std::string const& name) {
  return name.ends_with(":TERRAIN") && is_site_context(model, name);
}

// What is drawn besides receivers: the model's shades, walls that take no part in shading, and the
// neighbouring buildings near by.
std::vector<SurfaceId> drawn_casters(SceneAssembly const& assembly, Scene const& scene,
                                     RunRecord const& record) {
  constexpr double reach = 1.5;
  auto const near = surrounds_of(scene, record, reach);
  auto const& model = assembly.model();
  auto ids = assembly.shown();
  // Windows inside of the building show nothing.
  std::erase_if(ids, [&](SurfaceId id) {
    return scene[id].casting == Casting::never && model.shading.base_of.contains(scene[id].name);
  });
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const& name = scene[id].name;
    if (is_site_context(model, name) && !is_terrain(model, name) && near.has(scene[id].polygon)) {
      ids.push_back(id);
    }
  }
  return ids;
}

PageTerrain drawn_terrain(SceneAssembly const& assembly, Scene const& scene,
                          RunRecord const& record) {
  std::vector<Polygon const*> ground;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (is_terrain(assembly.model(), scene[id].name)) ground.push_back(&scene[id].polygon);
  }
  // Farther than neighbours: hills matter from far away.
  constexpr double reach = 4.0;
  auto const near = surrounds_of(scene, record, reach);
  return terrain_in(ground, near.low, near.high);
}

// Returns their ids.
std::vector<SurfaceId> add_surfaces(RunPage& page, SceneAssembly const& assembly,
                                    RunRecord const& record) {
  auto const scene = assembly.scene();
  PageStyles styles(assembly.optics().deployments().size());
  std::vector<SurfaceId> ids;
  std::vector<bool> added(scene.size(), false);
  for (std::size_t i = 0; i < record.receivers().size(); ++i) {
    auto const id = record.receivers()[i];
    added[id] = true;
    ids.push_back(id);
    page.surfaces.push_back({scene[id].name, scene[id].polygon, 0});
    page.receivers.push_back(
        receiver_of(scene[id], assembly.model().shading.base_of.contains(scene[id].name)));
    add_light(page.receivers.back(), record.light()[i], record);
  }
  for (auto const id : drawn_casters(assembly, scene, record)) {
    auto const& surface = scene[id];
    if (added[id] || area(assembly.surfaces()[id].polygon) <= 0.0) continue;
    auto const style = styles.number_of(surface);
    if (auto const* const crown = surface.filter.find<Crown>()) {
      constexpr int sides = 8;
      for (auto& face : crown_faces(surface.polygon, *crown, sides)) {
        ids.push_back(id);
        page.surfaces.push_back({surface.name, std::move(face), style});
      }
      continue;
    }
    ids.push_back(id);
    page.surfaces.push_back({surface.name, surface.polygon, style});
  }
  page.styles = styles.all();
  page.terrain = drawn_terrain(assembly, scene, record);
  return ids;
}

RunPage page_of(SceneAssembly const& assembly, DeviceInfo const& device, AnswerErrors const& errors,
                RunRecord const& record, std::vector<RunRecord::Day const*> const& days,
                PositionRecord const& positions) {
  RunPage page;
  page.title = assembly.model().file;
  auto const ids = add_surfaces(page, assembly, record);
  add_hours(page, days);
  add_shares(page, days);
  auto const kind = record.of_design_days() ? RunDay::Kind::design_day : RunDay::Kind::run_period;
  add_motions(page, assembly, ids, kind, positions);
  page.facts = {
      {record.of_design_days() ? "Design days simulated" : "Days simulated",
       std::to_string(record.simulated())},
      {"Receivers", std::to_string(page.receivers.size())},
      {"Other surfaces drawn", std::to_string(page.surfaces.size() - page.receivers.size())},
      {"Shading computed on", gpu_shading::describe(device)},
      {"Errors of sunlit fractions", describe_errors(errors)},
      {"Reflected light", assembly.model().reflected_light.receivers.empty()
                              ? "EnergyPlus's own, which shades do not dim"
                              : "by ground, shades and neighbours, all of it"},
  };
  if (days.size() < record.days().size()) {
    page.notes.push_back(
        fmt::format("The page and its tables have {} of the {} days with answers of "
                    "their own; sunlit.csv has all answers.",
                    days.size(), record.days().size()));
  }
  return page;
}

// Receivers with a mask: one byte for each cell of the sky; and with mean days: two for each hour.
constexpr std::size_t max_skies = 300;

std::uint8_t sky_code(BeamShare const& share) {
  if (!share.faced) return RunPage::behind;
  auto const most = std::ranges::max_element(share.stopped);
  auto const level = std::lround((1.0F - share.sunlit) * (RunPage::sky_levels - 1));
  return static_cast<std::uint8_t>(RunPage::sky_levels * (most - share.stopped.begin()) +
                                   std::clamp(level, 0L, RunPage::sky_levels - 1L));
}

// How shades that change stand in the masks: as optics().update({}) and rest_positions() set them.
std::string sky_state_of(SceneAssembly const& assembly) {
  auto const& model = assembly.model();
  auto const& optics = assembly.optics();
  auto const leaves = model.surroundings.leaf_schedules.size();
  std::vector<std::string> parts;
  if (!model.moving_shades.empty()) parts.emplace_back("moving shades at rest");
  if (leaves > 0) parts.emplace_back("trees in full leaf");
  if (optics.deployment_names().size() > leaves) parts.emplace_back("screens fully deployed");
  if (!optics.factor_names().empty()) parts.emplace_back("transmittances at their lowest");
  return fmt::format("{}", fmt::join(parts, ", "));
}

// All or max_skies of the receivers, the largest, windows first.
std::vector<std::size_t> largest_of(RunPage const& page) {
  std::vector<std::size_t> order(page.receivers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    auto const& [first, second] = std::tie(page.receivers[a], page.receivers[b]);
    return std::pair(second.window, second.area) < std::pair(first.window, first.area);
  });
  if (order.size() > max_skies) order.resize(max_skies);
  return order;
}

// After they are written to their table.
void leave_out_mean_days(RunPage& page) {
  std::vector<bool> kept(page.receivers.size(), false);
  for (auto const number : largest_of(page)) kept[number] = true;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) page.receivers[i].mean_days.clear();
  }
}

void add_skies(RunPage& page, SceneAssembly& assembly, RunRecord const& record) {
  auto const order = largest_of(page);
  if (order.empty()) return;
  assembly.optics().update({});
  page.sky_state = sky_state_of(assembly);
  auto const scene = assembly.scene();
  RayScene const rays(scene, {.screens = ScreenDetail::automatic});
  auto const kinds = kinds_of(assembly, scene);
  SkyGrid const grid(RunPage::sky_step);
  auto const directions = grid.directions();
  for (auto const number : order) {
    auto const id = record.receivers()[number];
    constexpr int rays_of_cell = 16;
    auto const points = points_of(scene[id].polygon, rays_of_cell);
    auto const shares = trace_shares(rays,
                                     {.receiver = id,
                                      .factors = assembly.optics().factors(),
                                      .deployments = assembly.optics().deployments()},
                                     kinds, points, directions);
    auto const view = sky_view(grid, shares, points.normal);
    auto& sky = page.skies.emplace_back(PageSky{number, view.view, view.unshaded, {}});
    for (auto const& share : shares) sky.codes.push_back(sky_code(share));
  }
  for (std::size_t k = 0; k < shade_kinds; ++k) {
    page.sky_kinds.emplace_back(name_of(static_cast<ShadeKind>(k)));
  }
  if (order.size() < page.receivers.size()) {
    page.notes.push_back(
        fmt::format("Shading masks and mean days of the {} largest receivers are shown, windows "
                    "first; gpu_shading mask draws other masks, run_mean_days.csv has all.",
                    order.size()));
  }
}

// Sums over all maps of a page: one byte for each of the two values.
constexpr std::size_t max_map_cells = 200000;

// Adds the map of a receiver. Throws Error if it cannot be read.
void add_map(RunPage& page, std::filesystem::path const& folder, MapFolder::Row const& row,
             std::size_t receiver) {
  auto array = read_map_array(folder / (row.stem + ".npy"));
  // One cell is the bounding rectangle.
  constexpr double widest = 1e9;
  MapGrid const whole(page.surfaces[receiver].polygon, widest);
  auto const& axes = whole.axes();
  auto const size = whole.cell_size();
  page.maps.push_back({receiver, axes.origin, size.x * axes.u, size.y * axes.v, array.columns,
                       array.rows, std::move(array.hours), std::move(array.energy), row.mean_hours,
                       row.mean_energy});
}

void add_maps_of(RunPage& page, std::filesystem::path const& folder) {
  auto const maps = read_map_folder(folder);
  if (!maps) return;
  page.maps_from = maps->from;
  page.maps_to = maps->to;
  std::unordered_map<std::string, std::size_t> receivers;
  for (std::size_t i = 0; i < page.receivers.size(); ++i) {
    receivers.emplace(csv_field(page.surfaces[i].name), i);
  }
  std::size_t cells = 0;
  for (auto const& row : maps->rows) {
    auto const found = receivers.find(row.receiver);
    if (found == receivers.end()) continue;
    add_map(page, folder, row, found->second);
    cells += page.maps.back().hours.size();
    if (cells <= max_map_cells) continue;
    page.maps.pop_back();
    page.notes.push_back(fmt::format(
        "Maps of {} receivers are shown; more would make the page too large.", page.maps.size()));
    return;
  }
}

void add_modules_of(RunPage& page, std::filesystem::path const& folder) {
  auto modules = read_module_folder(folder);
  if (!modules) return;
  page.modules = std::move(*modules);
  if (page.modules.left_out > 0) {
    page.notes.push_back(
        fmt::format("{} strings of photovoltaic modules are left out; strings.csv "
                    "has them.",
                    page.modules.left_out));
  }
}

// Maps and modules are not needed: one that cannot be read is no reason to lose a run's report.
void add_from(RunPage& page, std::filesystem::path const& report, char const* what,
              std::function<void()> const& add) {
  try {
    add();
  } catch (std::exception const& error) {
    auto why = one_line(error.what());
    auto const where = report.string() + '/';
    // The page may go elsewhere, and say nothing of this computer.
    for (auto at = why.find(where); at != std::string::npos; at = why.find(where)) {
      why.erase(at, where.size());
    }
    page.notes.push_back(fmt::format("{} are left out: {}", what, why));
  }
}

void add_maps(RunPage& page, std::filesystem::path const& report) {
  for (auto const& folder : {report, report / "maps"}) {
    add_from(page, report, "Maps", [&] { add_maps_of(page, folder); });
    if (!page.maps.empty()) return;
  }
}

void write_facts(RunPage const& page, std::ostream& csv) {
  csv << "fact,value\n";
  for (auto const& [fact, value] : page.facts) {
    csv << fmt::format("{},{}\n", csv_field(fact), csv_field(value));
  }
  for (auto const& note : page.notes) csv << fmt::format("Note,{}\n", csv_field(note));
}

// The heads of the page's kinds of light.
std::string light_heads(std::string_view unit) {
  return fmt::format(
      "beam [{0}],sky [{0}],reflected by ground [{0}],reflected by shades [{0}],all [{0}]\n", unit);
}

// Blank where only the beam is known.
std::string light_fields(std::vector<double> const& kinds) {
  auto const fields = fmt::format("{:.1f}", fmt::join(kinds, ","));
  return fields + (kinds.size() > 1 ? "\n" : ",,,,\n");
}

void write_months(RunPage const& page, std::ostream& csv) {
  csv << "receiver,month," << light_heads("kWh/m2");
  for (std::size_t i = 0; i < page.receivers.size(); ++i) {
    auto const name = csv_field(page.surfaces[i].name);
    for (std::size_t month = 0; month < ReceivedLight::months; ++month) {
      std::vector<double> kinds;
      for (auto const& months : page.receivers[i].months) kinds.push_back(months.at(month));
      csv << fmt::format("{},{},{}", name, month + 1, light_fields(kinds));
    }
  }
}

void write_mean_days(RunPage const& page, std::ostream& csv) {
  csv << "receiver,month,hour," << light_heads("W/m2");
  for (std::size_t i = 0; i < page.receivers.size(); ++i) {
    auto const& mean_days = page.receivers[i].mean_days;
    if (mean_days.empty()) continue;
    auto const name = csv_field(page.surfaces[i].name);
    for (std::size_t month = 0; month < mean_days.front().size(); ++month) {
      for (std::size_t hour = 0; hour < mean_days.front()[month].size(); ++hour) {
        std::vector<double> kinds;
        kinds.reserve(mean_days.size());
        for (auto const& months : mean_days) kinds.push_back(months.at(month).at(hour));
        if (kinds.back() <= 0.0) continue;
        csv << fmt::format("{},{},{},{}", name, month + 1, hour + 1, light_fields(kinds));
      }
    }
  }
}

void write_skies(RunPage const& page, std::ostream& csv) {
  csv << "receiver,sky view factor,unshaded view factor\n";
  for (auto const& sky : page.skies) {
    csv << fmt::format("{},{:.3f},{:.3f}\n", csv_field(page.surfaces[sky.receiver].name), sky.view,
                       sky.unshaded);
  }
}

void write_receivers(RunPage const& page, RunRecord const& record, AnswerErrors const& errors,
                     std::ostream& csv) {
  csv << "receiver,area [m2],azimuth [deg],tilt [deg],mean sunlit fraction,beam [kWh/m2],"
         "beam [kWh],largest error\n";
  for (std::size_t i = 0; i < page.receivers.size(); ++i) {
    auto const& receiver = page.receivers[i];
    auto const id = record.receivers()[i];
    csv << fmt::format(
        "{},{:.3f},{:.1f},{:.1f},{},{:.1f},{:.1f},{}\n", csv_field(page.surfaces[i].name),
        receiver.area, receiver.azimuth, receiver.tilt,
        receiver.mean ? fmt::format("{:.4f}", *receiver.mean) : "", receiver.beam,
        receiver.beam * receiver.area,
        errors.all_measured_of(id) ? fmt::format("{:.2g}", errors.largest_of(id)) : "");
  }
}

void write_hours(RunPage const& page, std::vector<RunRecord::Day const*> const& days,
                 std::ostream& csv) {
  csv << "day,hour,sun azimuth [deg],sun altitude [deg],beam normal [W/m2]";
  for (std::size_t i = 0; i < page.receivers.size(); ++i) {
    csv << ',' << csv_field(page.surfaces[i].name);
  }
  csv << '\n';
  for (auto const* day : days) {
    for (auto const& [hour, sun, fractions, beam, shares] : day->hours) {
      csv << fmt::format("{:02}-{:02},{},{:.4f},{:.4f},{:.0f}", day->month, day->day, hour,
                         degrees_clockwise(sun.azimuth), glm::degrees(sun.altitude), beam);
      for (float const fraction : fractions)
        csv << fmt::format(",{:.4f}", std::max(fraction, 0.0F));
      csv << '\n';
    }
  }
}

bool is_our_page(std::filesystem::path const& file) {
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t enough = 1000;
  std::string head(enough, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(enough));
  return head.find(page_marker) != std::string::npos;
}

}  // namespace

void prepare_page(std::filesystem::path const& folder) {
  naming("--gpu-shading-report", [&] {
    StagedFiles files(folder);
    files.add(page_file);
    auto const file = folder / page_file;
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) && !is_our_page(file)) {
      throw Error(fmt::format("{} is not of an earlier report: move it, or choose another folder",
                              file.string()));
    }
  });
}

void write_run(StagedFiles& files, std::filesystem::path const& folder, SceneAssembly& assembly,
               DeviceInfo const& device, AnswerErrors const& errors, RunRecord const& record,
               PositionRecord const& positions) {
  auto const days = chosen_days(record);
  assembly.set_positions(assembly.rest_positions());
  auto page = page_of(assembly, device, errors, record, days, positions);
  add_maps(page, folder);
  add_from(page, folder, "Modules", [&] { add_modules_of(page, folder / "modules"); });
  add_skies(page, assembly, record);
  simplify(page);
  files.write(mean_days_table, [&](std::ostream& csv) { write_mean_days(page, csv); });
  leave_out_mean_days(page);
  files.write(facts_table, [&](std::ostream& csv) { write_facts(page, csv); });
  files.write(receivers_table,
              [&](std::ostream& csv) { write_receivers(page, record, errors, csv); });
  files.write(months_table, [&](std::ostream& csv) { write_months(page, csv); });
  files.write(skies_table, [&](std::ostream& csv) { write_skies(page, csv); });
  files.write(hours_table, [&](std::ostream& csv) { write_hours(page, days, csv); });
  files.write(page_file, to_html(std::move(page)));
}

}  // namespace gpu_shading::energyplus

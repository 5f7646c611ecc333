#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// How surfaces of one kind look.
struct PageStyle {
  enum class Kind { receiver, opaque, glass, screen, foliage };

  Kind kind = Kind::opaque;
  double passes = 0.0;  // of the beam at normal incidence, 0 .. 1, where the share is 1
  // By what it is deployed, leaved or transmits: index in RunPage::shares.
  std::optional<std::size_t> share = std::nullopt;
  double without = 0.0;  // what passes where the share is 0
  // Of a screen: "round", "square", "slotted", "hexagonal", or "texture" with nothing else.
  std::string hole;
  std::string arrangement;  // "straight", "staggered 45", "staggered 60"
  double size = 0.0;        // m, as are the next three
  double length = 0.0;
  double pitch = 0.0;
  double row_pitch = 0.0;

  bool operator==(PageStyle const&) const = default;
};

struct PageSurface {
  std::string name;
  Polygon polygon;
  std::size_t style = 0;                             // index in RunPage::styles
  std::optional<std::size_t> motion = std::nullopt;  // index in RunPage::motions
  std::vector<Polygon> moved = {};                   // at the positions of its motion
};

// How the surfaces of a moving shade stand.
struct PageMotion {
  std::string name;
  std::string unit;
  std::vector<double> positions;     // in order
  std::vector<std::uint16_t> hours;  // by hour of the days: the index of its position
};

// What the page tells about a receiver; its table has the same numbers.
struct PageReceiver {
  double area = 0.0;     // m2
  double azimuth = 0.0;  // of the normal, degrees clockwise from true north; 0 if horizontal
  double tilt = 0.0;     // degrees from the zenith
  // Of the sunlit fraction on the page's days, over the hours during all of which the sun faces it;
  // empty if there are none.
  std::optional<double> mean = std::nullopt;
  double beam = 0.0;    // of the run, kWh/m2
  bool window = false;  // or a door
  // kWh/m2 of each month, January first: the beam, the sky's light, what the ground and what
  // shades, neighbours and the building alone reflect, and the sum. The beam alone if no more is
  // known.
  std::vector<std::array<double, 12>> months = {};
  // W/m2 of the same by month and hour of the months' mean days; empty: left out.
  std::vector<std::array<std::array<double, 24>, 12>> mean_days = {};
};

// What a receiver sees of the sky, in cells of SkyGrid(sky_step).
struct PageSky {
  std::size_t receiver = 0;  // index in RunPage::receivers
  double view = 0.0;         // view factor
  double unshaded = 0.0;
  // By cell: sky_levels x the kind that stops most + what is stopped in all, 0 .. sky_levels - 1.
  std::vector<std::uint8_t> codes;
};

struct PageHour {
  int hour = 0;  // at whose end the sun is here, 1 .. 24
  SunDirection sun;
  double beam = 0.0;  // direct normal irradiance, W/m2: mean of the days that the day stands for
};

struct PageDay {
  int month = 0;
  int day = 0;
  std::vector<PageHour> hours;  // with the sun up
};

// A map of a receiver, over its bounding rectangle.
struct PageMap {
  std::size_t receiver = 0;  // index in RunPage::receivers
  glm::dvec3 corner{0.0};    // the lower left one as seen from outside, m
  glm::dvec3 right{0.0};     // along the lower edge, as long as it is
  glm::dvec3 up{0.0};
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> hours;   // row by row, from below; not a number where there is no cell
  std::vector<float> energy;  // kWh/m2
  double mean_hours = 0.0;    // of the receiver
  double mean_energy = 0.0;
};

// The ground near by, as heights of the nodes of a grid; without nodes if there is none.
struct PageTerrain {
  static constexpr std::size_t nodes_of_side = 97;

  std::size_t nodes = 0;  // of each side
  glm::dvec2 low{0.0};    // the south-western node, m
  glm::dvec2 step{0.0};
  std::vector<float>
      heights;  // m, row by row from the south; not a number where there is no ground
};

// Photovoltaic modules over a period.
struct PageModules {
  static constexpr std::size_t hours_of_day = 24;
  static constexpr std::uint8_t dark = 255;  // instead of a percentage: sun behind or down

  struct Module {
    int string = 0;     // from 1, as are the next two
    int column = 0;     // from the left
    int row = 0;        // from below
    double loss = 0.0;  // of its beam over the period, 0 .. 1
  };

  struct Field {
    std::string surface;
    double width = 0.0;  // of a module on the surface, m
    double height = 0.0;
    std::vector<Module> modules;
    // By string: the mean sunlit fraction of its cells in percent, by day, then by hour.
    std::vector<std::vector<std::uint8_t>> strings;
  };

  std::vector<std::pair<int, int>> days;  // month and day
  std::vector<Field> fields;
  std::size_t left_out = 0;  // strings beyond max_strings
};

// Everything on a page, which is one file that loads nothing.
struct RunPage {
  static constexpr std::uint8_t turned_away = 254;  // instead of a percentage
  static constexpr int sky_step = 6;                // degrees
  static constexpr std::uint8_t sky_levels = 50;
  static constexpr std::uint8_t behind = 255;  // instead of a code of the sky

  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  // what the run is, and what it says
  std::vector<PageStyle> styles;
  std::vector<PageSurface> surfaces;  // the receivers first
  std::vector<PageReceiver> receivers;
  std::vector<PageDay> days;
  // Sunlit, percent: of each receiver at the first hour of the first day, then at the next.
  std::vector<std::uint8_t> percents;
  std::vector<std::vector<std::uint8_t>> shares;  // percent, each by hour of the days
  std::vector<PageMotion> motions;
  std::vector<PageMap> maps;
  std::vector<PageSky> skies;
  std::vector<std::string> sky_kinds;  // of what stops the beam
  std::string sky_state;               // how shades that change stand in the masks, or ""
  std::string maps_from;               // the days that they are about, MM-DD
  std::string maps_to;
  PageTerrain terrain;
  PageModules modules;
  std::vector<std::string> notes;  // what is left out
};

// The beginning of the line by which a page is known to be ours.
inline constexpr char const* page_marker = "<meta name=\"generator\" content=\"gpu_shading report";

// Leaves out casting surfaces beyond some 2 MB, the smallest first, and adds a note that says so.
void simplify(RunPage& page);

// The page as HTML, simplified. Names may hold anything. A build without three.js makes a plain
// drawing.
std::string to_html(RunPage page);

}  // namespace gpu_shading::energyplus

// The perforated case of Jones & Greenberg over a year: error of the projected sunlit surface
// fraction against its exact value, and seconds.
//
//   perforated_case [every [pixels [screen]]]    one position in so many; all that is left out
//   perforated_case blend                        error by pixel size over hole size
//   perforated_case geometry [positions [pixels]]  the sheet as polygons, 500 at 4096

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <string_view>

#include "perforated_tables.h"
#include "support/transparent_case.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

struct Row {
  std::string name;
  std::shared_ptr<PerforatedScreen const> screen;
};

std::vector<Row> rows_of(PerforatedCase const& given) {
  std::vector<Row> rows;
  auto const add = [&](std::string name, auto const& holes, std::optional<int> layers,
                       ScreenDetail detail) {
    Sheet const sheet{given.thickness, given.plane, layers, detail};
    rows.push_back({std::move(name), std::make_shared<PerforatedScreen const>(holes, sheet)});
  };
  HolePattern const pattern = given.pattern();
  for (int const layers : {2, 5, 10, 20, 40}) {
    add(std::to_string(layers) + " layers", pattern, layers, ScreenDetail::holes);
  }
  add("exact holes", pattern, std::nullopt, ScreenDetail::holes);
  add("effective", pattern, std::nullopt, ScreenDetail::effective);
  add("automatic", pattern, std::nullopt, ScreenDetail::automatic);
  for (int const texels : {48, 96}) {
    add("raster of " + std::to_string(texels), OpacityTile(pattern, given.hole / texels),
        std::nullopt, ScreenDetail::holes);
  }
  add("raster of 48, automatic", OpacityTile(pattern, given.hole / 48), std::nullopt,
      ScreenDetail::automatic);
  return rows;
}

// The row that the arguments name, or all rows.
struct Choice {
  int resolution = 0;
  std::string_view screen;
};

void print_table(std::span<SunDirection const> suns, Choice const& chosen) {
  PerforatedCase const given;
  std::vector<double> const exact = exact_fractions(given, suns);
  std::printf("%s\n", renderer_of(Scene()).device().renderer.c_str());
  std::printf(
      "screen                   pixels positions signed mean  mean abs   largest  seconds\n");
  std::fflush(stdout);
  for (Row const& row : rows_of(given)) {
    if (!chosen.screen.empty() && chosen.screen != row.name) continue;
    if (row.screen->tile()) row.screen->transmittance();  // its construction is not timed
    for (int const resolution : {256, 512, 1024, 2048}) {
      if (chosen.resolution != 0 && chosen.resolution != resolution) continue;
      Renderer renderer = renderer_of(given.scene(row.screen), resolution);
      sunlit(renderer, suns.front(), 0);  // creates targets
      Stopwatch const watch;
      Errors const errors = errors_of(renderer, suns, exact);
      std::printf("%-24s %6d %9zu %+11.2e %9.2e %9.2e %8.1f\n", row.name.c_str(), resolution,
                  errors.count(), errors.signed_mean(), errors.mean(), errors.largest(),
                  watch.seconds());
      std::fflush(stdout);
    }
  }
}

std::vector<SunDirection> thinned(std::vector<SunDirection> const& suns, std::size_t every) {
  std::vector<SunDirection> kept;
  for (std::size_t i = 0; i < suns.size(); i += every) kept.push_back(suns[i]);
  return kept;
}

int number(int argc, char** argv, int place, int otherwise) {
  return argc > place ? std::max(1, std::atoi(argv[place])) : otherwise;
}

void run(int argc, char** argv) {
  std::vector<SunDirection> suns = year_of_suns(42 * degree);
  std::string_view const mode = argc > 1 ? argv[1] : "";
  if (mode == "blend") {
    print_blend_table(thinned(suns, suns.size() / 100));
  } else if (mode == "geometry") {
    constexpr unsigned seed = 1;
    std::shuffle(suns.begin(), suns.end(), std::mt19937(seed));
    auto const positions = static_cast<std::size_t>(number(argc, argv, 2, 500));
    suns.resize(std::min(suns.size(), positions));
    print_geometry_table(suns, number(argc, argv, 3, 4096));
  } else {
    auto const every = static_cast<std::size_t>(number(argc, argv, 1, 1));
    print_table(thinned(suns, every),
                {number(argc, argv, 2, 0), argc > 3 ? std::string_view(argv[3]) : ""});
  }
}

}  // namespace

std::vector<double> exact_fractions(PerforatedCase const& given,
                                    std::span<SunDirection const> suns) {
  PerforatedReference const reference(given);
  std::vector<double> fractions;
  fractions.reserve(suns.size());
  for (SunDirection const sun : suns) fractions.push_back(reference(sun));
  return fractions;
}

Errors errors_of(Renderer& renderer, std::span<SunDirection const> suns,
                 std::span<double const> exact) {
  Errors errors;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    errors.add(sunlit(renderer, suns[i], 0).projected_area - exact[i]);
  }
  return errors;
}

}  // namespace gpu_shading

int main(int argc, char** argv) {
  return gpu_shading::print_or_say_why("perforated_case", [&] { gpu_shading::run(argc, argv); });
}

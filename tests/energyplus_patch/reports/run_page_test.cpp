#include "reports/page/run_page.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;
using testing::Not;

Polygon square(double x, double size) {
  return {{{x, 0.0, 0.0}, {x + size, 0.0, 0.0}, {x + size, 0.0, size}, {x, 0.0, size}}, {}};
}

RunPage page_of(std::size_t receivers, std::size_t casters) {
  RunPage page;
  page.title = "model.idf";
  page.styles.resize(2);
  page.styles.front().kind = PageStyle::Kind::receiver;
  for (std::size_t i = 0; i < receivers; ++i) {
    page.surfaces.push_back(
        {fmt::format("RECEIVER {}", i), square(static_cast<double>(i), 1.0), 0});
    page.receivers.push_back({1.0, 180.0, 90.0, 0.5, 100.0});
  }
  for (std::size_t i = 0; i < casters; ++i) {
    double const size = i % 2 == 0 ? 0.1 : 0.5;
    page.surfaces.push_back({fmt::format("CASTER {}", i), square(static_cast<double>(i), size), 1});
  }
  return page;
}

TEST(RunPage, IsMarkedAsOurs) { EXPECT_THAT(to_html(page_of(1, 0)), HasSubstr(page_marker)); }

TEST(RunPage, KeepsNamesFromBeingMarkup) {
  auto page = page_of(1, 1);
  page.title = "</title><script>stop()</script> @scripts@ \xe9";
  page.surfaces[0].name = "</script><script>stop()</script>";
  page.surfaces[1].name = "<!-- @library@ \xff";
  auto const html = to_html(page);
  EXPECT_THAT(html, Not(HasSubstr("stop()</script>")));
  EXPECT_THAT(html, Not(HasSubstr("<!-- @library@")));
  EXPECT_THAT(html, HasSubstr("&lt;/title&gt;&lt;script&gt;stop()&lt;/script&gt; @scripts@"));
}

TEST(RunPage, LeavesNoPlaceForSurfacesThatMoveThroughTooManyPositions) {
  auto page = page_of(1, 2);
  page.motions.push_back({"Louvres", "deg", std::vector<double>(40000), {}});
  page.surfaces[2].motion = 0;  // the larger one
  page.surfaces[2].moved.assign(40000, square(0.0, 0.5));
  simplify(page);
  ASSERT_EQ(page.surfaces.size(), 1U);
  EXPECT_EQ(page.notes.size(), 1U);
}

// As many receivers and casting surfaces as the hotel has, on terrain.
RunPage large_page() {
  auto page = page_of(2385, 95000);
  constexpr std::size_t hours = 377;  // some 900,000 fractions
  page.days.push_back({3, 21, std::vector<PageHour>(hours)});
  page.percents.assign(hours * page.receivers.size(), 57);
  PageMap map;
  map.columns = 400;
  map.rows = 500;
  map.hours.assign(map.columns * map.rows, 3.0F);
  map.energy = map.hours;
  page.maps.push_back(map);
  for (std::size_t i = 0; i < 300; ++i) {
    page.skies.push_back({i, 0.25, 0.5, std::vector<std::uint8_t>(900, 57)});
  }
  page.terrain.nodes = PageTerrain::nodes_of_side;
  page.terrain.step = {1.0, 1.0};
  page.terrain.heights.assign(page.terrain.nodes * page.terrain.nodes, 1.0F);
  return page;
}

TEST(RunPage, OfALargeModelHasLessThanFiveMegabytes) {
  auto const html = to_html(large_page());
  RecordProperty("bytes", static_cast<int>(html.size()));
  EXPECT_LT(html.size(), 5'000'000U);
  EXPECT_THAT(html, HasSubstr("The drawing is simplified: it has 35115 of 95000 casting surfaces"));
}

TEST(RunPage, GivesUpCastingSurfacesForModules) {
  auto page = large_page();
  constexpr std::size_t days = 366;
  constexpr std::size_t modules = 10'000;
  constexpr std::size_t strings = 20;
  page.modules.days.assign(days, {12, 21});
  auto& field = page.modules.fields.emplace_back();
  field.modules.assign(modules, {10, 1'000, 1'000, 0.123456});
  field.strings.assign(strings, std::vector<std::uint8_t>(days * PageModules::hours_of_day, 57));
  EXPECT_LT(to_html(std::move(page)).size(), 5'000'000U);
}

}  // namespace
}  // namespace gpu_shading::energyplus

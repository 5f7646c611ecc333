#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "each_backend.h"
#include "gpu_shading/error.h"
#include "support/exact.h"
#include "support/room.h"

namespace gpu_shading {
namespace {

// With the wall around the window, and an overhang above it.
struct BoxRoom : Room {
  SurfaceId wall;

  BoxRoom() {
    Polygon around = south_facing(0, 0, 0, 4, 3);
    around.holes = {scene[window].polygon.outline};
    wall = scene.add({"south wall", around});
    scene.add({"overhang", level(0.5, -0.5, 2.6, 3, 0.5)});
  }
};

double sum(std::vector<double> const& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<SunDirection> const suns_into_rooms{sun_at(180, 10), sun_at(180, 45), sun_at(140, 20),
                                                sun_at(230, 35), sun_at(105, 8),  sun_at(260, 60)};

class Interior : public EachBackend {};
INSTANTIATE_TEST_SUITE_P(Is, Interior, backends, name_of);

TEST_P(Interior, BoxRoomAgainstPolygonClipping) {
  BoxRoom const room;
  Renderer renderer = renderer_of(room.scene);
  for (SunDirection const sun : suns_into_rooms) {
    auto const got = interior_areas(renderer, sun, room.window, room.surfaces);
    // The box is convex: no surface hides another.
    auto const exact = exact::interior_areas(room.scene, sun, room.window, room.surfaces);
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_NEAR(got[i], exact[i], 1e-3 * 2 * 1.6) << room.scene[room.surfaces[i]].name;
    }
    EXPECT_GT(sum(got), 0.0);
  }
}

TEST_P(Interior, TheSumIsWhatTheWindowGets) {
  BoxRoom const room;
  Renderer renderer = renderer_of(room.scene);
  for (SunDirection const sun : suns_into_rooms) {
    double const window = sunlit(renderer, sun, room.window).projected_area;
    double const inside = sum(interior_areas(renderer, sun, room.window, room.surfaces));
    EXPECT_LE(inside, window * (1.0 + 1e-12));
    // The room is closed: only what passes within the clearance of the window's plane is lost.
    EXPECT_NEAR(inside, window, 1e-3 * 2 * 1.6);
  }
}

TEST_P(Interior, TheNearestSurfaceTakesTheRay) {
  BoxRoom room;
  SurfaceId const table = room.scene.add({"table", level(1.2, 0.5, 0.7, 1.5, 1)});
  SurfaceId const floor = room.surfaces[0];
  Renderer renderer = renderer_of(room.scene);
  SunDirection const sun = sun_at(190, 50);
  for (auto const& order :
       {std::vector<SurfaceId>{table, floor}, std::vector<SurfaceId>{floor, table}}) {
    auto const got = interior_areas(renderer, sun, room.window, order);
    auto const exact = exact::interior_areas(room.scene, sun, room.window, {table, floor});
    std::size_t const at = order[0] == table ? 0 : 1;
    EXPECT_NEAR(got[at], exact[0], 1e-3 * 2 * 1.6);
    EXPECT_NEAR(got[1 - at], exact[1], 1e-3 * 2 * 1.6);
    EXPECT_GT(got[at], 0.1);
    EXPECT_GT(got[1 - at], 0.1);
  }
}

TEST_P(Interior, RaysGoOnThroughAWindowInTheBackWall) {
  BoxRoom room;
  Polygon holed = south_facing(0, 2, 0, 4, 3);
  holed.holes = {{{0.5, 2, 0.2}, {3.5, 2, 0.2}, {3.5, 2, 1.0}, {0.5, 2, 1.0}}};
  SurfaceId const partition = room.scene.add({"partition", holed});
  std::vector<SurfaceId> const nearest_first{partition, room.surfaces[0], room.surfaces[2]};
  Renderer renderer = renderer_of(room.scene);
  SunDirection const sun = sun_at(175, 22);
  auto const got = interior_areas(renderer, sun, room.window, nearest_first);
  auto const exact = exact::interior_areas(room.scene, sun, room.window, nearest_first);
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], exact[i], 1e-3 * 2 * 1.6);
  EXPECT_GT(got[0], 0.1);
  EXPECT_GT(got[1] + got[2], 0.1);
}

TEST_P(Interior, WhatLiesInTheSamePlaceIsCountedOnce) {
  BoxRoom const room;
  Renderer renderer = renderer_of(room.scene);
  SunDirection const sun = sun_at(180, 45);
  SurfaceId const floor = room.surfaces[0];
  std::vector<SurfaceId> const twice{floor, floor};
  auto const got = interior_areas(renderer, sun, room.window, twice);
  auto const once = interior_areas(renderer, sun, room.window, {&floor, 1});
  EXPECT_GT(once[0], 0.1);
  EXPECT_EQ(got[0] + got[1], once[0]);
}

TEST_P(Interior, SurfacesWithoutAreaOrBeforeTheWindowGetNothing) {
  BoxRoom room;
  SurfaceId const line = room.scene.add({"line", {{{0, 1, 0}, {4, 1, 0}}, {}}});
  SurfaceId const outside = room.scene.add({"terrace", level(0, -9, -0.1, 4, 9)});
  std::vector<SurfaceId> const asked{line, outside, room.wall, room.window};
  Renderer renderer = renderer_of(room.scene);
  for (double const got : interior_areas(renderer, sun_at(180, 45), room.window, asked)) {
    EXPECT_EQ(got, 0.0);
  }
}

TEST_P(Interior, NothingWhenTheWindowFacesAwayAndNoAnswersForNoQuestions) {
  BoxRoom const room;
  Renderer renderer = renderer_of(room.scene);
  for (double const got : interior_areas(renderer, sun_at(0, 45), room.window, room.surfaces)) {
    EXPECT_EQ(got, 0.0);
  }
  EXPECT_TRUE(interior_areas(renderer, sun_at(180, 45), room.window, {}).empty());
}

TEST_P(Interior, AnUnknownSurfaceIsAnError) {
  BoxRoom const room;
  Renderer renderer = renderer_of(room.scene);
  SurfaceId const unknown = 99;
  EXPECT_THROW(interior_areas(renderer, sun_at(180, 45), room.window, {&unknown, 1}), Error);
  EXPECT_THROW(interior_areas(renderer, sun_at(180, 45), unknown, room.surfaces), Error);
}

}  // namespace
}  // namespace gpu_shading

#include "calculation/session.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <regex>
#include <sstream>

#include "gpu_shading/error.h"
#include "gpu_shading/sun_position.h"
#include "model/idf/model_file.h"
#include "platform/process.h"
#include "reports/report.h"
#include "tasks/perform_task.h"

namespace gpu_shading::energyplus {
namespace {

// What a session said.
struct Said {
  std::vector<std::string> warnings;
  std::vector<std::string> remarks;
  std::string eio;

  Messages messages() {
    return {[this](std::string const& line) { warnings.push_back(line); },
            [this](std::string const& line) { remarks.push_back(line); },
            [this](std::string const& line) { eio += line; }};
  }
};

Model model_of(std::string const& idf, Mode mode = Mode::automatic) {
  Model model;
  model.shading = read_shading_input(read_idf(idf));
  model.options.mode = mode;
  return model;
}

Polygon rectangle(glm::dvec3 const& corner, glm::dvec3 const& a, glm::dvec3 const& b) {
  return {{corner, corner + a, corner + a + b, corner + b}, {}};
}

Surface surface_of(std::string name, Polygon polygon) {
  Surface surface;
  surface.name = std::move(name);
  surface.polygon = std::move(polygon);
  return surface;
}

SunDirection const zenith{};

TEST(Session, NoMoreBackSurfacesAreLitThanEnergyPlusHasRoomFor) {
  // A skylight of 3 x 1 m over a floor of 30 strips, each a little wider than the one before.
  constexpr std::size_t strips = 30;
  Session session(model_of(""));
  auto const skylight =
      session.add(surface_of("SKYLIGHT", rectangle({0, 0, 3}, {3, 0, 0}, {0, 1, 0})));
  std::vector<SurfaceId> floor;
  double x = 0.0;
  for (std::size_t i = 0; i < strips; ++i) {
    double const width = 0.05 + 0.1 / 29.0 * static_cast<double>(i);
    floor.push_back(
        session.add(surface_of("STRIP", rectangle({x, 0, 0}, {0, 1, 0}, {width, 0, 0}))));
    x += width;
  }
  ASSERT_NEAR(x, 3.0, 1e-9);
  Said said;
  session.start({said.messages(), {}});
  session.set_sun(zenith);
  auto const areas = session.interior_areas(skylight, floor);
  ASSERT_EQ(areas.size(), strips);
  for (std::size_t i = 0; i < strips; ++i) {
    bool const kept = i >= strips - max_back_surfaces;
    EXPECT_NEAR(areas[i], kept ? 0.05 + 0.1 / 29.0 * static_cast<double>(i) : 0.0, 2e-3) << i;
  }
}

TEST(Session, ShadingSurfaceNobodyAsksAfterCostsNothing) {
  Session session(
      model_of("Shading:Site:Detailed,Plate;Shading:Site:Detailed,Named;"
               "Output:Variable,Named,Surface Outside Face Sunlit Fraction;"));
  auto const plate = session.add(surface_of("PLATE", rectangle({0, 0, 1}, {2, 0, 0}, {0, 2, 0})));
  auto const named = session.add(surface_of("NAMED", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  session.add(surface_of("ROOF", rectangle({0, 0, 2}, {1, 0, 0}, {0, 2, 0})));
  Said said;
  session.start({said.messages(), {}});
  session.set_sun({0.0, std::asin(0.5)});
  EXPECT_NEAR(session.projected_sunlit_area(plate), 4.0 * 0.5, 1e-6);
  session.set_sun(zenith);
  EXPECT_NEAR(session.projected_sunlit_area(named), 0.0, 1e-3);
}

TEST(Session, CoordinatesAreNumbersOnEarth) {
  for (double const value : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e308, -1.1e7}) {
    Session session(model_of(""));
    auto wall = surface_of("WALL", rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, 1}));
    auto pierced = wall;
    wall.polygon.outline[2].y = value;
    pierced.polygon.holes.push_back({{0, 0, 0}, {0, 0, value}, {1, 0, 0}});
    EXPECT_THAT(
        [&] { session.add(wall); },
        testing::ThrowsMessage<Error>(testing::HasSubstr("surface WALL: vertex 3 is (1, ")));
    EXPECT_THROW(session.add(pierced), Error);
  }
}

// A child process has none of its parent's threads.
TEST(Session, AnswersInAForkedProcessAsBefore) {
  auto model = model_of("Schedule:Constant,LEAVES,,0.5;");
  model.shading.shading_surfaces["TREE"] = {"Shading:Site:Detailed", "LEAVES"};
  model.options.device.device = DeviceId{};
  Schedules const schedules{[](std::string const&) { return std::pair(0.0, 1.0); },
                            [](std::string const&, Moment) { return 0.5; }};
  constexpr int strips = 40;
  // Answers of all strips, above which the tree covers some.
  auto const ask = [&](Session& session, double altitude) {
    session.set_sun({0.3, altitude});
    std::vector<double> areas;
    for (SurfaceId id = 1; id <= strips; ++id) areas.push_back(session.projected_sunlit_area(id));
    return areas;
  };
  Said said;
  auto const started = [&] {
    auto session = std::make_unique<Session>(model);
    session->add(surface_of("TREE", rectangle({0.2, 0.1, 1}, {20, 0, 0}, {0, 0.6, 0})));
    for (int i = 0; i < strips; ++i) {
      session->add(surface_of("STRIP", rectangle({i, 0, 0}, {0.9, 0, 0}, {0, 1, 0})));
    }
    session->start({said.messages(), schedules, {}});
    session->set_time({12, 1});
    return session;
  };
  auto const expected = ask(*started(), 1.0);
  auto const before = started();
  ask(*before, 0.7);
  pid_t const child = fork();
  if (child == 0) {
    alarm(60);
    bool const same = ask(*before, 1.0) == expected && ask(*started(), 1.0) == expected;
    _exit(same ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(Session, SimplifiedSurfacesCastAndReceiveAsTheyAreWritten) {
  // EnergyPlus makes a triangle of a slat and of its mirrored copy.
  auto model = model_of(
      "Shading:Site:Detailed,Slat;Output:Variable,Slat,Surface Outside Face Sunlit Fraction;"
      "Output:Variable,Mir-Slat,Surface Outside Face Sunlit Fraction;");
  model.simplified.outlines["SLAT"] = rectangle({0, 0, 1}, {1, 0, 0}, {0, 0.004, 0}).outline;
  Session session(std::move(model));
  auto const floor =
      session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {1, 0, 0}, {0, 0.02, 0})));
  auto const slat = session.add(surface_of("SLAT", {{{0, 0, 1}, {1, 0, 1}, {1, 0.004, 1}}, {}}));
  auto const copy = session.add_mirrored(slat);
  Said said;
  session.start({said.messages(), {}});
  session.set_sun(zenith);
  EXPECT_NEAR(session.projected_sunlit_area(floor), 0.016, 2e-5);
  // EnergyPlus divides by its own area.
  EXPECT_NEAR(session.projected_sunlit_area(slat), 0.002, 1e-6);
  EXPECT_EQ(session.projected_sunlit_area(copy), 0.0F);
}

TEST(Session, PlaceholdersHaveIdsButShadeNothing) {
  auto model = model_of("Building,Box,0,City,0.04,0.4,FullExteriorWithReflections;");
  model.lean.placeholders = make_placeholders({}, {});
  Session session(std::move(model));
  auto const plate = rectangle({0, 0, 1}, {2, 0, 0}, {0, 2, 0});
  auto const pole = session.add(surface_of("GPU SHADING PLACEHOLDER 1", plate));
  auto const copy = session.add_mirrored(pole);
  auto const floor = session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  EXPECT_EQ(session.shading_surfaces(), std::vector{pole});
  EXPECT_TRUE(session.is_placeholder(pole) && session.is_placeholder(copy));
  EXPECT_EQ(session.surface(copy).name, "Mir-GPU SHADING PLACEHOLDER 1");
  Said said;
  session.start({said.messages(), {}});
  session.set_sun(zenith);
  EXPECT_NEAR(session.projected_sunlit_area(floor), 4.0, 1e-6);
  // Unshaded, on the side of the sun.
  EXPECT_NEAR(session.projected_sunlit_area(pole), 4.0, 1e-6);
  EXPECT_EQ(session.projected_sunlit_area(copy), 0.0F);
  EXPECT_THROW(session.interior_areas(pole, {floor}), Error);
  EXPECT_THROW(session.interior_areas(floor, {copy}), Error);
}

TEST(Session, MirroredCopiesThatNobodyAsksAfterAreUnshaded) {
  Session session(model_of("Shading:Site:Detailed,Low;Shading:Site:Detailed,High;"));
  auto const low = session.add(surface_of("LOW", rectangle({0, 0, 0}, {0, 2, 0}, {2, 0, 0})));
  auto const copy = session.add_mirrored(low);
  session.add(surface_of("HIGH", rectangle({0, 0, 1}, {2, 0, 0}, {0, 2, 0})));
  Said said;
  session.start({said.messages(), {}});
  session.set_sun(zenith);
  EXPECT_NEAR(session.projected_sunlit_area(copy), 4.0, 1e-6);
  EXPECT_EQ(session.surface(copy).name, "Mir-LOW");
}

TEST(Session, SameDirectionIsRenderedOnce) {
  Session session(model_of(""));
  auto const floor = session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  session.add(surface_of("PLATE", rectangle({0, 0, 1}, {1, 0, 0}, {0, 2, 0})));
  Said said;
  session.start({said.messages(), {}});
  for (int day = 0; day < 5; ++day) {
    session.set_sun(zenith);
    EXPECT_NEAR(session.projected_sunlit_area(floor), 2.0, 5e-3);
    session.set_sun({1.0, 1.0});
    session.projected_sunlit_area(floor);
  }
  session.finish();
  ASSERT_FALSE(said.remarks.empty());
  EXPECT_NE(said.remarks.back().find("1 receivers, 2 casters, 2 directions"), std::string::npos)
      << said.remarks.back();
}

// A skylight under a plate, over two halves of a floor, on a day at 42 degrees north.
struct WithDay {
  explicit WithDay(std::function<double()> site) : session(model_of("")) {
    skylight = session.add(surface_of("SKYLIGHT", rectangle({0, 0, 3}, {2, 0, 0}, {0, 1, 0})));
    for (double const x : {-9.0, 1.0}) {
      floor.push_back(
          session.add(surface_of("FLOOR", rectangle({x, 0, 0}, {0, 9, 0}, {10, 0, 0}))));
    }
    session.add(surface_of("PLATE", rectangle({0, 0, 4}, {1, 0, 0}, {0, 1, 0})));
    session.start({said.messages(), {}, std::move(site)});
  }

  Scene scene() const {
    Scene all;
    for (SurfaceId id = 0; id < session.size(); ++id) all.add(session.surface(id));
    return all;
  }

  // At so many quarters of an hour past noon, as EnergyPlus hands it over.
  std::vector<double> at(int quarters) {
    auto const sun = to_direction(HourDirection{0.1, quarters * std::numbers::pi / 48.0}, latitude);
    session.set_sun({static_cast<float>(sun.azimuth), static_cast<float>(sun.altitude)});
    std::vector<double> areas{session.projected_sunlit_area(skylight)};
    for (double const area : session.interior_areas(skylight, floor)) areas.push_back(area);
    return areas;
  }

  // "6 views drawn, 0 clear"
  std::string rendered() {
    session.finish();
    std::smatch views;
    EXPECT_TRUE(std::regex_search(said.remarks.back(), views, std::regex("\\d+ views.*clear")));
    return views[0];
  }

  std::string directions() {
    session.finish();
    std::smatch directions;
    EXPECT_TRUE(
        std::regex_search(said.remarks.back(), directions, std::regex("(\\d+) directions")));
    return directions[1];
  }

  static constexpr double latitude = 0.73;
  Said said;
  Session session;
  SurfaceId skylight = 0;
  std::vector<SurfaceId> floor;
};

TEST(Session, TheRestOfADayIsRenderedInOneGo) {
  WithDay ahead([] { return WithDay::latitude; });
  WithDay one_at_a_time({});
  ahead.at(-20);
  ahead.at(-19);
  auto const rendered = ahead.rendered();
  EXPECT_EQ(ahead.directions(), "2");  // were asked for
  double inside = 0.0;
  for (int quarters = -20; quarters <= 25; ++quarters) {
    auto const areas = ahead.at(quarters);
    auto const expected = one_at_a_time.at(quarters);
    for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], expected[i], 1e-5) << i;
    inside += areas[1] + areas[2];
  }
  EXPECT_GT(inside, 10.0);
  // Until the last quarter before sunset, 0.09 radians past six.
  EXPECT_EQ(ahead.directions(), "46");
  EXPECT_EQ(ahead.rendered(), rendered);
  EXPECT_EQ(one_at_a_time.rendered(), rendered);
}

// EnergyPlus divides by a cosine of incidence of its own.
TEST(Session, GrazingSunIsTakenAsItIsHandedOver) {
  constexpr double from_edge_on = 0.003;
  for (int i = 0; i < 20; ++i) {
    double const last = -1.0 + 0.1 * i;
    auto const at = [&](int step) {
      auto const sun = to_direction(HourDirection{0.1, last + step * std::numbers::pi / 48.0},
                                    WithDay::latitude);
      return SunDirection{static_cast<float>(sun.azimuth), static_cast<float>(sun.altitude)};
    };
    auto const sun = at(0);
    double const heading = sun.azimuth - from_edge_on;
    Session session(model_of(""));
    auto const wall = session.add(surface_of(
        "WALL", rectangle({}, {std::sin(heading), std::cos(heading), 0.0}, {0.0, 0.0, 1.0})));
    Said said;
    session.start({said.messages(), {}, [] { return WithDay::latitude; }});
    for (int step = -3; step < 0; ++step) {
      session.set_sun(at(step));
      session.projected_sunlit_area(wall);
    }
    session.set_sun(sun);
    double const cosine = std::cos(sun.altitude) * std::sin(from_edge_on);
    EXPECT_NEAR(session.projected_sunlit_area(wall), cosine, 1e-6 * cosine);
  }
}

TEST(Session, TheSkyIsRenderedInOneGo) {
  WithDay sky({});
  Renderer renderer(sky.scene(), {});
  sky.session.set_sun({1.308997F, 0.65449847F});
  sky.session.projected_sunlit_area(sky.skylight);
  auto const rendered = sky.rendered();
  for (int i = 0; i < 144; ++i) {
    int const row = i / 24;
    double const azimuth = i % 24 * std::numbers::pi / 12.0;
    double const altitude = (row + 0.5) * std::numbers::pi / 12.0;
    sky.session.set_sun({static_cast<float>(azimuth), static_cast<float>(altitude)});
    auto const expected = renderer.projected_sunlit_areas(SunDirection{azimuth, altitude},
                                                          std::span(&sky.skylight, 1));
    EXPECT_FLOAT_EQ(static_cast<float>(sky.session.projected_sunlit_area(sky.skylight)),
                    static_cast<float>(expected.front().projected_area));
  }
  EXPECT_EQ(sky.directions(), "144");
  EXPECT_EQ(sky.rendered(), rendered);
}

TEST(Session, ReportHoldsEveryAnswerAndPictures) {
  auto const folder = std::filesystem::path(testing::TempDir()) / "session_report";
  std::filesystem::remove_all(folder);
  auto model = model_of("");
  model.options.report = folder;
  Session session(std::move(model));
  auto const floor =
      session.add(surface_of("FLOOR, \"A\"", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  session.add(surface_of("PLATE", rectangle({0, 0, 1}, {1, 0, 0}, {0, 2, 0})));
  Said said;
  session.start({said.messages(), {}});
  session.set_sun(zenith);
  session.projected_sunlit_area(floor);
  session.finish();
  std::ifstream table(folder / "sunlit.csv");
  std::string header;
  std::string row;
  std::getline(table, header);
  std::getline(table, row);
  EXPECT_EQ(header.substr(0, 9), "receiver,");
  EXPECT_EQ(row.substr(0, 15), "\"FLOOR, \"\"A\"\"\",");
  EXPECT_TRUE(std::filesystem::exists(folder / "FLOOR___A__000.0_90.0.png"));
}

// A plate over half a floor, with a screen that is deployed by a schedule.
struct Deployed {
  explicit Deployed(std::filesystem::path const& report = {},
                    std::filesystem::path const& cache = {})
      : session(model(report, cache)) {
    floor = session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
    session.add(surface_of("PLATE", rectangle({0, 0, 1}, {1, 0, 0}, {0, 2, 0})));
    session.start({said.messages(),
                   {[](std::string const&) { return std::pair(0.0, 1.0); },
                    [this](std::string const&, Moment) { return share; }}});
  }

  static Model model(std::filesystem::path const& report, std::filesystem::path const& cache) {
    auto const objects = read_idf(
        "Shading:Site:Detailed,Plate;GPUShading:PerforatedScreen,S,Plate,Round,,,0.005,,0.008,,0,,,"
        ","
        ",,,,,,,Sails;");
    Model model;
    model.shading = read_shading_input(objects);
    model.screens = read_perforated_screens(objects, model.shading, {}, {});
    if (!report.empty()) model.options.report = report;
    if (!cache.empty()) model.options.cache = CacheFolder{cache};
    return model;
  }

  void ask(double now, SunDirection sun) {
    share = now;
    session.set_time({1, 1});
    session.set_sun(sun);
    session.projected_sunlit_area(floor);
  }

  Said said;
  double share = 1.0;
  Session session;
  SurfaceId floor = 0;
};

TEST(Session, AnswersAreKeptForEachStateOfDeployment) {
  Deployed deployed;
  for (int day = 0; day < 3; ++day) {
    for (double const share : {1.0, 0.25, 0.0}) deployed.ask(share, zenith);
    deployed.ask(0.25, {1.0, 1.0});
  }
  deployed.session.finish();
  ASSERT_FALSE(deployed.said.remarks.empty());
  EXPECT_NE(deployed.said.remarks.back().find(" 4 directions"), std::string::npos)
      << deployed.said.remarks.back();
}

TEST(Session, CacheKeepsAnswersForEachStateOfDeployment) {
  TemporaryFolder const folder;
  for (auto const* const wanted :
       {" 3 directions rendered, 0 from the cache", " 1 directions rendered, 2 from the cache"}) {
    Deployed deployed({}, folder.path());
    bool const first = std::string_view(wanted).starts_with(" 3");
    for (double const share : first ? std::vector{1.0, 0.25, 0.0} : std::vector{0.0, 0.25, 0.75}) {
      deployed.ask(share, zenith);
    }
    deployed.session.finish();
    EXPECT_NE(deployed.said.remarks.back().find(wanted), std::string::npos)
        << deployed.said.remarks.back();
  }
}

TEST(Session, EioListsScreens) {
  Deployed const deployed;
  EXPECT_EQ(deployed.said.eio,
            "! <GPU Shading Surface>, Surface Name, Transmittance\n"
            "GPU Shading Surface,PLATE,perforated (round holes 5 mm; 60 degrees staggered; pitch 8 "
            "mm; 35.4 % open; 0 mm thick) deployed by SAILS\n");
}

TEST(Session, ReportSaysWhenItHasTooManyPictures) {
  TemporaryFolder const folder;
  auto model = model_of("");
  model.options.report = folder.path();
  Session session(std::move(model));
  std::vector<SurfaceId> strips;
  for (std::size_t i = 0; i < max_report_pictures + 2; ++i) {
    // Narrow, so that the pictures are small.
    strips.push_back(session.add(
        surface_of("STRIP " + std::to_string(i),
                   rectangle({0.0, 0.01 * static_cast<double>(i), 0.0}, {1, 0, 0}, {0, 0.01, 0}))));
  }
  session.add(surface_of("PLATE", rectangle({0, 0, 1}, {0.5, 0, 0}, {0, 9, 0})));
  Said said;
  session.start({said.messages(), {}});
  session.set_sun(zenith);
  for (auto const strip : strips) session.projected_sunlit_area(strip);
  session.finish();
  EXPECT_THAT(
      said.remarks,
      testing::Contains(testing::HasSubstr("the first 300 pictures are drawn, 2 more are not")));
  std::size_t pictures = 0;
  for (auto const& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().extension() == ".png") ++pictures;
  }
  EXPECT_EQ(pictures, max_report_pictures);
}

TEST(Session, ReportTellsStatesOfDeploymentApart) {
  auto const folder = std::filesystem::path(testing::TempDir()) / "deployment_report";
  std::filesystem::remove_all(folder);
  Deployed deployed(folder);
  for (double const share : {1.0, 0.25}) deployed.ask(share, {0.5, 1.0});
  deployed.session.finish();
  std::ifstream table(folder / "sunlit.csv");
  std::string line;
  std::getline(table, line);
  EXPECT_TRUE(line.ends_with(",sunlit fraction,error,\"share by SAILS\"")) << line;
  std::vector<std::string> shares;
  while (std::getline(table, line)) shares.push_back(line.substr(line.rfind(',') + 1));
  EXPECT_EQ(shares, (std::vector<std::string>{"1", "0.25"}));
  EXPECT_TRUE(std::filesystem::exists(folder / "FLOOR_028.6_57.3_100.png"));
}

// A yard behind leaves, its edge of 1 mm, and a yard behind a plate, which is exact.
struct WithLeaves {
  explicit WithLeaves(double error, std::filesystem::path const& cache = {},
                      std::optional<int> resolution = {})
      : session(model(error, cache, resolution)) {
    yard = session.add(surface_of("YARD", rectangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0})));
    Polygon const corner{
        {{0, 0, 0}, {4, 0, 0}, {4, 1e-3, 0}, {1e-3, 1e-3, 0}, {1e-3, 4, 0}, {0, 4, 0}}, {}};
    edge = session.add(surface_of("EDGE", corner));
    open = session.add(surface_of("OPEN", rectangle({50, 0, 0}, {4, 0, 0}, {0, 4, 0})));
    constexpr int leaves = 1500;
    for (int i = 0; i < leaves; ++i) {
      glm::dvec3 const corner_of_leaf(std::fmod(0.618034 * i, 4.0), std::fmod(0.7548777 * i, 4.0),
                                      0.5);
      glm::dvec3 const along(0.1 * std::cos(0.5 * i), 0.1 * std::sin(0.5 * i), 0.0);
      session.add(surface_of("LEAF", rectangle(corner_of_leaf, along, {-along.y, along.x, 0.05})));
    }
    session.add(surface_of("PLATE", rectangle({51, 0, 1}, {1, 0, 0}, {0, 1, 0})));
    session.start({said.messages(), {}});
  }

  static Model model(double error, std::filesystem::path const& cache,
                     std::optional<int> resolution) {
    auto made = model_of("");
    made.options.error = error;
    made.options.resolution = resolution;
    made.options.device.device = DeviceId{};
    if (!cache.empty()) made.options.cache = CacheFolder{cache};
    return made;
  }

  // The fields of the .eio's line, after suns of which the last is behind the receivers.
  std::vector<std::string> errors(std::vector<SurfaceId> const& receivers) {
    for (double const altitude : {0.5, 0.8, 1.1, -0.1}) {
      session.set_sun({0.3, altitude});
      session.projected_sunlit_areas(receivers);
    }
    session.finish();
    std::smatch line;
    EXPECT_TRUE(std::regex_search(said.eio, line, std::regex("\nGPU Shading Error,(.*)\n")));
    std::vector<std::string> fields;
    std::istringstream text(line[1]);
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    return fields;
  }

  Said said;
  Session session;
  SurfaceId yard = 0;
  SurfaceId edge = 0;
  SurfaceId open = 0;
};

TEST(Session, StatesTheErrorsOfItsAnswers) {
  WithLeaves run(1e-3);
  std::vector<SurfaceId> const asked{run.yard, run.open};
  auto const fields = run.errors(asked);
  Scene scene;
  for (SurfaceId id = 0; id < run.session.size(); ++id) scene.add(run.session.surface(id));
  RendererOptions options;
  options.device = parse_device_choice("cpu");
  Renderer renderer(scene, options);
  double largest = 0.0;
  for (double const altitude : {0.5, 0.8, 1.1}) {
    auto const answers = renderer.projected_sunlit_areas(SunDirection{0.3, altitude}, asked);
    largest = std::max(largest, answers[0].error.value());
    EXPECT_EQ(answers[1].error, 0.0);
  }
  EXPECT_GT(largest, 1e-5);
  auto const stated = fmt::format("{:.2g}", largest);
  EXPECT_EQ(fields, (std::vector<std::string>{"0.001", "3", stated, stated, "3", "0"}));
  EXPECT_THAT(run.said.warnings,
              testing::Not(testing::Contains(testing::HasSubstr("target error"))));
}

// What is answered from the cache is no more exact than it was.
TEST(Session, StatesTheErrorsOfCachedAnswersToo) {
  TemporaryFolder const folder;
  WithLeaves first(1e-3, folder.path());
  auto const stated = first.errors({first.yard, first.open});
  WithLeaves again(1e-3, folder.path());
  EXPECT_EQ(again.errors({again.yard, again.open}), stated);
  EXPECT_THAT(again.said.remarks.back(), testing::HasSubstr(" 0 views drawn"));
}

TEST(Session, StatesNoErrorAtAFixedResolution) {
  WithLeaves run(1e-3, {}, 256);
  EXPECT_EQ(run.errors({run.yard, run.open}),
            (std::vector<std::string>{"", "0", "", "", "3", "3"}));
}

TEST(Session, NamesReceiversThatMissTheTargetError) {
  WithLeaves run(1e-5);
  auto const fields = run.errors({run.yard, run.edge, run.open});
  EXPECT_EQ(fields[1], "6");
  EXPECT_THAT(
      run.said.warnings,
      testing::Contains("sunlit fractions of 1 receiver cannot be brought within the target "
                        "error of 1e-05: EDGE (within " +
                        fields[3] + "); see docs/explanation/accuracy.md"));
}

// A skylight over two halves of a floor, half under a plate that a schedule makes transparent.
struct WithCache {
  WithCache(std::filesystem::path const& folder, double plate_height, double transmittance)
      : session(model(folder)) {
    skylight = session.add(surface_of("SKYLIGHT", rectangle({0, 0, 3}, {2, 0, 0}, {0, 1, 0})));
    for (double const x : {0.0, 1.0}) {
      floor.push_back(session.add(surface_of("FLOOR", rectangle({x, 0, 0}, {0, 1, 0}, {1, 0, 0}))));
    }
    session.add(surface_of("PLATE", rectangle({0, 0, plate_height}, {1, 0, 0}, {0, 1, 0})));
    session.start({said.messages(),
                   {[](std::string const&) { return std::pair(0.0, 1.0); },
                    [transmittance](std::string const&, Moment) { return transmittance; }}});
    session.set_time({1, 1});
    session.set_sun(zenith);
  }

  static Model model(std::filesystem::path const& folder) {
    auto made = model_of("Shading:Site:Detailed,Plate,Leaves;");
    made.options.cache = CacheFolder{folder};
    return made;
  }

  std::vector<double> ask() {
    auto answers = session.interior_areas(skylight, floor);
    answers.push_back(session.projected_sunlit_area(skylight));
    return answers;
  }

  std::string remark() {
    session.finish();
    return said.remarks.empty() ? "" : said.remarks.back();
  }

  Said said;
  Session session;
  SurfaceId skylight = 0;
  std::vector<SurfaceId> floor;
};

TEST(Session, CacheAnswersALaterRunAndSchedulesStillCount) {
  TemporaryFolder const folder;
  WithCache first(folder.path(), 4, 0.5);
  auto const answers = first.ask();
  EXPECT_NEAR(answers[2], 1.5, 1e-2);
  EXPECT_NE(first.remark().find(" 1 directions rendered, 0 from the cache, "), std::string::npos)
      << first.remark();
  for (double const transmittance : {0.5, 0.25}) {
    WithCache again(folder.path(), 4, transmittance);
    auto const same = again.ask();
    EXPECT_EQ(same == answers, transmittance == 0.5);
    EXPECT_NEAR(same[2], 1.0 + transmittance, 1e-2);
    EXPECT_NE(again.remark().find(" 0 directions rendered, 1 from the cache, 0 views drawn"),
              std::string::npos)
        << again.remark();
  }
  WithCache moved(folder.path(), 4.5, 0.5);
  moved.ask();
  EXPECT_NE(moved.remark().find(" 1 directions rendered, 0 from the cache"), std::string::npos);
}

// What the renderer would never say shows where the answers are from.
TEST(Session, CachedInteriorsAreNotRenderedAgain) {
  TemporaryFolder const folder;
  {
    WithCache first(folder.path(), 4, 0.5);
    first.ask();
    first.session.finish();
  }
  std::filesystem::path file;
  for (auto const& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().extension() == ".sunlit") file = entry.path();
  }
  auto const digits = file.stem().string();
  Hash scene{};
  for (std::size_t i = 0; i < scene.size(); ++i) {
    scene[i] = static_cast<std::uint8_t>(std::stoi(digits.substr(2 * i, 2), nullptr, 16));
  }
  std::ifstream in(file, std::ios::binary);
  std::string const text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  auto const known = decode(std::as_bytes(std::span(text)), scene);
  SceneAnswers odd;
  odd.states = known.states;
  known.answers.for_each([&](AnswerStore::Direction const& direction) {
    for (auto const& [question, answers] : direction.interior) {
      std::vector<Sunlit> changed(answers.count);
      for (auto& answer : changed) answer.projected_area = 0.125;
      odd.answers.keep_interior(odd.answers.at(direction.sun, direction.state), question, changed);
    }
  });
  auto const bytes = encode(odd, scene);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<char const*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  WithCache second(folder.path(), 4, 0.5);
  auto const answers = second.ask();
  EXPECT_EQ(answers[0], 0.125F);
  EXPECT_EQ(answers[1], 0.125F);
  EXPECT_NEAR(answers[2], 1.5, 1e-2) << "is not in the file, so rendered";
}

TEST(Session, CacheThatCannotBeWrittenAtTheEndIsAWarning) {
  TemporaryFolder const folder;
  WithCache run(folder.path() / "cache", 4, 0.5);
  auto const before = run.said.warnings.size();
  run.ask();
  std::filesystem::remove_all(folder.path() / "cache");
  std::ofstream(folder.path() / "cache") << "in its place";
  EXPECT_NO_THROW(run.session.finish());
  ASSERT_EQ(run.said.warnings.size(), before + 1);
  EXPECT_NE(run.said.warnings.back().find("cannot be written"), std::string::npos);
}

TEST(Session, AScheduleThatIsOverriddenLeavesTheCachesApart) {
  TemporaryFolder const folder;
  auto const run = [&] {
    double now = 0.5;
    Said said;
    Session session(WithCache::model(folder.path()));
    auto const floor = session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 1, 0})));
    session.add(surface_of("PLATE", rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0})));
    session.start({said.messages(),
                   {[](std::string const&) { return std::pair(0.5, 0.5); },
                    [&now](std::string const&, Moment) { return now; }}});
    session.set_sun(zenith);
    for (double const value : {0.5, 0.25}) {
      now = value;
      session.set_time({1, 1});
      EXPECT_NEAR(session.projected_sunlit_area(floor), 1.0 + value, 1e-2);
    }
    session.finish();
    return said.remarks.back();
  };
  EXPECT_NE(run().find(" 2 directions rendered, 0 from the cache"), std::string::npos);
  EXPECT_NE(run().find(" 0 directions rendered, 2 from the cache"), std::string::npos);
}

TEST(Session, ReportThatCannotBeWrittenIsSaidAtTheStart) {
  auto model = model_of("");
  model.options.report = "/proc/nothing/here";
  Session session(std::move(model));
  session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  Said said;
  EXPECT_THROW(session.start({said.messages(), {}}), Error);
}

TEST(Session, WithoutAGpuTheCpuComputesUnlessAGpuIsRequired) {
  Said said;
  Session session(model_of(""));
  session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  session.start({said.messages(), {}});
  if (said.remarks.empty()) GTEST_SKIP() << "a GPU renders here";
  EXPECT_TRUE(said.warnings.empty());
  EXPECT_NE(said.remarks[0].find("no GPU available; computing on the CPU, "), std::string::npos);
  Session strict(model_of("", Mode::require));
  strict.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  EXPECT_THROW(strict.start({said.messages()}), DeviceError);
}

TEST(Session, TasksAreDoneInPlaceOfShading) {
  TemporaryFolder const folder;
  auto const perform = [](Task const& task) {
    Session session(model_of("Shading:Site:Detailed,Plate;"));
    session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
    session.add(surface_of("PLATE", rectangle({0, 0, 1}, {1, 0, 0}, {0, 2, 0})));
    Said said;
    return perform_task(task, session.complete({}), said.messages());
  };
  EXPECT_THAT(perform(ListingTask{}), testing::HasSubstr("2 surfaces"));
  EXPECT_THAT(perform(ListingTask{true}), testing::HasSubstr("\"PLATE\",4,0,2,1\n"));
  std::vector<SunView> const views{{"scene.png", zenith, ""}, {"floor.png", zenith, "Floor"}};
  perform(ViewsTask{views, folder.path(), 64});
  for (auto const& view : views) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / view.picture)) << view.picture;
  }
  EXPECT_THROW(perform(ViewsTask{{{"none.png", zenith, "Door"}}, folder.path(), 64}), Error);
}

TEST(Session, QuestionsBeforeTheStartAndOfNoSurfaceAreErrors) {
  Session session(model_of(""));
  session.add(surface_of("FLOOR", rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0})));
  EXPECT_THROW(session.set_sun(zenith), Error);
  EXPECT_THROW(session.projected_sunlit_area(0), Error);
  EXPECT_THROW(session.interior_areas(0, {}), Error);
  Said said;
  session.start({said.messages(), {}});
  EXPECT_THROW(session.projected_sunlit_area(7), Error);
}

}  // namespace
}  // namespace gpu_shading::energyplus

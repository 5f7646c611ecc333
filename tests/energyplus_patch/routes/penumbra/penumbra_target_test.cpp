#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <penumbra/penumbra.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr float pi = std::numbers::pi_v<float>;
constexpr float south = pi;

// Keeps what it is told.
class Record : public Courierr::Courierr {
 public:
  void error(const std::string_view message) override { errors.emplace_back(message); }
  void warning(const std::string_view message) override { warnings.emplace_back(message); }
  void info(const std::string_view message) override { remarks.emplace_back(message); }
  void debug(const std::string_view /*message*/) override {}

  std::vector<std::string> errors, warnings, remarks;
};

// Three metres wide and high, facing south.
const Penumbra::Polygon wall{0, 0, 0, 3, 0, 0, 3, 0, 3, 0, 0, 3};
// One metre deep above it, and wider, so that its ends do not count.
const Penumbra::Polygon overhang{-9, -1, 3, 12, -1, 3, 12, 0, 3, -9, 0, 3};
// Before all of it.
const Penumbra::Polygon screen{-9, -1, -9, 12, -1, -9, 12, -1, 12, -9, -1, 12};

// Every test begins without a model.
class PenumbraTarget : public testing::Test {
 protected:
  PenumbraTarget() { Penumbra::take_options({}); }

  unsigned add(Penumbra::Polygon const& polygon, std::string const& name) {
    return penumbra().add_surface(Penumbra::Surface(polygon, name));
  }
  Penumbra::Penumbra& penumbra() {
    if (!penumbra_) penumbra_ = std::make_unique<Penumbra::Penumbra>(512u, record);
    return *penumbra_;
  }

  std::shared_ptr<Record> record = std::make_shared<Record>();

 private:
  std::unique_ptr<Penumbra::Penumbra> penumbra_;
};

TEST_F(PenumbraTarget, IsThereOnEveryMachine) {
  EXPECT_TRUE(Penumbra::Penumbra::is_valid_context());
}

// The shadow of an overhang reaches down its depth x tan(altitude).
TEST_F(PenumbraTarget, ShadesBelowAnOverhang) {
  auto const id = add(wall, "Wall");
  add(overhang, "Overhang");
  penumbra().set_model();
  for (float const altitude : {0.2f, 0.5f, 0.8f, 1.1f}) {
    penumbra().set_sun_position(south, altitude);
    double const lit = 3.0 * (3.0 - std::tan(altitude));
    EXPECT_NEAR(penumbra().calculate_pssa(id), lit * std::cos(altitude), 1e-3) << altitude;
  }
  EXPECT_THAT(record->errors, ElementsAre());
}

TEST_F(PenumbraTarget, LightsBothFaces) {
  auto const id = add(wall, "Wall");
  penumbra().set_model();
  for (float const azimuth : {0.0f, 0.3f, south - 0.3f, south}) {
    penumbra().set_sun_position(azimuth, 0.0f);
    EXPECT_NEAR(penumbra().calculate_pssa(id), 9.0 * std::abs(std::cos(azimuth)), 1e-5);
  }
}

TEST_F(PenumbraTarget, LeavesOutHoles) {
  Penumbra::Surface surface(wall, "Wall");
  surface.add_hole({1, 0, 1, 2, 0, 1, 2, 0, 2, 1, 0, 2});
  auto const id = penumbra().add_surface(surface);
  penumbra().set_model();
  penumbra().set_sun_position(south, 0.0f);
  EXPECT_NEAR(penumbra().calculate_pssa(id), 8.0, 1e-5);
}

TEST_F(PenumbraTarget, AddsWhatComesThroughSeveralWindows) {
  Penumbra::Surface front(wall, "Front");
  const Penumbra::Polygon left{0.5, 0, 1, 1, 0, 1, 1, 0, 2, 0.5, 0, 2};
  const Penumbra::Polygon right{2, 0, 1, 2.5, 0, 1, 2.5, 0, 2, 2, 0, 2};
  front.add_hole(left);
  front.add_hole(right);
  penumbra().add_surface(front);
  auto const first = add(left, "Left");
  auto const second = add(right, "Right");
  auto const back = add({3, 5, 0, 0, 5, 0, 0, 5, 3, 3, 5, 3}, "Back");
  penumbra().set_model();
  penumbra().set_sun_position(south, 0.0f);
  EXPECT_NEAR(penumbra().calculate_interior_pssas({first, second}, {back})[back], 1.0, 1e-3);
}

TEST_F(PenumbraTarget, RefusesNumbersOfNoSurface) {
  add(wall, "Wall");
  penumbra().set_model();
  EXPECT_THROW(penumbra().calculate_pssa(1u), Penumbra::SurfaceException);
  EXPECT_THROW(penumbra().submit_pssa(std::vector<unsigned>{0u, 7u}), Penumbra::PenumbraException);
  EXPECT_THROW(penumbra().calculate_interior_pssas({0}, {3}), Penumbra::PenumbraException);
  EXPECT_THROW(penumbra().calculate_interior_pssas({}, {0}), Penumbra::PenumbraException);
  EXPECT_THAT(record->errors, ElementsAre(HasSubstr("Surface 1 does not exist"),
                                          HasSubstr("Surface 7 does not exist"),
                                          HasSubstr("Interior surface 3 does not exist"),
                                          HasSubstr("at least one transparent surface")));
}

TEST_F(PenumbraTarget, RefusesQuestionsBeforeTheModel) {
  auto const id = add(wall, "Wall");
  EXPECT_THROW(penumbra().calculate_pssa(id), Penumbra::PenumbraException);
  penumbra().set_model();
  EXPECT_NEAR(penumbra().calculate_pssa(id), 9.0, 1e-5);  // the sun is in the north so far
  auto const late = add(overhang, "Overhang");
  EXPECT_THROW(penumbra().calculate_pssa(late), Penumbra::PenumbraException);
  EXPECT_THAT(record->errors, ElementsAre(HasSubstr("set_model"), HasSubstr("set_model")));
}

TEST_F(PenumbraTarget, PassesOnWhatTheDeviceRefuses) {
  Penumbra::Penumbra coarse(0u, record);
  coarse.add_surface(Penumbra::Surface(wall));
  EXPECT_THROW(coarse.set_model(), Penumbra::PenumbraException);
  EXPECT_THAT(record->errors, ElementsAre(HasSubstr("resolution 0")));
}

TEST_F(PenumbraTarget, BeginsAnewWithoutSurfaces) {
  add(wall, "Wall");
  add(screen, "Screen");
  penumbra().set_model();
  penumbra().clear_model();
  EXPECT_EQ(penumbra().get_number_of_surfaces(), 0u);
  penumbra().set_model();
  EXPECT_THAT(record->warnings, ElementsAre(HasSubstr("no surfaces")));
  auto const id = add(wall, "Wall");
  penumbra().set_model();
  penumbra().set_sun_position(south, 0.0f);
  EXPECT_NEAR(penumbra().calculate_pssa(id), 9.0, 1e-5);
}

TEST_F(PenumbraTarget, WritesAreasInsteadOfPictures) {
  add(wall, "Wall");
  penumbra().set_model();
  penumbra().set_sun_position(south, 0.0f);
  penumbra().render_scene(0);
  EXPECT_THAT(record->remarks, ElementsAre(HasSubstr("Wall: 9.0")));
}

// The rest is what Penumbra has not.

constexpr char const* screened_model =
    "Version,24.2;"
    "ShadowCalculation,PolygonClipping;"
    "GlobalGeometryRules,LowerLeftCorner,Counterclockwise,World;"
    "Shading:Site:Detailed,Screen,Leaves,4,-9,-1,-9,12,-1,-9,12,-1,12,-9,-1,12;"
    "GPUShading:TransparentShade,Foil,Screen,Constant,0.5;";

class PenumbraModel : public PenumbraTarget {
 protected:
  // Reads a model, and adds the wall and the screen, whose schedule has the value 0.4 at noon.
  void begin(std::string const& model, std::vector<std::string> const& options = {}) {
    std::vector<std::string> arguments{"--gpu-shading", "--gpu-shading-lean=off"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Penumbra::take_options(arguments);
    text = Penumbra::read_idf(model, "model.idf", "24.2");
    wall_id = add(wall, "WALL");
    screen_id = add(screen, "SCREEN");
    mirrored_id = penumbra().add_mirrored_surface(screen_id);
    penumbra().set_simulation(
        {[] { return 0.7; }, [](std::string const& name) { return name == "LEAVES" ? 7 : 0; },
         [](int) { return std::pair(0.2, 0.8); },
         [](int schedule, int hour, int) { return schedule == 7 && hour == 12 ? 0.4 : 0.8; },
         [this](std::string const& line) { lines += line; }});
    penumbra().set_model();
    penumbra().set_sun_position(south, 0.0f);
  }

  std::string text;
  unsigned wall_id = 0;
  unsigned screen_id = 0;
  int mirrored_id = 0;
  std::string lines;
};

TEST_F(PenumbraModel, TakesItsOptionsOnly) {
  EXPECT_THAT(Penumbra::take_options({"energyplus", "--gpu-shading-error", "0.01", "-w", "w.epw"}),
              ElementsAre("energyplus", "-w", "w.epw"));
  EXPECT_TRUE(Penumbra::is_wanted());
  Penumbra::take_options({"energyplus", "-w", "w.epw"});
  EXPECT_FALSE(Penumbra::is_wanted());
  EXPECT_THAT(Penumbra::options_help(), HasSubstr("--gpu-shading"));
}

TEST_F(PenumbraModel, LeavesATextAloneUnlessItIsWanted) {
  EXPECT_EQ(Penumbra::read_idf(screened_model, "model.idf", "24.2"), screened_model);
}

TEST_F(PenumbraModel, RewritesWhatEnergyPlusReads) {
  begin(screened_model);
  EXPECT_THAT(text, Not(HasSubstr("GPUShading")));
  EXPECT_THAT(text, HasSubstr("PixelCounting"));
  EXPECT_THAT(text, HasSubstr("Shading:Site:Detailed"));
}

TEST_F(PenumbraModel, RewritesEpJson) {
  Penumbra::take_options({"--gpu-shading"});
  auto const json = Penumbra::read_epjson(
      R"({"GPUShading:Settings":{"S":{"device":"cpu"}},"Version":{"V":{"version_identifier":"24.2"}}})",
      "model.epJSON", "24.2");
  EXPECT_THAT(json, Not(HasSubstr("GPUShading")));
  EXPECT_THAT(json, HasSubstr("PixelCounting"));
}

TEST_F(PenumbraModel, LetsShadesTransmitByTheirSchedules) {
  begin(screened_model);
  for (auto const& [hour, value] : {std::pair(12, 0.4), std::pair(13, 0.8)}) {
    penumbra().set_time(hour, 1);
    EXPECT_NEAR(penumbra().calculate_pssa(wall_id), 9.0 * 0.5 * value, 1e-4) << hour;
  }
  penumbra().set_time(24, 0);  // of the whole simulation, the lowest
  EXPECT_NEAR(penumbra().calculate_pssa(wall_id), 9.0 * 0.5 * 0.2, 1e-4);
  EXPECT_THAT(record->errors, ElementsAre());
}

TEST_F(PenumbraModel, SaysWhatItRendered) {
  begin(screened_model);
  penumbra().set_time(12, 1);
  penumbra().calculate_pssa(wall_id);
  penumbra().finish();
  EXPECT_THAT(record->remarks, testing::Contains(HasSubstr("1 directions")));
  EXPECT_THAT(lines, HasSubstr("SCREEN"));
}

TEST_F(PenumbraModel, NamesAScheduleThatIsMissing) {
  std::string model = screened_model;
  model.replace(model.find("Leaves"), 6, "Needles");
  EXPECT_THROW(begin(model), Penumbra::PenumbraException);
  EXPECT_THAT(record->errors, testing::Contains(HasSubstr("NEEDLES")));
}

// Its sunlit fraction is wanted only where something shows it or light is reflected.
TEST_F(PenumbraModel, TakesMirroredSurfacesWhereTheyMatter) {
  begin(screened_model);
  EXPECT_EQ(mirrored_id, -1);
}

TEST_F(PenumbraModel, TakesMirroredSurfacesForReflections) {
  begin(std::string(screened_model) + "Building,B,0,City,,,FullExteriorWithReflections;");
  ASSERT_EQ(mirrored_id, 2);
  penumbra().set_sun_position(0.0f, 0.0f);  // from the north, over the wall
  double const whole = 21.0 * 21.0;
  EXPECT_NEAR(penumbra().calculate_pssa(2u), whole - 9.0, 1e-3 * whole);
}

TEST_F(PenumbraModel, SendsRaysThroughWhatEnergyPlusDoesNotSee) {
  begin(
      std::string(screened_model) +
          "Daylighting:Controls,D,Z;Shading:Site:Detailed,Pane,,4,20,-1,0,21,-1,0,21,-1,1,20,-1,1;",
      {"--gpu-shading-lean=on"});
  EXPECT_THAT(text, Not(HasSubstr("Pane")));
  penumbra().begin_daylighting();
  EXPECT_EQ(penumbra().ray_transmittance({20.5, 0, 0.5}, {0, -1, 0}, 12), 0.0);
  EXPECT_EQ(penumbra().ray_transmittance({30.5, 0, 0.5}, {0, -1, 0}, 12), 1.0);
}

TEST_F(PenumbraModel, RefusesWrongOptionsAndModels) {
  EXPECT_THAT(Penumbra::take_options({"--gpu-shading-device=tea", "-w"}), ElementsAre("-w"));
  auto const read = [](std::string const& model) {
    try {
      Penumbra::read_idf(model, "model.idf", "24.2");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(read("Version,24.2;"), HasSubstr("tea"));
  Penumbra::take_options({"--gpu-shading"});
  testing::internal::CaptureStderr();
  EXPECT_EQ(read("Version,23.1;"), "");
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("Version is 23.1, older than this EnergyPlus, 24.2"));
  EXPECT_THAT(read("GPUShading:TransparentShade,Foil,Screen,Constant,5;"), HasSubstr("Foil"));
}

TEST_F(PenumbraModel, SaysThatItHasOneMethod) {
  testing::internal::CaptureStderr();
  Penumbra::take_options({"--gpu-shading-method=scheduled"});
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("--gpu-shading-method scheduled: ignored"));
}

}  // namespace

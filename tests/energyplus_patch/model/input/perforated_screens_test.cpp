#include "model/input/perforated_screens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "energyplus_patch/files/test_images.h"
#include "gpu_shading/perforated_screen.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/model_file.h"
#include "model/model_reader.h"
#include "support/degree.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

constexpr char const* surfaces =
    "Shading:Site:Detailed,Panel 1;Shading:Site:Detailed,Panel 2;Shading:Zone:Detailed,Fin,Wall;";

PerforatedScreens read(std::string const& text) {
  auto const objects = read_idf(surfaces + text);
  auto const input = read_shading_input(objects);
  return read_perforated_screens(objects, input, read_transparent_shades(objects, input, {}),
                                 temporary(""));
}

// An object by its fields' names, in the dictionary's order.
std::string object(std::map<std::string, std::string> fields) {
  fields.try_emplace("name", "S");
  fields.try_emplace("surface_name", "Panel 1");
  fields.try_emplace("thickness", "0.003");
  std::string text = "GPUShading:PerforatedScreen";
  std::size_t used = 0;
  auto const types = extension_types();
  auto const type = std::find_if(types.begin(), types.end(), [](ExtensionType const& each) {
    return each.type == extension::perforated_screen::type;
  });
  for (auto const* const field : type->fields) {
    auto const found = fields.find(std::string(field->key));
    text += ',';
    if (found == fields.end()) continue;
    text += found->second;
    ++used;
  }
  EXPECT_EQ(used, fields.size()) << "a field that does not exist";
  return text + ";";
}

std::string pattern(std::map<std::string, std::string> fields = {}) {
  fields.try_emplace("hole_shape", "Round");
  fields.try_emplace("hole_size", "0.005");
  fields.try_emplace("pitch", "0.008");
  return object(std::move(fields));
}

std::string textured(std::map<std::string, std::string> fields = {}) {
  fields.try_emplace("hole_shape", "Texture");
  fields.try_emplace("texture_file_name", "checks.png");
  return object(std::move(fields));
}

// 2 x 1 texels, the first solid.
class Textured : public testing::Test {
 protected:
  Textured() { write_texture("checks.png", 2, 1, 1, {1, 0}); }
};

Polygon const panel{{{1, 0, 3}, {1, 0, 1}, {5, 0, 1}, {5, 0, 3}}, {}};

PerforatedScreen const& made(PerforatedScreens const& screens) {
  return *screens.by_surface.at("PANEL 1").maker->make(panel);
}

std::string described(std::string const& text, Polygon const& polygon = panel) {
  return read(text).by_surface.at("PANEL 1").maker->describe(polygon);
}

std::string refusal(std::string const& text) {
  return refusal_of([&] { read(text); });
}

TEST(PerforatedScreens, PatternOfEveryShape) {
  auto const round = read(pattern({{"row_pitch", "0.009"}, {"arrangement", "straight"}}));
  auto const& perforation = made(round).pattern()->perforation();
  EXPECT_EQ(perforation.hole, Hole::Round);
  EXPECT_EQ(perforation.arrangement, Arrangement::Straight);
  EXPECT_EQ(perforation.size, 0.005);
  EXPECT_EQ(perforation.pitch, 0.008);
  EXPECT_EQ(perforation.row_pitch, 0.009);
  EXPECT_EQ(made(round).sheet().thickness, 0.003);

  auto const plain = made(read(pattern())).pattern()->perforation();
  EXPECT_EQ(plain.arrangement, Arrangement::Staggered60);
  EXPECT_EQ(plain.row_pitch, 0.0);
  auto const diagonal = read(pattern({{"arrangement", "STAGGERED45"}, {"hole_shape", "square"}}));
  EXPECT_EQ(made(diagonal).pattern()->perforation().arrangement, Arrangement::Staggered45);
  EXPECT_EQ(made(diagonal).pattern()->perforation().hole, Hole::Square);
  auto const slots = read(pattern({{"hole_shape", "Slotted"},
                                   {"hole_length", "0.02"},
                                   {"pitch", "0.03"},
                                   {"row_pitch", "0.01"}}));
  EXPECT_EQ(made(slots).pattern()->perforation().length, 0.02);
  EXPECT_EQ(made(read(pattern({{"hole_shape", "Hexagonal"}}))).pattern()->perforation().hole,
            Hole::Hexagonal);
}

TEST(PerforatedScreens, SheetAndItsPlace) {
  auto const plain = read(pattern());
  EXPECT_EQ(made(plain).sheet().plane, SheetPlane::centre);
  EXPECT_EQ(made(plain).sheet().layers, std::nullopt);
  EXPECT_EQ(made(plain).sheet().detail, ScreenDetail::automatic);
  EXPECT_EQ(plain.by_surface.at("PANEL 1").deployment_schedule, "");

  auto const given = read(pattern({{"sheet_plane", "outside"},
                                   {"layers", "7"},
                                   {"detail", "Holes"},
                                   {"thickness", "0"},
                                   {"tile_origin_u", "0.1"},
                                   {"tile_origin_v", "-0.2"},
                                   {"tile_rotation", "30"},
                                   {"deployment_schedule_name", "Sails"}}));
  EXPECT_EQ(made(given).sheet().plane, SheetPlane::outside);
  EXPECT_EQ(made(given).sheet().layers, 7);
  EXPECT_EQ(made(given).sheet().detail, ScreenDetail::holes);
  EXPECT_EQ(made(given).sheet().thickness, 0.0);
  auto const& screen = given.by_surface.at("PANEL 1");
  auto const placement = screen.maker->placement(panel);
  EXPECT_EQ(placement.origin_u, 0.1);
  EXPECT_EQ(placement.origin_v, -0.2);
  EXPECT_NEAR(placement.rotation, 30 * degree, 1e-12);
  EXPECT_EQ(screen.deployment_schedule, "SAILS");

  auto const inside =
      read(pattern({{"sheet_plane", "Inside"}, {"layers", "auto"}, {"detail", "Effective"}}));
  EXPECT_EQ(made(inside).sheet().plane, SheetPlane::inside);
  EXPECT_EQ(made(inside).sheet().layers, std::nullopt);
  EXPECT_EQ(made(inside).sheet().detail, ScreenDetail::effective);
}

TEST(PerforatedScreens, SurfacesOfAnObjectShareAScreen) {
  auto const screens = read(pattern({{"surface_name", "panel *"}}));
  ASSERT_EQ(screens.by_surface.size(), 2U);
  EXPECT_EQ(screens.by_surface.at("PANEL 1").maker->make(panel),
            screens.by_surface.at("PANEL 2").maker->make({{{0, 0, 9}, {0, 0, 0}, {1, 0, 0}}, {}}));
}

TEST(PerforatedScreens, DescriptionsOfPatterns) {
  EXPECT_EQ(
      described(pattern()),
      "perforated (round holes 5 mm, 60 degrees staggered, pitch 8 mm, 35.4 % open, 3 mm thick)");
  EXPECT_EQ(described(pattern({{"hole_shape", "Square"}, {"arrangement", "Straight"}})),
            "perforated (square holes 5 mm, straight, pitch 8 mm, 39.1 % open, 3 mm thick)");
  EXPECT_EQ(described(pattern({{"hole_shape", "Slotted"},
                               {"hole_length", "0.02"},
                               {"pitch", "0.024"},
                               {"row_pitch", "0.01"}})),
            "perforated (slots 5 x 20 mm, staggered, pitch 24 mm, rows 10 mm apart, 39.4 % open, 3 "
            "mm thick)");
  EXPECT_EQ(described(pattern({{"hole_shape", "Hexagonal"}, {"arrangement", "Staggered45"}})),
            "perforated (hexagonal holes 5 mm, 45 degrees staggered, pitch 8 mm, 33.8 % open, 3 mm "
            "thick)");
}

TEST_F(Textured, TileCoversEachSurfaceOnce) {
  auto const screens = read(textured({{"surface_name", "*"}}));
  auto const& maker = screens.by_surface.at("PANEL 1").maker;
  auto const screen = maker->make(panel);
  EXPECT_NEAR(screen->tile()->width(), 4.0, 1e-12);
  EXPECT_NEAR(screen->tile()->height(), 2.0, 1e-12);
  EXPECT_EQ(screen->tile()->threshold(), 0.5);
  EXPECT_THAT(screen->tile()->opacity(), ElementsAre(65535, 0));
  // One tile of the same size but for rounding, and one of another.
  Polygon const elsewhere{{{7, 1, 2}, {7, 1, 0}, {7, 5, 0}, {7, 5, 2.00001}}, {}};
  EXPECT_EQ(maker->make(elsewhere), screen);
  Polygon const larger{{{7, 1, 2}, {7, 1, 0}, {7, 6, 0}, {7, 6, 2}}, {}};
  EXPECT_NEAR(maker->make(larger)->tile()->width(), 5.0, 1e-12);
  EXPECT_EQ(maker->make(larger)->tile()->opacity()[0], 65535);
  EXPECT_EQ(maker->describe(panel),
            "perforated (texture checks.png 2 x 1, 50.0 % open over 4 x 2 m tiles, 3 mm thick)");
}

TEST_F(Textured, TileBeginsAtTheCornerOfTheBoundingRectangle) {
  // A triangle whose second vertex is its lower right corner.
  Polygon const triangle{{{2, 0, 0}, {4, 0, 0}, {2, 0, 3}}, {}};
  auto const maker = read(textured()).by_surface.at("PANEL 1").maker;
  auto const width = std::hypot(2.0, 3.0);
  EXPECT_NEAR(maker->make(triangle)->tile()->width(), width, 1e-12);
  EXPECT_NEAR(maker->make(triangle)->tile()->height(), 6.0 / width, 1e-12);
  EXPECT_NEAR(maker->placement(triangle).origin_u, 0.0, 1e-12);
  EXPECT_NEAR(maker->placement(triangle).origin_v, 0.0, 1e-12);

  // Turned by a quarter, u runs up and v to the left.
  auto const turned =
      read(textured({{"tile_rotation", "90"}, {"tile_origin_u", "0.5"}})).by_surface.at("PANEL 1");
  EXPECT_NEAR(turned.maker->make(panel)->tile()->width(), 2.0, 1e-12);
  EXPECT_NEAR(turned.maker->make(panel)->tile()->height(), 4.0, 1e-12);
  EXPECT_NEAR(turned.maker->placement(panel).origin_u, 4.5, 1e-12);
  EXPECT_NEAR(turned.maker->placement(panel).origin_v, 0.0, 1e-12);
}

TEST_F(Textured, TileOfGivenSize) {
  auto const wide = read(textured({{"tile_width", "0.5"}}));
  EXPECT_NEAR(made(wide).tile()->width(), 0.5, 1e-12);
  EXPECT_NEAR(made(wide).tile()->height(), 0.25, 1e-12);
  auto const high = read(textured({{"tile_height", "0.5"}, {"tile_origin_v", "2"}}));
  EXPECT_NEAR(made(high).tile()->width(), 1.0, 1e-12);
  EXPECT_EQ(high.by_surface.at("PANEL 1").maker->placement(panel).origin_v, 2.0);
  auto const both = read(textured({{"tile_width", "0.5"}, {"tile_height", "0.7"}}));
  EXPECT_NEAR(made(both).tile()->height(), 0.7, 1e-12);
}

TEST_F(Textured, OpacityOfTexels) {
  EXPECT_EQ(made(read(textured({{"invert_opacity", "Yes"}}))).tile()->opacity()[0], 0);
  EXPECT_EQ(made(read(textured({{"invert_opacity", "no"}}))).tile()->opacity()[0], 65535);
  EXPECT_EQ(made(read(textured({{"opacity", "Fractional"}}))).tile()->threshold(), std::nullopt);
  EXPECT_EQ(made(read(textured({{"opacity", "Threshold"}, {"opacity_threshold", "0.25"}})))
                .tile()
                ->threshold(),
            0.25);
}

TEST_F(Textured, WhatIsSolidEverywhereIsWarnedOf) {
  write_texture("black.png", 2, 1, 2, {0, 1, 0, 1});
  auto const screens =
      read(textured({{"texture_file_name", "black.png"}, {"surface_name", "Panel*"}}));
  EXPECT_TRUE(screens.warnings().empty());
  made(screens);
  ASSERT_EQ(screens.warnings().size(), 1U);
  EXPECT_EQ(screens.warnings()[0],
            "GPUShading:PerforatedScreen S: black.png is solid everywhere, by its alpha channel");
}

TEST_F(Textured, TexelsAreReadOnce) {
  auto const path = write_texture("once.png", 2, 2, 1, {0, 0.25F, 0, 0.25F});
  auto const screens = read(textured({{"texture_file_name", "once.png"}}));
  auto const& maker = screens.by_surface.at("PANEL 1").maker;
  EXPECT_EQ(maker->make(panel)->open_fraction(), 1.0);
  std::filesystem::remove(path);
  Polygon const larger{{{7, 1, 2}, {7, 1, 0}, {7, 6, 0}, {7, 6, 2}}, {}};
  EXPECT_EQ(maker->make(larger)->open_fraction(), 1.0);
}

TEST_F(Textured, FileThatIsDamagedBehindItsHeader) {
  auto const message = [](char const* name) {
    return StartsWith("GPUShading:PerforatedScreen S: Texture File Name: " +
                      temporary(name).string() + ": cannot be read: ");
  };
  write_texture("half.png", 64, 64, 1, noise(64, 64, 1));
  cut(temporary("half.png"), 0.5);
  EXPECT_THAT(refusal(textured({{"texture_file_name", "half.png"}})), message("half.png"));
  // Of a large one, the header is read with the model.
  constexpr int side = 2100;
  write_texture("large.png", side, side, 1, noise(side, side, 1));
  cut(temporary("large.png"), 0.5);
  auto const screens = read(textured({{"texture_file_name", "large.png"}}));
  EXPECT_THAT(refusal_of([&] { made(screens); }), message("large.png"));
}

using Fields = std::map<std::string, std::string>;

void expect_refused(std::string const& text, std::string const& message) {
  EXPECT_THAT(refusal(text), StartsWith("GPUShading:PerforatedScreen S: " + message)) << text;
}

TEST(PerforatedScreens, PatternsThatAreNoneAreRefused) {
  for (auto const& [fields, message] : std::vector<std::pair<Fields, std::string>>{
           {{{"surface_name", "Tree*"}}, "Surface Name is \"Tree*\", which no shading surface"},
           {{{"hole_shape", ""}},
            "Hole Shape is blank, expected Texture, Round, Square, Slotted or "},
           {{{"hole_shape", "Oval"}}, "Hole Shape is \"Oval\", expected Texture, Round,"},
           {{{"arrangement", "Staggered"}},
            "Arrangement is \"Staggered\", expected Straight, Staggered45 or Staggered60"},
           {{{"hole_size", ""}}, "Hole Size is blank, expected a number from 1e-06 to 1000 m"},
           {{{"hole_size", "wide"}}, "Hole Size is \"wide\", expected a number from 1e-06"},
           {{{"hole_size", "0"}}, "Hole Size is \"0\", expected a number from 1e-06"},
           {{{"hole_size", "nan"}}, "Hole Size is \"nan\", expected a number from 1e-06"},
           {{{"hole_size", "0.01"}}, "Hole Size is 0.01 m, expected less than the pitch, 0.008 m"},
           {{{"hole_size", "0.0079"}, {"arrangement", "Straight"}, {"row_pitch", "0.0079"}},
            "Row Pitch is 0.0079 m, so holes overlap or touch"},
           {{{"hole_shape", "Slotted"}}, "Hole Length is blank"},
           {{{"hole_shape", "Slotted"}, {"hole_length", "0.004"}, {"pitch", "0.03"}},
            "Hole Length is 0.004 m, expected more than the hole size, 0.005 m"},
           {{{"hole_shape", "Slotted"}, {"hole_length", "0.02"}, {"pitch", "0.024"}}, "accepted"},
           {{{"hole_length", "0.02"}},
            "Hole Length is \"0.02\", expected blank with Hole Shape Round"},
           {{{"pitch", ""}}, "Pitch is blank"},
           {{{"pitch", "-1"}}, "Pitch is \"-1\", expected a number from 1e-06"},
           {{{"row_pitch", "0"}}, "Row Pitch is \"0\", expected a number from 1e-06"},
           {{{"row_pitch", "-0.01"}}, "Row Pitch is \"-0.01\", expected a number from 1e-06"},
           {{{"thickness", ""}}, "Thickness is blank"},
           {{{"thickness", "thin"}},
            "Thickness is \"thin\", expected a number of at least 0 and below 1 m"},
           {{{"thickness", "-0.001"}},
            "Thickness is \"-0.001\", expected a number of at least 0 and below 1 m"},
           {{{"thickness", "1"}},
            "Thickness is \"1\", expected a number of at least 0 and below 1 m"},
           {{{"thickness", "6.35"}},
            "Thickness is \"6.35\", expected a number of at least 0 and below 1 m: lengths are in "
            "metres; is it in millimetres (0.00635), centimetres (0.0635), inches (0.1613)?"},
           {{{"sheet_plane", "Front"}},
            "Sheet Plane is \"Front\", expected Centre, Outside or Inside"},
           {{{"layers", "0"}}, "Layers is \"0\", expected Auto or an integer from 1 to 64"},
           {{{"layers", "65"}}, "Layers is \"65\""},
           {{{"layers", "2.5"}}, "Layers is \"2.5\""},
           {{{"layers", "many"}}, "Layers is \"many\""},
           {{{"detail", "Fine"}}, "Detail is \"Fine\", expected Auto, Holes or Effective"},
           {{{"tile_origin_u", "left"}},
            "Tile Origin U is \"left\", expected a number from -100000 to 100000 m"},
           {{{"tile_origin_v", "inf"}}, "Tile Origin V is \"inf\", expected a number"},
           {{{"tile_rotation", "half"}},
            "Tile Rotation is \"half\", expected a number from -360 to 360 deg"},
           {{{"texture_file_name", "a.png"}},
            "Texture File Name is \"a.png\", expected blank with Hole Shape Round"},
           {{{"opacity", "Threshold"}}, "Opacity is \"Threshold\", expected blank with"},
           {{{"opacity_threshold", "0.5"}}, "Opacity Threshold is \"0.5\", expected blank with"},
           {{{"invert_opacity", "No"}}, "Invert Opacity is \"No\", expected blank with"},
           {{{"tile_width", "1"}}, "Tile Width is \"1\", expected blank with"},
           {{{"tile_height", "1"}}, "Tile Height is \"1\", expected blank with"},
       }) {
    if (message == "accepted") {
      EXPECT_EQ(refusal(pattern(fields)), message);
    } else {
      expect_refused(pattern(fields), message);
    }
  }
}

TEST_F(Textured, TexturesThatAreNoneAreRefused) {
  write_bytes("text.png", "no image");
  write_bytes("huge.tga", huge_targa());
  auto const file = [](std::string const& name) { return temporary(name).string(); };
  for (auto const& [fields, message] : std::vector<std::pair<Fields, std::string>>{
           {{{"texture_file_name", ""}},
            "Texture File Name is blank, expected the name of an image"},
           {{{"texture_file_name", "none.png"}},
            "Texture File Name: " + file("none.png") + ": no such file"},
           {{{"texture_file_name", "text.png"}},
            "Texture File Name: " + file("text.png") + ": cannot be read"},
           {{{"texture_file_name", "huge.tga"}},
            "Texture File Name: " + file("huge.tga") +
                ": is 20000 x 20000 texels, expected at most 16384 per side"},
           {{{"arrangement", "Straight"}},
            "Arrangement is \"Straight\", expected blank with Hole Shape Texture"},
           {{{"hole_size", "1"}}, "Hole Size is \"1\", expected blank with"},
           {{{"hole_length", "1"}}, "Hole Length is \"1\", expected blank with"},
           {{{"pitch", "1"}}, "Pitch is \"1\", expected blank with"},
           {{{"row_pitch", "1"}}, "Row Pitch is \"1\", expected blank with"},
           {{{"opacity", "Half"}}, "Opacity is \"Half\", expected Threshold or Fractional"},
           {{{"opacity_threshold", "1"}},
            "Opacity Threshold is \"1\", expected a number of at least 0 and below 1"},
           {{{"opacity_threshold", "-0.1"}},
            "Opacity Threshold is \"-0.1\", expected a number of at least 0 and below 1"},
           {{{"opacity_threshold", "0.5"}, {"opacity", "Fractional"}},
            "Opacity Threshold is \"0.5\", expected blank with Opacity Fractional"},
           {{{"invert_opacity", "maybe"}}, "Invert Opacity is \"maybe\", expected Yes or No"},
           {{{"tile_width", "0"}}, "Tile Width is \"0\", expected a number from 1e-06"},
           {{{"tile_width", "wide"}}, "Tile Width is \"wide\", expected a number from 1e-06"},
           {{{"tile_height", "-1"}}, "Tile Height is \"-1\", expected a number from 1e-06"},
           {{{"thickness", "2"}},
            "Thickness is \"2\", expected a number of at least 0 and below 1 m"},
       }) {
    expect_refused(textured(fields), message);
  }
}

TEST(PerforatedScreens, SurfaceNamedTwiceIsRefused) {
  EXPECT_EQ(refusal(pattern({{"name", "First"}, {"surface_name", "Panel*"}}) + pattern()),
            "GPUShading:PerforatedScreen S: Surface Name \"Panel 1\": PANEL 1 is named by First "
            "already");
  EXPECT_EQ(refusal("GPUShading:TransparentShade,Glass,Panel 1,Constant,0.5;" + pattern()),
            "GPUShading:PerforatedScreen S: Surface Name \"Panel 1\": PANEL 1 is named by "
            "GPUShading:TransparentShade Glass already");
}

TEST_F(Textured, IdfEpJsonAndSideFileAreAlike) {
  auto const screen = textured({{"surface_name", "panel *"},
                                {"layers", "3"},
                                {"opacity_threshold", "0.25"},
                                {"tile_width", "0.5"},
                                {"tile_rotation", "45"},
                                {"invert_opacity", "Yes"},
                                {"deployment_schedule_name", "Sails"}});
  auto const epjson = nlohmann::json::parse(R"({
    "Shading:Site:Detailed": {"Panel 1": {}, "Panel 2": {}},
    "GPUShading:PerforatedScreen": {"S": {"surface_name": "panel *", "hole_shape": "Texture",
      "texture_file_name": "checks.png", "thickness": 0.003, "layers": 3, "opacity_threshold": 0.25,
      "tile_width": 0.5, "tile_rotation": 45, "invert_opacity": "Yes",
      "deployment_schedule_name": "Sails"}}})");
  auto const path = [](std::string const& name) { return temporary(name); };
  write_bytes("inside.idf", surfaces + screen);
  write_bytes("inside.epJSON", epjson.dump());
  write_bytes("beside.idf", surfaces);
  write_bytes("beside.gpu-shading.idf", screen);
  for (auto const* name : {"inside.idf", "inside.epJSON", "beside.idf"}) {
    auto const model = read_model(path(name), {});
    ASSERT_EQ(model.screens.by_surface.size(), 2U) << name;
    auto const& entry = model.screens.by_surface.at("PANEL 2");
    EXPECT_EQ(entry.deployment_schedule, "SAILS");
    EXPECT_NEAR(entry.maker->placement(panel).rotation, 45 * degree, 1e-12);
    auto const made_screen = entry.maker->make(panel);
    EXPECT_EQ(made_screen->sheet().layers, 3);
    EXPECT_EQ(made_screen->tile()->threshold(), 0.25);
    EXPECT_NEAR(made_screen->tile()->height(), 0.25, 1e-12);
    EXPECT_EQ(made_screen->tile()->opacity()[0], 0);
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus

#include "model/lean_input.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "model/idf/model_file.h"
#include "model/idf/placeholders.h"
#include "model/shading_outlines.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string const rules = "GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;\n";
std::string const corners = "0,0,3,0,0,0,4,0,0,4,0,3;\n";

std::string shade(std::string const& name, std::string const& schedule = "") {
  return fmt::format("Shading:Building:Detailed,{},{},,{}", name, schedule, corners);
}

LeanInput plan(std::string const& idf, Lean lean = Lean::on, EnergyPlusRays const& rays = {}) {
  auto const parsed = parse_idf(idf);
  auto const objects = read_idf(parsed);
  Options options;
  options.lean = lean;
  return plan_lean_input(objects, read_shading_input(objects), options, rays,
                         [&](Names const& names) { return find_mentions(parsed, names); });
}

TEST(LeanInput, SurfacesThatOnlyShadeAreLeftOut) {
  auto const lean = plan(rules + shade("One") + shade("Two"));
  EXPECT_EQ(lean.left_out, (Names{"ONE", "TWO"}));
  ASSERT_EQ(lean.casters.size(), 2U);
  EXPECT_EQ(lean.casters[0].name, "ONE");
  EXPECT_EQ(lean.casters[0].polygon.outline.size(), 4U);
  EXPECT_THAT(lean.remark, HasSubstr("2 shading surfaces hidden"));
}

TEST(LeanInput, WhatIsNamedOrNotUnderstoodStays) {
  auto const lean = plan(rules + shade("Gone") + shade("Used") + shade("Twice") + shade("twice") +
                         "Generator:Photovoltaic,Cells,used;\n"
                         "Shading:Site:Detailed,Short,,4,0,0,3,0,0,0,4,0,0;\n"
                         "Shading:Site:Detailed,Odd,,,0,0,3,0,0,x,4,0,0;\n"
                         "Shading:Zone:Detailed,Lost,No Such Wall,,," +
                         corners + "Output:Variable,*,Surface Outside Face Sunlit Fraction;\n");
  EXPECT_EQ(lean.left_out, (Names{"GONE"}));
  EXPECT_THAT(lean.remark, HasSubstr("USED, which Generator:Photovoltaic names"));
  EXPECT_THAT(lean.remark, HasSubstr("key *"));
}

TEST(LeanInput, EverySchedulePutsUpAPlaceholder) {
  auto const lean = plan(rules + shade("One", "Leaves") + shade("Two", "LEAVES") +
                         shade("Three", "Glass") + shade("GPU Shading Placeholder 1"));
  std::vector<std::string> names;
  std::vector<std::string> schedules;
  for (auto const& placeholder : lean.placeholders) {
    names.push_back(placeholder.name);
    schedules.push_back(placeholder.schedule);
  }
  EXPECT_THAT(schedules, ElementsAre("", "", "", "", "Leaves", "Glass"));
  EXPECT_EQ(names.front(), "GPU SHADING PLACEHOLDER 2");
  EXPECT_TRUE(lean.is_placeholder(names.back()));
  EXPECT_FALSE(lean.is_placeholder("ONE"));
}

TEST(LeanInput, SomeEndOfAPlaceholderIsBeforeEveryPlane) {
  auto const lean = plan(rules + shade("One"));
  std::vector<glm::dvec3> ends;
  for (auto const& placeholder : lean.placeholders) {
    auto const fields = idf_fields(placeholder_object(placeholder));
    ASSERT_EQ(fields.size(), 3U + 4U * 3U);
    Polygon pole;
    for (std::size_t i = 3; i < fields.size(); i += 3) {
      pole.outline.emplace_back(std::stod(fields[i]), std::stod(fields[i + 1]),
                                std::stod(fields[i + 2]));
    }
    ends.insert(ends.end(), pole.outline.begin(), pole.outline.end());
    // Level, towards the model.
    EXPECT_LT(glm::dot(normal(pole), pole.outline[0]), 0.0);
    EXPECT_NEAR(normal(pole).z, 0.0, 1e-6);
    // What of the sky it hides, in radians of its width.
    EXPECT_LT(glm::distance(pole.outline[1], pole.outline[2]) / glm::length(pole.outline[1]), 1e-6);
  }
  // Planes through the edge of a model of 100 km, whatever way they face.
  for (int azimuth = 0; azimuth < 360; azimuth += 7) {
    for (int tilt = 0; tilt <= 180; tilt += 5) {
      double const a = glm::radians(static_cast<double>(azimuth));
      double const t = glm::radians(static_cast<double>(tilt));
      glm::dvec3 const facing(std::sin(t) * std::sin(a), std::sin(t) * std::cos(a), std::cos(t));
      EXPECT_TRUE(std::any_of(ends.begin(), ends.end(),
                              [&](glm::dvec3 const& end) { return glm::dot(facing, end) > 1e5; }))
          << azimuth << ' ' << tilt;
    }
  }
}

TEST(LeanInput, FewSurfacesStayUnlessAskedFor) {
  std::string idf = rules;
  for (std::size_t i = 1; i < fewest_left_out; ++i) idf += shade(fmt::format("S{}", i));
  EXPECT_FALSE(plan(idf, Lean::automatic).active());
  EXPECT_EQ(plan(idf, Lean::automatic).remark, "");
  idf += shade("Last");
  EXPECT_TRUE(plan(idf, Lean::automatic).active());
  EXPECT_FALSE(plan(idf, Lean::off).active());
}

std::string slat(std::string const& name, double z) {
  return fmt::format("Shading:Building:Detailed,{0},,,0,-1,{2},0,-1,{1},4,-1,{1},4,-1,{2};\n", name,
                     z, z + 0.004);
}

TEST(LeanInput, SurfacesThatEnergyPlusWouldSimplifyAreLeftOutHoweverFew) {
  auto const idf = rules + shade("Wide") + slat("Thin", 1.0) + slat("Used", 2.0) +
                   "Output:Variable,Mir-Used,Surface Outside Face Sunlit Fraction;";
  auto const lean = plan(idf, Lean::automatic);
  EXPECT_EQ(lean.left_out, (Names{"THIN"}));
  ASSERT_EQ(lean.casters.size(), 1U);
  EXPECT_EQ(lean.casters[0].polygon.outline.size(), 4U);
  auto const objects = read_idf(idf);
  auto const found = find_simplified_surfaces(objects, read_shading_input(objects), lean.left_out);
  ASSERT_EQ(found.outlines.size(), 1U);
  EXPECT_NEAR(area({found.outlines.at("USED"), {}}), 4 * 0.004, 1e-5);
  EXPECT_THAT(found.warning,
              HasSubstr("of 1 shading surface: USED; it calls 1 of them degenerate"));
}

TEST(LeanInput, OutlinesThatCannotBeReproducedStayEnergyPluss) {
  auto const objects = read_idf(rules + slat("A", 1.0) + shade("B") + "GeometryTransform,XY,1,2;");
  auto const found = find_simplified_surfaces(objects, read_shading_input(objects), {});
  EXPECT_TRUE(found.outlines.empty());
  EXPECT_THAT(found.warning, HasSubstr("their shadows are simplified too (GeometryTransform"));
}

TEST(LeanInput, MovingScreensPutUpAPlaceholderForTheSky) {
  auto lean = plan(rules + shade("One"));
  EXPECT_TRUE(own_schedules(lean.placeholders, {}).empty());
  add_sky_placeholder(lean, {});
  ASSERT_EQ(lean.placeholders.size(), 5U);
  EXPECT_EQ(lean.placeholders[4].name, "GPU SHADING PLACEHOLDER 5");
  Rewrite rewrite{shading_method("PixelCounting")};
  ASSERT_EQ(own_schedules(lean.placeholders, {}).size(), 1U);
  rewrite.added = schedule_objects(own_schedules(lean.placeholders, {}).front());
  rewrite.added.push_back(placeholder_object(lean.placeholders[4]));
  std::string const own = "ShadowCalculation,PixelCounting,Periodic;";
  auto const text = rewrite_idf(own, parse_idf(own), rewrite);
  auto const schedule = lean.placeholders[4].schedule;
  EXPECT_THAT(text, HasSubstr("Schedule:Compact,\n  " + schedule + ","));
  EXPECT_THAT(text, HasSubstr("GPU SHADING PLACEHOLDER 5"));
  nlohmann::json model = nlohmann::json::object();
  rewrite_epjson(model, rewrite);
  EXPECT_EQ(model.at("Schedule:Compact").at(schedule).at("data").size(), 6U);
}

TEST(LeanInput, ReasonsAreGiven) {
  auto const reason = [](std::string const& more) {
    auto const lean = plan(rules + shade("One") + more);
    EXPECT_FALSE(lean.active());
    EXPECT_THAT(lean.remark, StartsWith("lean input is off: "));
    return lean.remark;
  };
  EXPECT_THAT(reason("Building,B,,,,,FullExteriorWithReflections;"), HasSubstr("reflections"));
  EXPECT_THAT(reason("Daylighting:Controls,Light;"), HasSubstr("Daylighting:Controls Light"));
  EXPECT_THAT(reason("GeometryTransform,XY,1,2;"), HasSubstr("GeometryTransform"));
  EXPECT_THAT(reason("Output:Variable,One[,Surface Outside Face Sunlit Fraction;"),
              HasSubstr("Key Value is \"One[\""));
}

TEST(LeanInput, DaylightingWhoseRaysAreAnsweredDoesNotForbidIt) {
  auto const light = rules + shade("Pane") + shade("Wall") + "Daylighting:Controls,Light;";
  EXPECT_EQ(plan(light, Lean::on, {true, {}}).left_out, (Names{"PANE", "WALL"}));
  // Of a few surfaces, those that the rays would take as opaque.
  EXPECT_EQ(plan(light, Lean::automatic, {true, {"PANE"}}).left_out, (Names{"PANE"}));
  EXPECT_FALSE(plan(light, Lean::automatic, {true, {}}).active());
}

TEST(LeanInput, ReflectionsOfEnergyPlusKeepAllSurfaces) {
  std::string idf = rules + "Building,B,,,,,FullExteriorWithReflections;";
  for (std::size_t i = 1; i < fewest_with_reflections; ++i) idf += shade(fmt::format("S{}", i));
  EXPECT_EQ(plan(idf, Lean::automatic).remark, "");
  EXPECT_FALSE(has_many_for_reflections(read_idf(idf), Lean::automatic));
  EXPECT_TRUE(has_many_for_reflections(read_idf(idf), Lean::on));
  idf += shade("Last");
  EXPECT_THAT(plan(idf, Lean::automatic).remark, HasSubstr("asks for reflections"));
  EXPECT_TRUE(has_many_for_reflections(read_idf(idf), Lean::automatic));
  EXPECT_FALSE(has_many_for_reflections(read_idf(idf), Lean::off));
}

TEST(LeanInput, TheRestOfTheTextIsKept) {
  std::string const kept = "! note\nZone,A; ! last\n" + shade("Stays");
  std::string const gone = shade("Goes") + "ShadingProperty:Reflectance,goes,0.3;\n";
  Rewrite rewrite{shading_method("PixelCounting"), {"GOES"}};
  for (auto const& each : make_placeholders({}, {})) {
    rewrite.added.push_back(placeholder_object(each));
  }
  auto const model = "ShadowCalculation,PixelCounting,Periodic;" + kept + gone;
  auto const text = rewrite_idf(model, parse_idf(model), rewrite);
  EXPECT_THAT(text, HasSubstr(kept));
  EXPECT_THAT(text, Not(HasSubstr("oes,")));
  EXPECT_EQ(read_idf(text).size(), 7U);  // with four placeholders
}

TEST(LeanInput, EpJsonIsRewrittenAlike) {
  auto model = nlohmann::json::parse(R"({"Zone": {"A": {}},
    "Shading:Site:Detailed": {"Stays": {}, "Goes": {}}, "Shading:Zone:Detailed": {"Goes": {}},
    "ShadingProperty:Reflectance": {"R 1": {"shading_surface_name": "goes"}}})");
  Rewrite rewrite{shading_method("PixelCounting"), {"GOES"}};
  for (auto const& each : make_placeholders({"Half"}, {})) {
    rewrite.added.push_back(placeholder_object(each));
  }
  rewrite_epjson(model, rewrite);
  EXPECT_FALSE(model.contains("ShadingProperty:Reflectance"));
  EXPECT_FALSE(model.contains("Shading:Zone:Detailed"));
  auto const& site = model.at("Shading:Site:Detailed");
  EXPECT_EQ(site.size(), 6U);
  EXPECT_EQ(site.at("GPU SHADING PLACEHOLDER 5").at("transmittance_schedule_name"), "Half");
  EXPECT_EQ(site.at("GPU SHADING PLACEHOLDER 1").at("vertices").size(), 4U);
}

}  // namespace
}  // namespace gpu_shading::energyplus

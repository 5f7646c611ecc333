#include "model/idf/model_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

std::string refusal_of_idf(std::string const& text) {
  return refusal_of([&] { check_idf_text(text, parse_idf(text)); });
}

TEST(ModelText, MistakesAreNamed) {
  EXPECT_EQ(refusal_of_idf("Version,9.6;\nZone,A;"), "accepted");
  EXPECT_EQ(refusal_of_idf(""), "has no objects; expected a model");
  EXPECT_EQ(refusal_of_idf("! OS:Version\n"), "has no objects; expected a model");
  EXPECT_EQ(refusal_of_idf("OS:Version,{1},3.9.0;"),
            "is an OpenStudio model; expected an IDF: export it from OpenStudio");
  EXPECT_TRUE(refusal_of_idf("A,1;\r\n\r\n##include b.idf\r\n")
                  .starts_with("line 3: ##include is a macro: "));
  EXPECT_TRUE(refusal_of_idf("A,\n  ##if x\n 1;").starts_with("line 2: ##if is a macro: "));
  EXPECT_EQ(refusal_of_idf("A,1;  ! ## heading\n! ##include\nB,room ##2,## 5;"), "accepted");
}

TEST(ModelText, Utf16IsNamed) {
  EXPECT_EQ(refusal_of_idf(std::string("\xFF\xFEV\0", 4)),
            "is not UTF-8 text (UTF-16?): save it as UTF-8");
}

TEST(ModelText, NamesInOtherEncodingsAreFoundByTheirLine) {
  EXPECT_EQ(refusal_of_idf("Version,9.6;\nZone,\n  B\xFCro;"),
            "line 3: Zone B\xEF\xBF\xBDro is not UTF-8 text (Latin-1?): save the file as UTF-8");
  EXPECT_EQ(refusal_of_idf("Zone,B\xC3\xBCro;"), "accepted");
  EXPECT_EQ(refusal_of_idf("Zone,A;  ! B\xFCro"), "accepted");
}

TEST(ModelText, OtherJsonIsNamed) {
  auto const check = [](char const* text) {
    return refusal_of([&] { check_epjson(nlohmann::json::parse(text)); });
  };
  EXPECT_EQ(check("{}"), "has no objects; expected a model");
  EXPECT_TRUE(check(R"({"type": "Model"})").starts_with("is JSON of another program"));
  EXPECT_EQ(check(R"({"Zone": {"A": {}}})"), "accepted");
}

TEST(ModelText, TemplatesAreFound) {
  EXPECT_EQ(find_template(parse_idf("A,1;hvactemplate:thermostat,All;")),
            "hvactemplate:thermostat");
  EXPECT_EQ(find_template(parse_idf("GroundHeatTransfer:Control,A;")),
            "GroundHeatTransfer:Control");
  EXPECT_EQ(find_template(parse_idf("A,HVACTemplate:Thermostat; ! HVACTemplate:Thermostat")), "");
}

}  // namespace
}  // namespace gpu_shading::energyplus

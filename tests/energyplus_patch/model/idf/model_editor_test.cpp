#include "model/idf/model_editor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/idf/idf_text.h"
#include "platform/files.h"
#include "platform/process.h"
#include "runs/named_files.h"

namespace gpu_shading::energyplus {
namespace {

namespace fs = std::filesystem;

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

constexpr FieldPosition axis{1, "north_axis"};
constexpr FieldPosition terrain{2, "terrain"};

void change(ModelEditor& model) {
  model.remove([](std::string_view type) { return type == "Output:Variable"; });
  model.edit("BUILDING", [](EditedObject& building) {
    EXPECT_EQ(building.get(axis), "30");
    EXPECT_EQ(building.get(terrain), "");
    building.set(axis, 45);
    building.set(terrain, "City");
  });
  model.add({"Zone", {{"name", "Hall"}, {"direction_of_relative_north", 10}}});
}

TEST(ModelEditor, Idf) {
  auto const model = edit_idf("Building,House,30; ! north\nOutput:Variable,*,Sun;\n");
  change(*model);
  auto const objects = parse_idf(model->text());
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_THAT(objects[0].fields, ElementsAre("House", "45", "City"));
  EXPECT_EQ(objects[1].type, "Zone");
  EXPECT_THAT(objects[1].fields, ElementsAre("Hall", "10"));
}

TEST(ModelEditor, Epjson) {
  auto const model = edit_epjson(nlohmann::json::parse(
      R"({"Building": {"House": {"north_axis": 30}}, "Output:Variable": {"O 1": {}}})"));
  change(*model);
  auto const changed = nlohmann::json::parse(model->text());
  EXPECT_EQ(changed,
            nlohmann::json::parse(R"({"Building": {"House": {"north_axis": 45, "terrain": "City"}},
                                      "Zone": {"Hall": {"direction_of_relative_north": 10}}})"));
}

TEST(ModelEditor, EditsAllTexts) {
  auto const extend = [](std::string& text) { text += '+'; };
  auto const idf = edit_idf("Schedule:File,S,,data.csv;");
  idf->edit_texts(extend);
  EXPECT_THAT(parse_idf(idf->text())[0].fields, ElementsAre("S+", "+", "data.csv+"));
  auto const epjson = edit_epjson(
      nlohmann::json::parse(R"({"Building": {"House": {"north_axis": 30, "terrain": "City"}}})"));
  epjson->edit_texts(extend);
  EXPECT_EQ(
      nlohmann::json::parse(epjson->text()),
      nlohmann::json::parse(R"({"Building": {"House": {"north_axis": 30, "terrain": "City+"}}})"));
}

TEST(NamedFiles, ThatLeaveTheFolderAreNamedByTheirWholePath) {
  TemporaryFolder const folder;
  std::ofstream(folder.path() / "data.csv") << "1\n";
  auto const model = edit_idf("Schedule:File,S,,../data.csv,1;Schedule:File,T,,../none.csv,1;");
  for (auto const* const name : {"models", "placed"}) {
    std::filesystem::create_directory(folder.path() / name);
  }
  bring_named_files(*model, folder.path() / "models" / "model.idf", folder.path() / "placed");
  auto const objects = parse_idf(model->text());
  EXPECT_EQ(objects[0].fields[2], std::filesystem::canonical(folder.path() / "data.csv"));
  EXPECT_EQ(objects[1].fields[2], "../none.csv");
}

// The links in a folder and in folders within it.
std::vector<std::string> links_in(fs::path const& folder) {
  std::vector<std::string> names;
  for (auto const& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_symlink()) names.push_back(entry.path().lexically_relative(folder));
  }
  return names;
}

class FilesBesideAModel : public testing::Test {
 protected:
  FilesBesideAModel() {
    for (auto const* const name :
         {"occupancy.csv", "data/light.csv", "data/other.csv", "eplusout.sql", "eplusout.eso",
          "out/eplusout.err", "notes.txt", "Zone", "plugin.py", "package/__init__.py",
          "modules/more.py", "search/fonts.txt", "Window5DataFile.dat", "model.rvi", "old.rvi"}) {
      fs::create_directories((models / name).parent_path());
      std::ofstream(models / name) << name;
    }
    fs::create_directory(models / "placed");
  }

  std::vector<std::string> linked_for(ModelEditor& model) const {
    bring_named_files(model, models / "model.idf", models / "placed");
    return links_in(models / "placed");
  }

  TemporaryFolder folder;
  fs::path models = folder.path() / "models";
};

TEST_F(FilesBesideAModel, AreLinkedIfItNamesThem) {
  auto const idf = edit_idf(
      "Schedule:File,S,,occupancy.csv,1;Schedule:File,T,,data\\light.csv,1;Zone,out;"
      "Schedule:File,U,,./data/light.csv,1;Schedule:File,V,,none.csv,1;");
  EXPECT_THAT(linked_for(*idf),
              UnorderedElementsAre("occupancy.csv", "data/light.csv", "model.rvi"));
  EXPECT_EQ(read_text_file(models / "placed" / "data" / "light.csv"), "data/light.csv");
}

TEST_F(FilesBesideAModel, AreLinkedForAnEpjson) {
  auto const epjson = edit_epjson(nlohmann::json::parse(
      R"({"Schedule:File": {"S": {"file_name": "occupancy.csv"}}, "Zone": {"out": {}}})"));
  EXPECT_THAT(linked_for(*epjson), UnorderedElementsAre("occupancy.csv", "model.rvi"));
}

TEST_F(FilesBesideAModel, AreLinkedIfEnergyPlusKnowsTheirNames) {
  auto const idf = edit_idf("Construction:WindowDataFile,Glass;");
  EXPECT_THAT(linked_for(*idf), UnorderedElementsAre("Window5DataFile.dat", "model.rvi"));
}

TEST_F(FilesBesideAModel, AreLinkedIfAPluginMayImportThem) {
  auto const idf = edit_idf(
      "PythonPlugin:Instance,P,Yes,plugin,Class;PythonPlugin:SearchPaths,Paths,Yes,Yes,No,search;");
  EXPECT_THAT(linked_for(*idf),
              UnorderedElementsAre("plugin.py", "package", "modules", "search", "model.rvi"));
}

}  // namespace
}  // namespace gpu_shading::energyplus

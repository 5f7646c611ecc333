#include "tasks/task_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/process.h"

namespace gpu_shading::energyplus {
namespace {

// Names in IDF files may be in Latin-1.
constexpr char const* not_utf8 =
    "FA\xC7"
    "ADE";

TEST(TaskFile, TasksComeBackAsTheyWere) {
  TemporaryFolder const folder;
  auto const file = folder.path() / "task";
  std::vector<Task> const tasks{
      ListingTask{},
      ListingTask{true},
      ListingTask{false, true},
      ViewsTask{{{"1.png", {std::sqrt(2.0), 1.0 / 3.0}, not_utf8},
                 {"2.gif", {}, "", SunDirection{0.5, 1.0 / 3.0}}},
                folder.path() / not_utf8,
                640,
                true},
      SamplesTask{"medium samples", -std::acos(0.75), folder.path() / "parts", {3, 8}, 7, 0.5},
      MapTask{not_utf8,
              0.1,
              4,
              {4, {{6, 21, 12, 3, {1.0 / 3.0, 0.5}, {0.25}, 812.5}}, {"HEDGE"}},
              folder.path() / not_utf8,
              7},
      DirectionsTask{{{1.0 / 3.0, 0.5}, {}}, folder.path() / not_utf8},
      MaskTask{not_utf8, 2, 16, 0.1, {{1.0 / 3.0, 0.5}}, folder.path() / not_utf8, 7},
      ModulesTask{{4, {{6, 21, 12, 3, {1.0 / 3.0, 0.5}, {0.25}, 812.5}}, {"HEDGE"}},
                  folder.path() / not_utf8,
                  folder.path() / not_utf8,
                  7}};
  for (auto const& task : tasks) {
    write_request(file, {task, folder.path() / "reply"});
    auto const request = read_request(file);
    EXPECT_TRUE(request.task == task) << task.index();
    EXPECT_EQ(request.reply, folder.path() / "reply");
  }
}

TEST(TaskFile, RepliesComeBackAsTheyWere) {
  TemporaryFolder const folder;
  auto const file = folder.path() / "reply";
  EXPECT_FALSE(find_reply(file));
  for (auto const& reply : {TaskReply{std::string(not_utf8) + "\n1 surfaces\n", {"a", "b"}, ""},
                            TaskReply{"", {}, "model.idf: no such file"}}) {
    write_reply(file, reply);
    EXPECT_TRUE(find_reply(file) == reply);
  }
}

TEST(TaskFile, MasksComeBackAsTheyWere) {
  TemporaryFolder const folder;
  auto const file = folder.path() / "masks";
  BeamShare const share{true, 1.0F / 3.0F, {0.25F, 0.0F, 0.125F}};
  write_masks(file, {{{not_utf8, {0.1, 0.2, 0.3}}, std::nullopt, {share, {}}, {share}},
                     {{"B", {1, 0, 0}}, glm::dvec3(1.0 / 3.0, 2, 3), {}, {}}});
  auto const masks = read_masks(file);
  ASSERT_EQ(masks.size(), 2U);
  EXPECT_EQ(masks[0].receiver, (SampledReceiver{not_utf8, {0.1, 0.2, 0.3}}));
  EXPECT_EQ(masks[0].sky, (std::vector<BeamShare>{share, {}}));
  EXPECT_EQ(masks[0].suns, std::vector<BeamShare>{share});
  EXPECT_FALSE(masks[0].point);
  EXPECT_EQ(masks[1].point, glm::dvec3(1.0 / 3.0, 2, 3));
}

TEST(TaskFile, OtherFilesAreErrors) {
  TemporaryFolder const folder;
  auto const file = folder.path() / "task";
  EXPECT_THROW(read_request(file), Error);
  write_request(file, {ListingTask{}, folder.path() / "reply"});
  auto const whole = read_text_file(file);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream(file) << whole.substr(0, length);
    EXPECT_THROW(read_request(file), Error) << length;
  }
  std::ofstream(file) << "Version,9.6;";
  EXPECT_THROW(read_request(file), Error);
}

}  // namespace
}  // namespace gpu_shading::energyplus

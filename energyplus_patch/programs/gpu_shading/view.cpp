#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <regex>
#include <sstream>
#include <utility>

#include "files/pictures.h"
#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/site/site_clock.h"
#include "platform/console.h"
#include "platform/process.h"
#include "platform/staged_files.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "tasks/view_list.h"

namespace gpu_shading::energyplus {
namespace {

namespace chrono = std::chrono;
using Path = std::filesystem::path;

// A time to draw.
struct SunTime {
  std::string caption;  // "06-21 15:00", or empty for a direction alone
  SunDirection sun;     // above the horizon
};

chrono::local_days day_of(char const* option, std::smatch const& words, SiteClock const& clock) {
  chrono::year const year = words[1].matched ? chrono::year(std::stoi(words[1])) : clock.year();
  auto const date = year / std::stoi(words[2]) / std::stoi(words[3]);
  if (!date.ok()) {
    throw Error(fmt::format("{} \"{}\": {} has no such day", option, words[0].str(),
                            static_cast<int>(year)));
  }
  return chrono::local_days(date);
}

std::string caption_of(ClockTime time) {
  chrono::year_month_day const date(chrono::floor<chrono::days>(time));
  chrono::hh_mm_ss const clock(time - chrono::floor<chrono::days>(time));
  return fmt::format("{:02}-{:02} {:02}:{:02}", static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count());
}

std::vector<SunTime> times_of(chrono::local_days day, SiteClock const& clock,
                              chrono::minutes step) {
  std::vector<SunTime> times;
  for (ClockTime time = day; time < day + chrono::days(1); time += step) {
    auto const sun = clock.sun(time);
    if (sun.altitude > 0.0) times.push_back({caption_of(time), sun});
  }
  return times;
}

// "MM-DD HH:MM" in the site's clock time, optionally preceded by a year and a hyphen. Throws Error
// if it is invalid, or if the sun is down.
SunTime sun_time(std::string const& text, SiteClock const& clock) {
  static std::regex const form(R"((?:(\d{4})-)?(\d\d?)-(\d\d?)[ T](\d\d?):(\d\d))");
  std::smatch words;
  if (!std::regex_match(text, words, form)) {
    throw Error(
        fmt::format("--at \"{}\": expected month, day and time, as in \"06-21 15:00\"", text));
  }
  auto const day = day_of("--at", words, clock);
  auto const time = day + chrono::hours(std::stoi(words[4])) + chrono::minutes(std::stoi(words[5]));
  if (std::stoi(words[5]) >= 60 || time > day + chrono::days(1)) {
    throw Error(fmt::format("--at \"{}\": expected a time from 00:00 to 24:00", text));
  }
  auto const sun = clock.sun(time);
  if (sun.altitude <= 0.0) {
    throw Error(fmt::format("--at \"{}\": the sun is down, {:.1f} degrees below the horizon", text,
                            -glm::degrees(sun.altitude)));
  }
  return {caption_of(time), sun};
}

// The multiples of the step in clock time from sunrise to sunset of "MM-DD", optionally with a
// year. Throws Error if it is not a day, or if the sun does not rise.
std::vector<SunTime> sun_times(std::string const& text, SiteClock const& clock,
                               std::chrono::minutes step) {
  static std::regex const form(R"((?:(\d{4})-)?(\d\d?)-(\d\d?))");
  std::smatch words;
  if (!std::regex_match(text, words, form)) {
    throw Error(fmt::format("--day \"{}\": expected month and day, as in 06-21", text));
  }
  auto const day = day_of("--day", words, clock);
  auto times = times_of(day, clock, step);
  // The sun may be up only between two steps.
  if (times.empty()) times = times_of(day, clock, chrono::minutes(1));
  if (times.empty()) throw Error(fmt::format("--day \"{}\": the sun does not rise", text));
  return times;
}

struct Look {
  int size;    // pixels
  bool range;  // of moving shades
};

// Views in a folder of their own, under the names of their pictures.
struct DrawnViews {
  Path folder;
  std::vector<std::string> fractions;  // of each view's receiver
};

DrawnViews draw_in(Path const& temporary, ModelRun const& run, std::vector<SunView> const& views,
                   Look const& look) {
  auto drawn = temporary / "views";
  std::filesystem::create_directory(drawn);
  auto const reply = run_task(run, ViewsTask{views, drawn, look.size, look.range});
  for (auto const& warning : reply.warnings) {
    print_line("warning: " + warning);
  }
  DrawnViews found{std::move(drawn), {}};
  std::istringstream lines(reply.text);
  for (std::string line; std::getline(lines, line);) found.fractions.push_back(line);
  found.fractions.resize(views.size());
  return found;
}

// All pictures of a list, or none.
void draw(ModelRun const& run, std::vector<SunView> const& views, Path const& folder,
          Look const& look) {
  if (views.empty()) throw Error("no picture was requested");
  // Before the time is spent: whether the folder can be written to.
  StagedFiles files(folder);
  TemporaryFolder const temporary;
  auto const drawn = draw_in(temporary.path(), run, views, look).folder;
  for (auto const& view : views) files.copy(view.picture, drawn / view.picture);
  files.commit();
}

// A view below its caption.
struct CaptionedView {
  SunView view;  // under any name
  std::string caption;
};

// Lines above a picture: the receiver or the model, its time and fraction, and the sun.
std::string lines_above(CaptionedView const& captioned, std::string const& fraction) {
  auto const& [view, caption] = captioned;
  auto text = view.receiver.empty() ? "" : upper(view.receiver) + "\n";
  text += caption;
  if (!fraction.empty()) text += fmt::format("{}sunlit {}", caption.empty() ? "" : ", ", fraction);
  if (!text.empty() && !text.ends_with('\n')) text += "\n";
  return text + fmt::format("sun at azimuth {:.1f}, altitude {:.1f}",
                            glm::degrees(view.sun.azimuth), glm::degrees(view.sun.altitude));
}

// In one file with a scale of sunlit fractions, arranged in rows or, if its name ends in .gif, as
// an animation.
void draw_together(ModelRun const& run, std::vector<CaptionedView> const& views, Path const& file,
                   Look const& look) {
  StagedFiles files(file.parent_path());
  std::vector<SunView> plain;
  for (auto const& view : views) {
    plain.push_back(view.view);
    plain.back().picture = fmt::format("{}.png", plain.size());
  }
  TemporaryFolder const temporary;
  auto const drawn = draw_in(temporary.path(), run, plain, look);
  PictureSheet sheet;
  for (std::size_t i = 0; i < views.size(); ++i) {
    sheet.items.push_back(
        {drawn.folder / plain[i].picture, lines_above(views[i], drawn.fractions[i])});
  }
  auto const name = file.filename().string();
  files.write(name, encode_sheet(name, sheet));
  files.commit();
}

struct ViewArguments {
  std::string receiver;
  std::vector<double> sun;
  std::vector<double> camera;
  std::string at;
  std::string day;
  std::string list;
  std::string output;
  std::optional<int> size;
  bool range = false;

  Look look(int default_size) const { return {size.value_or(default_size), range}; }
};

std::vector<SunTime> view_times(ModelRun const& model, ViewArguments const& arguments) {
  if (!arguments.sun.empty()) {
    return {{"", direction_of_degrees(arguments.sun[0], arguments.sun[1])}};
  }
  SiteClock const clock(read_objects(model.model), model.weather);
  if (!arguments.at.empty()) return {sun_time(arguments.at, clock)};
  // As many as fit on a page, or as an animation needs.
  std::chrono::minutes const step(is_animation(arguments.output) ? 15 : 60);
  return sun_times(arguments.day, clock, step);
}

std::optional<SunDirection> camera_of(ViewArguments const& arguments) {
  if (arguments.camera.empty()) return std::nullopt;
  if (!arguments.receiver.empty() || !arguments.list.empty()) {
    throw Error("--camera: draws the whole model; leave out --receiver and --list");
  }
  auto const [azimuth, altitude] = std::pair(arguments.camera[0], arguments.camera[1]);
  constexpr double zenith = 90.0;
  constexpr double circle = 360.0;
  if (!(altitude > 0.0 && altitude <= zenith && std::abs(azimuth) <= circle)) {
    throw Error(fmt::format(
        "--camera {},{}: expected an azimuth from -360 to 360 and an altitude above 0, up to 90",
        azimuth, altitude));
  }
  return direction_of_degrees(azimuth, altitude);
}

// Before the model is drawn, which may take minutes.
void require_picture_name(Path const& picture) {
  constexpr std::array<std::string_view, 9> endings{".png", ".jpg", ".jpeg", ".tif", ".tiff",
                                                    ".gif", ".bmp", ".tga",  ".exr"};
  auto const ending = picture.extension().string();
  if (std::ranges::any_of(endings,
                          [&](std::string_view known) { return same_name(known, ending); })) {
    return;
  }
  throw Error(fmt::format(
      "-o {}: expected the name of a picture, such as {}.png (also .jpg, .tif, .gif, .bmp, .tga "
      "and .exr)",
      picture.string(), picture.stem().string()));
}

void run_view(ModelRun const& model, ViewArguments const& arguments) {
  Path const output = arguments.output;
  if (arguments.range && !arguments.receiver.empty()) {
    throw Error("--range: draws the whole model; leave out --receiver");
  }
  constexpr int default_size = 800;
  if (!arguments.list.empty()) {
    draw(model, read_views(arguments.list), output, arguments.look(default_size));
    return;
  }
  if (arguments.sun.empty() && arguments.at.empty() && arguments.day.empty()) {
    throw Error(
        "expected --at \"MM-DD HH:MM\", --day MM-DD, --sun AZIMUTH,ALTITUDE, or --list FILE");
  }
  require_picture_name(output);
  auto const camera = camera_of(arguments);
  std::vector<CaptionedView> views;
  for (auto const& time : view_times(model, arguments)) {
    views.push_back({{"", time.sun, arguments.receiver, camera}, time.caption});
    if (!camera) continue;
    auto const model_name = model.model.filename().string();
    views.back().caption = time.caption.empty() ? model_name : model_name + ", " + time.caption;
  }
  constexpr int size_of_many = 400;
  draw_together(model, views, output,
                arguments.look(views.size() > 1 ? size_of_many : default_size));
  for (auto const& view : views) {
    auto const sun = view.view.sun;
    print("{}sun at azimuth {:.3f}, altitude {:.3f} degrees\n",
          view.caption.empty() ? "" : view.caption + ": ", glm::degrees(sun.azimuth),
          glm::degrees(sun.altitude));
  }
}

}  // namespace

void add_view(Program const& program) {
  Command const command(
      program, "view",
      "Draw the model as the sun sees it, with receivers coloured from dark blue to yellow by "
      "their sunlit fraction; or one receiver, each part by its share of the beam. Transmittance "
      "schedules are at their lowest value, "
      "and screens fully deployed",
      model_options());
  auto const model = command.add_model();
  auto const arguments = std::make_shared<ViewArguments>();
  command->add_option("--receiver", arguments->receiver, "Name of the receiver to draw")
      ->type_name("NAME");
  auto* const when = command->add_option_group("position of the sun");
  when->add_option("--at", arguments->at,
                   "Month, day and clock time at Site:Location, with daylight saving if the model "
                   "has it, as in \"06-21 15:00\"")
      ->type_name("\"MM-DD HH:MM\"");
  when->add_option("--day", arguments->day,
                   "The hours of a day from sunrise to sunset in one picture; an animation in "
                   "steps of 15 minutes if the picture's name ends in .gif")
      ->type_name("MM-DD");
  when->add_option("--sun", arguments->sun,
                   "Azimuth clockwise from true north and altitude above the horizon, in degrees")
      ->delimiter(',')
      ->expected(2)
      ->type_name("AZIMUTH,ALTITUDE");
  when->add_option("--list", arguments->list,
                   "A file that lists pictures to draw without captions, one per line: PICTURE "
                   "AZIMUTH ALTITUDE [RECEIVER]")
      ->type_name("FILE");
  when->require_option(0, 1);
  command
      ->add_option(
          "--camera", arguments->camera,
          "Draw the model with its shadows as seen from here instead of from the sun, with "
          "north and a scale: azimuth clockwise from true north and altitude, in degrees")
      ->delimiter(',')
      ->expected(2)
      ->type_name("AZIMUTH,ALTITUDE");
  command->add_flag("--range", arguments->range,
                    "Draw the outlines of moving shades at both ends of their range, too");
  command
      ->add_option("-o,--output", arguments->output,
                   "The picture, in the format of its file name extension; with --list, the folder "
                   "for all pictures")
      ->required()
      ->type_name("FILE");
  constexpr int min_size = 16;
  constexpr int max_size = 8192;
  command
      ->add_option("--size", arguments->size,
                   "Pixels on the longer side of each picture (default: 800; 400 with --day)")
      ->check(CLI::Range(min_size, max_size));
  command.run([model, arguments] { run_view(*model, *arguments); });
}

}  // namespace gpu_shading::energyplus

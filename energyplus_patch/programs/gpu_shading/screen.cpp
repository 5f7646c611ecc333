#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/trigonometric.hpp>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/extensions/extension_fields.h"
#include "model/geometry_rules.h"
#include "model/idf/model_file.h"
#include "model/model_reader.h"
#include "model/shading_outlines.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/gpu_shading/commands.h"
#include "programs/gpu_shading/listed_folder.h"
#include "programs/gpu_shading/screen_files.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;
namespace field = extension::perforated_screen;

// Which screens of a model to describe, and where to.
struct ScreenTask {
  Path model;                  // IDF or epJSON
  std::string name;            // of GPUShading:PerforatedScreen objects, or a pattern; "": all
  std::optional<Path> folder;  // for files; empty: none are written
  std::optional<Path> bsdf;    // for one screen's, as XML
};

// One object of the model, and surfaces that it names.
struct NamedScreen {
  std::shared_ptr<ScreenMaker> maker;
  std::vector<std::string> surfaces;
};

struct DescribedScreen {
  NamedScreen named;
  std::shared_ptr<PerforatedScreen const> screen;
  std::string description;
  double rotation = 0.0;  // degrees
};

// By their objects' names.
std::map<std::string, NamedScreen> screens_of(PerforatedScreens const& screens) {
  std::map<std::string, NamedScreen> named;
  for (auto const& [surface, screen] : screens.by_surface) {
    auto& entry = named[screen.maker->object()];
    entry.maker = screen.maker;
    entry.surfaces.push_back(surface);
  }
  return named;
}

std::vector<NamedScreen> choose(std::map<std::string, NamedScreen> const& screens,
                                ScreenTask const& task) {
  if (screens.empty()) {
    throw Error(fmt::format("{}: has no {}", task.model.string(), field::type));
  }
  std::vector<NamedScreen> chosen;
  std::vector<std::string> names;
  for (auto const& [name, screen] : screens) {
    names.push_back(name);
    if (task.name.empty() || matches(task.name, name)) chosen.push_back(screen);
  }
  if (chosen.empty()) {
    throw Error(fmt::format("{}: no {} matches {}{}", task.model.string(), field::type,
                            in_quotes(task.name), did_you_mean(task.name, names)));
  }
  return chosen;
}

// Polygons by the upper-case names of their surfaces, as far as they are known without EnergyPlus.
using Outlines = std::map<std::string, Polygon>;

Outlines read_outlines(Path const& path, ShadingInput const& shading) {
  auto const objects = read_objects(path);
  if (!reason_against_outlines(objects).empty()) return {};
  auto const rules = read_geometry_rules(objects);
  Outlines outlines;
  for (auto const& object : objects) {
    if (auto outline = outline_of(object, shading, rules)) {
      outlines[upper(object.name)].outline = std::move(outline->vertices);
    }
  }
  return outlines;
}

DescribedScreen describe(NamedScreen const& named, Polygon const& surface) {
  return {named, named.maker->make(surface), named.maker->describe(surface),
          glm::degrees(named.maker->placement(surface).rotation)};
}

// A texture that covers each surface has another tile, and so another transmittance, for each size
// of them. Surfaces of unknown size get a line each in `refused`.
void describe_each(NamedScreen const& named, Outlines const& outlines,
                   std::vector<DescribedScreen>& screens, std::vector<std::string>& refused) {
  auto const first = screens.size();
  for (auto const& name : named.surfaces) {
    auto const outline = outlines.find(name);
    if (outline == outlines.end()) {
      refused.push_back(fmt::format(
          "{}: {} and {} are blank, so that the tile has the size of {}, which only EnergyPlus "
          "knows; give one of them",
          named.maker->where(), field::tile_width.title, field::tile_height.title, name));
      continue;
    }
    auto described = describe({named.maker, {name}}, outline->second);
    auto const same = std::find_if(
        screens.begin() + static_cast<std::ptrdiff_t>(first), screens.end(),
        [&](DescribedScreen const& other) { return other.screen == described.screen; });
    if (same == screens.end()) {
      screens.push_back(std::move(described));
    } else {
      same->named.surfaces.push_back(name);
    }
  }
}

std::vector<DescribedScreen> describe(std::vector<NamedScreen> const& chosen, Path const& path,
                                      ShadingInput const& shading) {
  std::vector<DescribedScreen> screens;
  std::vector<std::string> refused;
  std::optional<Outlines> outlines;
  for (auto const& named : chosen) {
    if (named.maker->stretches()) {
      if (!outlines) outlines = read_outlines(path, shading);
      describe_each(named, *outlines, screens, refused);
    } else {
      screens.push_back(describe(named, {}));
    }
  }
  if (screens.empty()) throw Error(refused.front());
  for (auto const& line : refused) print_line("warning: " + line);
  return screens;
}

constexpr std::array azimuths{0, 45, 90, 135};

void print_table(PerforatedScreen const& screen) {
  constexpr int step = 10;
  constexpr int last = 80;
  print("{:>7}{:>10}{:>10}{:>10}{:>10}\n", "theta", "u (0)", "45", "v (90)", "135");
  for (int theta = 0; theta <= last; theta += step) {
    print("{:>7}", theta);
    for (auto const phi : azimuths) {
      print("{:>10.4f}", transmittance(screen, theta, phi));
    }
    print_text("\n");
  }
}

void print_described(DescribedScreen const& described) {
  auto const& screen = *described.screen;
  print("{}\n", one_line(described.named.maker->where()));
  print("  sheet          {}\n", one_line(described.description));
  print("  surfaces       {}\n", listed(described.named.surfaces, 3));
  print("  open fraction  {:.4f}\n", screen.open_fraction());
  double const cut_off = glm::degrees(screen.transmittance().cut_off());
  constexpr double right_angle = 90.0;
  if (screen.sheet().thickness > 0.0 && cut_off < right_angle) {
    print("  cut-off        {:.1f} degrees from the normal: no beam passes beyond\n", cut_off);
  }
  if (described.rotation != 0.0) {
    print(
        "  rotation       u and v are rotated by {:g} degrees counterclockwise as seen from "
        "outside\n",
        described.rotation);
  }
  print_text("\n");
  print_table(screen);
}

void print_legend() {
  print_text(
      "\nFraction of the beam that passes, tau, by angle of incidence from the normal, theta, and\n"
      "azimuth about the normal, phi, in degrees. u (phi = 0) runs to the right along the lower\n"
      "edge of the surface as seen from outside, and v (phi = 90) runs up; there, theta is the\n"
      "profile angle. Both faces are alike, and so are phi and phi + 180.\n");
}

void write_files(std::vector<DescribedScreen> const& screens, ListedFolder& files,
                 Path const& folder) {
  FileNames tables;
  FileNames plots;
  FileNames tiles;
  std::vector<std::string> written;
  for (auto const& described : screens) {
    auto const& object = described.named.maker->object();
    written.push_back(tables.add(object, "_tau.csv"));
    files.write(written.back(),
                [&](std::ostream& csv) { write_transmittances(*described.screen, csv); });
    written.push_back(plots.add(object, "_tau.svg"));
    files.write(written.back(), [&](std::ostream& svg) {
      write_polar_plot(*described.screen, printable(object), one_line(described.description), svg);
    });
    auto const tile = tiles.add(object, "_tile.png");
    if (auto const picture = encode_tile(*described.screen, tile)) {
      files.write(tile, *picture);
      written.push_back(tile);
    }
  }
  files.commit(nlohmann::ordered_json::object());
  print_text("\n");
  for (auto const& name : written) print("{}\n", (folder / name).string());
}

// As in EnergyPlus's solar reflections: the model's ShadingProperty:Reflectance, or the default.
SheetReflectance reflectance_of(std::string const& surface, ShadingInput const& shading) {
  auto const found = shading.shading_surfaces.find(surface);
  auto const properties =
      found == shading.shading_surfaces.end() ? ShadingInput::ShadingSurface{} : found->second;
  double const matt = 1.0 - properties.glazed;
  return {matt * properties.reflectance, matt * properties.visible_reflectance};
}

SheetReflectance reflectance_of(NamedScreen const& named, ShadingInput const& shading,
                                Path const& file) {
  auto const& first = named.surfaces.front();
  auto const reflectance = reflectance_of(first, shading);
  auto const differs = [&](std::string const& surface) {
    return reflectance_of(surface, shading) != reflectance;
  };
  auto const other = std::ranges::find_if(named.surfaces, differs);
  if (other != named.surfaces.end()) {
    print_line(
        fmt::format("warning: --bsdf {}: {} and {} have different reflectances; the file has "
                    "those of {}",
                    file.string(), printable(first), printable(*other), printable(first)));
  }
  return reflectance;
}

void write_bsdf_file(DescribedScreen const& described, ShadingInput const& shading,
                     Path const& file) {
  auto const& object = described.named.maker->object();
  auto const reflectance = reflectance_of(described.named, shading, file);
  write_whole_file(file, [&](std::ostream& xml) {
    write_bsdf(*described.screen, described.rotation, reflectance, printable(object),
               one_line(described.description), xml);
  });
  print("{}\n", file.string());
}

// EnergyPlus is not run.
void describe_screens(ScreenTask const& task, Choices const& choices) {
  require_model(task.model);
  auto const model = read_model(task.model, choices);
  auto const screens = describe(choose(screens_of(model.screens), task), task.model, model.shading);
  for (auto const& warning : model.screens.warnings()) print_line("warning: " + warning);
  if (task.bsdf && screens.size() != 1) {
    throw Error(fmt::format("--bsdf {}: one file is for one screen, but {} are chosen; name one",
                            task.bsdf->string(), screens.size()));
  }
  std::optional<ListedFolder> files;
  if (task.folder) files.emplace(*task.folder, "screens.json", "gpu_shading screens 1");
  for (auto const& screen : screens) {
    if (&screen != &screens.front()) print_text("\n");
    print_described(screen);
  }
  print_legend();
  if (files) write_files(screens, *files, *task.folder);
  if (task.bsdf) write_bsdf_file(screens.front(), model.shading, *task.bsdf);
}

}  // namespace

void add_screen(Program const& program) {
  Command const command(
      program, "screen",
      "Print the sheet and the transmittance by angle of incidence and azimuth of the perforated "
      "screens of a model, and write tables, polar plots and pictures of them. EnergyPlus is not "
      "run",
      {"file", "threads", "quiet", "assets"});
  auto const task = std::make_shared<ScreenTask>();
  command
      ->add_option_function<std::string>(
          "model", [task](std::string const& text) { task->model = text; }, "IDF or epJSON file")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("name", task->name,
                   "Name of a GPUShading:PerforatedScreen, or a pattern in which * stands for "
                   "any characters (default: all)")
      ->type_name("PATTERN");
  command
      ->add_option_function<std::string>(
          "-o,--output", [task](std::string const& text) { task->folder = text; },
          "Folder for NAME_tau.csv (transmittance by angles), NAME_tau.svg (polar plot) and "
          "NAME_tile.png (one tile of the sheet): new, empty, or with earlier screens, which are "
          "replaced")
      ->check(folder_name())
      ->type_name("DIR");
  command
      ->add_option_function<std::string>(
          "--bsdf", [task](std::string const& text) { task->bsdf = text; },
          "File for one screen as a BSDF, in WINDOW's XML with Klems's 145 x 145 "
          "directions: direct transmission, and diffuse reflection of the faces")
      ->type_name("FILE");
  command.run([task, choices = program.choices] { describe_screens(*task, choices); });
}

}  // namespace gpu_shading::energyplus

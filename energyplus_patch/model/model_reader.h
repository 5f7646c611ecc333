#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/far_outlines.h"
#include "model/idf/input_object.h"
#include "model/idf/model_file.h"
#include "model/input/moving_shades.h"
#include "model/input/perforated_screens.h"
#include "model/input/pv_modules.h"
#include "model/input/pv_reductions.h"
#include "model/input/shading_input.h"
#include "model/input/surrounding_groups.h"
#include "model/input/transparent_shades.h"
#include "model/lean_input.h"
#include "model/options/options.h"
#include "model/reflected_light.h"
#include "model/shading_outlines.h"
#include "model/site/surroundings.h"

namespace gpu_shading::energyplus {

// A model as this module understands it.
struct Model {
  std::string file;  // its name, without folders
  ShadingInput shading;
  TransparentShades shades;
  PerforatedScreens screens;
  std::vector<MovingShade> moving_shades;
  std::vector<PvModules> pv_modules;
  PvReductions pv_reductions;
  Options options;
  LeanInput lean;
  SimplifiedSurfaces simplified;
  FarOutlines far_outlines;
  Surroundings surroundings;
  std::vector<SurroundingGroup> surrounding_groups;
  std::optional<std::filesystem::path> surrounding_objects;  // to be added to EnergyPlus's input
  Names own_environments;             // surfaces with a SurfaceProperty:LocalEnvironment
  bool daylighting_answered = false;  // rays of daylighting ask this module
  ReflectedLight reflected_light;
  std::vector<FieldChange> field_changes;  // in EnergyPlus's input
  std::vector<NewObject> new_objects;
  std::vector<std::string> ray_warnings;    // see warn_of_rays
  std::string transform_warning;            // see warn_of_transform; or ""
  std::vector<std::string> early_warnings;  // for before the run, since EnergyPlus may stop
  std::vector<std::string> warnings;        // more of them, about moving shades and view factors
  std::vector<std::string> remarks;

  // Whether the light on receivers is recorded during a run.
  bool records_light() const { return options.report || reflected_light.undimmed; }
};

// The EnergyPlus that reads a model.
struct Reader {
  MentionFinder find_mentions;   // for the model's own file; without it, lean input is not planned
  bool daylight_rays = false;    // rays of daylighting can be answered
  bool reflected_light = false;  // reflected light can be passed to EnergyPlus
  bool horizons = true;  // of sites; false to check a model without reading all that is far away
  std::optional<Release> release = std::nullopt;  // to check the model's version against
};

// Reads a model's objects together with those of its side file, and resolves all options.
// `choices`: command line, then environment. Side file: choices.file, or MODEL.gpu-shading.idf if
// it exists. Throws Error: one line naming object, field and value.
Model understand(std::vector<InputObject> objects, std::filesystem::path const& path,
                 Choices const& choices, Reader const& reader = {});

// The same, from the model's file (.idf, .imf or .epJSON).
Model read_model(std::filesystem::path const& path, Choices const& choices,
                 Reader const& reader = {});

// The input that EnergyPlus reads in place of the model's file.
Rewrite rewrite_for(Model const& model);

// The file of extension objects of a model: choices.file, or that in the model's folder, or none.
std::optional<std::filesystem::path> find_side_file(std::filesystem::path const& model,
                                                    Choices const& choices);

}  // namespace gpu_shading::energyplus

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "input/input_object.h"
#include "input/perforated_screens.h"
#include "input/shading_input.h"
#include "input/transparent_shades.h"
#include "lean/lean_input.h"
#include "options/options.h"
#include "site/surroundings.h"

namespace gpu_shading::energyplus {

// A model as this module understands it.
struct Model {
  ShadingInput shading;
  TransparentShades shades;
  PerforatedScreens screens;
  Options options;
  LeanInput lean;
  Surroundings surroundings;
};

// The objects of known types (known_types) in a model's file. Throws Error.
std::vector<InputObject> read_objects(std::filesystem::path const& path);

// Reads a model's objects together with those of its side file, and answers every option.
// `choices`: command line over environment. Side file: choices.file, else MODEL.gpu-shading.idf
// where that exists. `find_mentions`, of the model's own file: without it lean input is not
// planned. Throws Error: one line naming object, field and value.
Model understand(std::vector<InputObject> objects, std::filesystem::path const& path,
                 Choices const& choices, MentionFinder const& find_mentions = {});

// The same from the model's file (.idf, .imf or .epJSON).
Model read_model(std::filesystem::path const& path, Choices const& choices);

// The file of extension objects that goes with a model: choices.file, else the one beside it, else
// none.
std::optional<std::filesystem::path> find_side_file(std::filesystem::path const& model,
                                                    Choices const& choices);

bool is_epjson(std::filesystem::path const& path);
bool is_idf(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus

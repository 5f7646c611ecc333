#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "input/idf_text.h"

namespace gpu_shading::energyplus {

using Names = std::unordered_set<std::string>;  // upper case

// Which of some names of shading surfaces any other object of the model has in any field, each with
// the type of one such object. Objects of ours do not count, nor ShadingProperty:Reflectance, which
// goes with its surface.
using Mentions = std::unordered_map<std::string, std::string>;
Mentions find_mentions(std::vector<IdfObject> const& objects, Names const& names);
Mentions find_mentions(nlohmann::json const& model, Names const& names);

// The same, of a model that is at hand.
using MentionFinder = std::function<Mentions(Names const&)>;

}  // namespace gpu_shading::energyplus

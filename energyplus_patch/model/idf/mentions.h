#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "model/idf/idf_text.h"

namespace gpu_shading::energyplus {

using Names = std::unordered_set<std::string>;  // upper case

// The names of shading surfaces that appear in any field of any other object of the model, each
// with the type of one such object. Our objects are not searched, nor is
// ShadingProperty:Reflectance, which belongs to its surface.
using Mentions = std::unordered_map<std::string, std::string>;
Mentions find_mentions(std::vector<IdfObject> const& objects, Names const& names);
Mentions find_mentions(nlohmann::json const& model, Names const& names);

// The same, for a model in memory.
using MentionFinder = std::function<Mentions(Names const&)>;

}  // namespace gpu_shading::energyplus

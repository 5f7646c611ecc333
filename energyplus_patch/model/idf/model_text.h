#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/idf/idf_text.h"

// Mistakes in the text of a model that EnergyPlus reports in the words of its parser, or by a
// crash.
namespace gpu_shading::energyplus {

// Throws Error for text in UTF-16.
void refuse_utf16(std::string_view text);

// Throws Error for text in UTF-16, text without objects, an OpenStudio model, macros (##include),
// and a name that is not UTF-8, which EnergyPlus refuses too. `parsed`: the text's objects.
void check_idf_text(std::string_view text, std::vector<IdfObject> const& parsed);

// Throws Error for epJSON without objects, and JSON of another program.
void check_epjson(nlohmann::json const& model);

// The type of the first object that only ExpandObjects (-x) understands, or "".
std::string find_template(std::vector<IdfObject> const& parsed);

}  // namespace gpu_shading::energyplus

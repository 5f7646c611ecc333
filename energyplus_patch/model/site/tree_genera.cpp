#include "model/site/tree_genera.h"

#include <algorithm>
#include <iterator>

#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// Printed by scripts/dev/tree_genera, from 10,500 trees of 17 cities in the United States: Urban
// Tree Database (McPherson, van Doorn and Peper, 2016, doi:10.2737/RDS-2016-0005). Leaf area was
// estimated from photographs of whole crowns (Peper and McPherson, 2003).
constexpr TreeGenus genera[] = {
    {"Acacia", 0.60, true},        {"Acer", 0.44, false},          {"Betula", 0.55, false},
    {"Brachychiton", 0.85, true},  {"Calophyllum", 0.37, true},    {"Cassia", 0.42, false},
    {"Catalpa", 0.45, false},      {"Cedrus", 0.30, true},         {"Celtis", 0.37, false},
    {"Chilopsis", 0.25, false},    {"Cinnamomum", 0.48, true},     {"Cornus", 0.17, false},
    {"Crataegus", 0.76, false},    {"Delonix", 0.41, false},       {"Eucalyptus", 0.56, true},
    {"Fagus", 0.52, false},        {"Ficus", 0.43, true},          {"Fraxinus", 0.45, false},
    {"Ginkgo", 0.42, false},       {"Gleditsia", 0.33, false},     {"Ilex", 0.28, true},
    {"Jacaranda", 0.72, false},    {"Juglans", 0.36, false},       {"Juniperus", 0.37, true},
    {"Koelreuteria", 0.40, false}, {"Lagerstroemia", 0.49, false}, {"Liquidambar", 0.57, false},
    {"Liriodendron", 0.46, false}, {"Magnolia", 0.45, true},       {"Malus", 0.46, false},
    {"Melaleuca", 0.66, true},     {"Morus", 0.59, false},         {"Parkinsonia", 0.49, false},
    {"Picea", 0.79, true},         {"Pinus", 0.49, true},          {"Pistacia", 0.59, false},
    {"Pittosporum", 0.74, true},   {"Platanus", 0.38, false},      {"Populus", 0.34, false},
    {"Prunus", 0.63, false},       {"Pyrus", 0.50, false},         {"Quercus", 0.37, false},
    {"Robinia", 0.43, false},      {"Samanea", 0.29, false},       {"Schinus", 0.70, true},
    {"Sequoia", 0.54, true},       {"Swietenia", 0.35, true},      {"Tabebuia", 0.46, true},
    {"Tilia", 0.54, false},        {"Triadica", 0.69, false},      {"Ulmus", 0.41, false},
    {"Zelkova", 0.45, false},
};

}  // namespace

TreeGenus const* find_genus(std::string const& taxon) {
  auto const name = taxon.substr(0, taxon.find(' '));
  auto const* const found = std::ranges::find_if(
      genera, [&](TreeGenus const& genus) { return same_name(genus.name, name); });
  return found == std::end(genera) ? nullptr : found;
}

std::string list_genera() {
  std::string list;
  for (auto const& genus : genera) {
    if (!list.empty()) list += ", ";
    list += genus.name;
  }
  return list;
}

}  // namespace gpu_shading::energyplus

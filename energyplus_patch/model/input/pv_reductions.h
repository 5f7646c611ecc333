#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// By how much the sunlit fraction of photovoltaic surfaces is reduced, 0 .. 1, so that their
// generators lose what partly shaded cells cost (--gpu-shading-pv).
struct PvReductions {
  struct Time {
    int month = 0;
    int day = 0;
    int hour = 0;      // 1 .. 24
    int timestep = 0;  // of the hour, from 1

    // Different for different times.
    int key() const;
  };

  std::map<std::string, std::unordered_map<int, float>> by_surface;  // upper case; by Time::key()

  bool empty() const { return by_surface.empty(); }
};

// Reads a table as gpu_shading.pv.write_reductions() of the Python package writes it. It has a
// column of its own for Generator:PVWatts, which shades the beam alone, while others shade the
// circumsolar part of the sky's light with it. Throws Error, naming file, line and value; for a
// surface that is none of the model's shading surfaces, too: its sunlit fraction would also change
// what it absorbs.
PvReductions read_pv_reductions(std::filesystem::path const& file,
                                std::vector<InputObject> const& objects, ShadingInput const& input);

}  // namespace gpu_shading::energyplus

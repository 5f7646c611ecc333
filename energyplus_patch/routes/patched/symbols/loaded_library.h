#pragma once

#include <cstddef>
#include <filesystem>

namespace gpu_shading::energyplus {

// A library in this process, and its load address.
struct Loaded {
  std::filesystem::path path;
  std::byte* base = nullptr;
};

// EnergyPlus's own library: behind the path `wanted`, or of any path if it is null. Throws Error if
// it is not loaded.
Loaded find_loaded(char const* wanted);

}  // namespace gpu_shading::energyplus

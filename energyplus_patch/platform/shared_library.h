#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// A library that is loaded at run time and stays loaded. Its symbols do not resolve to another
// library's.
class SharedLibrary {
 public:
  // Throws Error with the system's reason.
  explicit SharedLibrary(std::filesystem::path const& path);

  // Sets a function from its name. Throws Error if there is none.
  template <typename Function>
  void find(char const* name, Function*& function) const {
    function = reinterpret_cast<Function*>(address_of(name));
  }

 private:
  void* address_of(char const* name) const;

  void* handle_;
};

}  // namespace gpu_shading::energyplus

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>

namespace gpu_shading::energyplus {

// A function or an object of a loaded library.
struct Symbol {
  std::byte* address = nullptr;  // in this process
  std::size_t size = 0;
  std::uint64_t file_offset = 0;  // of a function: offset of its code in the library's file
};

// Which symbols of a library: all, including local ones, from .symtab, or those that it exports,
// from .dynsym, which a stripped library has as well.
enum class Symbols { all, exported };

// The functions and the tables of virtual functions of a loaded shared library by their mangled
// names, read from its file. (dlsym does not tell their sizes.)
class SymbolTable {
 public:
  // `base`: the library's load address. Throws Error if the file cannot be read or has no such
  // symbols.
  SymbolTable(std::filesystem::path library, std::byte* base, Symbols which = Symbols::all);

  // nullptr if there is no such function.
  Symbol const* find(std::string_view name) const;

  // What the first word of each object of a class points to, from the class's mangled name, such as
  // "N10EnergyPlus12SurfacesDataE"; nullptr if it has no virtual functions here.
  std::byte const* virtual_functions(std::string_view class_name) const;

  std::filesystem::path const& library() const { return library_; }

 private:
  std::filesystem::path library_;
  std::unordered_map<std::string, Symbol> functions_;
  std::unordered_map<std::string, std::byte const*> tables_;  // of virtual functions
};

}  // namespace gpu_shading::energyplus

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gpu_shading::energyplus {

// A function, or a table of virtual functions, of a loaded library.
struct Symbol {
  std::byte* address = nullptr;  // in this process
  std::size_t size = 0;
  std::uint64_t file_offset = 0;  // of a function: offset of its code in the library's file
};

// Which symbols of a library: all, including local ones, from .symtab, or those that it exports,
// from .dynsym, which a stripped library has as well.
enum class Symbols { all, exported };

// Symbols of a loaded shared library by their mangled names, read from its file. (dlsym does not
// tell their sizes.)
class SymbolTable {
 public:
  SymbolTable() = default;
  // Finds `names`, whose text must outlive this. `base`: the library's load address. Throws Error
  // if the file cannot be read or has no such symbols.
  SymbolTable(std::filesystem::path library, std::byte* base,
              std::vector<std::string_view> const& names, Symbols which = Symbols::all);

  // nullptr if there is no such symbol, or it was not among the names.
  Symbol const* find(std::string_view name) const;

  std::filesystem::path const& library() const { return library_; }

 private:
  std::filesystem::path library_;
  std::unordered_map<std::string_view, Symbol> symbols_;  // without an address: not found
};

}  // namespace gpu_shading::energyplus

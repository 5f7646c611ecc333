#include "routes/patched/binary/symbol_table.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gelf.h>
#include <libelf.h>

#include <memory>

#include "gpu_shading/error.h"
#include "platform/file_descriptor.h"

namespace gpu_shading::energyplus {
namespace {

using ElfHandle = std::unique_ptr<Elf, decltype(&elf_end)>;

GElf_Shdr header_of(Elf_Scn* section) {
  GElf_Shdr header{};
  gelf_getshdr(section, &header);
  return header;
}

Elf_Scn* find_symbol_section(Elf* elf, Symbols which) {
  GElf_Word const type = which == Symbols::all ? SHT_SYMTAB : SHT_DYNSYM;
  for (Elf_Scn* section = nullptr; (section = elf_nextscn(elf, section)) != nullptr;) {
    if (header_of(section).sh_type == type) return section;
  }
  return nullptr;
}

// How the names of tables of virtual functions begin (Itanium C++ ABI 5.1.4).
constexpr std::string_view table_prefix = "_ZTV";

}  // namespace

SymbolTable::SymbolTable(std::filesystem::path library, std::byte* base, Symbols which)
    : library_(std::move(library)) {
  elf_version(EV_CURRENT);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  FileDescriptor const file(open(library_.c_str(), O_RDONLY | O_CLOEXEC));
  ElfHandle const elf(elf_begin(file.get(), ELF_C_READ_MMAP, nullptr), &elf_end);
  if (!elf) throw Error(fmt::format("{}: cannot be read as an ELF file", library_.string()));
  Elf_Scn* const section = find_symbol_section(elf.get(), which);
  if (section == nullptr) {
    throw Error(
        fmt::format("{}: has no symbol table (stripped), so its shading interface cannot be "
                    "found",
                    library_.string()));
  }
  GElf_Shdr const header = header_of(section);
  Elf_Data* const data = elf_getdata(section, nullptr);
  auto const count = static_cast<int>(header.sh_size / header.sh_entsize);
  for (int i = 0; i < count; ++i) {
    GElf_Sym symbol{};
    gelf_getsym(data, i, &symbol);
    if (symbol.st_shndx == SHN_UNDEF) continue;
    char const* const name = elf_strptr(elf.get(), header.sh_link, symbol.st_name);
    if (name != nullptr && GELF_ST_TYPE(symbol.st_info) == STT_OBJECT &&
        std::string_view(name).starts_with(table_prefix)) {
      tables_.emplace(name, base + symbol.st_value);
    }
    if (GELF_ST_TYPE(symbol.st_info) != STT_FUNC) continue;
    Elf_Scn* const code = elf_getscn(elf.get(), symbol.st_shndx);
    if (name == nullptr || code == nullptr) continue;
    GElf_Shdr const code_header = header_of(code);
    functions_.emplace(name, Symbol{base + symbol.st_value, symbol.st_size,
                                    symbol.st_value - code_header.sh_addr + code_header.sh_offset});
  }
}

Symbol const* SymbolTable::find(std::string_view name) const {
  auto const found = functions_.find(std::string(name));
  return found == functions_.end() ? nullptr : &found->second;
}

std::byte const* SymbolTable::virtual_functions(std::string_view class_name) const {
  auto const found = tables_.find(std::string(table_prefix) + std::string(class_name));
  if (found == tables_.end()) return nullptr;
  // Two words come before them: an offset and the type's information.
  return found->second + 2 * sizeof(void*);
}

}  // namespace gpu_shading::energyplus

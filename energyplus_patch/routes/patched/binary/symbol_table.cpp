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

}  // namespace

SymbolTable::SymbolTable(std::filesystem::path library, std::byte* base,
                         std::vector<std::string_view> const& names, Symbols which)
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
  for (auto const& name : names) symbols_.try_emplace(name);
  for (int i = 0; i < count; ++i) {
    GElf_Sym symbol{};
    gelf_getsym(data, i, &symbol);
    auto const type = GELF_ST_TYPE(symbol.st_info);
    if (symbol.st_shndx == SHN_UNDEF || (type != STT_FUNC && type != STT_OBJECT)) continue;
    char const* const name = elf_strptr(elf.get(), header.sh_link, symbol.st_name);
    if (name == nullptr) continue;
    auto const wanted = symbols_.find(name);
    Elf_Scn* const content = elf_getscn(elf.get(), symbol.st_shndx);
    if (wanted == symbols_.end() || wanted->second.address != nullptr || content == nullptr)
      continue;
    GElf_Shdr const content_header = header_of(content);
    wanted->second = {base + symbol.st_value, symbol.st_size,
                      symbol.st_value - content_header.sh_addr + content_header.sh_offset};
  }
}

Symbol const* SymbolTable::find(std::string_view name) const {
  auto const found = symbols_.find(name);
  return found == symbols_.end() || found->second.address == nullptr ? nullptr : &found->second;
}

}  // namespace gpu_shading::energyplus

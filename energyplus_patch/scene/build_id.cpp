#include <link.h>

#include <cstdint>
#include <cstring>

#include "gpu_shading/error.h"
#include "scene/scene_hash.h"

namespace gpu_shading::energyplus {
namespace {

using Bytes = std::span<std::byte const>;

// Searches a segment of notes; empty if it is not there.
Bytes find_build_id(Bytes notes) {
  auto const aligned = [](std::size_t size) { return (size + 3) & ~std::size_t{3}; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes.data(), sizeof note);
    auto const name = sizeof note;
    auto const description = name + aligned(note.n_namesz);
    if (description + note.n_descsz > notes.size()) break;
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == sizeof ELF_NOTE_GNU &&
        std::memcmp(notes.data() + name, ELF_NOTE_GNU, sizeof ELF_NOTE_GNU) == 0) {
      return notes.subspan(description, note.n_descsz);
    }
    auto const next = description + aligned(note.n_descsz);
    if (next > notes.size()) break;
    notes = notes.subspan(next);
  }
  return {};
}

struct Search {
  std::uintptr_t inside;  // an address in the object to search for
  Bytes found;
};

int look_into(dl_phdr_info* info, std::size_t /*size*/, void* context) {
  auto& search = *static_cast<Search*>(context);
  std::span<ElfW(Phdr) const> const segments(info->dlpi_phdr, info->dlpi_phnum);
  bool here = false;
  for (auto const& segment : segments) {
    auto const start = info->dlpi_addr + segment.p_vaddr;
    here = here || (segment.p_type == PT_LOAD && search.inside >= start &&
                    search.inside - start < segment.p_memsz);
  }
  if (!here) return 0;
  for (auto const& segment : segments) {
    if (segment.p_type != PT_NOTE || !search.found.empty()) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    auto const* start = reinterpret_cast<std::byte const*>(info->dlpi_addr + segment.p_vaddr);
    search.found = find_build_id({start, segment.p_memsz});
  }
  return 1;
}

}  // namespace

std::span<std::byte const> build_id() {
  Search search{reinterpret_cast<std::uintptr_t>(&find_build_id), {}};
  dl_iterate_phdr(&look_into, &search);
  if (search.found.empty()) {
    throw Error(
        "--gpu-shading-cache: this program has no build ID, which distinguishes its answers from "
        "those of other builds; link it with --build-id");
  }
  return search.found;
}

}  // namespace gpu_shading::energyplus

#include "reports/module_folder.h"

#include <array>
#include <utility>

#include "fuzz.h"

// The same bytes as each of the files that a report reads of a folder of modules, with the others
// as they should be.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  constexpr std::array<std::pair<char const*, char const*>, 4> right{{
      {"modules.json",
       R"({"format": "gpu_shading modules 1", "fields": [{"surface": "ROW", "module_width": 1.0, )"
       R"("module_area": 1.6, "landscape": false}]})"},
      {"modules.csv", "surface,string,column,row,beam loss\nROW,1,1,1,0.25\n"},
      {"times.csv", "month,day\n3,21\n"},
      {"strings.csv", "surface,string,month,day,hour,sunlit fraction\nROW,1,3,21,12,0.5\n"},
  }};
  auto const text = as_text(data, size);
  for (auto const& tried : right) {
    for (auto const& file : right) file_of(file.second, file.first);
    auto const folder = file_of(text, tried.first).parent_path();
    try_to([&] { read_module_folder(folder); });
  }
  return 0;
}

// Stands in for libFuzzer: reads every file of the folders that it is given, once.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz.h"

int main(int argc, char** argv) {
  try {
    std::size_t count = 0;
    for (int i = 1; i < argc; ++i) {
      std::vector<std::filesystem::path> files;
      for (auto const& entry : std::filesystem::directory_iterator(argv[i])) {
        files.push_back(entry.path());
      }
      std::sort(files.begin(), files.end());
      for (auto const& path : files) {
        std::ifstream file(path, std::ios::binary);
        std::vector<char> const bytes{std::istreambuf_iterator<char>(file), {}};
        // Before it is read, so that the last line names the one that crashes.
        std::printf("%s\n", path.filename().c_str());
        std::fflush(stdout);
        LLVMFuzzerTestOneInput(reinterpret_cast<std::uint8_t const*>(bytes.data()), bytes.size());
        ++count;
      }
    }
    return count > 0 ? 0 : 1;
  } catch (std::exception const& error) {
    std::fprintf(stderr, "replay: %s\n", error.what());
    return 1;
  }
}

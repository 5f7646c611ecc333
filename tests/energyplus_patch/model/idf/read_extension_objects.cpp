#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "gpu_shading/error.h"
#include "model/idf/extension_objects.h"
#include "model/idf/model_file.h"

// Reads models of extension objects, one a line of standard input, and prints a line for each:
// "ok", or why it is refused. The argument is their form, idf or epjson.
int main(int argc, char** argv) {
  using namespace gpu_shading::energyplus;
  std::string const form = argc == 2 ? argv[1] : "";
  if (form != "idf" && form != "epjson") {
    std::cerr << "usage: read_extension_objects idf|epjson\n";
    return 2;
  }
  for (std::string line; std::getline(std::cin, line);) {
    try {
      check_unique(form == "idf" ? read_idf(line) : read_epjson(parse_epjson(line)));
      std::cout << "ok\n";
    } catch (gpu_shading::Error const& error) {
      std::cout << error.what() << '\n';
    }
  }
  return 0;
}

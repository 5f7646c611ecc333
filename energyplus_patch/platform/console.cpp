#include "platform/console.h"

#include <atomic>
#include <cstdio>

#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

std::atomic<bool>& state() {
  static std::atomic<bool> quiet = false;
  return quiet;
}

}  // namespace

void set_quiet(bool quiet) { state() = quiet; }

bool is_quiet() { return state(); }

void print_line(std::string const& line) {
  bool const matters = line.starts_with("warning: ") || line.starts_with("error: ");
  if (matters || !is_quiet()) std::fprintf(stderr, "gpu_shading: %s\n", one_line(line).c_str());
}

void print_text(std::string_view text) {
  auto const safe = without_controls(text);
  std::fwrite(safe.data(), 1, safe.size(), stdout);
}

}  // namespace gpu_shading::energyplus

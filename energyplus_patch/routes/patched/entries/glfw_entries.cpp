#include <memory>
#include <string_view>

#include "routes/opengl/opengl_functions.h"
#include "routes/patched/entries/entries.h"

// In place of GLFW's functions of the same names, for windows that are never shown.

namespace gpu_shading::energyplus {
namespace {

constexpr int yes = 1;
constexpr int no = 0;

// GLFW's windows: each is an OpenGL context. EnergyPlus uses them on the thread that made them.
std::vector<std::unique_ptr<OpenGlContext>>& windows() {
  thread_local std::vector<std::unique_ptr<OpenGlContext>> open;
  return open;
}

int init() { return yes; }

void terminate() {
  use_context(nullptr);
  windows().clear();
}

void hint(int /*what*/, int /*value*/) {}

OpenGlContext* create_window(int /*width*/, int /*height*/, char const* /*title*/,
                             void* /*monitor*/, void* /*share*/) {
  OpenGlContext* made = nullptr;
  or_end_run([&] { made = windows().emplace_back(std::make_unique<OpenGlContext>()).get(); });
  return made;
}

void destroy_window(OpenGlContext* window) {
  if (current_context() == window) use_context(nullptr);
  std::erase_if(windows(), [&](auto const& each) { return each.get() == window; });
}

void make_current(OpenGlContext* window) { use_context(window); }

void* get_function(char const* name) { return opengl_function(name); }

int has_extension(char const* name) {
  std::string_view const wanted(name);
  std::string_view const all(opengl_extensions);
  auto const at = all.find(wanted);
  if (wanted.empty() || at == std::string_view::npos) return no;
  auto const end = at + wanted.size();
  return (at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ') ? yes : no;
}

void swap_interval(int /*interval*/) {}
void set_pointer(OpenGlContext* /*window*/, void* /*pointer*/) {}

// Callbacks that are never called; there was none before.
void* set_error_callback(void* /*callback*/) { return nullptr; }
void* set_callback(OpenGlContext* /*window*/, void* /*callback*/) { return nullptr; }

}  // namespace

std::vector<EntryPatch> glfw_entries() {
  std::vector<EntryPatch> entries{
      replace("glfwInit", &init),
      replace("glfwTerminate", &terminate),
      replace("glfwWindowHint", &hint),
      replace("glfwCreateWindow", &create_window),
      replace("glfwDestroyWindow", &destroy_window),
      replace("glfwMakeContextCurrent", &make_current),
      replace("glfwGetCurrentContext", &current_context),
      replace("glfwGetProcAddress", &get_function),
      replace("glfwExtensionSupported", &has_extension),
      replace("glfwSwapInterval", &swap_interval),
      replace("glfwSetWindowUserPointer", &set_pointer),
      replace("glfwSetErrorCallback", &set_error_callback),
  };
  for (char const* const name : {"glfwSetKeyCallback", "glfwSetScrollCallback",
                                 "glfwSetMouseButtonCallback", "glfwSetCursorPosCallback"}) {
    entries.push_back(replace(name, &set_callback));
  }
  return entries;
}

}  // namespace gpu_shading::energyplus

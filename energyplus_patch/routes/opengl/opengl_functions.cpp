#include "routes/opengl/opengl_functions.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>

#include "calculation/plain_scene.h"
#include "gpu_shading/error.h"

// OpenGL 2.1 as far as GLFW 3.3.8, glad and Penumbra notice. What is not here succeeds and does
// nothing.

namespace gpu_shading::energyplus {
namespace {

// Values from the OpenGL registry.
using Enum = std::uint32_t;
constexpr Enum gl_vendor = 0x1F00;
constexpr Enum gl_renderer = 0x1F01;
constexpr Enum gl_version = 0x1F02;
constexpr Enum gl_extensions = 0x1F03;
constexpr Enum gl_shading_language_version = 0x8B8C;
constexpr Enum gl_max_viewport_dims = 0x0D3A;
constexpr Enum gl_compile_status = 0x8B81;
constexpr Enum gl_link_status = 0x8B82;
constexpr Enum gl_framebuffer_complete = 0x8CD5;

thread_local OpenGlContext* current = nullptr;

RendererOptions options_of_environment() {
  constexpr char const* variable = "GPU_SHADING_ERROR";
  RendererOptions options;
  options.device.device = DeviceId{};
  char const* const given = std::getenv(variable);
  if (given == nullptr || *given == '\0') return options;
  char* end = nullptr;
  double const error = std::strtod(given, &end);
  if (*end != '\0' || !(error >= RendererOptions::min_error) ||
      error > RendererOptions::max_error) {
    throw Error(std::string(variable) + " is '" + given + "': expected a number, 1e-5 to 0.1");
  }
  options.error = error;
  return options;
}

// The model of this run, which outlives EnergyPlus's contexts.
std::shared_ptr<DrawnModel>& model_of_run() {
  static std::shared_ptr<DrawnModel> instance;
  return instance;
}

// A function of OpenGL that changes nothing here.
long long nothing() { return 0; }

// Calls `use` with the current context's recorder. Penumbra cannot be told of an error.
template <typename Use>
void record(Use const& use) {
  if (current == nullptr) return;
  or_end_run([&] { use(current->recorder); });
}

char const* get_string(Enum name) {
  switch (name) {
    case gl_vendor:
      return "Mesa";  // Penumbra takes a vendor that it does not know for an error
    case gl_renderer:
      return "gpu_shading";
    case gl_version:
      return "2.1.0";
    case gl_shading_language_version:
      return "1.20";
    case gl_extensions:
      return opengl_extensions;
    default:
      return "";
  }
}

// Penumbra's image has at most 34,023 pixels on a side; nothing of that size is ever allocated.
void get_integers(Enum name, int* values) {
  constexpr int enough = 34100;
  if (name == gl_max_viewport_dims) {
    values[0] = enough;
    values[1] = enough;
  } else {
    values[0] = 0;
  }
}

Enum framebuffer_status(Enum /*target*/) { return gl_framebuffer_complete; }

// Names of objects that are told apart only by not being 0.
void create_objects(int count, std::uint32_t* names) {
  static std::uint32_t last = 0;
  for (int i = 0; i < count; ++i) names[i] = ++last;
}

std::uint32_t create_object() {
  std::uint32_t name = 0;
  create_objects(1, &name);
  return name;
}

void get_object(std::uint32_t /*object*/, Enum what, int* value) {
  *value = what == gl_compile_status || what == gl_link_status ? 1 : 0;
}

void get_log(std::uint32_t /*object*/, int size, int* length, char* log) {
  if (size > 0) log[0] = '\0';
  if (length != nullptr) *length = 0;
}

void set_viewport(int /*x*/, int /*y*/, int width, int height) {
  record([&](Recorder& recorder) { recorder.set_viewport(width, height); });
}

void set_buffer(Enum /*target*/, std::intptr_t size, void const* data, Enum /*usage*/) {
  if (data == nullptr || size <= 0) return;
  std::span const numbers(static_cast<float const*>(data),
                          static_cast<std::size_t>(size) / sizeof(float));
  record([&](Recorder& recorder) { recorder.set_vertices(numbers); });
}

void set_matrix(int /*location*/, int /*count*/, unsigned char /*transpose*/, float const* values) {
  std::array<float, 16> matrix{};
  std::copy_n(values, matrix.size(), matrix.begin());
  record([&](Recorder& recorder) { recorder.set_matrix(matrix); });
}

void clear(Enum /*mask*/) {
  record([](Recorder& recorder) { recorder.clear(); });
}

void draw_arrays(Enum /*mode*/, int first, int count) {
  if (first < 0 || count < 0) return;
  record([&](Recorder& recorder) {
    recorder.draw({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
  });
}

void create_queries(int count, std::uint32_t* names) {
  record([&](Recorder& recorder) {
    recorder.create_queries({names, static_cast<std::size_t>(count)});
  });
}

void delete_queries(int count, std::uint32_t const* names) {
  record([&](Recorder& recorder) {
    recorder.delete_queries({names, static_cast<std::size_t>(count)});
  });
}

void begin_query(Enum /*target*/, std::uint32_t name) {
  record([&](Recorder& recorder) { recorder.begin_query(name); });
}

void end_query(Enum /*target*/) {
  record([](Recorder& recorder) { recorder.end_query(); });
}

void get_query(std::uint32_t name, Enum /*what*/, int* value) {
  record([&](Recorder& recorder) { *value = recorder.result(name); });
}

template <typename Function>
void* pointer(Function* function) {
  return reinterpret_cast<void*>(function);
}

}  // namespace

void draw_with(DrawnModel::Input input) {
  model_of_run() = std::make_shared<DrawnModel>(std::move(input));
}

void finish_drawing() {
  auto const finished = std::move(model_of_run());
  if (finished) finished->finish();
}

void fail_drawing(std::string const& why) {
  if (model_of_run()) model_of_run()->fail(why);
}

std::shared_ptr<DrawnModel> model_of_context() {
  if (model_of_run()) return model_of_run();
  return std::make_shared<DrawnModel>(
      [options = options_of_environment()] { return std::make_unique<PlainScene>(options); });
}

void use_context(OpenGlContext* context) { current = context; }

OpenGlContext* current_context() { return current; }

void* opengl_function(std::string_view name) {
  static std::array<std::pair<std::string_view, void*>, 24> const functions{{
      {"glGetString", pointer(&get_string)},
      {"glGetIntegerv", pointer(&get_integers)},
      {"glCheckFramebufferStatus", pointer(&framebuffer_status)},
      {"glCheckFramebufferStatusEXT", pointer(&framebuffer_status)},
      {"glGenFramebuffersEXT", pointer(&create_objects)},
      {"glGenRenderbuffersEXT", pointer(&create_objects)},
      {"glGenVertexArrays", pointer(&create_objects)},
      {"glGenVertexArraysAPPLE", pointer(&create_objects)},
      {"glGenBuffers", pointer(&create_objects)},
      {"glCreateProgram", pointer(&create_object)},
      {"glCreateShader", pointer(&create_object)},
      {"glGetShaderiv", pointer(&get_object)},
      {"glGetProgramiv", pointer(&get_object)},
      {"glGetShaderInfoLog", pointer(&get_log)},
      {"glViewport", pointer(&set_viewport)},
      {"glBufferData", pointer(&set_buffer)},
      {"glUniformMatrix4fv", pointer(&set_matrix)},
      {"glClear", pointer(&clear)},
      {"glDrawArrays", pointer(&draw_arrays)},
      {"glGenQueries", pointer(&create_queries)},
      {"glDeleteQueries", pointer(&delete_queries)},
      {"glBeginQuery", pointer(&begin_query)},
      {"glEndQuery", pointer(&end_query)},
      {"glGetQueryObjectiv", pointer(&get_query)},
  }};
  for (auto const& [known, function] : functions) {
    if (known == name) return function;
  }
  return pointer(&nothing);
}

}  // namespace gpu_shading::energyplus

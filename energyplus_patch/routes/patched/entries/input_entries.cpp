#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ios>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>

#include "model/reflected_light_input.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"
#include "routes/run_setup.h"

namespace gpu_shading::energyplus {

// EnergyPlus's function that prints its line about shading, watched to get the file that it writes
// to. Its arguments are passed on unchanged in registers and on the stack, so the entry is written
// in assembly.
extern "C" {
__attribute__((visibility("hidden"))) void* gpu_shading_original_print = nullptr;
__attribute__((visibility("hidden"))) void gpu_shading_note_eio(std::ostream* eio) {
  this_run().eio = eio;
}
__attribute__((naked)) void gpu_shading_watch_print();
}

__attribute__((naked)) void gpu_shading_watch_print() {
  asm("push %rdi\n\t"
      "push %rsi\n\t"
      "push %rdx\n\t"
      "push %rcx\n\t"
      "push %r8\n\t"
      "push %r9\n\t"
      "sub $8, %rsp\n\t"
      "call gpu_shading_note_eio\n\t"
      "add $8, %rsp\n\t"
      "pop %r9\n\t"
      "pop %r8\n\t"
      "pop %rcx\n\t"
      "pop %rdx\n\t"
      "pop %rsi\n\t"
      "pop %rdi\n\t"
      "jmp *gpu_shading_original_print(%rip)");
}

namespace {

using Path = std::filesystem::path;

PointerTo<symbol::process_input> original_process_input = nullptr;
PointerTo<symbol::read_file> original_read_file = nullptr;
PointerTo<symbol::read_json> original_read_json = nullptr;
PointerTo<symbol::close_output_files> original_close = nullptr;
PointerTo<symbol::end_energyplus> original_end = nullptr;
PointerTo<symbol::abort_energyplus> original_abort = nullptr;

// Objects that polygon clipping ignores.
void warn_of_missing_surroundings(Run const& run) {
  if (run.model->surroundings.empty()) return;
  messages_of(run).warning(
      "rendering is off: GPUShading:SiteContext, GPUShading:Geometry and GPUShading:Tree are "
      "ignored, so their geometry casts no shadow");
}

// Shades that are opaque to polygon clipping because only our objects make them transparent.
void warn_of_opaque_shades(Run const& run) {
  std::set<std::string> opaque;
  for (auto const& [surface, shade] : run.model->shades.by_surface) opaque.insert(surface);
  for (auto const& [surface, screen] : run.model->screens.by_surface) opaque.insert(surface);
  for (auto const& [surface, type] : run.model->surroundings.types) opaque.erase(surface);
  if (opaque.empty()) return;
  auto const more = opaque.size() - 1;
  messages_of(run).warning(
      fmt::format("rendering is off: GPUShading objects are ignored, so these surfaces are opaque "
                  "except for transmittance schedules: {}{}",
                  *opaque.begin(), more == 0 ? "" : fmt::format(" and {} more", more)));
}

// Reads the model and returns the text that EnergyPlus is to read instead.
Rewrite take_model(std::vector<InputObject> objects, Path const& path,
                   MentionFinder const& find_mentions) {
  auto& run = this_run();
  auto const& installed = installation();
  Reader reader{find_mentions, installed.serves(Need::daylight_rays),
                installed.serves(Need::reflected_light)};
  reader.release = installed.release;
  run.model = understand(std::move(objects), path, installed.choices, reader);
  if (run.model->options.mode != Mode::off) {
    for (auto const& warning : run.model->early_warnings) messages_of(run).warning(warning);
    if (!run.model->reflected_light.receivers.empty()) {
      installed.functions.request_light_of_ground(*run.state);
    }
    if (run.model->records_light() && installed.serves(Need::reflected_light)) {
      record_light(*run.state);
    }
  } else {
    warn_of_opaque_shades(run);
    warn_of_missing_surroundings(run);
  }
  auto rewrite = rewrite_for(*run.model);
  std::ranges::move(constant_schedules(run.model->reflected_light),
                    std::back_inserter(rewrite.added));
  return rewrite;
}

// EnergyPlus passes the state here, before the input is read and after its preprocessors.
void process_input(void* self, State& state) {
  if (auto const& start = installation().choices.start) {
    std::error_code ignored;
    std::filesystem::current_path(*start, ignored);
  }
  this_run() = {};
  this_run().state = &state;
  original_process_input(self, state);
}

// The first file that EnergyPlus reads in a run is its model, whatever name a preprocessor gives it
// (.expidf, .epmidf); schedules and other files come later.
bool is_model() {
  auto const& run = this_run();
  return run.state != nullptr && !run.model;
}

std::string read_file(Path const& path, std::ios_base::openmode mode) {
  auto text = original_read_file(path, mode);
  if (!is_model()) return text;
  return guarded([&] {
    return rewrite_idf_model(text, path, [&](auto objects, MentionFinder const& find) {
      return take_model(std::move(objects), path, find);
    });
  });
}

// EnergyPlus's JSON value has the same layout as ours: it is the same library, and its versions 3.x
// do not differ in any member.
nlohmann::json read_json(Path const& path, std::ios_base::openmode mode) {
  auto json = original_read_json(path, mode);
  if (!is_model()) return json;
  return guarded([&] {
    rewrite_epjson_model(json, path, [&](auto objects, MentionFinder const& find) {
      return take_model(std::move(objects), path, find);
    });
    return std::move(json);
  });
}

void finish_run() {
  auto& run = this_run();
  if (run.session == nullptr) return;
  try {
    run.session->finish();
  } catch (std::exception const& error) {
    run.unwritten = error_line(error);
    print_line("error: " + run.unwritten);
    installation().functions.warning(*run.state, "gpu_shading: " + run.unwritten);
  }
  run.session = nullptr;
}

// The last moment for lines in the .eio file.
void close_output_files(State& state) {
  finish_run();
  original_close(state);
}

void end_energyplus(State& state) {
  finish_run();
  original_end(state);
}

void abort_energyplus(State& state) {
  finish_run();
  original_abort(state);
}

}  // namespace

std::vector<Entry> input_entries() {
  EntryPatch print{symbol::print_shading_line.symbol,
                   reinterpret_cast<void*>(&gpu_shading_watch_print), &gpu_shading_original_print};
  print.result.reset();
  return {
      watch(symbol::process_input, &process_input, &original_process_input),
      watch(symbol::read_file, &read_file, &original_read_file),
      watch(symbol::read_json, &read_json, &original_read_json),
      watch(symbol::close_output_files, &close_output_files, &original_close),
      watch(symbol::end_energyplus, &end_energyplus, &original_end),
      watch(symbol::abort_energyplus, &abort_energyplus, &original_abort),
      {symbol::print_shading_line.need, print},
  };
}

}  // namespace gpu_shading::energyplus

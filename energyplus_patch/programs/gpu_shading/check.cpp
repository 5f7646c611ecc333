#include "platform/console.h"
#include "programs/gpu_shading/commands.h"

namespace gpu_shading::energyplus {

void add_check(Program const& program) {
  Command const command(program, "check",
                        "Read a model and its extension objects, and print how each surface takes "
                        "part in the shading calculation, or every error",
                        model_options());
  auto const model = command.add_model();
  auto const task = std::make_shared<ListingTask>();
  command->add_flag("--vertices", task->vertices, "Print the vertices of every surface instead");
  command->add_flag("--json", task->json,
                    "Print one JSON document; with --vertices, the scene that is rendered: "
                    "vertices, optics and rules of all surfaces");
  command.run([model, task] { print_text(run_task(*model, *task).text); });
}

}  // namespace gpu_shading::energyplus

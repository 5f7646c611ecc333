#pragma once

#include <functional>
#include <string>
#include <vector>

#include "answers/sun_questions.h"
#include "platform/messages.h"
#include "reports/run_record.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Says that there is no GPU. Throws DeviceError where a GPU is required.
void check_device(DeviceInfo const& device, Options const& options, Messages const& messages);

// What a run and a check say about a model, one line each, besides Model::early_warnings.
std::vector<std::string> warnings_of(SceneAssembly const& scene);
std::vector<std::string> remarks_of(Model const& model);

// Before the first question: the model's warnings, what was left out and what surrounds it, and the
// .eio's list of the surfaces that let light through.
void describe_scene(SceneAssembly const& scene, Messages const& messages);

// After the last question: what rendered how much, the errors of its answers, and which receivers
// miss the target error or may.
void describe_answers(SunQuestions const& answers, AnswerErrors const& errors,
                      Options const& options, Messages const& messages);

// "99 % of 1200 sampled views within 0.00081, all within 0.00099; 300 views exact, within 1e-07"
std::string describe_errors(AnswerErrors const& errors);

// At the end of a run whose light from the ground no object of ours dims: names the receivers that
// get over a tenth of their light from there, the largest shares first. `ratios`: for a few of
// them, that light divided by all reflected light.
void warn_of_ground_light(
    Scene const& surfaces, RunRecord const& record,
    std::function<std::vector<double>(std::vector<SurfaceId> const&)> const& ratios,
    Messages const& messages);

}  // namespace gpu_shading::energyplus

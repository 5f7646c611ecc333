#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "answers/answer_store.h"
#include "scene/digest.h"

namespace gpu_shading::energyplus {

// The answers of one scene and the meaning of their indices.
struct SceneAnswers {
  std::vector<SurfaceId> receivers;  // by ReceiverNumber
  DeploymentStates states;           // by Direction::state
  AnswerStore answers;
};

// Adds what another set has and this one lacks.
void add_answers(SceneAnswers const& from, SceneAnswers& to);

// Throws Error if a surface is not one of the scene's, or an answer is not one of the scene's.
void check_answers(SceneAnswers const& set, AnswerLimits const& limits);

// The contents of a file: a header that names the scene, the answers, and a checksum of both.
std::vector<std::byte> encode(SceneAnswers const& set, Hash const& scene);

// Throws Error with the reason unless these bytes are exactly what encode() writes for the scene.
SceneAnswers decode(std::span<std::byte const> file, Hash const& scene);

}  // namespace gpu_shading::energyplus

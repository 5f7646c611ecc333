#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "answers/answers.h"
#include "answers/deployment_states.h"
#include "scene/digest.h"

namespace gpu_shading::energyplus {

// The answers of one scene and the meaning of their indices.
struct AnswerSet {
  std::vector<SurfaceId> receivers;  // by ReceiverNumber
  DeploymentStates states;           // by Direction::state
  Answers answers;
};

// Adds what another set has and this one lacks.
void add_answers(AnswerSet const& from, AnswerSet& to);

// Throws Error if a surface is not one of the scene's, or an answer is not one of the scene's.
void check_answers(AnswerSet const& set, AnswerLimits const& limits);

// The contents of a file: a header that names the scene, the answers, and a checksum of both.
std::vector<std::byte> encode(AnswerSet const& set, Hash const& scene);

// Throws Error with the reason unless these bytes are exactly what encode() writes for the scene.
AnswerSet decode(std::span<std::byte const> file, Hash const& scene);

}  // namespace gpu_shading::energyplus

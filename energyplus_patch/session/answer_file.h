#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "session/answers.h"
#include "session/deployment_states.h"
#include "session/digest.h"

namespace gpu_shading::energyplus {

// Answers and what their numbers stand for, of one scene.
struct AnswerSet {
  std::vector<SurfaceId> receivers;  // by ReceiverNumber
  DeploymentStates states;           // by Direction::state
  Answers answers;
};

// Adds to a set what it lacks and another has.
void add_answers(AnswerSet const& from, AnswerSet& to);

// As a file has them: a head that names the scene, the answers, and a checksum of all before it.
std::vector<std::byte> encode(AnswerSet const& set, Hash const& scene);

// Throws Error, saying what is the matter, where these bytes are not what encode() made for the
// scene, down to the last one.
AnswerSet decode(std::span<std::byte const> file, Hash const& scene);

}  // namespace gpu_shading::energyplus

#pragma once

#include <memory>
#include <string>

#include <swept/engine/task_system.h>
#include <swept/samples/runner.h>

#include "../reference/peer_world.h"

namespace swept::worlds {

/// Our engine driven like any other. It measures its stages, as the rival always does.
/// @param scene  outlives the world
/// @param tasks  null: the calling thread; outlives the world
/// @return null, and a reason in `error`, when the engine refuses something
std::unique_ptr<PeerWorld> makeSweptWorld(const SceneDescription& scene, Precision precision, TaskSystem* tasks,
                                          std::string& error);

}  // namespace swept::worlds

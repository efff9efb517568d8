#pragma once

#include <string>
#include <vector>

#include <swept/samples/scene_description.h>

#include "peer_settings.h"

namespace swept {

const char* peerName(PeerEngine engine);

/// Whether the engine was found when this was built.
bool hasPeer(PeerEngine engine);

/// What the scene needs and our adapter to the engine does not have, in a few words ("gear joints"); empty when it can
/// be run.
std::string peerLacks(PeerEngine engine, const SceneDescription& scene);

/// What the engine, as our adapter drives it, does otherwise than the scene format says: one sentence each.
std::vector<std::string> peerApproximations(PeerEngine engine, const SceneDescription& scene);

}  // namespace swept

#pragma once

#include <box2d/id.h>

#include <swept/samples/scene_description.h>

namespace swept {

/// @param joint  nothing that `peerLacks` names
/// @param isStiff  as stiff as the engine can solve
void addBox2d3Joint(b2WorldId world, b2BodyId bodyA, b2BodyId bodyB, const JointDescription& joint, bool isStiff);

}  // namespace swept

#pragma once

#include "../broadphase_contestant.h"

namespace swept::bench {

/// The pair finding of Box2D 3.x, whose functions are not public, rebuilt around its public dynamic tree: a tree each
/// for static, kinematic and dynamic proxies; a moved proxy's leaf is enlarged in place; then one query per moved proxy
/// and tree; of two moved ones only one reports; pairs that are known are looked up in a hash set, others filtered; at
/// the end the trees of movable things are partially rebuilt, as it does it when it has one thread. Its step does more
/// in the same stage: it looks filters up in its shapes and bodies, and makes contacts. What is measured here is
/// therefore what it takes at least.
std::unique_ptr<BroadphaseContestant> makeBox2d3Broadphase();

}  // namespace swept::bench

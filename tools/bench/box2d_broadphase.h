#pragma once

#include "broadphase_contestant.h"

namespace swept::bench {

/// `b2BroadPhase` of Box2D 2.4.1: one dynamic tree for everything, one query of it per moved proxy. It enlarges boxes
/// by 10 cm by itself; so that it works on the boxes of the trace and not on larger ones, it is given the world in
/// units of about a nanometre (a power of two, so nothing is rounded). It reports every overlap of a moved proxy, old
/// ones too: as its world does, filters and what is known already are looked up in the callback (the world walks the
/// contacts of a body; here it is a hash set).
std::unique_ptr<BroadphaseContestant> makeBox2dBroadphase();

}  // namespace swept::bench

#pragma once

#include "../toi_contestant.h"

namespace swept::bench {

/// `b2TimeOfImpact` of an installed Box2D 3.x, judged by its own contract: as that of 2.4.1 (box2d_toi.h), but with the
/// target max(slop, R − slop), and in coordinates about the start of B, as its solver asks. Its bodies do not turn at a
/// constant rate: its sweep holds the rotations of both ends, in float, and mixes them linearly and normalises. That is
/// the motion it is judged by. It cannot express half a turn or more, so it is not asked about such.
/// Iterations: not told by the engine, 0.
std::unique_ptr<ToiContestant> makeBox2d3Toi();

}  // namespace swept::bench

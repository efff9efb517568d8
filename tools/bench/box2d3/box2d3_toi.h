#pragma once

#include "../toi_contestant.h"

namespace swept::bench {

/// `b2TimeOfImpact` of an installed Box2D 3.x, judged by its own contract: as that of 2.4.1 (box2d_toi.h), but with the
/// target max(slop, R − slop), and in coordinates about the start of B, as its solver asks. Its bodies do not turn at a
/// constant rate: it mixes the two rotations linearly and normalises. So it is asked only where the two motions differ
/// by a fiftieth of the tolerance at most, that is, for turns up to a seventh of a radian at a reach of a metre, and the
/// tolerance it is judged by is stretched by as much.
/// Iterations: not told by the engine, 0.
std::unique_ptr<ToiContestant> makeBox2d3Toi();

}  // namespace swept::bench

#pragma once

#include "sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {

/// Rounds of impulses at one moment: a wedge of angle φ passes an impact to and fro about π/φ times; what still
/// approaches after that many is stopped plastically.
inline constexpr int kMaxImpactRounds = 64;

inline const Body& Flight::body() const { return world->bodies[slot]; }

/// What a turn moves: the farthest vertex, not what is round about it, metres. 0 of a disk about its centre.
inline double turningArm(const Shape& shape) { return static_cast<double>(shape.radius - shape.polygon.radius); }

/// Of a body as it is at the start of the step.
Flight flightOf(WorldState& world, std::uint32_t slot, double dt, FlightScratch& scratch);
/// The rest of the step as a sweep: the parabola through its exact end points with the present velocity. Exact without
/// damping.
Sweep sweepOf(const Flight& flight);
/// First static or kinematic shape that the rest of the step meets, before this fraction of it.
/// @param ahead  shapes that only what follows this fraction may meet are left out; not before `limit`
FirstImpact nextImpact(const Flight& flight, const Sweep& sweep, double limit = 1, double ahead = 1);
/// On to a fraction of the rest of the step, velocities too.
void advance(Flight& flight, const Sweep& sweep, double fraction);
/// Contacts of this moment with static and kinematic shapes, all together: approaching velocities are reflected, slow
/// ones stopped. The first one takes those that the last search found; the second one looks for them.
/// @return whether any of them was a hit: faster than what does not bounce
bool resolveHere(Flight& flight);
bool resolveStanding(Flight& flight);
/// Contacts of the start of the step. Before the first sweep: a shape that is within its target already is looked for
/// at a lower separation, as if its approach were dealt with. What has no contact is farther away than any target, but
/// for what woke in this step: that is met at fraction 0.
void resolveStart(Flight& flight);
/// Impulses of an impact of `scratch.states`, by the constraints in `scratch.order`: what still approaches after
/// `kMaxImpactRounds` is stopped. @param threshold  m/s, what meets slower does not bounce
void reflectOrStop(FlightScratch& scratch, Real threshold);
/// By which two bodies that sank below their target part, per inverse mass of each, world, m·kg: B along it, A against
/// it. Zero where they are as far apart as is told from noise.
/// @param separation   metres
/// @param inverseMass  of both together, 1/kg; 0 where none moves
DVec2 partingWay(const WorldState& world, const FlightObstacle& shapes, Real separation, double inverseMass,
                 Vec2 normal);
void notePose(const Flight& flight);
void limitSpeed(Flight& flight);
/// As the flight ends, before it is written down.
void limitSqueezed(Flight& flight);
/// Whether it gives up the rest of the step, after so many impacts: it may lose no more time than `maxLostTime`.
bool isExhausted(const Flight& flight, int impacts, LostTimeReason reason);
/// The rest of the step is lost.
void enterLedger(const Flight& flight, LostTimeReason reason);

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include "../state/world_state.h"

/// Who is awake (`WorldState::awake`) or held (`WorldState::held`), who wakes whom, and how long each has to rest
/// before it may sleep.

namespace swept::inline SWEPT_PRECISION {

/// Adds a body to the awake list, with all that fell asleep together with it. No effect on awake, static and disabled
/// bodies.
void wake(WorldState& world, std::uint32_t body);
/// Likewise, when something happens to a body between steps. What is awake rests anew: if it was about to fall asleep,
/// it would do so in the very step that shows what comes of it, and hang in the air, or lose a speed it was given.
void rouse(WorldState& world, std::uint32_t body);
/// Between steps a body is put elsewhere, or back into the world: it did not move there, and what bore it is gone; what
/// it stands on now may hold it in the very next step.
void notePut(Body& body);
/// Gives a body other velocities, between steps, and rouses it.
void setInMotion(WorldState& world, std::uint32_t body, Vec2 velocity, Real angularVelocity);
/// Wakes all that fell asleep; what was made asleep, and nothing woke yet, sleeps on.
void wakeAll(WorldState& world);
/// Wakes everything that a joint holds to the body.
void wakeJoined(WorldState& world, std::uint32_t body);
/// All that is held with a body takes part again, in its old order. @pre it is held
void releaseHeld(WorldState& world, std::uint32_t body);
/// As `wake`: a balance of all that rested together is sought at once.
void wakeToRest(WorldState& world, std::uint32_t body);
/// Likewise, as `rouse`: what carried it is gone, or is another thing now.
void rouseToRest(WorldState& world, std::uint32_t body);
/// What everything was in balance with is no longer so.
void releaseAllHeld(WorldState& world);
/// Whether a body wakes what it touches: it is awake and can push. A kinematic body at rest lets others sleep on it.
bool disturbs(const WorldState& world, std::uint32_t body);
/// Seconds that a body has to rest before it may sleep; a body without extent (only sensors) counts steps alone.
double restTimeOf(const WorldState& world, const Body& body);
/// All that is awake counts its rest from now on: after another gravity; and nothing counts while sleep is off.
void restAnew(WorldState& world);
/// Between steps: a body is no longer among the awake ones. Its place stays as a gap, so that each of many that go
/// costs no look at all.
void leaveAwake(WorldState& world, std::uint32_t body);
/// Leaves the ring of bodies it sleeps with by waking them all.
void removeFromAwake(WorldState& world, std::uint32_t body);
/// Closes these gaps, as a step begins; what stays moves up in its order.
void closeUpAwake(WorldState& world);
/// For all that sleeps, and one more body: then to wake any of it asks for no memory.
void makeRoomToWake(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION

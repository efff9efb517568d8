#pragma once

#include "../state/bullet_work.h"

namespace swept::inline SWEPT_PRECISION {

bool isBullet(const WorldState& world, std::uint32_t slot);
/// Whether it stays on its way, whatever hits it.
inline bool isTied(const Body& body) { return body.holdingJoints > 0 || body.touchesDynamic; }
/// How far any awake dynamic body gets at its speed in this step, metres.
Real farthestOf(const WorldState& world, Real dt);
/// Where a body may get within the step, whatever direction it is sent into at the speed that it began the step with:
/// told while others are moved. @pre `BulletWork::farthest`
Aabb realmAtStart(const WorldState& world, std::uint32_t slot, Real dt);
/// The number of the clash that the body was in before that dissolved (clash.h), else `kNoIndex`.
std::uint32_t dissolvedClashOf(const WorldState& world, std::uint32_t slot);
/// Who is a partner from the start of the step on, into `BulletWork::early`: bullets, and what is fast, or was moved
/// far, and near enough to get to where they may get. But bullets that sleep, or hardly move, are no more than what
/// others may meet
/// (`BulletWork::areSomeAtRest`): those in a pile cost as much as if they were none. And how far all but the early ones
/// move: `BulletWork::drift`.
void findEarly(WorldState& world, Real dt);

}  // namespace swept::inline SWEPT_PRECISION

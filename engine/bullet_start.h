#pragma once

#include "bullet_work.h"

namespace swept::inline SWEPT_PRECISION {

bool isBullet(const WorldState& world, std::uint32_t slot);
/// Who is a partner from the start of the step on, into `BulletWork::early`: bullets, and what is fast and near enough
/// to get to where they may get. And how far the others move: `BulletWork::drift`.
void findEarly(WorldState& world, Real dt);
/// Puts bodies into an order in which those that are near each other follow each other: along a curve that fills the
/// plane (G. M. Morton 1966).
void orderByPlace(WorldState& world, std::vector<std::uint32_t>& slots);

}  // namespace swept::inline SWEPT_PRECISION

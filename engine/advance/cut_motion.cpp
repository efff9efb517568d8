#include "cut_motion.h"

#include <algorithm>

#include "../bodies/body_mass.h"
#include "../flight/free_path.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Which part of a change of velocity impulses took back in the same time, by the part of them that opposes it. Forces
/// and damping are one change: what opposes both of them bears both.
double borneShare(double opposed, double changeSquared) {
    return changeSquared > 0 ? std::clamp(-opposed / changeSquared, 0.0, 1.0) : 1;
}

}  // namespace

void cutMotion(WorldState& world, std::uint32_t slot, const BodyMotion& before, double time, double fraction) {
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    motion.center = before.center + fraction * (motion.center - before.center);
    motion.angle = before.angle + fraction * (motion.angle - before.angle);
    updatePose(world, slot);
    const FreeVelocity whole = velocityAfter(before, driftOf(world, body, time));
    const FreeVelocity cut = velocityAfter(before, driftOf(world, body, fraction * time));
    const DVec2 change = toDouble(whole.linear - before.velocity);
    const double borne = borneShare(dot(toDouble(motion.velocity - whole.linear), change), dot(change, change));
    motion.velocity -= static_cast<Real>(1 - borne) * (whole.linear - cut.linear);
    const auto turn = static_cast<double>(whole.angular - before.angularVelocity);
    const auto solved = static_cast<double>(motion.angularVelocity - whole.angular);
    motion.angularVelocity -=
        static_cast<Real>(1 - borneShare(solved * turn, turn * turn)) * (whole.angular - cut.angular);
}

}  // namespace swept::inline SWEPT_PRECISION

#pragma once

#include "../counters.h"
#include "../state/body.h"
#include "members.h"

/// Members of what has more of them than can be tied: each list is checked to be complete.

namespace swept::inline SWEPT_PRECISION {

template <MaybeConst<Body> T>
constexpr auto allMembers(T& b) {
    static_assert(areAllListed<Body>(46));
    return listed(b.inverseMass, b.inverseInertia, b.extent, b.widest, b.radius, b.reach, b.localCenter, b.force,
                  b.torque, b.groundNormal, b.ground, b.holdingJoints, b.awake, b.fresh, b.isPut, b.touchesDynamic,
                  b.hasContact, b.deepContact, b.sunk, b.bounces, b.rests, b.strikes, b.startled, b.fast, b.flung,
                  b.hasSensor, b.hasLine, b.role, b.searchDebt, b.soughtSteps, b.effort, b.startCenter, b.startAngle,
                  b.leastPassed, b.def, b.shapes, b.joints, b.mass, b.inertia, b.lostTime, b.restCenter, b.restAngle,
                  b.restTime, b.restSteps, b.nextAsleep, b.heldIn);
}

template <MaybeConst<StepCounters> T>
constexpr auto allMembers(T& c) {
    static_assert(areAllListed<StepCounters>(39));
    return listed(c.awakeBodies, c.freeBodies, c.solvedBodies, c.flyers, c.clashes, c.pairsFound, c.boxTests,
                  c.contacts, c.manifolds, c.touching, c.constraints, c.colours, c.subSteps, c.bounceRounds,
                  c.bodySubSteps, c.effortClasses, c.mostSubSteps, c.bodiesAgain, c.directBodies, c.settledBodies,
                  c.factorisations, c.directRounds, c.directGivenUp, c.overPenetration, c.overJointError,
                  c.overLostTime, c.islands, c.sweeps, c.toiCalls, c.toiIterations, c.sensorSweeps, c.impacts,
                  c.aheadContacts, c.speedsLimited, c.speedsCapped, c.fellAsleep, c.wokeUp, c.putBack, c.proxiesMoved);
}

}  // namespace swept::inline SWEPT_PRECISION

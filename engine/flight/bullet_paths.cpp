#include "bullet_paths.h"

#include <algorithm>

#include "flight_state.h"
#include "sweep_obstacles.h"
#include "take_along.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A path that another body would push it along ends where it meets ground.
/// @return at which fraction of it; 1 where it meets none
double endAtGround(const Flight& flight, Sweep& path) {
    const FirstImpact first = nextImpact(flight, path);
    if (!first.hit) { return 1; }
    const DVec2 center = centerAt(path, first.fraction);
    path.a1 = angleAt(path, first.fraction);
    path.c1 = center;
    return first.fraction;
}

}  // namespace

bool mayLeave(const BulletPartner& partner) {
    return partner.isBullet && partner.tied && !partner.stopped && partner.flight.body().holdingJoints == 0;
}

double fractionAt(const BulletPartner& partner, double time) {
    const double length = partner.flight.dt - partner.pathFrom;
    return length > 0 ? std::min((time - partner.pathFrom) / length, 1.0) : 1;
}

Sweep pathAfter(const BulletPartner& partner, double time) {
    if (time <= partner.pathFrom || partner.pathFrom >= partner.flight.dt) { return partner.path; }
    return part(partner.path, std::min(fractionAt(partner, time), 1 - 0x1p-52), 1);
}

Sweep pathWith(const BulletPartner& rider, const BulletPartner& carrier, double time) {
    const Flight& flight = rider.flight;
    const double from = fractionAt(carrier, time);
    const double turn = angleAt(carrier.path, 1) - angleAt(carrier.path, from);
    const Rotation rotation = rotationFromAngle(turn);
    const BodyMotion& motion = flight.motion;
    const DVec2 arm = motion.center - centerAt(carrier.path, from);
    const DVec2 turned{static_cast<double>(rotation.c) * arm.x - static_cast<double>(rotation.s) * arm.y,
                       static_cast<double>(rotation.s) * arm.x + static_cast<double>(rotation.c) * arm.y};
    Sweep path{.localCenter = rider.path.localCenter,
               .c0 = motion.center,
               .c1 = centerAt(carrier.path, 1) + turned,
               .a0 = motion.angle,
               .a1 = motion.angle + (flight.body().def.fixedRotation ? 0 : turn)};
    const double met = endAtGround(flight, path);
    if (!(met < 1)) { return path; }
    // It stands there for the rest of the step, in which a kinematic body goes on.
    BodyMotion end = motionAt(path, 1, flight.body().localCenter);
    takeAlong(*flight.world, flight.slot, end, flight.elapsed + met * flight.remaining(), flight.dt, *flight.scratch);
    path.c1 = end.center;
    path.a1 = end.angle;
    return path;
}

void shift(Flight& flight, DVec2 by) {
    BodyMotion& motion = flight.motion;
    Sweep path{.localCenter = toDouble(flight.body().localCenter),
               .c0 = motion.center,
               .c1 = motion.center + by,
               .a0 = motion.angle,
               .a1 = motion.angle};
    endAtGround(flight, path);
    motion.center = path.c1;
    motion.pose = poseOf(motion.center, motion.angle, flight.body().localCenter);
}

}  // namespace swept::inline SWEPT_PRECISION

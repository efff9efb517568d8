// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "../../shapes/vec2.h"
#include "wide_drives.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_drives_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Lengths are found in double.
#if HWY_TARGET == HWY_SCALAR || !HWY_HAVE_FLOAT64
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const DriveKernels* kernelsForDrives() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"
#include "wide_pins.inc"
// after it
#include "wide_lengths.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

// Every function here does what its scalar twin in motor_constraint.cpp does, in the same order. Signs are moved only
// where that is exact.

class DriveGroup : PinGroup<WideDrive> {
public:
    HWY_INLINE DriveGroup(WideDrive& block, std::size_t begin, const SolverBodies& bodies)
        : PinGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findPlace(); }
        if (block_.parts.drivesLine) { pushOnly({at(block_.impulseX), at(block_.impulseY)}); }
        if (block_.parts.drivesAngle) { turn(at(block_.angularImpulse)); }
        writeBodies();
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findPlace(); }
        if (kUseBias) { aim(hn::Set(Tag(), pass.h)); }
        if (block_.parts.drivesAngle) { driveAngle<kUseBias>(); }
        if (block_.parts.drivesLine) { driveLine<kUseBias>(); }
        if (pass.isLast) { addUp(); }
        writeBodies();
    }

private:
    HWY_INLINE void findPlace() {
        if (!block_.parts.drivesLine) { return; }
        const Quad a = motionOfA();
        const Quad b = motionOfB();
        const Pair armA = armOfA(a);
        const Pair armB = armOfB(b);
        put(armA.x, block_.armAX, begin_);
        put(armA.y, block_.armAY, begin_);
        put(armB.x, block_.armBX, begin_);
        put(armB.y, block_.armBY, begin_);
        findMatrix(armA, armB);
        if (!block_.parts.seeksPlace) { return; }
        const Pair offset = this->anchorOffset(a, b, armA, armB);
        put(offset.x, block_.offsetNowX, begin_);
        put(offset.y, block_.offsetNowY, begin_);
    }

    /// `approachSpeed`.
    HWY_INLINE Lanes approachSpeed(Lanes distance, Lanes acceleration) const {
        const Lanes inTime = hn::Sqrt(hn::Mul(hn::Mul(hn::Set(Tag(), Real(2)), acceleration), distance));
        const Lanes near = hn::Mul(at(block_.approachRate), distance);
        return hn::IfThenElse(hn::Lt(inTime, near), inTime, near);
    }

    /// `aimDrive`.
    HWY_INLINE void aim(Lanes h) {
        if (block_.parts.seeksPlace) {
            const UnitLanes away = normalizedLanes({at(block_.offsetNowX), at(block_.offsetNowY)});
            const LaneMask isAway = hn::Gt(away.length, hn::Zero(Tag()));
            const Lanes acceleration = hn::Mul(hn::Div(at(block_.maxLinearImpulse), h), mass());
            const Lanes back = hn::Neg(approachSpeed(away.length, acceleration));
            put(hn::Mul(back, hn::IfThenElseZero(isAway, away.unit.x)), block_.velocityX, begin_);
            put(hn::Mul(back, hn::IfThenElseZero(isAway, away.unit.y)), block_.velocityY, begin_);
        }
        if (block_.parts.seeksAngle) {
            const Lanes off = angle();
            const Lanes acceleration = hn::Mul(hn::Div(at(block_.maxAngularImpulse), h), turns());
            put(hn::CopySign(approachSpeed(hn::Abs(off), acceleration), hn::Neg(off)), block_.spin, begin_);
        }
    }

    template <bool kUseBias>
    HWY_INLINE void driveAngle() {
        const Lanes response = turns();
        const Lanes before = at(block_.angularImpulse);
        Lanes wanted = at(block_.spin);
        if (kUseBias && block_.parts.seeksAngle) {
            wanted = hn::Sub(wanted, hn::Mul(hn::Mul(at(block_.ease), response), before));
            put(wanted, block_.spin, begin_);
        }
        const Lanes inertia = hn::Div(hn::Set(Tag(), Real(1)), response);
        const Lanes asWanted = hn::Sub(before, hn::Mul(inertia, hn::Sub(speedOfSpin(), wanted)));
        const Lanes change = hn::Sub(clampedTo(at(block_.maxAngularImpulse), asWanted), before);
        add(change, block_.angularImpulse);
        turn(change);
    }

    template <bool kUseBias>
    HWY_INLINE void driveLine() {
        const Matrix matrix = pointMatrix();
        const Pair before{at(block_.impulseX), at(block_.impulseY)};
        Pair wanted{at(block_.velocityX), at(block_.velocityY)};
        if (kUseBias && block_.parts.seeksPlace) {
            const Lanes ease = at(block_.ease);
            const Lanes givesX = hn::Add(hn::Mul(matrix.xx, before.x), hn::Mul(matrix.xy, before.y));
            const Lanes givesY = hn::Add(hn::Mul(matrix.xy, before.x), hn::Mul(matrix.yy, before.y));
            wanted = {hn::Sub(wanted.x, hn::Mul(ease, givesX)), hn::Sub(wanted.y, hn::Mul(ease, givesY))};
            put(wanted.x, block_.velocityX, begin_);
            put(wanted.y, block_.velocityY, begin_);
        }
        const Pair asWanted = minus(before, solved(matrix, minus(pointSpeeds(), wanted)));
        const UnitLanes size = normalizedLanes(asWanted);
        const Lanes most = at(block_.maxLinearImpulse);
        const LaneMask isTooMuch = hn::Gt(size.length, most);
        const Pair total{hn::IfThenElse(isTooMuch, hn::Mul(most, size.unit.x), asWanted.x),
                         hn::IfThenElse(isTooMuch, hn::Mul(most, size.unit.y), asWanted.y)};
        pushOnly(minus(total, before));
        put(total.x, block_.impulseX, begin_);
        put(total.y, block_.impulseY, begin_);
    }

    HWY_INLINE void addUp() {
        add(at(block_.impulseX), block_.totalX);
        add(at(block_.impulseY), block_.totalY);
        add(at(block_.angularImpulse), block_.totalTwist);
    }
};

const DriveKernels* kernelsForDrives() {
    static const DriveKernels kKernels = kernelsOf<DriveGroup, WideDrive>();
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForDrives);
}

const DriveKernels* driveKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForDrives)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

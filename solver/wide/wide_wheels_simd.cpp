// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "wide_targets.h"
#include "wide_wheels.h"

// Cars are few, and have two wheels: registers of 64 bytes are hardly ever full.
#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 32
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_wheels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || (defined(SWEPT_F64) && !HWY_HAVE_FLOAT64)
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const WheelKernels* kernelsForWheels() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"
#include "wide_lines.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

// Every function here does what its scalar twin in wheel_constraint.cpp does, in the same order. Signs are moved only
// where that is exact.

class WheelGroup : LineGroup<WideWheel> {
public:
    HWY_INLINE WheelGroup(WideWheel& block, std::size_t begin, const SolverBodies& bodies)
        : LineGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findAxle(); }
        if (block_.parts.hasSpring) { add(warmStartSpring(), block_.heldImpulse); }
        pushOnlyAcross(at(block_.heldImpulse));
        pushAlong(suspensionImpulse());
        if (block_.parts.hasMotor) { turn(at(block_.motorImpulse)); }
        writeBodies();
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findAxle(); }
        const Lanes given = kUseBias
                                ? hn::Mul(hn::Div(at(block_.impulseScale), at(block_.massScale)), at(block_.lonely))
                                : hn::Zero(Tag());
        solveAcross<kUseBias>(given);
        if (block_.parts.hasMotor) { driveSpin(given); }
        if (block_.parts.isSprung()) { solveAlong<kUseBias, false>(given, hn::Set(Tag(), pass.h)); }
        if (pass.isLast) { addUpLine(suspensionImpulse(), at(block_.motorImpulse)); }
        writeBodies();
    }

private:
    HWY_INLINE Lanes determinantWithAngle(const Spins& row) const {
        return hn::Add(hn::Mul(mass(), turns()), hn::Mul(bothTurn(), squareOf(hn::Sub(row.a, row.b))));
    }
    /// `axleOf`.
    HWY_INLINE void findAxle() {
        const Quad a = motionOfA();
        const Quad b = motionOfB();
        const Pair axis = rotated({a.z, a.w}, {at(block_.axisX), at(block_.axisY)});
        const Pair anchorA = armOfA(a);
        const Pair armB = armOfB(b);
        const Pair offset = anchorOffset(a, b, anchorA, armB);
        const Pair armA = plus(anchorA, offset);
        const Line line = findLine(axis, offset, armA, armB);
        put(hn::Add(hn::Mul(inverseInertiaA_, line.across.a), hn::Mul(inverseInertiaB_, line.across.b)),
            block_.spinCoupled, begin_);
        const Lanes point = pointDeterminant(armA, armB);
        const Lanes inverse = quotient(point, line.response, hn::Zero(Tag()));
        put(inverse, block_.inverseMass, begin_);
        if (block_.parts.hasSpring) { this->findGains(inverse); }
        put(quotient(determinantWithAngle(line.across), line.response, turns()), block_.spinInverse, begin_);
        put(lonelyResponse(line, point, fullDeterminant(armA, armB)), block_.lonely, begin_);
    }
    HWY_INLINE Lanes lonelyResponse(const Line& line, Lanes point, Lanes all) const {
        if (block_.parts.hasMotor && block_.parts.isSprung()) {
            return quotient(all, determinantWithAngle(line.along), line.response);
        }
        if (block_.parts.hasMotor) { return hn::Div(determinantWithAngle(line.across), turns()); }
        return block_.parts.isSprung() ? quotient(point, line.own, line.response) : line.response;
    }

    HWY_INLINE void driveSpin(Lanes given) {
        const GuidedPart spin = guidedPart(at(block_.spinInverse), turns(), at(block_.spinCoupled), given);
        const Lanes change = motorChange(spin.mass, speedOfSpin());
        add(change, block_.motorImpulse);
        turn(change);
        pushAcross(hn::Mul(change, spin.answer));
    }

    HWY_INLINE Lanes suspensionImpulse() const {
        return hn::Sub(hn::Add(at(block_.springImpulse), at(block_.lowerImpulse)), at(block_.upperImpulse));
    }
};

const WheelKernels* kernelsForWheels() {
    static const WheelKernels kKernels = kernelsOf<WheelGroup, WideWheel>();
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForWheels);
}

const WheelKernels* wheelKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForWheels)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

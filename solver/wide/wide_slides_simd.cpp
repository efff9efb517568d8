// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "../joints/free_angle.h"
#include "wide_slides.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 32
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_slides_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || (defined(SWEPT_F64) && !HWY_HAVE_FLOAT64)
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const SlideKernels* kernelsForSlides() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"
#include "wide_lines.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

// Every function here does what its scalar twin in prismatic_constraint.cpp does, in the same order. Signs are moved
// only where that is exact. One body or both can turn.

class SlideGroup : LineGroup<WideSlide> {
public:
    HWY_INLINE SlideGroup(WideSlide& block, std::size_t begin, const SolverBodies& bodies)
        : LineGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findSlide(); }
        if (block_.parts.hasSpring) {
            moveTwist(hn::Neg(leverTorque()));
            add(warmStartSpring(), block_.heldImpulse);
            moveTwist(leverTorque());
        }
        pushOnlyAcross(at(block_.heldImpulse));
        pushAlong(freedomImpulse());
        turn(hn::Sub(at(block_.heldTwist), leverTorque()));
        writeBodies();
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findSlide(); }
        const Lanes compliance = kUseBias ? hn::Div(at(block_.impulseScale), at(block_.massScale)) : hn::Zero(Tag());
        const Lanes given = hn::Mul(compliance, at(block_.lonely));
        moveTwist(hn::Neg(leverTorque()));
        solveAngle<kUseBias>(compliance);
        solveAcross<kUseBias>(given);
        if (block_.parts.any()) { solveAlong<kUseBias, true>(given, hn::Set(Tag(), pass.h)); }
        moveTwist(leverTorque());
        if (pass.isLast) { addUpLine(freedomImpulse(), at(block_.heldTwist)); }
        writeBodies();
    }

private:
    HWY_INLINE Lanes angleNow() const { return hn::Add(at(block_.baseAngle), hn::Sub(b_.w, a_.w)); }

    /// `slideOf`.
    HWY_INLINE void findSlide() {
        const Quad a = motionOfA();
        const Quad b = motionOfB();
        const Pair axis = rotated({a.z, a.w}, {at(block_.axisX), at(block_.axisY)});
        const Pair anchorA = armOfA(a);
        const Pair armB = armOfB(b);
        const Pair offset = anchorOffset(a, b, anchorA, armB);
        const Pair armA = plus(anchorA, offset);
        const Lanes turning = turns();
        const Lanes partA = hn::Div(inverseInertiaA_, turning);
        const Lanes partB = hn::Div(inverseInertiaB_, turning);
        const Pair lever{hn::Neg(hn::Add(hn::Mul(partA, armA.x), hn::Mul(partB, armB.x))),
                         hn::Neg(hn::Add(hn::Mul(partA, armA.y), hn::Mul(partB, armB.y)))};
        const Line line = findLine(axis, offset, plus(armA, lever), plus(armB, lever));
        const Lanes angle = angleNow();
        const Lanes leverAcross = crossOf(lever, axis);
        const Lanes leverAlong = dotOf(lever, axis);
        put(angle, block_.angle, begin_);
        put(leverAcross, block_.leverAcross, begin_);
        put(leverAlong, block_.leverAlong, begin_);
        add(hn::Mul(leverAcross, angle), block_.place);
        add(hn::Mul(leverAlong, angle), block_.gap);
        const Pair apart = minus(armA, armB);
        const Lanes determinant =
            hn::Mul(mass(), hn::Add(mass(), hn::Mul(hn::Mul(partA, inverseInertiaB_), dotOf(apart, apart))));
        const Lanes zero = hn::Zero(Tag());
        put(quotient(determinant, line.response, zero), block_.inverseMass, begin_);
        put(quotient(determinant, line.own, zero), block_.lonely, begin_);
        const Lanes farther = hn::Add(mass(), hn::Mul(turning, dotOf(lever, lever)));
        const Lanes part = hn::Div(hn::Mul(hn::Set(Tag(), kFreeAngle), mass()), farther);
        const Lanes share = hn::Mul(turning, hn::Min(hn::Set(Tag(), Real(1)), part));
        put(hn::IfThenElse(hn::Gt(farther, zero), share, turning), block_.angleShare, begin_);
    }

    HWY_INLINE Lanes freedomImpulse() const {
        return hn::Sub(hn::Add(hn::Add(at(block_.springImpulse), at(block_.motorImpulse)), at(block_.lowerImpulse)),
                       at(block_.upperImpulse));
    }
    HWY_INLINE Lanes leverTorque() const {
        return hn::Add(hn::Mul(freedomImpulse(), at(block_.leverAcross)),
                       hn::Mul(at(block_.heldImpulse), at(block_.leverAlong)));
    }
    HWY_INLINE void moveTwist(Lanes torque) { add(torque, block_.heldTwist); }

    template <bool kUseBias>
    HWY_INLINE void solveAngle(Lanes compliance) {
        const Lanes given = hn::Mul(compliance, at(block_.angleShare));
        Lanes wanted = speedOfSpin();
        if constexpr (kUseBias) {
            wanted = hn::Add(
                wanted, hn::Add(hn::Mul(at(block_.biasRate), at(block_.angle)), hn::Mul(given, at(block_.heldTwist))));
        }
        const Lanes twist = hn::Div(hn::Neg(wanted), hn::Add(turns(), given));
        moveTwist(twist);
        turn(twist);
    }
};

const SlideKernels* kernelsForSlides() {
    static const SlideKernels kKernels = kernelsOf<SlideGroup, WideSlide>();
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForSlides);
}

const SlideKernels* slideKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForSlides)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

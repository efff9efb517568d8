// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "../../shapes/vec2.h"
#include "wide_rods.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_rods_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Lengths are found in double.
#if HWY_TARGET == HWY_SCALAR || !HWY_HAVE_FLOAT64
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const RodKernels* kernelsForRods() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"
#include "wide_joints.inc"
// after it
#include "wide_lengths.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

// Every function here does what its scalar twin in distance_constraint.cpp does, in the same order. Signs are moved
// only where that is exact.

class RodGroup : JointGroup<WideRod> {
public:
    HWY_INLINE RodGroup(WideRod& block, std::size_t begin, const SolverBodies& bodies)
        : JointGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findGeometry(); }
        if (block_.parts.hasSpring) {
            const Lanes stretch = hn::Sub(at(block_.lengthNow), at(block_.length));
            const Lanes push = hn::Mul(hn::Neg(at(block_.mass)), hn::Mul(at(block_.springPush), stretch));
            put(push, block_.springImpulse, begin_);
        }
        apply(impulse());
        writeBodies();
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findGeometry(); }
        // A spring alone has its say in the pass with bias.
        if (kUseBias || block_.parts.isRigid || block_.parts.hasLimits) {
            solveParts<kUseBias>(hn::Set(Tag(), pass.h));
            writeBodies();
        }
        if (pass.isLast) { addUp(); }
    }

private:
    HWY_INLINE void findGeometry() {
        const Tag tag;
        const Lanes zero = hn::Zero(tag);
        const Quad a = motionOfA();
        const Quad b = motionOfB();
        const Pair armA = armOfA(a);
        const Pair armB = armOfB(b);
        put(armA.x, block_.armAX, begin_);
        put(armA.y, block_.armAY, begin_);
        put(armB.x, block_.armBX, begin_);
        put(armB.y, block_.armBY, begin_);
        const UnitLanes offset = normalizedLanes(anchorOffset(a, b, armA, armB));
        const LaneMask isLong = hn::Gt(offset.length, zero);
        const Pair axis{hn::IfThenElse(isLong, offset.unit.x, at(block_.axisX)),
                        hn::IfThenElse(isLong, offset.unit.y, at(block_.axisY))};
        put(axis.x, block_.axisX, begin_);
        put(axis.y, block_.axisY, begin_);
        put(offset.length, block_.lengthNow, begin_);
        const Lanes inverse = hn::Add(hn::Add(mass(), hn::Mul(inverseInertiaA_, squareOf(crossOf(armA, axis)))),
                                      hn::Mul(inverseInertiaB_, squareOf(crossOf(armB, axis))));
        const Lanes heavy = hn::Div(hn::Set(tag, Real(1)), inverse);
        put(hn::IfThenElseZero(hn::Gt(inverse, zero), heavy), block_.mass, begin_);
        if (block_.parts.hasSpring) { this->findGains(inverse); }
    }

    HWY_INLINE Lanes impulse() const {
        return hn::Sub(hn::Add(hn::Add(at(block_.rigidImpulse), at(block_.springImpulse)), at(block_.lowerImpulse)),
                       at(block_.upperImpulse));
    }
    HWY_INLINE Lanes speed() const {
        const Lanes x =
            hn::Sub(hn::Sub(b_.x, hn::Mul(b_.z, at(block_.armBY))), hn::Sub(a_.x, hn::Mul(a_.z, at(block_.armAY))));
        const Lanes y =
            hn::Sub(hn::Add(b_.y, hn::Mul(b_.z, at(block_.armBX))), hn::Add(a_.y, hn::Mul(a_.z, at(block_.armAX))));
        return hn::Add(hn::Mul(at(block_.axisX), x), hn::Mul(at(block_.axisY), y));
    }
    HWY_INLINE void apply(Lanes impulse) {
        const Lanes x = hn::Mul(impulse, at(block_.axisX));
        const Lanes y = hn::Mul(impulse, at(block_.axisY));
        const Lanes twistA = hn::Sub(hn::Mul(at(block_.armAY), x), hn::Mul(at(block_.armAX), y));
        a_.x = hn::Sub(a_.x, hn::Mul(inverseMassA_, x));
        a_.y = hn::Sub(a_.y, hn::Mul(inverseMassA_, y));
        a_.z = hn::Add(a_.z, hn::Mul(inverseInertiaA_, twistA));
        const Lanes twistB = hn::Sub(hn::Mul(at(block_.armBX), y), hn::Mul(at(block_.armBY), x));
        b_.x = hn::Add(b_.x, hn::Mul(inverseMassB_, x));
        b_.y = hn::Add(b_.y, hn::Mul(inverseMassB_, y));
        b_.z = hn::Add(b_.z, hn::Mul(inverseInertiaB_, twistB));
    }
    /// Of one part. Where nothing can be moved, nothing is pushed.
    HWY_INLINE void push(Lanes change, LaneArray& accumulated, bool isPull) {
        const LaneMask isMovable = hn::Gt(at(block_.mass), hn::Zero(Tag()));
        const Lanes before = at(accumulated);
        put(hn::IfThenElse(isMovable, hn::Add(before, change), before), accumulated, begin_);
        const Lanes pushed = hn::IfThenElseZero(isMovable, change);
        apply(isPull ? hn::Neg(pushed) : pushed);
    }

    template <bool kUseBias>
    HWY_INLINE void solveParts(Lanes h) {
        const Lanes mass = at(block_.mass);
        const Lanes length = at(block_.lengthNow);
        if (block_.parts.hasSpring && kUseBias) {
            push(this->dragChange(hn::Mul(mass, speed())), block_.springImpulse, false);
        }
        if (block_.parts.isRigid) {
            const Lanes error = kUseBias ? hn::Sub(length, at(block_.length)) : hn::Zero(Tag());
            push(scalarChange<kUseBias>(mass, speed(), error, at(block_.rigidImpulse)), block_.rigidImpulse, false);
        }
        if (!block_.parts.hasLimits) { return; }
        push(limitChange<kUseBias>(mass, speed(), hn::Sub(length, at(block_.minLength)), block_.lowerImpulse, h),
             block_.lowerImpulse, false);
        push(limitChange<kUseBias>(mass, hn::Neg(speed()), hn::Sub(at(block_.maxLength), length), block_.upperImpulse,
                                   h),
             block_.upperImpulse, true);
    }

    HWY_INLINE void addUp() {
        const Lanes all = impulse();
        add(hn::Mul(all, at(block_.axisX)), block_.totalX);
        add(hn::Mul(all, at(block_.axisY)), block_.totalY);
    }
};

const RodKernels* kernelsForRods() {
    static const RodKernels kKernels = kernelsOf<RodGroup, WideRod>();
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForRods);
}

const RodKernels* rodKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForRods)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

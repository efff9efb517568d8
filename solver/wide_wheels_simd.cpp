// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "wide_targets.h"
#include "wide_wheels.h"

// Cars are few, and have two wheels: registers of 64 bytes are hardly ever full.
#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 32
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide_wheels_simd.cpp"
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
#include "wide_joints.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

// Every function here does what its scalar twin in wheel_constraint.cpp does, in the same order. Signs are moved only
// where that is exact.

class WheelGroup : JointGroup<WideWheel> {
public:
    HWY_INLINE WheelGroup(WideWheel& block, std::size_t begin, const SolverBodies& bodies)
        : JointGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findAxle(); }
        if (block_.parts.hasSpring) { warmStartSpring(); }
        pushOnlyAcross(at(block_.heldImpulse));
        pushAlong(suspensionImpulse());
        if (block_.parts.hasMotor) { turn(at(block_.motorImpulse)); }
        writeBodies();
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findAxle(); }
        const Lanes given =
            kUseBias ? hn::Mul(hn::Div(at(block_.impulseScale), at(block_.massScale)), at(block_.lonely))
                     : hn::Zero(Tag());
        solveAcross<kUseBias>(given);
        if (block_.parts.hasMotor) { driveSpin(given); }
        if (block_.parts.isSprung()) { solveSuspension<kUseBias>(given, hn::Set(Tag(), pass.h)); }
        if (pass.isLast) { addUp(); }
        writeBodies();
    }

private:
    /// Speed along a row per turn of each body.
    struct Spins {
        Lanes a;
        Lanes b;
    };
    /// A row that the one across guides.
    struct Guided {
        Lanes mass;
        Lanes answer;
    };

    HWY_INLINE Pair axis() const { return {at(block_.axisNowX), at(block_.axisNowY)}; }
    HWY_INLINE Spins along() const { return {at(block_.alongA), at(block_.alongB)}; }
    HWY_INLINE Spins across() const { return {at(block_.acrossA), at(block_.acrossB)}; }
    HWY_INLINE Lanes responseOf(const Spins& p, const Spins& q) const {
        return hn::Add(hn::Mul(hn::Mul(inverseInertiaA_, p.a), q.a), hn::Mul(hn::Mul(inverseInertiaB_, p.b), q.b));
    }
    HWY_INLINE Lanes determinantWithAngle(const Spins& row) const {
        return hn::Add(hn::Mul(mass(), turns()), hn::Mul(bothTurn(), squareOf(hn::Sub(row.a, row.b))));
    }
    static HWY_INLINE Lanes quotient(Lanes a, Lanes b, Lanes otherwise) {
        return hn::IfThenElse(hn::Gt(b, hn::Zero(Tag())), hn::Div(a, b), otherwise);
    }

    /// `axleOf`.
    HWY_INLINE void findAxle() {
        const Arms arms = findArms();
        const Pair axis = rotated(arms.turnOfA, {at(block_.axisX), at(block_.axisY)});
        const Pair offset = anchorOffset(arms);
        const Pair armA = plus(arms.a, offset);
        const Spins along{crossOf(armA, axis), crossOf(arms.b, axis)};
        const Spins across{dotOf(armA, axis), dotOf(arms.b, axis)};
        put(axis.x, block_.axisNowX, begin_);
        put(axis.y, block_.axisNowY, begin_);
        put(along.a, block_.alongA, begin_);
        put(along.b, block_.alongB, begin_);
        put(across.a, block_.acrossA, begin_);
        put(across.b, block_.acrossB, begin_);
        put(dotOf(axis, offset), block_.place, begin_);
        put(crossOf(axis, offset), block_.gap, begin_);
        const Lanes straight = hn::Mul(mass(), dotOf(axis, axis));
        const Lanes response = hn::Add(straight, responseOf(across, across));
        const Lanes own = hn::Add(straight, responseOf(along, along));
        put(response, block_.response, begin_);
        put(own, block_.own, begin_);
        put(responseOf(along, across), block_.coupled, begin_);
        put(hn::Add(hn::Mul(inverseInertiaA_, across.a), hn::Mul(inverseInertiaB_, across.b)), block_.spinCoupled,
            begin_);
        const Lanes point = pointDeterminant(armA, arms.b);
        put(quotient(point, response, hn::Zero(Tag())), block_.inverseMass, begin_);
        put(quotient(determinantWithAngle(across), response, turns()), block_.spinInverse, begin_);
        put(lonelyResponse(along, across, response, own, point, fullDeterminant(armA, arms.b)), block_.lonely, begin_);
    }
    HWY_INLINE Lanes lonelyResponse(const Spins& along, const Spins& across, Lanes response, Lanes own, Lanes point,
                                    Lanes all) const {
        if (block_.parts.hasMotor && block_.parts.isSprung()) {
            return quotient(all, determinantWithAngle(along), response);
        }
        if (block_.parts.hasMotor) { return hn::Div(determinantWithAngle(across), turns()); }
        return block_.parts.isSprung() ? quotient(point, own, response) : response;
    }

    HWY_INLINE Lanes speedOn(Lanes straight, const Spins& row) const {
        return hn::Sub(hn::Add(straight, hn::Mul(row.b, b_.z)), hn::Mul(row.a, a_.z));
    }
    HWY_INLINE Pair moving() const { return {hn::Sub(b_.x, a_.x), hn::Sub(b_.y, a_.y)}; }
    HWY_INLINE Lanes speedAcross() const { return speedOn(crossOf(axis(), moving()), across()); }
    HWY_INLINE Lanes speedAlong() const { return speedOn(dotOf(axis(), moving()), along()); }

    HWY_INLINE void push(const Pair& direction, const Spins& row, Lanes impulse) {
        const Lanes ofA = hn::Mul(inverseMassA_, impulse);
        const Lanes ofB = hn::Mul(inverseMassB_, impulse);
        a_.x = hn::Sub(a_.x, hn::Mul(ofA, direction.x));
        a_.y = hn::Sub(a_.y, hn::Mul(ofA, direction.y));
        b_.x = hn::Add(b_.x, hn::Mul(ofB, direction.x));
        b_.y = hn::Add(b_.y, hn::Mul(ofB, direction.y));
        a_.z = hn::Sub(a_.z, hn::Mul(hn::Mul(inverseInertiaA_, row.a), impulse));
        b_.z = hn::Add(b_.z, hn::Mul(hn::Mul(inverseInertiaB_, row.b), impulse));
    }
    HWY_INLINE void pushAlong(Lanes impulse) { push(axis(), along(), impulse); }
    HWY_INLINE void pushOnlyAcross(Lanes impulse) {
        push({hn::Neg(at(block_.axisNowY)), at(block_.axisNowX)}, across(), impulse);
    }
    HWY_INLINE void pushAcross(Lanes impulse) {
        add(impulse, block_.heldImpulse);
        pushOnlyAcross(impulse);
    }

    /// `guidedBy`.
    HWY_INLINE Guided guided(Lanes inverse, Lanes own, Lanes coupled, Lanes given) const {
        const Tag tag;
        const Lanes zero = hn::Zero(tag);
        const Lanes response = at(block_.response);
        const LaneMask isHeavy = hn::Gt(response, zero);
        const LaneMask isMovable = hn::Gt(inverse, zero);
        const Lanes all = hn::Add(response, given);
        const Lanes soft = hn::Div(all, hn::Add(hn::Mul(inverse, response), hn::Mul(own, given)));
        const Lanes mass = hn::IfThenElse(isHeavy, soft, hn::Div(hn::Set(tag, Real(1)), inverse));
        return {hn::IfThenElseZero(isMovable, mass),
                hn::IfThenElseZero(hn::And(isMovable, isHeavy), hn::Div(hn::Neg(coupled), all))};
    }
    HWY_INLINE Guided guidedAlong(Lanes given) const {
        return guided(at(block_.inverseMass), at(block_.own), at(block_.coupled), given);
    }

    template <bool kUseBias>
    HWY_INLINE void solveAcross(Lanes given) {
        const Lanes all = hn::Add(at(block_.response), given);
        Lanes wanted = speedAcross();
        if constexpr (kUseBias) {
            wanted = hn::Add(wanted, hn::Add(hn::Mul(at(block_.biasRate), at(block_.gap)),
                                             hn::Mul(given, at(block_.heldImpulse))));
        }
        pushAcross(quotient(hn::Neg(wanted), all, hn::Zero(Tag())));
    }

    HWY_INLINE void driveSpin(Lanes given) {
        const Guided spin = guided(at(block_.spinInverse), turns(), at(block_.spinCoupled), given);
        const Lanes before = at(block_.motorImpulse);
        const Lanes wanted = hn::Sub(before, hn::Mul(spin.mass, hn::Sub(speedOfSpin(), at(block_.motorSpeed))));
        const Lanes change = hn::Sub(clampedTo(at(block_.maxMotorImpulse), wanted), before);
        add(change, block_.motorImpulse);
        turn(change);
        pushAcross(hn::Mul(change, spin.answer));
    }

    /// Of one part of the suspension. Where nothing can be moved, nothing is pushed.
    HWY_INLINE void pushPart(const Guided& guided, Lanes change, LaneArray& accumulated, bool isPull) {
        const LaneMask isMovable = hn::Gt(guided.mass, hn::Zero(Tag()));
        const Lanes before = at(accumulated);
        put(hn::IfThenElse(isMovable, hn::Add(before, change), before), accumulated, begin_);
        const Lanes size = hn::IfThenElseZero(isMovable, change);
        const Lanes pushed = isPull ? hn::Neg(size) : size;
        pushAlong(pushed);
        pushAcross(hn::Mul(pushed, guided.answer));
    }

    template <bool kUseBias>
    HWY_INLINE void solveSuspension(Lanes given, Lanes h) {
        const Guided along = guidedAlong(given);
        if (block_.parts.hasSpring && kUseBias) {
            const Lanes left = hn::Sub(at(block_.springImpulse), hn::Mul(along.mass, speedAlong()));
            pushPart(along, hn::Mul(at(block_.springDrag), left), block_.springImpulse, false);
        }
        if (!block_.parts.hasLimits) { return; }
        const Lanes place = at(block_.place);
        pushPart(along,
                 limitChange<kUseBias>(along.mass, speedAlong(), hn::Sub(place, at(block_.lower)), block_.lowerImpulse,
                                       h),
                 block_.lowerImpulse, false);
        pushPart(along,
                 limitChange<kUseBias>(along.mass, hn::Neg(speedAlong()), hn::Sub(at(block_.upper), place),
                                       block_.upperImpulse, h),
                 block_.upperImpulse, true);
    }

    HWY_INLINE void warmStartSpring() {
        const Guided along = guidedAlong(hn::Zero(Tag()));
        const Lanes before = at(block_.springImpulse);
        const Lanes push = hn::Mul(hn::Neg(along.mass), hn::Mul(at(block_.springPush), at(block_.place)));
        put(push, block_.springImpulse, begin_);
        add(hn::Mul(hn::Sub(push, before), along.answer), block_.heldImpulse);
    }

    HWY_INLINE Lanes suspensionImpulse() const {
        return hn::Sub(hn::Add(at(block_.springImpulse), at(block_.lowerImpulse)), at(block_.upperImpulse));
    }
    HWY_INLINE void addUp() {
        const Lanes all = suspensionImpulse();
        const Lanes held = at(block_.heldImpulse);
        add(hn::Sub(hn::Mul(all, at(block_.axisNowX)), hn::Mul(held, at(block_.axisNowY))), block_.totalX);
        add(hn::Add(hn::Mul(all, at(block_.axisNowY)), hn::Mul(held, at(block_.axisNowX))), block_.totalY);
        add(at(block_.motorImpulse), block_.totalTwist);
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

// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "wide_revolutes.h"

#include "../softness.h"
#include "wide_targets.h"

// Hinges differ in their parts, and most blocks of ragdolls have a few lanes in use: with registers of 64 bytes scene
// `rain` took 8 % longer to solve.
#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 32
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_revolutes_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || (defined(SWEPT_F64) && !HWY_HAVE_FLOAT64)
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const RevoluteKernels* kernelsForHinges() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"
#include "wide_pins.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

// Every function here does what its scalar twin in revolute_constraint.cpp does, in the same order.
// Signs are moved only where that is exact.

class RevoluteGroup : PinGroup<WideRevolute> {
public:
    HWY_INLINE RevoluteGroup(WideRevolute& block, std::size_t begin, const SolverBodies& bodies)
        : PinGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findGeometry(); }
        if (block_.parts.hasSpring) { warmStartSpring(); }
        applyImpulse();
        if (block_.parts.any()) { turn(twist()); }
        writeBodies();
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findGeometry(); }
        if (block_.parts.any()) {
            solveParts<kUseBias>(hn::Set(Tag(), pass.h));
        } else {
            solvePoint<kUseBias>();
        }
        if (pass.isLast) { addUp(); }
        writeBodies();
    }

private:
    /// A point that guides nothing.
    template <bool kUseBias>
    HWY_INLINE void solvePoint() {
        if constexpr (kUseBias) {
            const Lanes scale = hn::Neg(at(block_.massScale));
            const Lanes back = at(block_.impulseScale);
            const Pair firm = solved(pointMatrix(), wantedSpeeds());
            push({hn::Sub(hn::Mul(scale, firm.x), hn::Mul(back, at(block_.impulseX))),
                  hn::Sub(hn::Mul(scale, firm.y), hn::Mul(back, at(block_.impulseY)))});
        } else {
            const Pair firm = solved(pointMatrix(), pointSpeeds());
            push({hn::Neg(firm.x), hn::Neg(firm.y)});
        }
    }

    /// A point that guides the angle.
    template <bool kUseBias>
    HWY_INLINE void solveGuiding(const Spin& spin) {
        Pair rhs;
        if constexpr (kUseBias) {
            const Lanes x = at(block_.impulseX);
            const Lanes y = at(block_.impulseY);
            const Pair wanted = wantedSpeeds();
            rhs = {hn::Add(wanted.x, hn::Add(hn::Mul(spin.given.xx, x), hn::Mul(spin.given.xy, y))),
                   hn::Add(wanted.y, hn::Add(hn::Mul(spin.given.xy, x), hn::Mul(spin.given.yy, y)))};
        } else {
            rhs = pointSpeeds();
        }
        const Pair firm = solved(spin.pointMatrix, rhs);
        push({hn::Neg(firm.x), hn::Neg(firm.y)});
    }

    HWY_INLINE Lanes twist() const {
        return hn::Sub(hn::Add(hn::Add(at(block_.springImpulse), at(block_.motorImpulse)), at(block_.lowerImpulse)),
                       at(block_.upperImpulse));
    }
    /// `complianceOf` of a hinge.
    HWY_INLINE Lanes compliance() const {
        const Lanes ofPoint = hn::Div(at(block_.impulseScale), at(block_.massScale));
        if (!block_.parts.hasMotor) { return ofPoint; }
        const Lanes ofHeavy = hn::Min(inverseMassA_, inverseMassB_);
        const Lanes ratio = hn::Div(hn::Max(inverseMassA_, inverseMassB_), ofHeavy);
        const Lanes give = hn::Min(hn::Max(hn::Mul(hn::Set(Tag(), kMotorGive), ratio), hn::Set(Tag(), Real(1))),
                                   hn::Set(Tag(), kMostMotorGive));
        const LaneMask isWithin = hn::Lt(hn::Abs(at(block_.motorImpulse)), at(block_.maxMotorImpulse));
        const LaneMask isMotored = hn::And(hn::Gt(ofHeavy, hn::Zero(Tag())), isWithin);
        return hn::IfThenElse(isMotored, hn::Mul(give, ofPoint), ofPoint);
    }

    HWY_INLINE void turnGuided(const Spin& spin, Lanes impulse) {
        turn(impulse);
        push({hn::Mul(impulse, spin.answer.x), hn::Mul(impulse, spin.answer.y)});
    }

    HWY_INLINE void warmStartSpring() {
        const Spin spin = spinOf<false>();
        const Lanes before = at(block_.springImpulse);
        const Lanes push = hn::Mul(hn::Neg(spin.mass), hn::Mul(at(block_.springPush), angle()));
        put(push, block_.springImpulse, begin_);
        const Lanes change = hn::Sub(push, before);
        add(hn::Mul(change, spin.answer.x), block_.impulseX);
        add(hn::Mul(change, spin.answer.y), block_.impulseY);
    }

    template <bool kUseBias>
    HWY_INLINE void solveParts(Lanes h) {
        const Spin spin = kUseBias ? spinOf<kUseBias>(compliance()) : spinOf<kUseBias>();
        solveGuiding<kUseBias>(spin);
        const Lanes place = angle();
        if (block_.parts.hasSpring && kUseBias) {
            const Lanes change = this->dragChange(hn::Mul(spin.mass, speedOfSpin()));
            add(change, block_.springImpulse);
            turnGuided(spin, change);
        }
        if (block_.parts.hasMotor) {
            const Lanes before = at(block_.motorImpulse);
            const Lanes wanted = hn::Sub(before, hn::Mul(spin.mass, hn::Sub(speedOfSpin(), at(block_.motorSpeed))));
            const Lanes change = hn::Sub(clampedTo(at(block_.maxMotorImpulse), wanted), before);
            add(change, block_.motorImpulse);
            turnGuided(spin, change);
        }
        if (!block_.parts.hasLimits) { return; }
        const Lanes lower =
            limitChange<kUseBias>(spin.mass, speedOfSpin(), hn::Sub(place, at(block_.lower)), block_.lowerImpulse, h);
        add(lower, block_.lowerImpulse);
        turnGuided(spin, lower);
        const Lanes upper = limitChange<kUseBias>(spin.mass, hn::Neg(speedOfSpin()), hn::Sub(at(block_.upper), place),
                                                  block_.upperImpulse, h);
        add(upper, block_.upperImpulse);
        turnGuided(spin, hn::Neg(upper));
    }

    HWY_INLINE void addUp() {
        add(at(block_.impulseX), block_.totalX);
        add(at(block_.impulseY), block_.totalY);
        if (block_.parts.any()) { add(twist(), block_.totalTwist); }
    }
};

const RevoluteKernels* kernelsForHinges() {
    static const RevoluteKernels kKernels = kernelsOf<RevoluteGroup, WideRevolute>();
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForHinges);
}

const RevoluteKernels* revoluteKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForHinges)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

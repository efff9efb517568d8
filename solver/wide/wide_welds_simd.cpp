// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "wide_targets.h"
#include "wide_welds.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_welds_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || (defined(SWEPT_F64) && !HWY_HAVE_FLOAT64)
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const WeldKernels* kernelsForWelds() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"
#include "wide_pins.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

// Every function here does what its scalar twin in weld_constraint.cpp does, in the same order. Signs are moved only
// where that is exact.

class WeldGroup : PinGroup<WideWeld> {
public:
    HWY_INLINE WeldGroup(WideWeld& block, std::size_t begin, const SolverBodies& bodies)
        : PinGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findSeam(); }
        applyImpulse();
        turn(at(block_.angularImpulse));
        writeBodies();
    }

    /// `solveRigid`.
    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findSeam(); }
        const Pair firm = solved(pointMatrix(), kUseBias ? wantedSpeeds() : pointSpeeds());
        push({hn::Neg(firm.x), hn::Neg(firm.y)});
        const Lanes wanted = kUseBias ? hn::Add(speedOfSpin(), hn::Mul(at(block_.biasRate), angle())) : speedOfSpin();
        const Lanes twist = hn::Mul(hn::Neg(at(block_.spinMass)), wanted);
        turnBy(twist);
        push({hn::Mul(twist, at(block_.answerX)), hn::Mul(twist, at(block_.answerY))});
        if (kUseBias) {
            const Lanes back = hn::Neg(at(block_.impulseScale));
            push({hn::Mul(back, at(block_.impulseX)), hn::Mul(back, at(block_.impulseY))});
            turnBy(hn::Mul(back, at(block_.angularImpulse)));
        }
        if (pass.isLast) { addUp(); }
        writeBodies();
    }

private:
    HWY_INLINE void findSeam() {
        findGeometry();
        const Spin spin = spinOf<false>();
        put(spin.mass, block_.spinMass, begin_);
        put(spin.answer.x, block_.answerX, begin_);
        put(spin.answer.y, block_.answerY, begin_);
    }
    HWY_INLINE void turnBy(Lanes twist) {
        add(twist, block_.angularImpulse);
        turn(twist);
    }
    HWY_INLINE void addUp() {
        add(at(block_.impulseX), block_.totalX);
        add(at(block_.impulseY), block_.totalY);
        add(at(block_.angularImpulse), block_.totalTwist);
    }
};

const WeldKernels* kernelsForWelds() {
    static const WeldKernels kKernels = kernelsOf<WeldGroup, WideWeld>();
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForWelds);
}

const WeldKernels* weldKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForWelds)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

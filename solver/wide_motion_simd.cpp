// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include <array>

#include "../shapes/trig_series.h"
#include "wide_contacts.h"
#include "wide_motion.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide_motion_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || !HWY_HAVE_FLOAT64  // angles are double
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
MoveBodies kernelForMotion() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using Angles = hn::Repartition<double, Tag>;
using AngleLanes = hn::Vec<Angles>;

/// `polynomialInPairs`.
template <std::size_t N>
HWY_INLINE AngleLanes polynomial(const std::array<double, N>& c, AngleLanes z) {
    const Angles tag;
    const auto term = [tag, &c, z](std::size_t i)
                          HWY_ATTR { return hn::Add(hn::Set(tag, c[i]), hn::Mul(hn::Set(tag, c[i + 1]), z)); };
    const AngleLanes z2 = hn::Mul(z, z);
    const AngleLanes z4 = hn::Mul(z2, z2);
    const AngleLanes low = hn::Add(term(0), hn::Mul(z2, term(2)));
    const AngleLanes top = N == 8 ? term(N - 2) : hn::Set(tag, c[6]);
    const AngleLanes high = hn::Add(term(4), hn::Mul(z2, top));
    return hn::Add(low, hn::Mul(z4, high));
}

/// `sinCosOfReduced` of angles that need no reduction. @return whether that is so of all
HWY_INLINE bool sinCosOfSmall(AngleLanes x, AngleLanes& sines, AngleLanes& cosines) {
    const Angles tag;
    const AngleLanes zero = hn::Zero(tag);
    const AngleLanes one = hn::Set(tag, 1.0);
    const AngleLanes turns = hn::Add(hn::Mul(x, hn::Set(tag, kTwoOverPi)), hn::Set(tag, 0.5));
    // What is not a number is not small.
    if (!hn::AllTrue(tag, hn::And(hn::Ge(turns, zero), hn::Lt(turns, one)))) { return false; }
    const AngleLanes z = hn::Mul(x, x);
    const AngleLanes half = hn::Mul(hn::Set(tag, 0.5), z);
    const AngleLanes sine = hn::Add(x, hn::Mul(hn::Mul(x, z), polynomial(kSine, z)));
    const AngleLanes top = hn::Sub(one, half);
    const AngleLanes rest = hn::Add(hn::Sub(hn::Sub(one, top), half), hn::Mul(hn::Mul(z, z), polynomial(kCosine, z)));
    sines = hn::IfThenElse(hn::Eq(x, zero), x, sine);
    cosines = hn::Add(top, rest);
    return true;
}

/// In double, whatever a number is. @return whether all angles need no reduction; else nothing is found
template <class RealTag>
HWY_INLINE bool rotationsOf(RealTag tag, hn::Vec<RealTag> angles, hn::Vec<RealTag>& cosines, hn::Vec<RealTag>& sines) {
    if constexpr (sizeof(Real) == sizeof(double)) {
        return sinCosOfSmall(angles, sines, cosines);
    } else {
        const hn::Half<RealTag> half;
        AngleLanes lowSines;
        AngleLanes lowCosines;
        AngleLanes highSines;
        AngleLanes highCosines;
        const AngleLanes low = hn::PromoteTo(Angles(), hn::LowerHalf(half, angles));
        const AngleLanes high = hn::PromoteTo(Angles(), hn::UpperHalf(half, angles));
        if (!sinCosOfSmall(low, lowSines, lowCosines)) { return false; }
        if (!sinCosOfSmall(high, highSines, highCosines)) { return false; }
        sines = hn::Combine(tag, hn::DemoteTo(half, highSines), hn::DemoteTo(half, lowSines));
        cosines = hn::Combine(tag, hn::DemoteTo(half, highCosines), hn::DemoteTo(half, lowCosines));
        return true;
    }
}

constexpr auto kInOrder = [] {
    std::array<BodySlot, kGroup> slots{};
    for (std::size_t i = 0; i < kGroup; ++i) { slots[i] = static_cast<BodySlot>(i); }
    return slots;
}();

/// @return whether it was done
HWY_INLINE bool moveGroup(std::span<BodyState> bodies, Lanes h) {
    const Quad speed = gather(bodies, kInOrder.data(), kVelocities);
    Quad motion = gather(bodies, kInOrder.data(), kMotion);
    const Lanes angle = hn::Add(speed.w, hn::Mul(h, speed.z));
    if (!rotationsOf(Tag(), angle, motion.z, motion.w)) { return false; }
    motion.x = hn::Add(motion.x, hn::Mul(h, speed.x));
    motion.y = hn::Add(motion.y, hn::Mul(h, speed.y));
    constexpr std::uint32_t kAll = (1U << kGroup) - 1;
    scatter({speed.x, speed.y, speed.z, angle}, bodies, kInOrder.data(), kVelocities, kAll);
    scatter(motion, bodies, kInOrder.data(), kMotion, kAll);
    return true;
}

void moveGroups(std::span<BodyState> bodies, Real h) {
    const Lanes wide = hn::Set(Tag(), h);
    for (; bodies.size() >= kGroup; bodies = bodies.subspan(kGroup)) {
        if (!moveGroup(bodies.first(kGroup), wide)) { moveBodies(bodies.first(kGroup), h); }
    }
    moveBodies(bodies, h);
}

MoveBodies kernelForMotion() { return moveGroups; }

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelForMotion);
}

MoveBodies motionKernel() { return HWY_DYNAMIC_DISPATCH(kernelForMotion)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include <algorithm>
#include <array>
#include <cstddef>

#include "../../shapes/trig_series.h"
#include "wide_contacts.h"
#include "wide_motion.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_motion_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || !HWY_HAVE_FLOAT64  // angles are double
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
MoveBodies kernelForMotion() { return nullptr; }
FindRotations kernelForRotations() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_bodies.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

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

/// Where the bodies in the lanes of a group are.
using GroupOffsets = std::array<StateOffset, kGroup>;

constexpr GroupOffsets kInOrder = [] {
    GroupOffsets offsets{};
    for (std::size_t i = 0; i < kGroup; ++i) { offsets[i] = offsetOf(static_cast<BodySlot>(i)); }
    return offsets;
}();
constexpr std::uint32_t kAll = (1U << kGroup) - 1;

/// @param meant  one bit per lane: the others are not written
/// @return whether it was done
HWY_INLINE bool moveGroup(std::byte* bodies, const GroupOffsets& offsets, std::uint32_t meant, Lanes h) {
    const Quad speed = gather(bodies, offsets.data(), kVelocities);
    Quad motion = gather(bodies, offsets.data(), kMotion);
    const Lanes angle = hn::Add(speed.w, hn::Mul(h, speed.z));
    if (!rotationsOf(Tag(), angle, motion.z, motion.w)) { return false; }
    motion.x = hn::Add(motion.x, hn::Mul(h, speed.x));
    motion.y = hn::Add(motion.y, hn::Mul(h, speed.y));
    scatter({speed.x, speed.y, speed.z, angle}, bodies, offsets.data(), kVelocities, meant);
    scatter(motion, bodies, offsets.data(), kMotion, meant);
    return true;
}

/// Fewer bodies cost less one by one (AVX-512: 7 ns each against 25 for sixteen floats, 11 for eight doubles).
constexpr std::size_t kFewestMoved = kGroup / 4 + 1;

/// Fewer bodies than fill a register: the first one stands in all lanes that are left over.
HWY_INLINE bool moveSome(std::span<BodyState> bodies, Lanes h) {
    if (bodies.size() < kFewestMoved) { return false; }
    static constexpr std::array<GroupOffsets, kGroup> kFirst = [] {
        std::array<GroupOffsets, kGroup> ofSo{};
        for (std::size_t many = 0; many < kGroup; ++many) {
            for (std::size_t i = 0; i < many; ++i) { ofSo[many][i] = kInOrder[i]; }
        }
        return ofSo;
    }();
    return moveGroup(bytesOf(bodies), kFirst[bodies.size()], (1U << bodies.size()) - 1, h);
}

void moveGroups(std::span<BodyState> bodies, Real h) {
    const Lanes wide = hn::Set(Tag(), h);
    for (; bodies.size() >= kGroup; bodies = bodies.subspan(kGroup)) {
        if (!moveGroup(bytesOf(bodies), kInOrder, kAll, wide)) { moveBodies(bodies.first(kGroup), h); }
    }
    if (!moveSome(bodies, wide)) { moveBodies(bodies, h); }
}

MoveBodies kernelForMotion() { return moveGroups; }

constexpr std::size_t kAngles = hn::MaxLanes(Angles());

/// `reduced` of shapes/trig.cpp, and `sinCosOfReduced`.
HWY_INLINE void sinCosInQuadrant(AngleLanes angle, AngleLanes quadrant, AngleLanes& sine, AngleLanes& cosine) {
    const Angles tag;
    const AngleLanes one = hn::Set(tag, 1.0);
    const AngleLanes afterFirst = hn::Sub(angle, hn::Mul(quadrant, hn::Set(tag, kHalfPi1)));
    const AngleLanes second = hn::Mul(quadrant, hn::Set(tag, kHalfPi2));
    const AngleLanes afterSecond = hn::Sub(afterFirst, second);
    const AngleLanes subtracted = hn::Sub(afterFirst, afterSecond);
    const AngleLanes lost = hn::Add(hn::Sub(afterFirst, hn::Add(afterSecond, subtracted)), hn::Sub(subtracted, second));
    const AngleLanes rest = hn::Sub(lost, hn::Mul(quadrant, hn::Set(tag, kHalfPi3)));
    const AngleLanes high = hn::Add(afterSecond, rest);
    const AngleLanes low = hn::Add(hn::Sub(afterSecond, high), rest);
    const AngleLanes z = hn::Mul(high, high);
    const AngleLanes half = hn::Mul(hn::Set(tag, 0.5), z);
    const AngleLanes top = hn::Sub(one, half);
    sine = hn::Add(high, hn::Add(hn::Mul(hn::Mul(high, z), polynomial(kSine, z)), hn::Mul(low, top)));
    cosine = hn::Add(top, hn::Add(hn::Sub(hn::Sub(one, top), half),
                                  hn::Sub(hn::Mul(hn::Mul(z, z), polynomial(kCosine, z)), hn::Mul(high, low))));
}

/// @tparam Number  of `Rotation`
template <class Number>
HWY_INLINE void storeRotations(AngleLanes cosines, AngleLanes sines, Number* out) {
    const hn::Rebind<Number, Angles> tag;
    if constexpr (sizeof(Number) == sizeof(double)) {
        hn::StoreInterleaved2(cosines, sines, tag, out);
    } else {
        hn::StoreInterleaved2(hn::DemoteTo(tag, cosines), hn::DemoteTo(tag, sines), tag, out);
    }
}

/// `rotationFromAngle` of a group. @return whether all angles are such as are reduced by quadrants alone; else nothing
/// is found
HWY_INLINE bool rotateGroup(const double* angles, Rotation* rotations) {
    const Angles tag;
    const AngleLanes angle = hn::LoadU(tag, angles);
    if (!hn::AllTrue(tag, hn::Le(hn::Abs(angle), hn::Set(tag, kLargestExactAngle)))) { return false; }
    const AngleLanes zero = hn::Zero(tag);
    const AngleLanes quadrant = hn::Floor(hn::Add(hn::Mul(angle, hn::Set(tag, kTwoOverPi)), hn::Set(tag, 0.5)));
    AngleLanes sine;
    AngleLanes cosine;
    sinCosInQuadrant(angle, quadrant, sine, cosine);
    // Of four quadrants, exactly.
    const AngleLanes turns = hn::Floor(hn::Mul(quadrant, hn::Set(tag, 0.25)));
    const AngleLanes place = hn::Sub(quadrant, hn::Mul(hn::Set(tag, 4.0), turns));
    const auto isLast = hn::Ge(place, hn::Set(tag, 3.0));
    const auto isBack = hn::Ge(place, hn::Set(tag, 2.0));
    const auto isTurned = hn::Ge(place, hn::Set(tag, 1.0));
    const auto isOdd = hn::Or(hn::AndNot(isBack, isTurned), isLast);
    const AngleLanes ofSine = hn::IfThenElse(isOdd, cosine, sine);
    const AngleLanes ofCosine = hn::IfThenElse(isOdd, sine, cosine);
    const AngleLanes sines = hn::IfThenElse(isBack, hn::Neg(ofSine), ofSine);
    const AngleLanes cosines = hn::IfThenElse(hn::AndNot(isLast, isTurned), hn::Neg(ofCosine), ofCosine);
    const AngleLanes s = hn::IfThenElse(hn::Eq(angle, zero), angle, sines);  // keeps the sign of −0
    storeRotations(cosines, s, reinterpret_cast<Real*>(rotations));
    return true;
}

void rotateGroups(std::span<const double> angles, std::span<Rotation> rotations) {
    static_assert(sizeof(Rotation) == 2 * sizeof(Real) && offsetof(Rotation, s) == sizeof(Real));
    std::size_t i = 0;
    for (; i + kAngles <= angles.size(); i += kAngles) {
        if (!rotateGroup(&angles[i], &rotations[i])) {
            findRotations(angles.subspan(i, kAngles), rotations.subspan(i, kAngles));
        }
    }
    if (i == angles.size()) { return; }
    const std::size_t left = angles.size() - i;
    double some[kAngles] = {};
    Rotation found[kAngles];
    for (std::size_t k = 0; k < left; ++k) { some[k] = angles[i + k]; }
    if (!rotateGroup(some, found)) { return findRotations(angles.subspan(i), rotations.subspan(i)); }
    for (std::size_t k = 0; k < left; ++k) { rotations[i + k] = found[k]; }
}

FindRotations kernelForRotations() { return rotateGroups; }

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelForMotion);
HWY_EXPORT(kernelForRotations);
}  // namespace

MoveBodies motionKernel() { return HWY_DYNAMIC_DISPATCH(kernelForMotion)(); }
FindRotations rotationKernel() { return HWY_DYNAMIC_DISPATCH(kernelForRotations)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

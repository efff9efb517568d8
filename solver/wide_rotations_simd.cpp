// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include <array>

#include "../shapes/trig_series.h"
#include "wide_rotations.h"
#include "wide_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide_rotations_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
RotateBodies kernelForRotations() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Angles = hn::CappedTag<double, 4>;
using AngleLanes = hn::Vec<Angles>;
constexpr std::size_t kAngles = hn::MaxLanes(Angles());

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
HWY_INLINE bool sinCosOfSmall(const double* angles, double* sines, double* cosines) {
    const Angles tag;
    const AngleLanes x = hn::Load(tag, angles);
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
    hn::Store(hn::IfThenElse(hn::Eq(x, zero), x, sine), tag, sines);
    hn::Store(hn::Add(top, rest), tag, cosines);
    return true;
}

void rotateBodies(std::span<BodyState> bodies) {
    alignas(32) std::array<double, kAngles> angles;
    alignas(32) std::array<double, kAngles> sines;
    alignas(32) std::array<double, kAngles> cosines;
    std::size_t i = 0;
    for (; i + kAngles <= bodies.size(); i += kAngles) {
        for (std::size_t lane = 0; lane < kAngles; ++lane) {
            angles[lane] = static_cast<double>(bodies[i + lane].deltaAngle);
        }
        const bool small = sinCosOfSmall(angles.data(), sines.data(), cosines.data());
        for (std::size_t lane = 0; lane < kAngles; ++lane) {
            bodies[i + lane].deltaRotation =
                small ? Rotation{static_cast<Real>(cosines[lane]), static_cast<Real>(sines[lane])}
                      : rotationFromAngle(angles[lane]);
        }
    }
    for (; i < bodies.size(); ++i) {
        bodies[i].deltaRotation = rotationFromAngle(static_cast<double>(bodies[i].deltaAngle));
    }
}

RotateBodies kernelForRotations() { return rotateBodies; }

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelForRotations);
}

RotateBodies rotationKernel() { return HWY_DYNAMIC_DISPATCH(kernelForRotations)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

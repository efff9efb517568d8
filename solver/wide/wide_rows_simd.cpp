// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include <cstddef>

#include "../contacts/contact_lanes.h"
#include "../contacts/contact_rows.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_rows_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || (defined(SWEPT_F64) && !HWY_HAVE_FLOAT64)
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const ContactRowKernels* kernelsForRows() { return nullptr; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_contact_masses.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

using namespace SWEPT_GROUP;

// Places of numbers in a row, from the manifold's normal on, in `Real`s.
constexpr std::size_t inReals(std::size_t bytes) { return bytes / sizeof(Real); }
constexpr std::size_t kRowBegin = offsetof(ContactRow, manifold) + offsetof(Manifold, normal);
constexpr std::size_t kNormalAndFirst = 0;       // normal, first point
constexpr std::size_t kSeparationAndSecond = 4;  // separation of the first point, a name, second point
constexpr std::size_t kSecondSeparation = 8;
constexpr std::size_t kImpulses = inReals(offsetof(ContactRow, normalImpulse) - kRowBegin);
constexpr std::size_t kSurface = inReals(offsetof(ContactRow, friction) - kRowBegin);  // and restitution, radii
static_assert(sizeof(ManifoldPoint) == 4 * sizeof(Real) && offsetof(ManifoldPoint, separation) == 2 * sizeof(Real));
static_assert(offsetof(Manifold, points) == 2 * sizeof(Real));
static_assert(offsetof(ContactRow, tangentImpulse) == offsetof(ContactRow, normalImpulse) + 2 * sizeof(Real));
static_assert(offsetof(ContactRow, radiusB) == offsetof(ContactRow, friction) + 3 * sizeof(Real));
// What is loaded as four numbers ends within the row.
static_assert(sizeof(ContactRow) >= kRowBegin + (kSurface + 4) * sizeof(Real));

/// The numbers of the contacts of lanes.
struct RowsOfLanes {
    const ContactRow* const* rows;
    HWY_INLINE const Real* operator[](std::size_t lane) const {
        return reinterpret_cast<const Real*>(reinterpret_cast<const char*>(rows[lane]) + kRowBegin);
    }
};
struct WritableRows {
    ContactRow* const* rows;
    HWY_INLINE Real* operator[](std::size_t lane) const {
        return reinterpret_cast<Real*>(reinterpret_cast<char*>(rows[lane]) + kRowBegin);
    }
};

struct LanePair {
    Lanes x;
    Lanes y;
};

/// What the points of a group of contacts have in common.
struct Frame {
    LanePair rotation;
    LanePair localCenter;
    LanePair fromAToB;

    HWY_INLINE LanePair rotated(LanePair v) const {
        return {hn::Sub(hn::Mul(rotation.x, v.x), hn::Mul(rotation.y, v.y)),
                hn::Add(hn::Mul(rotation.y, v.x), hn::Mul(rotation.x, v.y))};
    }
};

/// `constraintPointOf` of the engine. @param impulses  of the normal and the tangent, as kept
HWY_INLINE void fillPoint(WideContactPoint& lanes, std::size_t begin, const Frame& frame, LanePair point,
                          Lanes separation, LanePair impulses, const ContactTerms& terms) {
    const Tag tag;
    const LanePair a = frame.rotated({hn::Sub(point.x, frame.localCenter.x), hn::Sub(point.y, frame.localCenter.y)});
    put(a.x, lanes.normalArmA, begin);
    put(a.y, lanes.tangentArmA, begin);
    put(hn::Sub(a.x, frame.fromAToB.x), lanes.normalArmB, begin);
    put(hn::Sub(a.y, frame.fromAToB.y), lanes.tangentArmB, begin);
    put(separation, lanes.baseSeparation, begin);
    const Lanes scale = hn::Set(tag, terms.scale);
    const Lanes normalImpulse = hn::Mul(scale, impulses.x);
    put(normalImpulse, lanes.normalImpulse, begin);
    put(hn::Mul(scale, impulses.y), lanes.tangentImpulse, begin);
    put(hn::Zero(tag), lanes.totalNormalImpulse, begin);
    if (terms.settled) {
        put(hn::IfThenZeroElse(hn::Gt(normalImpulse, hn::Zero(tag)), separation), lanes.separation, begin);
    }
}

/// One bit per lane of the group.
HWY_INLINE std::uint32_t bitsOf(LaneMask mask) {
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), mask, bits);
    return std::uint32_t{bits[0]} | std::uint32_t{bits[1]} << 8U;
}

/// Of bodies that can be moved.
HWY_INLINE std::uint32_t movableOf(const LaneArray& inverseMass, const LaneArray& inverseInertia, std::size_t begin) {
    const Lanes zero = hn::Zero(Tag());
    return bitsOf(hn::Or(hn::Gt(lanesAt(inverseMass, begin), zero), hn::Gt(lanesAt(inverseInertia, begin), zero)));
}

template <std::size_t kPoints>
HWY_INLINE void fillSoftness(WideContact<kPoints>& block, std::size_t begin, const ContactTerms& terms) {
    const Tag tag;
    const Lanes zero = hn::Zero(tag);
    const LaneMask isOnGround =
        hn::Or(hn::Eq(lanesAt(block.inverseMassA, begin), zero), hn::Eq(lanesAt(block.inverseMassB, begin), zero));
    const auto chosen = [&](Real onGround, Real between) {
        return hn::IfThenElse(isOnGround, hn::Set(tag, onGround), hn::Set(tag, between));
    };
    put(chosen(terms.groundSoftness.biasRate, terms.softness.biasRate), block.biasRate, begin);
    put(chosen(terms.groundSoftness.massScale, terms.softness.massScale), block.massScale, begin);
    put(chosen(terms.groundSoftness.impulseScale, terms.softness.impulseScale), block.impulseScale, begin);
}

template <std::size_t kPoints>
HWY_INLINE void fillGroup(WideContact<kPoints>& block, std::size_t begin, const ContactSources& from,
                          const ContactTerms& terms) {
    const Tag tag;
    const RowsOfLanes rows{from.rows.data() + begin};
    const auto at = [begin](const LaneArray& lanes) { return lanesAt(lanes, begin); };
    const Frame frame{.rotation = {at(from.rotationC), at(from.rotationS)},
                      .localCenter = {at(from.localCenterX), at(from.localCenterY)},
                      .fromAToB = {at(from.fromAToBX), at(from.fromAToBY)}};
    const Quad first = loadColumns(rows, kNormalAndFirst);
    const Quad second = loadColumns(rows, kSeparationAndSecond);
    const Quad impulses = loadColumns(rows, kImpulses);
    const Quad surface = loadColumns(rows, kSurface);
    const LanePair normal = frame.rotated({first.x, first.y});
    fillPoint(block.points[0], begin, frame, {first.z, first.w}, second.x, {impulses.x, impulses.z}, terms);
    if constexpr (kPoints == 2) {
        const Lanes separation = loadColumns(rows, kSecondSeparation).x;
        fillPoint(block.points[1], begin, frame, {second.z, second.w}, separation, {impulses.y, impulses.w}, terms);
    }
    put(normal.x, block.normalX, begin);
    put(normal.y, block.normalY, begin);
    fillSoftness(block, begin, terms);
    put(surface.x, block.friction, begin);
    put(surface.y, block.restitution, begin);
    put(surface.z, block.radiusA, begin);
    put(surface.w, block.radiusB, begin);
    const Lanes furthest = hn::Mul(hn::Set(tag, terms.pushRatio), at(from.extent));
    put(hn::Div(furthest, hn::Set(tag, terms.closingTime)), block.maxPushSpeed, begin);
    const LaneMask isLively = hn::Gt(surface.y, hn::Set(tag, kLivelyRestitution));
    const Lanes never = hn::Set(tag, std::numeric_limits<Real>::infinity());
    put(hn::IfThenElse(isLively, hn::Set(tag, terms.bounceSpeed), never), block.bounceSpeed, begin);
    block.unloaded[0] |= bitsOf(hn::Eq(impulses.x, hn::Zero(tag))) << begin;
    if constexpr (kPoints == 2) { block.unloaded[1] |= bitsOf(hn::Eq(impulses.y, hn::Zero(tag))) << begin; }
    block.movableA |= movableOf(block.inverseMassA, block.inverseInertiaA, begin) << begin;
    block.movableB |= movableOf(block.inverseMassB, block.inverseInertiaB, begin) << begin;
    if (!hn::AllFalse(tag, hn::Gt(surface.y, hn::Zero(tag)))) { block.mostRestitution = 1; }
    prepareGroup(block, begin);
    if constexpr (kPoints == 2) { prepareShared(block, begin); }
}

template <std::size_t kPoints>
void fill(WideContact<kPoints>& block, const ContactSources& from, const ContactTerms& terms) {
    block.movableA = block.movableB = 0;
    block.mostRestitution = 0;
    block.unloaded = {};
    for (std::size_t i = 0; i < block.lanes; i += kGroup) { fillGroup(block, i, from, terms); }
    if (block.mostRestitution > 0) {
        block.mostRestitution = 0;
        for (std::size_t i = 0; i < block.lanes; ++i) {
            block.mostRestitution =
                block.mostRestitution < block.restitution[i] ? block.restitution[i] : block.mostRestitution;
        }
    }
}

template <std::size_t kPoints>
LanesByPoint take(const WideContact<kPoints>& block, std::span<ContactRow* const> rows, Real scale) {
    const Lanes scales = hn::Set(Tag(), scale);
    const Lanes zero = hn::Zero(Tag());
    LanesByPoint pressing{};
    for (std::size_t i = 0; i < rows.size(); i += kGroup) {
        const auto kept = [&](const LaneArray& lanes) { return hn::Div(lanesAt(lanes, i), scales); };
        Quad impulses{kept(block.points[0].normalImpulse), zero, kept(block.points[0].tangentImpulse), zero};
        if constexpr (kPoints == 2) {
            impulses.y = kept(block.points[1].normalImpulse);
            impulses.w = kept(block.points[1].tangentImpulse);
        }
        const std::size_t count = rows.size() - i;
        const std::uint32_t inUse = count < kGroup ? (1U << count) - 1 : (1U << kGroup) - 1;
        storeColumns(impulses, WritableRows{rows.data() + i}, kImpulses, inUse);
        for (std::size_t k = 0; k < kPoints; ++k) {
            const LaneMask presses = hn::Gt(lanesAt(block.points[k].totalNormalImpulse, i), zero);
            pressing[k] |= (bitsOf(presses) & inUse) << i;
        }
    }
    return pressing;
}

const ContactRowKernels* kernelsForRows() {
    static const ContactRowKernels kKernels = {fill<1>, fill<2>, take<1>, take<2>};
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForRows);
}

const ContactRowKernels* contactRowKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForRows)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "../contacts/contact_constraint.h"
#include "wide_contacts.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/wide_contacts_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || (defined(SWEPT_F64) && !HWY_HAVE_FLOAT64)
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
const ContactKernels* kernelsForContacts() { return nullptr; }  // machines without registers to speak of: one by one
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_contact_lanes.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

// Every function here does what its scalar twin in contact_constraint.cpp does, in the same order. Signs are moved only
// where that is exact: x + (−y) is x − y.

/// A group of lanes of a block, and what a solve does with it.
template <std::size_t kPoints>
class ContactGroup : ContactLanes<kPoints> {
    using Base = ContactLanes<kPoints>;
    using Base::a_;
    using Base::at;
    using Base::b_;
    using Base::begin_;
    using Base::beginMotion;
    using Base::block_;
    using Base::bodies_;
    using Base::closingAt;
    using Base::findSeparations;
    using Base::push;
    using Base::slipAt;
    using Base::slow;
    using Base::sumOf;
    using Base::turn;
    using Base::turnByNormals;
    using typename Base::PointLanes;

public:
    HWY_INLINE ContactGroup(WideContact<kPoints>& block, std::size_t begin, const SolverBodies& bodies)
        : Base(block, begin, bodies) {}

    HWY_INLINE void warmStart() {
        PointLanes normals;
        PointLanes tangents;
        PointLanes ofA;
        PointLanes ofB;
        for (std::size_t i = 0; i < kPoints; ++i) {
            const WideContactPoint& point = block_.points[i];
            normals[i] = at(point.normalImpulse);
            tangents[i] = at(point.tangentImpulse);
            ofA[i] = hn::Add(hn::Mul(normals[i], at(point.normalArmA)), hn::Mul(tangents[i], at(point.tangentArmA)));
            ofB[i] = hn::Add(hn::Mul(normals[i], at(point.normalArmB)), hn::Mul(tangents[i], at(point.tangentArmB)));
        }
        turn(sumOf(ofA), sumOf(ofB));
        push(sumOf(normals), sumOf(tangents));
        scatterPair(block_, begin_, bodies_, a_, b_);
    }

    /// `bounceContacts`.
    HWY_INLINE void bounce(const ContactPass& pass) {
        if (pass.hasMoved) { findSeparations(); }
        beginMotion();
        PointLanes impulses;
        if constexpr (kPoints == 2) {
            findBounces(pass, impulses[0], impulses[1]);
        } else {
            impulses[0] = hn::Mul(at(block_.points[0].normalMass), bounceAt(block_.points[0], pass));
        }
        const Lanes zero = hn::Zero(Tag());
        LaneMask any = hn::Gt(impulses[0], zero);
        if constexpr (kPoints == 2) { any = hn::Or(any, hn::Gt(impulses[1], zero)); }
        if (hn::AllFalse(Tag(), any)) { return; }
        const Quad a = a_;
        const Quad b = b_;
        turnByNormals(impulses);
        PointLanes frictions;
        for (std::size_t i = 0; i < kPoints; ++i) {
            WideContactPoint& point = block_.points[i];
            const Lanes before = at(point.totalNormalImpulse);
            put(hn::IfThenElse(any, hn::Add(before, impulses[i]), before), point.totalNormalImpulse, begin_);
            const Lanes limit = hn::Mul(at(block_.friction), impulses[i]);
            frictions[i] = clampedTo(limit, hn::Neg(hn::Mul(at(point.tangentMass), slipAt(point))));
            slow(point, frictions[i]);
        }
        push(sumOf(impulses), sumOf(frictions));
        // What did not bounce keeps its bits: to add nothing to −0 makes 0 of it.
        a_ = chosen(any, a_, a);
        b_ = chosen(any, b_, b);
        scatterPair(block_, begin_, bodies_, a_, b_);
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findSeparations(); }
        const Lanes inverseH = hn::Set(Tag(), Real(1) / pass.h);
        beginMotion();
        PointLanes totals;
        if constexpr (kPoints == 2) {
            findTotals<kUseBias>(inverseH, totals[0], totals[1]);
        } else {
            totals[0] = totalAt<kUseBias>(block_.points[0], inverseH);
        }
        PointLanes normals;
        for (std::size_t i = 0; i < kPoints; ++i) {
            WideContactPoint& point = block_.points[i];
            normals[i] = hn::Sub(totals[i], at(point.normalImpulse));
            put(totals[i], point.normalImpulse, begin_);
            if (pass.isLast) {
                put(hn::Add(at(point.totalNormalImpulse), totals[i]), point.totalNormalImpulse, begin_);
            }
        }
        turnByNormals(normals);
        PointLanes tangents;
        for (std::size_t i = 0; i < kPoints; ++i) { tangents[i] = solveFriction(block_.points[i], totals[i]); }
        push(sumOf(normals), sumOf(tangents));
        scatterPair(block_, begin_, bodies_, a_, b_);
    }

private:
    struct Demand {
        LaneMask any;
        Lanes speed;
        Lanes massScale;     ///< 1 in a relaxation
        Lanes impulseScale;  ///< 0 in a relaxation
    };

    template <bool kUseBias>
    HWY_INLINE Demand demandOf(const WideContactPoint& point, Lanes inverseH, LaneMask isCarrying) const {
        const Tag tag;
        const Lanes separation = at(point.separation);
        const Lanes closing = closingAt(point);
        const LaneMask isApart = hn::Gt(separation, hn::Zero(tag));
        const Lanes gap = hn::Mul(separation, inverseH);
        if constexpr (kUseBias) {
            const Lanes bias = hn::Mul(at(block_.biasRate), separation);
            const Lanes fastest = hn::Neg(at(block_.maxPushSpeed));
            const Lanes massScale = at(block_.massScale);
            const Lanes impulseScale = at(block_.impulseScale);
            const Lanes excess = hn::Mul(hn::Mul(at(point.normalMass), massScale), hn::Sub(fastest, bias));
            const LaneMask isPressed = hn::Gt(closing, fastest);
            const LaneMask isTooFast =
                hn::And(isPressed, hn::Gt(excess, hn::Mul(impulseScale, at(point.normalImpulse))));
            const Lanes push =
                hn::IfThenElse(isPressed, hn::IfThenElse(isTooFast, fastest, bias), larger(bias, fastest));
            const Lanes wanted = hn::IfThenElse(isApart, gap, push);
            return {hn::Eq(inverseH, inverseH), hn::Sub(closing, wanted),
                    hn::IfThenElse(isApart, hn::Set(tag, Real(1)), massScale),
                    hn::IfThenZeroElse(hn::Or(isApart, isTooFast), impulseScale)};
        } else {
            const LaneMask isSlow = hn::Not(hn::Gt(closing, at(block_.bounceSpeed)));
            return {hn::And(isSlow, hn::Or(hn::Not(isApart), isCarrying)),
                    hn::Sub(closing, hn::IfThenElseZero(isApart, gap)), hn::Set(tag, Real(1)), hn::Zero(tag)};
        }
    }

    /// Of the impulse at a point, by itself.
    template <bool kUseBias>
    HWY_INLINE Lanes changeAt(const WideContactPoint& point, const Demand& demand) const {
        if constexpr (kUseBias) {
            return hn::Sub(hn::Mul(hn::Mul(at(point.normalMass), demand.massScale), demand.speed),
                           hn::Mul(demand.impulseScale, at(point.normalImpulse)));
        } else {
            return hn::Mul(at(point.normalMass), demand.speed);
        }
    }

    template <bool kUseBias>
    HWY_INLINE Lanes totalAt(const WideContactPoint& point, Lanes inverseH) const {
        const Lanes before = at(point.normalImpulse);
        const Demand demand = demandOf<kUseBias>(point, inverseH, hn::Gt(before, hn::Zero(Tag())));
        const Lanes total = notNegative(hn::Add(before, changeAt<kUseBias>(point, demand)));
        return kUseBias ? total : hn::IfThenElse(demand.any, total, before);
    }

    /// `totalsOf`.
    template <bool kUseBias>
    HWY_INLINE void findTotals(Lanes inverseH, Lanes& first, Lanes& second) const {
        const Tag tag;
        const Lanes zero = hn::Zero(tag);
        const WideContactPoint& one = block_.points[0];
        const WideContactPoint& two = block_.points[kPoints - 1];
        const Lanes beforeOne = at(one.normalImpulse);
        const Lanes beforeTwo = at(two.normalImpulse);
        const LaneMask carriesOne = hn::Gt(beforeOne, zero);
        const LaneMask carriesTwo = hn::Gt(beforeTwo, zero);
        const LaneMask begins = hn::Gt(at(block_.begins), zero);
        const Demand ofOne = demandOf<kUseBias>(one, inverseH, hn::Or(carriesOne, hn::And(begins, carriesTwo)));
        const Demand ofTwo = demandOf<kUseBias>(two, inverseH, hn::Or(carriesTwo, hn::And(begins, carriesOne)));
        const LaneMask both = hn::And(ofOne.any, ofTwo.any);
        const Lanes shared = hn::IfThenElseZero(both, at(block_.sharedResponse));
        const Lanes oneByTwo = hn::Mul(hn::Mul(shared, at(one.normalMass)), ofOne.massScale);
        const Lanes twoByOne = hn::Mul(hn::Mul(shared, at(two.normalMass)), ofTwo.massScale);
        const Lanes gain =
            kUseBias ? gainOf(oneByTwo, twoByOne) : hn::IfThenElse(both, at(block_.pairGain), hn::Set(tag, Real(1)));
        const Lanes aloneOne = hn::IfThenElseZero(ofOne.any, changeAt<kUseBias>(one, ofOne));
        const Lanes aloneTwo = hn::IfThenElseZero(ofTwo.any, changeAt<kUseBias>(two, ofTwo));
        const Lanes onlyOne = hn::Add(hn::Add(beforeOne, aloneOne), hn::Mul(oneByTwo, beforeTwo));
        const Lanes onlyTwo = hn::Add(hn::Add(beforeTwo, aloneTwo), hn::Mul(twoByOne, beforeOne));
        const Lanes totalOne = hn::Mul(hn::Sub(onlyOne, hn::Mul(oneByTwo, onlyTwo)), gain);
        const Lanes totalTwo = hn::Mul(hn::Sub(onlyTwo, hn::Mul(twoByOne, onlyOne)), gain);
        const LaneMask pulls = hn::Or(hn::Lt(totalOne, zero), hn::Lt(totalTwo, zero));
        const LaneMask press = hn::AndNot(pulls, hn::Gt(gain, zero));
        const Lanes mostTwo = notNegative(onlyTwo);
        const LaneMask isOne = hn::Gt(hn::Sub(onlyOne, hn::Mul(oneByTwo, mostTwo)), zero);
        first = hn::IfThenElse(press, totalOne, hn::IfThenElseZero(isOne, notNegative(onlyOne)));
        second = hn::IfThenElse(press, totalTwo, hn::IfThenZeroElse(isOne, mostTwo));
    }

    HWY_INLINE static Quad chosen(LaneMask mask, const Quad& yes, const Quad& no) {
        return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z),
                hn::IfThenElse(mask, yes.w, no.w)};
    }

    HWY_INLINE Lanes bounceAt(const WideContactPoint& point, const ContactPass& pass) const {
        const Lanes closing = closingAt(point);
        const Lanes restitution = at(block_.restitution);
        const LaneMask isFast = hn::Gt(closing, hn::Set(Tag(), pass.bounceSpeed));
        const LaneMask isNear = hn::Le(at(point.separation), hn::Mul(hn::Set(Tag(), pass.h), closing));
        const LaneMask isMeant = hn::Gt(restitution, hn::Set(Tag(), pass.leastRestitution));
        const LaneMask meets = hn::And(isMeant, hn::And(isFast, isNear));
        const Lanes one = hn::Set(Tag(), Real(1));
        return hn::IfThenElseZero(meets, hn::Mul(hn::Add(one, restitution), closing));
    }

    /// `bounceImpulses` of two points.
    HWY_INLINE void findBounces(const ContactPass& pass, Lanes& impulseOne, Lanes& impulseTwo) const {
        const Tag tag;
        const Lanes zero = hn::Zero(tag);
        const Lanes massOne = at(block_.points[0].normalMass);
        const Lanes massTwo = at(block_.points[kPoints - 1].normalMass);
        const Lanes ofOne = bounceAt(block_.points[0], pass);
        const Lanes ofTwo = bounceAt(block_.points[kPoints - 1], pass);
        impulseOne = impulseTwo = zero;
        if (hn::AllFalse(tag, hn::Gt(hn::Add(ofOne, ofTwo), zero))) { return; }
        const Lanes aloneOne = hn::Mul(massOne, ofOne);
        const Lanes aloneTwo = hn::Mul(massTwo, ofTwo);
        const LaneMask both = hn::And(hn::Gt(ofOne, zero), hn::Gt(ofTwo, zero));
        const Lanes shared = hn::IfThenElseZero(both, at(block_.sharedResponse));
        const Lanes oneByTwo = hn::Mul(shared, massOne);
        const Lanes twoByOne = hn::Mul(shared, massTwo);
        const Lanes rest = hn::Sub(hn::Set(tag, Real(1)), hn::Mul(oneByTwo, twoByOne));
        const Lanes leftOfOne = hn::Sub(aloneOne, hn::Mul(oneByTwo, aloneTwo));
        const Lanes leftOfTwo = hn::Sub(aloneTwo, hn::Mul(twoByOne, aloneOne));
        const LaneMask pulls = hn::Or(hn::Lt(leftOfOne, zero), hn::Lt(leftOfTwo, zero));
        const LaneMask press = hn::AndNot(pulls, hn::Gt(rest, hn::Set(tag, kTwoPointsRatio)));
        const LaneMask isOne = hn::Gt(leftOfOne, zero);
        impulseOne = hn::IfThenElse(press, hn::Div(leftOfOne, rest), hn::IfThenElseZero(isOne, aloneOne));
        impulseTwo = hn::IfThenElse(press, hn::Div(leftOfTwo, rest), hn::IfThenZeroElse(isOne, aloneTwo));
    }

    /// @return what it adds to the impulse
    HWY_INLINE Lanes solveFriction(WideContactPoint& point, Lanes normalImpulse) {
        const Lanes before = at(point.tangentImpulse);
        const Lanes limit = hn::Mul(at(block_.friction), normalImpulse);
        const Lanes total = clampedTo(limit, hn::Sub(before, hn::Mul(at(point.tangentMass), slipAt(point))));
        const Lanes impulse = hn::Sub(total, before);
        slow(point, impulse);
        put(total, point.tangentImpulse, begin_);
        return impulse;
    }
};

template <std::size_t kPoints>
void prepare(std::span<WideContact<kPoints> > blocks) {
    for (WideContact<kPoints>& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) {
            prepareGroup(block, i);
            if constexpr (kPoints == 2) { prepareShared(block, i); }
        }
    }
}

template <std::size_t kPoints>
void warmStart(std::span<WideContact<kPoints> > blocks, const SolverBodies& bodies) {
    for (WideContact<kPoints>& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) { ContactGroup<kPoints>(block, i, bodies).warmStart(); }
    }
}

template <std::size_t kPoints>
void bounce(std::span<WideContact<kPoints> > blocks, const SolverBodies& bodies, const ContactPass& pass) {
    for (WideContact<kPoints>& block : blocks) {
        if (!(block.mostRestitution > pass.leastRestitution)) { continue; }
        for (std::size_t i = 0; i < block.lanes; i += kGroup) { ContactGroup<kPoints>(block, i, bodies).bounce(pass); }
    }
}

template <std::size_t kPoints>
void solve(std::span<WideContact<kPoints> > blocks, const SolverBodies& bodies, const ContactPass& pass) {
    for (WideContact<kPoints>& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) {
            ContactGroup<kPoints> group(block, i, bodies);
            if (pass.useBias) {
                group.template solve<true>(pass);
            } else {
                group.template solve<false>(pass);
            }
        }
    }
}

const ContactKernels* kernelsForContacts() {
    static const ContactKernels kKernels = {hwy::TargetName(HWY_TARGET),
                                            prepare<1>,
                                            prepare<2>,
                                            warmStart<1>,
                                            warmStart<2>,
                                            bounce<1>,
                                            bounce<2>,
                                            solve<1>,
                                            solve<2>};
    return &kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForContacts);
}

const ContactKernels* contactKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForContacts)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif

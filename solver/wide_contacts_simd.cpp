// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "contact_constraint.h"
#include "wide_contacts.h"
#include "wide_targets.h"

#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 64
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide_contacts_simd.cpp"
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
#include "wide_contact_masses.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

// Every function here does what its scalar twin in contact_constraint.cpp does, in the same order. Signs are moved only
// where that is exact: x + (−y) is x − y.

/// A group of lanes of a block.
template <std::size_t kPoints>
class ContactGroup {
    /// Of each point. No array of the standard library, nor what the compiler makes by itself: these are not compiled
    /// for this instruction set, and GCC refuses them for NEON.
    struct PointLanes {
        Lanes lanes[kPoints];
        HWY_INLINE PointLanes() {}
        HWY_INLINE Lanes& operator[](std::size_t i) { return lanes[i]; }
        HWY_INLINE const Lanes& operator[](std::size_t i) const { return lanes[i]; }
    };

public:
    HWY_INLINE ContactGroup(WideContact<kPoints>& block, std::size_t begin, const SolverBodies& bodies)
        : block_(block),
          begin_(begin),
          bodies_(bodies),
          a_(gather(bodies.states, block.slotA.data() + begin, kVelocities)),
          b_(gather(bodies.states, block.slotB.data() + begin, kVelocities)),
          normalX_(at(block.normalX)),
          normalY_(at(block.normalY)),
          inverseMassA_(at(block.inverseMassA)),
          inverseMassB_(at(block.inverseMassB)),
          inverseInertiaA_(at(block.inverseInertiaA)),
          inverseInertiaB_(at(block.inverseInertiaB)) {}

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

    HWY_INLINE Lanes at(const LaneArray& lanes) const { return lanesAt(lanes, begin_); }

    HWY_INLINE static Lanes sumOf(const PointLanes& impulses) {
        if constexpr (kPoints == 2) {
            return hn::Add(impulses[0], impulses[1]);
        } else {
            return impulses[0];
        }
    }

    /// `currentSeparation`.
    HWY_INLINE void findSeparations() {
        const Quad a = gather(bodies_.states, block_.slotA.data() + begin_, kMotion);
        const Quad b = gather(bodies_.states, block_.slotB.data() + begin_, kMotion);
        const Lanes moved = hn::Add(hn::Mul(hn::Sub(b.x, a.x), normalX_), hn::Mul(hn::Sub(b.y, a.y), normalY_));
        const Lanes unit = hn::Set(Tag(), Real(1));
        const Lanes lowA = hn::Sub(unit, a.z);
        const Lanes lowB = hn::Sub(unit, b.z);
        const Lanes radiusA = at(block_.radiusA);
        const Lanes radiusB = at(block_.radiusB);
        for (WideContactPoint& point : block_.points) {
            const Lanes ofA =
                hn::Add(hn::Mul(a.w, at(point.normalArmA)), hn::Mul(lowA, hn::Add(at(point.tangentArmA), radiusA)));
            const Lanes ofB =
                hn::Add(hn::Mul(b.w, at(point.normalArmB)), hn::Mul(lowB, hn::Sub(at(point.tangentArmB), radiusB)));
            put(hn::Add(at(point.baseSeparation), hn::Add(moved, hn::Sub(ofB, ofA))), point.separation, begin_);
        }
    }

    /// `motionOf`.
    HWY_INLINE void beginMotion() {
        const Lanes x = hn::Sub(b_.x, a_.x);
        const Lanes y = hn::Sub(b_.y, a_.y);
        along_ = hn::Add(hn::Mul(x, normalX_), hn::Mul(y, normalY_));
        across_ = hn::Sub(hn::Mul(x, normalY_), hn::Mul(y, normalX_));
    }
    HWY_INLINE Lanes closingAt(const WideContactPoint& point) const {
        return hn::Neg(
            hn::Add(along_, hn::Sub(hn::Mul(b_.z, at(point.normalArmB)), hn::Mul(a_.z, at(point.normalArmA)))));
    }
    HWY_INLINE Lanes slipAt(const WideContactPoint& point) const {
        return hn::Add(across_, hn::Sub(hn::Mul(b_.z, at(point.tangentArmB)), hn::Mul(a_.z, at(point.tangentArmA))));
    }

    HWY_INLINE void turn(Lanes twistA, Lanes twistB) {
        a_.z = hn::Sub(a_.z, hn::Mul(inverseInertiaA_, twistA));
        b_.z = hn::Add(b_.z, hn::Mul(inverseInertiaB_, twistB));
    }
    HWY_INLINE void turnByNormals(const PointLanes& impulses) {
        PointLanes ofA;
        PointLanes ofB;
        for (std::size_t i = 0; i < kPoints; ++i) {
            ofA[i] = hn::Mul(impulses[i], at(block_.points[i].normalArmA));
            ofB[i] = hn::Mul(impulses[i], at(block_.points[i].normalArmB));
        }
        turn(sumOf(ofA), sumOf(ofB));
    }
    /// By friction at a point.
    HWY_INLINE void slow(const WideContactPoint& point, Lanes impulse) {
        across_ = hn::Add(across_, hn::Mul(hn::Add(inverseMassA_, inverseMassB_), impulse));
        turn(hn::Mul(impulse, at(point.tangentArmA)), hn::Mul(impulse, at(point.tangentArmB)));
    }
    /// What all impulses together do to the centres.
    HWY_INLINE void push(Lanes normal, Lanes tangent) {
        const Lanes x = hn::Add(hn::Mul(normal, normalX_), hn::Mul(tangent, normalY_));
        const Lanes y = hn::Sub(hn::Mul(normal, normalY_), hn::Mul(tangent, normalX_));
        a_.x = hn::Sub(a_.x, hn::Mul(inverseMassA_, x));
        a_.y = hn::Sub(a_.y, hn::Mul(inverseMassA_, y));
        b_.x = hn::Add(b_.x, hn::Mul(inverseMassB_, x));
        b_.y = hn::Add(b_.y, hn::Mul(inverseMassB_, y));
    }

    template <bool kUseBias>
    HWY_INLINE Demand demandOf(const WideContactPoint& point, Lanes inverseH, LaneMask isCarrying) const {
        const Tag tag;
        const Lanes separation = at(point.separation);
        const Lanes closing = closingAt(point);
        const LaneMask isApart = hn::Gt(separation, hn::Zero(tag));
        const Lanes gap = hn::Mul(separation, inverseH);
        if constexpr (kUseBias) {
            const Lanes bias = larger(hn::Mul(at(block_.biasRate), separation), hn::Neg(at(block_.maxPushSpeed)));
            return {hn::Eq(inverseH, inverseH), hn::Sub(closing, hn::IfThenElse(isApart, gap, bias)),
                    hn::IfThenElse(isApart, hn::Set(tag, Real(1)), at(block_.massScale)),
                    hn::IfThenZeroElse(isApart, at(block_.impulseScale))};
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

    WideContact<kPoints>& block_;
    std::size_t begin_;
    const SolverBodies& bodies_;
    Quad a_;
    Quad b_;
    Lanes normalX_;
    Lanes normalY_;
    Lanes inverseMassA_;
    Lanes inverseMassB_;
    Lanes inverseInertiaA_;
    Lanes inverseInertiaB_;
    // Of the centre of B in the view of that of A, along the normal and the tangent.
    Lanes along_ = hn::Zero(Tag());
    Lanes across_ = hn::Zero(Tag());
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

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
        pushSprings();
        applyImpulse();
        turn(at(block_.angularImpulse));
        writeBodies();
    }

    template <bool kUseBias>
    HWY_INLINE void solve(const ContactPass& pass) {
        if (pass.hasMoved) { findSeam(); }
        const bool isHung = block_.parts.hasLinearSpring;
        const bool isTwisted = block_.parts.hasAngularSpring;
        if (isHung && isTwisted) {
            if (kUseBias) { solveSprings(); }
        } else if (isHung) {
            solveHung<kUseBias>();
        } else if (isTwisted) {
            solveTwisted<kUseBias>();
        } else {
            solveRigid<kUseBias>();
        }
        if (pass.isLast) { addUp(); }
        writeBodies();
    }

private:
    template <bool kUseBias>
    HWY_INLINE void solveRigid() {
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
    }

    template <bool kUseBias>
    HWY_INLINE void solveTwisted() {
        const Spin spin = spinOf<true>(compliance<kUseBias>());
        const Pair gives = product(spin.given, impulse());
        Pair wanted = plus(pointSpeeds(), gives);
        if (kUseBias) {
            const Lanes rate = at(block_.biasRate);
            wanted = plus(wanted, {hn::Mul(rate, at(block_.gapX)), hn::Mul(rate, at(block_.gapY))});
        }
        const Pair firm = solved(spin.pointMatrix, wanted);
        push({hn::Neg(firm.x), hn::Neg(firm.y)});
        if (!kUseBias) { return; }
        const Lanes twist = dragOfAngle(spin.mass);
        turnBy(twist);
        push({hn::Mul(twist, spin.answer.x), hn::Mul(twist, spin.answer.y)});
    }

    template <bool kUseBias>
    HWY_INLINE void solveHung() {
        const Lanes zero = hn::Zero(Tag());
        const Lanes given = givenOfAngle(compliance<kUseBias>());
        const Lanes response = hn::Add(turns(), given);
        const Lanes bias = kUseBias ? hn::Mul(at(block_.biasRate), angle()) : zero;
        const Lanes speed = hn::Add(hn::Add(speedOfSpin(), bias), hn::Mul(given, at(block_.angularImpulse)));
        turnBy(hn::Div(hn::Neg(speed), response));
        if (!kUseBias) { return; }
        const Pair drag = dragOfPoint(pointsAtStiffAngle(given));
        push(drag);
        turnBy(hn::Div(hn::Neg(dotOf(pull(), drag)), response));
    }
    /// `StiffAngle::given`.
    HWY_INLINE Lanes givenOfAngle(Lanes compliance) const {
        if (block_.parts.isLinked) { return hn::Mul(compliance, turns()); }
        const Lanes spinMass = at(block_.spinMass);
        return hn::IfThenElseZero(hn::Gt(spinMass, hn::Zero(Tag())), hn::Div(compliance, spinMass));
    }
    /// `StiffAngle::points`.
    HWY_INLINE Matrix pointsAtStiffAngle(Lanes given) const {
        const Matrix firm = matrixAtAngle();
        const Pair p = pull();
        const Lanes more = hn::Div(given, hn::Mul(turns(), hn::Add(turns(), given)));
        const Lanes one = hn::Set(Tag(), Real(1));
        return {hn::Add(firm.xx, hn::Mul(more, squareOf(p.x))), hn::Add(firm.xy, hn::Mul(hn::Mul(more, p.x), p.y)),
                hn::Add(firm.yy, hn::Mul(more, squareOf(p.y))),
                hn::Mul(firm.determinant, hn::Add(one, hn::Mul(more, dotOf(p, solved(firm, p)))))};
    }

    HWY_INLINE void solveSprings() {
        turnBy(dragOfAngle(freeSpinMass()));
        push(dragOfPoint(pointMatrix()));
    }

    HWY_INLINE void pushSprings() {
        const bool isHung = block_.parts.hasLinearSpring;
        const bool isTwisted = block_.parts.hasAngularSpring;
        if (isHung) {
            const Pair change{hn::Sub(at(block_.pushX), at(block_.impulseX)),
                              hn::Sub(at(block_.pushY), at(block_.impulseY))};
            put(at(block_.pushX), block_.impulseX, begin_);
            put(at(block_.pushY), block_.impulseY, begin_);
            if (!isTwisted) {
                const Lanes answer = hn::Div(dotOf(pull(), change), turns());
                put(hn::Sub(at(block_.angularImpulse), answer), block_.angularImpulse, begin_);
            }
        }
        if (!isTwisted) { return; }
        const Lanes before = at(block_.angularImpulse);
        const Lanes mass = isHung ? freeSpinMass() : at(block_.spinMass);
        const Lanes twist = hn::Mul(hn::Neg(mass), hn::Mul(at(block_.anglePush), angle()));
        put(twist, block_.angularImpulse, begin_);
        if (isHung) { return; }
        const Lanes change = hn::Sub(twist, before);
        add(hn::Mul(change, at(block_.answerX)), block_.impulseX);
        add(hn::Mul(change, at(block_.answerY)), block_.impulseY);
    }

    HWY_INLINE void findSeam() {
        findGeometry();
        if (block_.parts.hasLinearSpring) { hang(); }
        const Spin spin = spinOf<false>();
        put(spin.mass, block_.spinMass, begin_);
        put(spin.answer.x, block_.answerX, begin_);
        put(spin.answer.y, block_.answerY, begin_);
        if (block_.parts.hasLinearSpring) { findPush(); }
    }
    /// `hangingOf`, after the geometry.
    HWY_INLINE void hang() {
        add(at(block_.gapX), block_.armAX);
        add(at(block_.gapY), block_.armAY);
        findMatrix({at(block_.armAX), at(block_.armAY)}, {at(block_.armBX), at(block_.armBY)});
    }
    /// `gainsOf`, and the push.
    HWY_INLINE void findPush() {
        const Tag tag;
        const Lanes zero = hn::Zero(tag);
        const Matrix stiffness = turnedStiffness();
        const Matrix response = block_.parts.hasAngularSpring ? pointMatrix() : matrixAtAngle();
        const Lanes mixed = hn::Mul(hn::Mul(hn::Set(tag, Real(2)), stiffness.xy), response.xy);
        const Lanes trace =
            hn::Add(hn::Add(hn::Mul(stiffness.xx, response.xx), mixed), hn::Mul(stiffness.yy, response.yy));
        const Lanes half = hn::Div(trace, hn::Set(tag, Real(2)));
        const Lanes rest = hn::Sub(squareOf(half), hn::Mul(stiffness.determinant, response.determinant));
        const Lanes wanted = hn::Add(half, hn::IfThenElseZero(hn::Gt(rest, zero), hn::Sqrt(rest)));
        const Lanes stiffest = hn::Set(tag, kStiffestPhase * kStiffestPhase);
        this->findGainsAt(hn::IfThenElse(hn::Lt(stiffest, wanted), stiffest, wanted));
        const Lanes part = hn::Div(at(block_.springPush), wanted);
        const Lanes back = hn::Neg(hn::IfThenElseZero(hn::Gt(wanted, zero), part));
        const Pair pulled = product(stiffness, {at(block_.gapX), at(block_.gapY)});
        put(hn::Mul(back, pulled.x), block_.pushX, begin_);
        put(hn::Mul(back, pulled.y), block_.pushY, begin_);
    }
    /// `turned`.
    HWY_INLINE Matrix turnedStiffness() const {
        const Quad motion = motionOfA();
        const Pair by{motion.z, motion.w};
        const Lanes xy = at(block_.stiffnessXY);
        const Pair x = rotated(by, {at(block_.stiffnessXX), xy});
        const Pair y = rotated(by, {xy, at(block_.stiffnessYY)});
        const Pair top = rotated(by, {x.x, y.x});
        const Pair bottom = rotated(by, {x.y, y.y});
        return {top.x, top.y, bottom.y, at(block_.stiffnessDeterminant)};
    }

    HWY_INLINE Pair impulse() const { return {at(block_.impulseX), at(block_.impulseY)}; }
    HWY_INLINE Pair pull() const {
        return pullOf({at(block_.armAX), at(block_.armAY)}, {at(block_.armBX), at(block_.armBY)});
    }
    HWY_INLINE Lanes freeSpinMass() const { return hn::Div(hn::Set(Tag(), Real(1)), turns()); }
    /// `complianceOf`.
    template <bool kUseBias>
    HWY_INLINE Lanes compliance() const {
        return kUseBias ? hn::Div(at(block_.impulseScale), at(block_.massScale)) : hn::Zero(Tag());
    }
    static HWY_INLINE Pair product(const Matrix& m, const Pair& v) {
        return {hn::Add(hn::Mul(m.xx, v.x), hn::Mul(m.xy, v.y)), hn::Add(hn::Mul(m.xy, v.x), hn::Mul(m.yy, v.y))};
    }
    HWY_INLINE Lanes dragOfAngle(Lanes mass) const {
        return hn::Sub(hn::Mul(at(block_.angleLag), at(block_.angularImpulse)),
                       hn::Mul(at(block_.angleDrag), hn::Mul(mass, speedOfSpin())));
    }
    HWY_INLINE Pair dragOfPoint(const Matrix& matrix) const {
        const Lanes lag = at(block_.springLag);
        const Lanes drag = at(block_.springDrag);
        const Pair motion = solved(matrix, pointSpeeds());
        return {hn::Sub(hn::Mul(lag, at(block_.impulseX)), hn::Mul(drag, motion.x)),
                hn::Sub(hn::Mul(lag, at(block_.impulseY)), hn::Mul(drag, motion.y))};
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

// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "wide_revolutes.h"
#include "wide_targets.h"

// Hinges differ in their parts, and most blocks of ragdolls have a few lanes in use: with registers of 64 bytes scene
// `rain` took 8 % longer to solve.
#undef SWEPT_GROUP_BYTES
#define SWEPT_GROUP_BYTES 32
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide_revolutes_simd.cpp"
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
#include "wide_joints.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

// Every function here does what its scalar twin in revolute_constraint.cpp and joint_rows.h does, in the same order.
// Signs are moved only where that is exact.

/// A group of lanes of a block.
class RevoluteGroup : JointGroup<WideRevolute> {
public:
    HWY_INLINE RevoluteGroup(WideRevolute& block, std::size_t begin, const SolverBodies& bodies)
        : JointGroup(block, begin, bodies) {}

    HWY_INLINE void warmStart(bool hasMoved) {
        if (hasMoved) { findGeometry(); }
        if (block_.parts.hasSpring) { warmStartSpring(); }
        const Lanes x = at(block_.impulseX);
        const Lanes y = at(block_.impulseY);
        a_.x = hn::Sub(a_.x, hn::Mul(inverseMassA_, x));
        a_.y = hn::Sub(a_.y, hn::Mul(inverseMassA_, y));
        const Lanes twistA = hn::Sub(hn::Mul(at(block_.armAY), x), hn::Mul(at(block_.armAX), y));
        a_.z = hn::Add(a_.z, hn::Mul(inverseInertiaA_, twistA));
        b_.x = hn::Add(b_.x, hn::Mul(inverseMassB_, x));
        b_.y = hn::Add(b_.y, hn::Mul(inverseMassB_, y));
        const Lanes twistB = hn::Sub(hn::Mul(at(block_.armBX), y), hn::Mul(at(block_.armBY), x));
        b_.z = hn::Add(b_.z, hn::Mul(inverseInertiaB_, twistB));
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
    /// Symmetric 2×2.
    struct Matrix {
        Lanes xx;
        Lanes xy;
        Lanes yy;
        Lanes determinant;
    };

    /// Turning while the point is held, and the point that guides it.
    struct Spin {
        Lanes mass;
        Pair answer;
        Matrix given;  ///< without determinant
        Matrix pointMatrix;
    };

    HWY_INLINE void findGeometry() {
        const Arms arms = findArms();
        put(hn::Add(arms.apart.x, hn::Sub(arms.b.x, arms.a.x)), block_.gapX, begin_);
        put(hn::Add(arms.apart.y, hn::Sub(arms.b.y, arms.a.y)), block_.gapY, begin_);
        findMatrix(arms.a, arms.b);
    }

    /// `pointMatrix`.
    HWY_INLINE void findMatrix(const Pair& armA, const Pair& armB) {
        const auto square = [](Lanes v) { return hn::Mul(v, v); };
        const Lanes mass = hn::Add(inverseMassA_, inverseMassB_);
        const Lanes spin = hn::Add(hn::Mul(inverseInertiaA_, hn::Add(square(armA.x), square(armA.y))),
                                   hn::Mul(inverseInertiaB_, hn::Add(square(armB.x), square(armB.y))));
        const auto response = [&](Lanes alongA, Lanes alongB) {
            return hn::Add(hn::Add(mass, hn::Mul(inverseInertiaA_, square(alongA))),
                           hn::Mul(inverseInertiaB_, square(alongB)));
        };
        const Lanes mixedA = hn::Neg(hn::Mul(hn::Mul(inverseInertiaA_, armA.x), armA.y));
        const Lanes mixedB = hn::Mul(hn::Mul(inverseInertiaB_, armB.x), armB.y);
        const Lanes crossed = hn::Sub(hn::Mul(armA.x, armB.y), hn::Mul(armA.y, armB.x));
        put(response(armA.y, armB.y), block_.matrixXX, begin_);
        put(hn::Sub(mixedA, mixedB), block_.matrixXY, begin_);
        put(response(armA.x, armB.x), block_.matrixYY, begin_);
        put(hn::Add(hn::Mul(mass, hn::Add(mass, spin)),
                    hn::Mul(hn::Mul(inverseInertiaA_, inverseInertiaB_), square(crossed))),
            block_.determinant, begin_);
    }

    HWY_INLINE Matrix pointMatrix() const {
        return {at(block_.matrixXX), at(block_.matrixXY), at(block_.matrixYY), at(block_.determinant)};
    }

    /// Impulse with matrix·impulse = rhs.
    static HWY_INLINE Pair solved(const Matrix& m, const Pair& rhs) {
        const LaneMask isHeavy = hn::Gt(m.determinant, hn::Zero(Tag()));
        const Lanes x = hn::Sub(hn::Mul(m.yy, rhs.x), hn::Mul(m.xy, rhs.y));
        const Lanes y = hn::Sub(hn::Mul(m.xx, rhs.y), hn::Mul(m.xy, rhs.x));
        return {hn::IfThenElseZero(isHeavy, hn::Div(x, m.determinant)),
                hn::IfThenElseZero(isHeavy, hn::Div(y, m.determinant))};
    }

    HWY_INLINE void push(const Pair& impulse) {
        a_.x = hn::Sub(a_.x, hn::Mul(inverseMassA_, impulse.x));
        a_.y = hn::Sub(a_.y, hn::Mul(inverseMassA_, impulse.y));
        b_.x = hn::Add(b_.x, hn::Mul(inverseMassB_, impulse.x));
        b_.y = hn::Add(b_.y, hn::Mul(inverseMassB_, impulse.y));
        a_.z = hn::Add(a_.z, hn::Mul(hn::Mul(inverseInertiaA_, at(block_.armAY)), impulse.x));
        a_.z = hn::Sub(a_.z, hn::Mul(hn::Mul(inverseInertiaA_, at(block_.armAX)), impulse.y));
        b_.z = hn::Sub(b_.z, hn::Mul(hn::Mul(inverseInertiaB_, at(block_.armBY)), impulse.x));
        b_.z = hn::Add(b_.z, hn::Mul(hn::Mul(inverseInertiaB_, at(block_.armBX)), impulse.y));
        add(impulse.x, block_.impulseX);
        add(impulse.y, block_.impulseY);
    }

    HWY_INLINE Pair pointSpeeds() const {
        return {
            hn::Add(hn::Sub(hn::Sub(b_.x, a_.x), hn::Mul(at(block_.armBY), b_.z)), hn::Mul(at(block_.armAY), a_.z)),
            hn::Sub(hn::Add(hn::Sub(b_.y, a_.y), hn::Mul(at(block_.armBX), b_.z)), hn::Mul(at(block_.armAX), a_.z))};
    }

    /// Speeds that are to go: the present ones and the bias.
    HWY_INLINE Pair wantedSpeeds() const {
        const Lanes rate = at(block_.biasRate);
        const Pair speeds = pointSpeeds();
        return {hn::Add(speeds.x, hn::Mul(rate, at(block_.gapX))), hn::Add(speeds.y, hn::Mul(rate, at(block_.gapY)))};
    }

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

    /// `spinOf`. @pre in lanes in use, one body or both can turn
    template <bool kIsSoft>
    HWY_INLINE Spin spinOf() const {
        const Tag tag;
        const Lanes zero = hn::Zero(tag);
        const Lanes one = hn::Set(tag, Real(1));
        const Lanes mass = hn::Add(inverseMassA_, inverseMassB_);
        const Lanes turns = hn::Add(inverseInertiaA_, inverseInertiaB_);
        const Lanes apartX = hn::Sub(at(block_.armAX), at(block_.armBX));
        const Lanes apartY = hn::Sub(at(block_.armAY), at(block_.armBY));
        const Lanes apart = hn::Add(hn::Mul(apartX, apartX), hn::Mul(apartY, apartY));
        const Lanes all =
            hn::Mul(mass, hn::Add(hn::Mul(mass, turns), hn::Mul(hn::Mul(inverseInertiaA_, inverseInertiaB_), apart)));
        const Matrix held = pointMatrix();
        const Lanes inverse = hn::IfThenElse(hn::Gt(held.determinant, zero), hn::Div(all, held.determinant), turns);
        const LaneMask isMovable = hn::Gt(inverse, zero);
        const Pair pull{
            hn::Neg(hn::Add(hn::Mul(inverseInertiaA_, at(block_.armAY)), hn::Mul(inverseInertiaB_, at(block_.armBY)))),
            hn::Add(hn::Mul(inverseInertiaA_, at(block_.armAX)), hn::Mul(inverseInertiaB_, at(block_.armBX)))};
        if constexpr (!kIsSoft) {
            const Pair answer = solved(held, pull);
            return {hn::IfThenElseZero(isMovable, hn::Div(turns, hn::Mul(turns, inverse))),
                    {hn::Neg(answer.x), hn::Neg(answer.y)},
                    {zero, zero, zero, zero},
                    held};
        } else {
            const Lanes compliance = hn::Div(at(block_.impulseScale), at(block_.massScale));
            const auto given = [&](Lanes heldPart, Lanes p, Lanes q) {
                return hn::IfThenElseZero(isMovable,
                                          hn::Mul(compliance, hn::Sub(heldPart, hn::Div(hn::Mul(p, q), turns))));
            };
            const Matrix gives{given(held.xx, pull.x, pull.x), given(held.xy, pull.x, pull.y),
                               given(held.yy, pull.y, pull.y), zero};
            const Lanes more = hn::Add(one, compliance);
            const Lanes soft =
                hn::Mul(hn::Mul(more, held.determinant), hn::Add(one, hn::Mul(compliance, hn::Div(inverse, turns))));
            const Matrix matrix{hn::Add(held.xx, gives.xx), hn::Add(held.xy, gives.xy), hn::Add(held.yy, gives.yy),
                                hn::IfThenElse(isMovable, soft, held.determinant)};
            const Pair answer = solved(matrix, pull);
            const Lanes spinMass =
                hn::Div(hn::Add(turns, hn::Mul(compliance, inverse)), hn::Mul(hn::Mul(more, turns), inverse));
            return {hn::IfThenElseZero(isMovable, spinMass), {hn::Neg(answer.x), hn::Neg(answer.y)}, gives, matrix};
        }
    }

    HWY_INLINE Lanes speed() const { return hn::Sub(b_.z, a_.z); }
    HWY_INLINE Lanes angle() const { return hn::Add(at(block_.baseAngle), hn::Sub(b_.w, a_.w)); }
    HWY_INLINE Lanes twist() const {
        return hn::Sub(hn::Add(hn::Add(at(block_.springImpulse), at(block_.motorImpulse)), at(block_.lowerImpulse)),
                       at(block_.upperImpulse));
    }
    HWY_INLINE void turn(Lanes impulse) {
        a_.z = hn::Sub(a_.z, hn::Mul(inverseInertiaA_, impulse));
        b_.z = hn::Add(b_.z, hn::Mul(inverseInertiaB_, impulse));
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
        const Spin spin = spinOf<kUseBias>();
        solveGuiding<kUseBias>(spin);
        const Lanes place = angle();
        if (block_.parts.hasSpring && kUseBias) {
            const Lanes change =
                hn::Mul(at(block_.springDrag), hn::Sub(at(block_.springImpulse), hn::Mul(spin.mass, speed())));
            add(change, block_.springImpulse);
            turnGuided(spin, change);
        }
        if (block_.parts.hasMotor) {
            const Lanes before = at(block_.motorImpulse);
            const Lanes wanted = hn::Sub(before, hn::Mul(spin.mass, hn::Sub(speed(), at(block_.motorSpeed))));
            const Lanes change = hn::Sub(clampedTo(at(block_.maxMotorImpulse), wanted), before);
            add(change, block_.motorImpulse);
            turnGuided(spin, change);
        }
        if (!block_.parts.hasLimits) { return; }
        const Lanes lower =
            limitChange<kUseBias>(spin.mass, speed(), hn::Sub(place, at(block_.lower)), block_.lowerImpulse, h);
        add(lower, block_.lowerImpulse);
        turnGuided(spin, lower);
        const Lanes upper = limitChange<kUseBias>(spin.mass, hn::Neg(speed()), hn::Sub(at(block_.upper), place),
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

void warmStart(std::span<WideRevolute> blocks, const SolverBodies& bodies, bool hasMoved) {
    for (WideRevolute& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) { RevoluteGroup(block, i, bodies).warmStart(hasMoved); }
    }
}

void solve(std::span<WideRevolute> blocks, const SolverBodies& bodies, const ContactPass& pass) {
    for (WideRevolute& block : blocks) {
        for (std::size_t i = 0; i < block.lanes; i += kGroup) {
            RevoluteGroup group(block, i, bodies);
            if (pass.useBias) {
                group.solve<true>(pass);
            } else {
                group.solve<false>(pass);
            }
        }
    }
}

const RevoluteKernels* kernelsForHinges() {
    static const RevoluteKernels kKernels = {warmStart, solve};
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

#include "direct_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../shapes/compiler.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Errors up to this part of the smaller radius of gyration, or of a radian, are closed within one sub-step; larger
/// ones at the joint's own rate, or as fast as that lets bodies turn: what closes them would turn the bodies too far
/// for one linear solve.
constexpr double kSmallErrorRatio = 1.0 / 8;

/// Radians whose square is not seen beside 1, and may underflow.
constexpr Real kLeastTurn = 1 / static_cast<Real>(std::uint64_t{1} << (std::numeric_limits<Real>::digits / 2 + 2));

/// Radians in a sub-step beyond which the second order tells nothing: what is so fast before the solve was spun by the
/// impulse of a blow that is over, which the solve takes back, and arms do not bend by it. (At 60 Hz and 16 sub-steps
/// 30 rad/s. With 1/2 85 of 300 pairs of discs that are jointed twice gained energy when they struck the ground, 8 now:
/// JointEnergy.OfDiscsJointedTwiceThatFall.)
constexpr Real kMostBendingTurn = Real(1) / 32;

/// Adds rows of one joint after another.
class RowWriter {
public:
    RowWriter(SolverBatch& batch, std::span<const Motion> motions, Real h, Real closing, bool useBias,
              std::vector<DirectRow>& rows)
        : batch_(batch), motions_(motions), h_(h), closing_(closing), useBias_(useBias), rows_(rows) {}

    void operator()(RevoluteConstraint& joint) {
        begin(joint);
        addPoint(joint, joint.linearImpulse);
    }
    void operator()(DistanceConstraint& joint) {
        if (!joint.isRigid) { return; }
        begin(joint);
        const UnitAndLength offset = normalized(anchorOffset(joint, *a_, *b_));
        if (offset.length > 0) { joint.axis = offset.unit; }
        const Real aside = cross(joint.axis, anchorMotion(armA_));
        const Real turn = offset.length > 0 ? bendingTurn(aside / offset.length) : Real(0);
        const Real bend = dot(joint.axis, bend_) + Real(0.5) * aside * turn;
        const Real error = offset.length - joint.length;
        add(rowAlong(joint.axis, armA_, armB_), rateFor(error), error, bend, joint.rigidImpulse);
        if (joint.isGliding) { rows_.back().bias -= joint.motion.asked(useBias_).lower; }
    }
    void operator()(PrismaticConstraint& joint) {
        begin(joint);
        addSide(joint, joint.heldImpulse.x);
        addAngle(joint, joint.heldImpulse.y);
    }
    void operator()(WheelConstraint& joint) {
        begin(joint);
        addSide(joint, joint.heldImpulse.x);
    }
    void operator()(WeldConstraint& joint) {
        begin(joint);
        if (!joint.hasLinearSpring) { addPoint(joint, joint.linearImpulse); }
        if (!joint.hasAngularSpring) { addAngle(joint, joint.angularImpulse); }
    }

private:
    SWEPT_FORCE_INLINE void begin(const JointConstraint& joint) {
        joint_ = &joint;
        a_ = &batch_.states[joint.slotA];
        b_ = &batch_.states[joint.slotB];
        armA_ = rotate(a_->deltaRotation, joint.anchorA);
        armB_ = rotate(b_->deltaRotation, joint.anchorB);
        turnA_ = notableTurn(h_ * motionOf(joint.slotA).spin);
        const Real turnB = notableTurn(h_ * motionOf(joint.slotB).spin);
        if (std::fabs(turnA_) > kMostBendingTurn || std::fabs(turnB) > kMostBendingTurn) {
            turnA_ = 0;
            bend_ = {};
        } else {
            bend_ = bendOf(turnB, armB_) - bendOf(turnA_, armA_);
        }
    }
    static Real notableTurn(Real turn) { return std::fabs(turn) < kLeastTurn ? Real(0) : turn; }
    static Real bendingTurn(Real turn) { return std::fabs(turn) > kMostBendingTurn ? Real(0) : notableTurn(turn); }
    /// What a turn does to an arm beyond the first order.
    static Vec2 bendOf(Real turn, Vec2 arm) {
        const Real half = Real(0.5) * square(turn);
        return -half * arm - (half * turn / 3) * leftPerp(arm);
    }
    /// First-order motion of B's anchor from A's within the sub-step.
    Vec2 anchorMotion(Vec2 armA) const {
        const Motion a = motionOf(joint_->slotA);
        const Motion b = motionOf(joint_->slotB);
        return h_ * ((b.velocity + cross(b.spin, armB_)) - (a.velocity + cross(a.spin, armA)));
    }
    Motion motionOf(BodySlot slot) const {
        const BodyState& state = batch_.states[slot];
        return motions_.empty() ? Motion{state.velocity, state.angularVelocity} : motions_[slot];
    }
    bool canTurn() const {
        return batch_.inertias[joint_->slotA].inverseInertia + batch_.inertias[joint_->slotB].inverseInertia > 0;
    }
    /// @param bend  what the error grows by beyond the first order, at the speeds there are: the motion is to end, not
    /// only to begin, where the joint holds
    void add(const JointRow& row, Real errorRate, Real error, Real bend, Real& impulse) {
        const Real bias = useBias_ ? errorRate * error + bend / h_ : Real(0);
        rows_.push_back({row, joint_->slotA, joint_->slotB, bias, &impulse});
    }
    void addPoint(const JointConstraint& joint, Vec2& impulse) {
        const Vec2 gap = anchorOffset(joint, *a_, *b_);
        add(rowAlong({1, 0}, armA_, armB_), rateFor(gap.x), gap.x, bend_.x, impulse.x);
        add(rowAlong({0, 1}, armA_, armB_), rateFor(gap.y), gap.y, bend_.y, impulse.y);
    }
    template <class Joint>
    void addAngle(const Joint& joint, Real& impulse) {
        if (canTurn()) {
            const Real angle = joint.baseAngle + (b_->deltaAngle - a_->deltaAngle);
            add(kSpinRow, rate(static_cast<double>(std::fabs(angle)), kSmallErrorRatio), angle, 0, impulse);
        }
    }
    /// Across an axis that turns with A. The force on A acts where B's anchor is.
    template <class Joint>
    void addSide(Joint& joint, Real& impulse) {
        joint.axisNow = rotate(a_->deltaRotation, joint.axis);
        const Vec2 offset = anchorOffset(joint, *a_, *b_);
        const Vec2 side = leftPerp(joint.axisNow);
        const Real error = dot(side, offset);
        const Real bend =
            dot(side, bend_) - turnA_ * dot(joint.axisNow, anchorMotion(armA_)) - Real(0.5) * square(turnA_) * error;
        add(rowAlong(side, armA_ + offset, armB_), rateFor(error), error, bend, impulse);
    }
    Real rateFor(Real error) const {
        const double most =
            std::min(smallErrorFor(batch_.inertias[joint_->slotA]), smallErrorFor(batch_.inertias[joint_->slotB]));
        return rate(static_cast<double>(std::fabs(error)), most);
    }
    static double smallErrorFor(const BodyInertia& body) {
        if (!(body.inverseInertia > 0) || !(body.inverseMass > 0)) { return std::numeric_limits<double>::infinity(); }
        return kSmallErrorRatio *
               std::sqrt(static_cast<double>(body.inverseMass) / static_cast<double>(body.inverseInertia));
    }
    /// Bodies that were put far apart come together no faster than they may turn.
    Real rate(double error, double small) const {
        if (error <= small) { return 1 / closing_; }
        return std::min(joint_->softness.biasRate, static_cast<Real>(small / error) / closing_);
    }

    SolverBatch& batch_;
    std::span<const Motion> motions_;
    Real h_;
    Real closing_;  ///< s
    bool useBias_;
    std::vector<DirectRow>& rows_;
    const JointConstraint* joint_ = nullptr;
    const BodyState* a_ = nullptr;
    const BodyState* b_ = nullptr;
    Vec2 armA_;
    Vec2 armB_;
    Real turnA_ = 0;  ///< within the sub-step, rad
    Vec2 bend_;       ///< of B's anchor against A's
};

}  // namespace

void addJointRows(SolverBatch& batch, std::span<const Motion> motions, Real h, Real closing, bool useBias,
                  std::vector<DirectRow>& rows) {
    RowWriter writer(batch, motions, h, closing, useBias, rows);
    forEachHeldKind(batch, [&writer](auto& joints) {
        for (auto& joint : joints) { writer(joint); }
    });
}

void addMotorRows(SolverBatch& batch, Real h, bool isFirst, std::vector<MotorRow>& rows) {
    const auto add = [&rows](const JointConstraint& joint, const JointRow& row, Real speed, Real most, Real& impulse,
                             bool isOfMotorJoint = false, bool hasOther = false) {
        rows.push_back({{row, joint.slotA, joint.slotB, -speed, &impulse}, most, hasOther, isOfMotorJoint});
    };
    for (RevoluteConstraint& joint : batch.revolutes) {
        if (joint.hasMotor) { add(joint, kSpinRow, joint.motorSpeed, joint.maxMotorImpulse, joint.motorImpulse); }
    }
    for (WheelConstraint& joint : batch.wheels) {
        if (joint.hasMotor) { add(joint, kSpinRow, joint.motorSpeed, joint.maxMotorImpulse, joint.motorImpulse); }
    }
    for (PrismaticConstraint& joint : batch.prismatics) {
        if (!joint.hasMotor) { continue; }
        const BodyState& a = batch.states[joint.slotA];
        const BodyState& b = batch.states[joint.slotB];
        const Vec2 axis = rotate(a.deltaRotation, joint.axis);
        // As with `addSide`.
        const Vec2 armA = rotate(a.deltaRotation, joint.anchorA) + anchorOffset(joint, a, b);
        const JointRow row = rowAlong(axis, armA, rotate(b.deltaRotation, joint.anchorB));
        add(joint, row, joint.motorSpeed, joint.maxMotorImpulse, joint.motorImpulse);
    }
    for (MotorConstraint& joint : batch.motors) {
        if (!joint.isDriveHeld) { continue; }
        BodyState& a = batch.states[joint.slotA];
        BodyState& b = batch.states[joint.slotB];
        if (isFirst) { aimDrive(joint, {a, b, batch.inertias[joint.slotA], batch.inertias[joint.slotB]}, h); }
        if (joint.drivesAngle) {
            add(joint, kSpinRow, joint.spin, joint.maxAngularImpulse, joint.angularImpulse, true);
        }
        if (!joint.drivesLine) { continue; }
        const Vec2 armA = rotate(a.deltaRotation, joint.anchorA);
        const Vec2 armB = rotate(b.deltaRotation, joint.anchorB);
        const Real most = joint.maxLinearImpulse;
        add(joint, rowAlong({1, 0}, armA, armB), joint.velocity.x, most, joint.linearImpulse.x, true, true);
        add(joint, rowAlong({0, 1}, armA, armB), joint.velocity.y, most, joint.linearImpulse.y, true);
    }
}

}  // namespace swept::inline SWEPT_PRECISION

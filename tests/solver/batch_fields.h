#pragma once

#include <swept/shapes/bit_cast.h>
#include <swept/solver/solver.h>

#include <vector>

/// A walk over all dimensional fields of a batch.

namespace swept::test {

/// Powers of the units of length, mass and time.
struct Dimension {
    int length = 0;
    int mass = 0;
    int time = 0;
};
inline constexpr Dimension kNumber{0, 0, 0};
inline constexpr Dimension kLength{1, 0, 0};
inline constexpr Dimension kSpeed{1, 0, -1};
inline constexpr Dimension kRate{0, 0, -1};
inline constexpr Dimension kTime{0, 0, 1};
inline constexpr Dimension kMass{0, 1, 0};
inline constexpr Dimension kInertia{2, 1, 0};
inline constexpr Dimension kPerMass{0, -1, 0};
inline constexpr Dimension kPerInertia{-2, -1, 0};
inline constexpr Dimension kImpulse{1, 1, -1};
inline constexpr Dimension kTwist{2, 1, -1};

template <class Visit>
void visitVector(Vec2& v, Dimension dimension, Visit&& visit) {
    visit(v.x, dimension);
    visit(v.y, dimension);
}

template <class Visit>
void visitSoftness(Softness& softness, Visit&& visit) {
    visit(softness.biasRate, kRate);
    visit(softness.massScale, kNumber);
    visit(softness.impulseScale, kNumber);
}

template <class Visit>
void visitGains(SpringGains& gains, Visit&& visit) {
    visit(gains.push, kRate);
    visit(gains.drag, kNumber);
    visit(gains.lag, kNumber);
}

template <class Visit>
void visitGains(TurningSpring& spring, Visit&& visit) {
    visit(spring.stiffness, kMass);
    visit(spring.loss, kNumber);
    visit(spring.rate, kRate);
}

template <class Visit>
void visitBodies(SolverBatch& batch, Visit&& visit) {
    for (BodyState& state : batch.states) {
        visitVector(state.velocity, kSpeed, visit);
        visit(state.angularVelocity, kRate);
        visit(state.deltaAngle, kNumber);
        visitVector(state.deltaPosition, kLength, visit);
        visit(state.deltaRotation.c, kNumber);
        visit(state.deltaRotation.s, kNumber);
    }
    for (BodyInertia& inertia : batch.inertias) {
        visit(inertia.inverseMass, kPerMass);
        visit(inertia.inverseInertia, kPerInertia);
    }
    for (BodyDrive& drive : batch.drives) {
        visitVector(drive.gain, kSpeed, visit);
        visit(drive.angularGain, kRate);
        visit(drive.decay, kNumber);
        visit(drive.angularDecay, kNumber);
    }
}

template <class Visit>
void visitContacts(SolverBatch& batch, Visit&& visit) {
    for (ContactConstraint& contact : batch.contacts) {
        visitVector(contact.normal, kNumber, visit);
        visit(contact.maxPushSpeed, kSpeed);
        visit(contact.radiusA, kLength);
        visit(contact.radiusB, kLength);
        visit(contact.sharedResponse, kPerMass);
        visitSoftness(contact.softness, visit);
        for (ContactConstraintPoint& point : contact.points) {
            visitVector(point.anchorA, kLength, visit);
            visitVector(point.anchorB, kLength, visit);
            visit(point.baseSeparation, kLength);
            visit(point.normalMass, kMass);
            visit(point.tangentMass, kMass);
            visit(point.normalImpulse, kImpulse);
            visit(point.tangentImpulse, kImpulse);
            visit(point.totalNormalImpulse, kImpulse);
            visit(point.bounceApproach, kSpeed);
        }
    }
}

template <class Visit>
void visitCommon(JointConstraint& joint, Visit&& visit) {
    visitVector(joint.anchorA, kLength, visit);
    visitVector(joint.anchorB, kLength, visit);
    visitVector(joint.centerOffset, kLength, visit);
    visitSoftness(joint.softness, visit);
    visitVector(joint.total.impulse, kImpulse, visit);
    visit(joint.total.twist, kTwist);
}

/// @param place  of what moves: a number for an angle, a length for a translation
template <class Visit>
void visitFreedom(FreedomParts& parts, Dimension place, Dimension impulse, Visit&& visit) {
    visit(parts.lower, place);
    visit(parts.upper, place);
    visit(parts.motorSpeed, {place.length, 0, -1});
    visitGains(parts.spring, visit);
    for (Real* value : {&parts.maxMotorImpulse, &parts.lowerImpulse, &parts.upperImpulse, &parts.motorImpulse,
                        &parts.springImpulse}) {
        visit(*value, impulse);
    }
}

template <class Visit>
void visitJoint(RevoluteConstraint& joint, Visit&& visit) {
    visitFreedom(joint, kNumber, kTwist, visit);
    visitVector(joint.linearImpulse, kImpulse, visit);
}
template <class Visit>
void visitJoint(DistanceConstraint& joint, Visit&& visit) {
    for (Real* length : {&joint.length, &joint.minLength, &joint.maxLength}) { visit(*length, kLength); }
    visitGains(joint.spring, visit);
    visitVector(joint.axis, kNumber, visit);
    for (Real* impulse : {&joint.rigidImpulse, &joint.springImpulse, &joint.lowerImpulse, &joint.upperImpulse}) {
        visit(*impulse, kImpulse);
    }
}
template <class Visit>
void visitJoint(PrismaticConstraint& joint, Visit&& visit) {
    visitFreedom(joint, kLength, kImpulse, visit);
    visitVector(joint.axis, kNumber, visit);
    visitVector(joint.axisNow, kNumber, visit);
    visit(joint.heldImpulse.x, kImpulse);
    visit(joint.heldImpulse.y, kTwist);
}
template <class Visit>
void visitJoint(WheelConstraint& joint, Visit&& visit) {
    visitFreedom(joint.suspension, kLength, kImpulse, visit);
    visitGains(joint.spring, visit);
    visitVector(joint.axis, kNumber, visit);
    visitVector(joint.axisNow, kNumber, visit);
    visit(joint.motorSpeed, kRate);
    visit(joint.maxMotorImpulse, kTwist);
    visit(joint.motorImpulse, kTwist);
    visit(joint.heldImpulse.x, kImpulse);
}
template <class Visit>
void visitJoint(WeldConstraint& joint, Visit&& visit) {
    PointMatrix& stiffness = joint.linearSpring.stiffness;
    for (Real* entry : {&stiffness.xx, &stiffness.xy, &stiffness.yy}) { visit(*entry, kMass); }
    visit(stiffness.determinant, {0, 2, 0});
    visitGains(joint.linearSpring.damping, visit);
    visitGains(joint.angularSpring, visit);
    visitVector(joint.linearImpulse, kImpulse, visit);
    visit(joint.angularImpulse, kTwist);
}
template <class Visit>
void visitJoint(MotorConstraint& joint, Visit&& visit) {
    visitVector(joint.velocity, kSpeed, visit);
    visit(joint.spin, kRate);
    visit(joint.approachRate, kRate);
    visit(joint.maxLinearImpulse, kImpulse);
    visit(joint.maxAngularImpulse, kTwist);
    visitVector(joint.linearImpulse, kImpulse, visit);
    visit(joint.angularImpulse, kTwist);
    visitVector(joint.hinge.armA, kLength, visit);
    visitVector(joint.hinge.armB, kLength, visit);
    visit(joint.hinge.guided, kTwist);
}
template <class Visit>
void visitJoint(MouseConstraint& joint, Visit&& visit) {
    visitGains(joint.spring, visit);
    visit(joint.maxImpulse, kImpulse);
    visit(joint.approachRate, kRate);
    visitVector(joint.linearImpulse, kImpulse, visit);
    visitVector(joint.springImpulse, kImpulse, visit);
    visitVector(joint.velocity, kSpeed, visit);
}
/// The dimensions of a gear follow from what its two joints leave free.
template <class Visit>
void visitJoint(GearConstraint& gear, Visit&& visit) {
    for (GearSide* side : {&gear.first, &gear.second}) {
        visitVector(side->axis, kNumber, visit);
        visitVector(side->anchorA, kLength, visit);
        visitVector(side->anchorB, kLength, visit);
        visitVector(side->centerOffset, kLength, visit);
    }
    const int first = gear.first.slides ? 1 : 0;
    visit(gear.ratio, {first - (gear.second.slides ? 1 : 0), 0, 0});
    visit(gear.baseError, {first, 0, 0});
    visitVector(gear.axisNow, kNumber, visit);
    visit(gear.impulse, {2 - first, 1, -1});
}
template <class Visit>
void visitJoint(PulleyConstraint& joint, Visit&& visit) {
    visitVector(joint.offsetA, kLength, visit);
    visitVector(joint.offsetB, kLength, visit);
    visit(joint.ratio, kNumber);
    visit(joint.totalLength, kLength);
    visitVector(joint.axisA, kNumber, visit);
    visitVector(joint.axisB, kNumber, visit);
    visit(joint.tension, kImpulse);
}

template <class Visit>
void visitJoints(SolverBatch& batch, Visit&& visit) {
    batch.forEachJointKind([&](auto& joints) {
        for (auto& joint : joints) {
            visitCommon(joint, visit);
            visitJoint(joint, visit);
        }
    });
}

/// Calls `visit(Real&, Dimension)` for every field that has or may have a dimension, in a fixed order.
template <class Visit>
void visitBatch(SolverBatch& batch, Visit&& visit) {
    visitBodies(batch, visit);
    visitContacts(batch, visit);
    visitJoints(batch, visit);
}

/// Every field in bits: −0 differs from 0.
inline std::vector<std::uint64_t> bitsOf(SolverBatch& batch) {
    std::vector<std::uint64_t> all;
    visitBatch(batch,
               [&](Real& value, Dimension) { all.push_back(bitCast<std::uint64_t>(static_cast<double>(value))); });
    return all;
}

}  // namespace swept::test

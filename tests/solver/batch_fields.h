#pragma once

#include <swept/solver/solver.h>

#include <bit>
#include <cmath>
#include <vector>

#include "../support/random.h"

/// A batch of everything at once, and a walk over all its dimensional fields.

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
    for (Real* length : {&joint.length, &joint.minLength, &joint.maxLength}) {
        visit(*length, kLength);
    }
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
    visitVector(joint.axis, kNumber, visit);
    visitVector(joint.axisNow, kNumber, visit);
    visit(joint.motorSpeed, kRate);
    visit(joint.maxMotorImpulse, kTwist);
    visit(joint.motorImpulse, kTwist);
    visit(joint.heldImpulse.x, kImpulse);
}
template <class Visit>
void visitJoint(WeldConstraint& joint, Visit&& visit) {
    visitGains(joint.linearSpring, visit);
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
}
template <class Visit>
void visitJoint(MouseConstraint& joint, Visit&& visit) {
    visitGains(joint.spring, visit);
    visit(joint.maxImpulse, kImpulse);
    visitVector(joint.linearImpulse, kImpulse, visit);
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

/// A batch and its settings: bodies of all kinds, contacts that rest, slide, bounce and overlap, joints with every
/// part.
struct RandomSolve {
    SolverBatch batch;
    SolverSettings settings;

    /// @param times  so many times as many bodies and contacts; then some contacts carry nothing at first
    explicit RandomSolve(std::uint64_t seed, int times = 1) : random_(seed), isCrowd_(times > 1) {
        settings = {.dt = number(0.01, 0.02),
                    .subSteps = random_.integer(1, 8),
                    .relaxPasses = random_.integer(0, 2),
                    .restitutionThreshold = number(0, 0.5),
                    .maxSpeed = number(2, 6)};
        h_ = settings.dt / static_cast<Real>(settings.subSteps);
        batch.clear();
        bodies_ = times * random_.integer(3, 12);
        for (int i = 0; i < bodies_; ++i) {
            addBody();
        }
        for (int i = times * random_.integer(1, 16); i > 0; --i) {
            addContact();
        }
        for (int i = 0; i < times; ++i) {
            addJoints(batch.revolutes, [this](auto& joint) { fill(joint); });
        }
        addJoints(batch.distances, [this](auto& joint) { fill(joint); });
        addJoints(batch.prismatics, [this](auto& joint) { fill(joint); });
        addJoints(batch.wheels, [this](auto& joint) { fill(joint); });
        addJoints(batch.welds, [this](auto& joint) { fill(joint); });
        addJoints(batch.motors, [this](auto& joint) { fill(joint); });
        addJoints(batch.mice, [this](auto& joint) { fill(joint); });
        addJoints(batch.gears, [this](auto& joint) { fill(joint); });
        addJoints(batch.pulleys, [this](auto& joint) { fill(joint); });
    }

private:
    Real number(double low, double high) { return static_cast<Real>(random_.range(low, high)); }
    Vec2 vector(double size) { return {number(-size, size), number(-size, size)}; }
    template <class Constraint>
    void chooseSlots(Constraint& constraint) {
        const int a = random_.chance(0.3) ? 0 : random_.integer(0, bodies_);
        constraint.slotA = static_cast<BodySlot>(a);
        constraint.slotB = static_cast<BodySlot>((a + random_.integer(1, bodies_)) % (bodies_ + 1));
    }
    void addBody() {
        BodyState state;
        state.velocity = vector(4);
        state.angularVelocity = number(-2, 2);
        const bool kinematic = random_.chance(0.1);
        const bool turns = !random_.chance(0.1);
        BodyInertia inertia;
        if (!kinematic) {
            inertia = {number(0.1, 10), turns ? number(0.1, 10) : Real(0)};
        }
        BodyDrive drive{{0, Real(-0.04)}, 0, number(0.99, 1), number(0.99, 1)};
        batch.addBody(state, inertia, kinematic ? BodyDrive{} : drive);
    }
    void addContact() {
        ContactConstraint contact;
        chooseSlots(contact);
        const Real x = number(-1, 1);
        contact.normal = {x, std::sqrt(1 - x * x)};
        contact.friction = number(0, 1);
        contact.restitution = random_.chance(0.4) ? Real(0) : number(0, 1);
        contact.maxPushSpeed = 4;
        contact.softness = softnessOfSubStep(kContactCycles, kContactDampingRatio, h_);
        contact.count = random_.integer(1, 2);
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
            ContactConstraintPoint& point = contact.points[i];
            point.anchorA = vector(1);
            point.anchorB = vector(1);
            point.baseSeparation = number(-0.02, 0.04);
            point.normalImpulse = number(0, 0.01);
            point.tangentImpulse = number(-0.01, 0.01) * contact.friction;
        }
        if (isCrowd_ && random_.chance(0.4)) {
            for (ContactConstraintPoint& point : contact.points) {
                point.normalImpulse = point.tangentImpulse = 0;
            }
        }
        batch.contacts.push_back(contact);
    }
    template <class Joint, class Fill>
    void addJoints(std::vector<Joint>& joints, Fill&& fillIn) {
        for (int i = random_.integer(0, 3); i > 0; --i) {
            Joint joint;
            chooseSlots(joint);
            joint.anchorA = vector(1);
            joint.anchorB = vector(1);
            joint.centerOffset = joint.anchorA - joint.anchorB + vector(0.01);
            joint.softness = softnessOfSubStep(kJointCycles, kJointDampingRatio, h_);
            fillIn(joint);
            joints.push_back(joint);
        }
    }
    SpringGains spring() { return springGainsOf(number(1, 200), number(0, 1), h_); }
    Vec2 direction() {
        const Real x = number(-1, 1);
        return {x, std::sqrt(1 - x * x)};
    }
    void fillParts(FreedomParts& parts) {
        parts.hasLimits = random_.chance(0.5);
        parts.lower = number(-1, 0);
        parts.upper = number(0, 1);
        parts.hasMotor = random_.chance(0.5);
        parts.motorSpeed = number(-2, 2);
        parts.maxMotorImpulse = number(0, 0.1);
        parts.hasSpring = random_.chance(0.5);
        parts.spring = spring();
    }
    void fill(RevoluteConstraint& joint) {
        joint.baseAngle = number(-1, 1);
        fillParts(joint);
        joint.linearImpulse = vector(0.1);
    }
    void fill(DistanceConstraint& joint) {
        joint.centerOffset = vector(3);
        joint.length = number(1, 3);
        joint.isRigid = random_.chance(0.5);
        joint.hasSpring = random_.chance(0.5);
        joint.spring = spring();
        joint.hasLimits = random_.chance(0.5);
        joint.minLength = number(0, 2);
        joint.maxLength = number(2, 4);
    }
    void fill(PrismaticConstraint& joint) {
        joint.axis = joint.axisNow = direction();
        joint.centerOffset += number(-0.5, 0.5) * joint.axis;
        joint.baseAngle = number(-0.01, 0.01);
        fillParts(joint);
        joint.heldImpulse = vector(0.1);
    }
    void fill(WheelConstraint& joint) {
        joint.axis = joint.axisNow = direction();
        joint.centerOffset += number(-0.5, 0.5) * joint.axis;
        fillParts(joint.suspension);
        joint.suspension.hasMotor = false;
        joint.hasMotor = random_.chance(0.5);
        joint.motorSpeed = number(-5, 5);
        joint.maxMotorImpulse = number(0, 0.1);
        joint.heldImpulse = {number(-0.1, 0.1), 0};
    }
    void fill(WeldConstraint& joint) {
        joint.baseAngle = number(-0.01, 0.01);
        joint.hasLinearSpring = random_.chance(0.5);
        joint.linearSpring = spring();
        joint.hasAngularSpring = random_.chance(0.5);
        joint.angularSpring = spring();
        joint.linearImpulse = vector(0.1);
    }
    void fill(MotorConstraint& joint) {
        joint.centerOffset += vector(0.5);
        joint.baseAngle = number(-1, 1);
        joint.velocity = vector(1);
        joint.spin = number(-1, 1);
        joint.approachRate = number(5, 20);
        joint.maxLinearImpulse = number(0, 0.1);
        joint.maxAngularImpulse = number(0, 0.1);
        joint.drivesLine = random_.chance(0.8);
        joint.drivesAngle = random_.chance(0.8);
        joint.seeksPlace = random_.chance(0.5);
        joint.seeksAngle = random_.chance(0.5);
    }
    void fill(MouseConstraint& joint) {
        joint.slotA = kFixedSlot;
        joint.slotB = static_cast<BodySlot>(random_.integer(1, bodies_));
        joint.anchorA = {};
        joint.hasSpring = random_.chance(0.7);
        joint.spring = spring();
        joint.maxImpulse = number(0, 0.1);
    }
    void fill(GearSide& side) {
        chooseSlots(side);
        side.slides = random_.chance(0.5);
        side.axis = direction();
        side.anchorA = vector(1);
        side.anchorB = vector(1);
        side.centerOffset = vector(1);
    }
    void fill(GearConstraint& joint) {
        fill(joint.first);
        fill(joint.second);
        joint.slotA = joint.first.slotB;
        joint.slotB = joint.second.slotB;
        joint.ratio = number(0.5, 2) * static_cast<Real>(random_.sign());
        joint.baseError = number(-0.01, 0.01);
    }
    void fill(PulleyConstraint& joint) {
        joint.offsetA = {number(-1, 1), number(-3, -1)};
        joint.offsetB = {number(-1, 1), number(-3, -1)};
        joint.ratio = number(0.5, 2);
        joint.totalLength = number(3, 6);
    }

    Random random_;
    bool isCrowd_ = false;
    Real h_ = 0;
    int bodies_ = 0;
};

/// Every field in bits: −0 differs from 0.
inline std::vector<std::uint64_t> bitsOf(SolverBatch& batch) {
    std::vector<std::uint64_t> all;
    visitBatch(batch, [&](Real& value, Dimension) {
        all.push_back(std::bit_cast<std::uint64_t>(static_cast<double>(value)));
    });
    return all;
}

}  // namespace swept::test

#pragma once

#include <swept/solver/solver.h>

#include <cmath>

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
void visitJoints(SolverBatch& batch, Visit&& visit) {
    for (RevoluteConstraint& joint : batch.revolutes) {
        visitVector(joint.anchorA, kLength, visit);
        visitVector(joint.anchorB, kLength, visit);
        visitVector(joint.centerOffset, kLength, visit);
        visit(joint.motorSpeed, kRate);
        visit(joint.maxMotorImpulse, kTwist);
        visitSoftness(joint.softness, visit);
        visitSoftness(joint.spring, visit);
        visit(joint.angularMass, kInertia);
        visitVector(joint.linearImpulse, kImpulse, visit);
        for (Real* twist : {&joint.lowerImpulse, &joint.upperImpulse, &joint.motorImpulse, &joint.springImpulse}) {
            visit(*twist, kTwist);
        }
    }
    for (DistanceConstraint& joint : batch.distances) {
        visitVector(joint.anchorA, kLength, visit);
        visitVector(joint.anchorB, kLength, visit);
        visitVector(joint.centerOffset, kLength, visit);
        for (Real* length : {&joint.length, &joint.minLength, &joint.maxLength}) {
            visit(*length, kLength);
        }
        visitSoftness(joint.softness, visit);
        visitSoftness(joint.spring, visit);
        visitVector(joint.axis, kNumber, visit);
        for (Real* impulse : {&joint.rigidImpulse, &joint.springImpulse, &joint.lowerImpulse, &joint.upperImpulse}) {
            visit(*impulse, kImpulse);
        }
    }
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

    explicit RandomSolve(std::uint64_t seed) : random_(seed) {
        settings = {.dt = number(0.01, 0.02),
                    .subSteps = random_.integer(1, 8),
                    .relaxPasses = random_.integer(0, 2),
                    .restitutionThreshold = number(0, 0.5),
                    .maxSpeed = number(2, 6)};
        h_ = settings.dt / static_cast<Real>(settings.subSteps);
        batch.clear();
        bodies_ = random_.integer(3, 12);
        for (int i = 0; i < bodies_; ++i) {
            addBody();
        }
        for (int i = random_.integer(1, 16); i > 0; --i) {
            addContact();
        }
        for (int i = random_.integer(0, 4); i > 0; --i) {
            addRevolute();
        }
        for (int i = random_.integer(0, 4); i > 0; --i) {
            addDistance();
        }
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
        batch.contacts.push_back(contact);
    }
    void addRevolute() {
        RevoluteConstraint joint;
        chooseSlots(joint);
        joint.anchorA = vector(1);
        joint.anchorB = vector(1);
        joint.centerOffset = joint.anchorA - joint.anchorB + vector(0.01);
        joint.baseAngle = number(-1, 1);
        joint.hasLimits = random_.chance(0.5);
        joint.lower = number(-1, 0);
        joint.upper = number(0, 1);
        joint.hasMotor = random_.chance(0.5);
        joint.motorSpeed = number(-2, 2);
        joint.maxMotorImpulse = number(0, 0.1);
        joint.hasSpring = random_.chance(0.5);
        joint.spring = softnessOf(number(1, 20), number(0, 1), h_);
        joint.softness = softnessOfSubStep(kJointCycles, kJointDampingRatio, h_);
        joint.linearImpulse = vector(0.1);
        batch.revolutes.push_back(joint);
    }
    void addDistance() {
        DistanceConstraint joint;
        chooseSlots(joint);
        joint.anchorA = vector(1);
        joint.anchorB = vector(1);
        joint.centerOffset = vector(3);
        joint.length = number(1, 3);
        joint.isRigid = random_.chance(0.5);
        joint.hasSpring = random_.chance(0.5);
        joint.spring = softnessOf(number(1, 20), number(0, 1), h_);
        joint.hasLimits = random_.chance(0.5);
        joint.minLength = number(0, 2);
        joint.maxLength = number(2, 4);
        joint.softness = softnessOfSubStep(kJointCycles, kJointDampingRatio, h_);
        batch.distances.push_back(joint);
    }

    Random random_;
    Real h_ = 0;
    int bodies_ = 0;
};

}  // namespace swept::test

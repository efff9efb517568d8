#pragma once

#include <swept/solver/solver.h>

#include <cmath>
#include <vector>

#include "../support/random.h"

/// A batch of everything at once.

namespace swept::test {

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
        for (int i = 0; i < bodies_; ++i) { addBody(); }
        for (int i = times * random_.integer(1, 16); i > 0; --i) { addContact(); }
        for (int i = 0; i < times; ++i) {
            addJoints(batch.revolutes, [this](auto& joint) { fill(joint); });
            addJoints(batch.distances, [this](auto& joint) { fill(joint); });
            addJoints(batch.welds, [this](auto& joint) { fill(joint); });
            addJoints(batch.prismatics, [this](auto& joint) { fill(joint); });
            addJoints(batch.wheels, [this](auto& joint) { fill(joint); });
            addJoints(batch.motors, [this](auto& joint) { fill(joint); });
        }
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
        if (!kinematic) { inertia = {number(0.1, 10), turns ? number(0.1, 10) : Real(0)}; }
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
            for (ContactConstraintPoint& point : contact.points) { point.normalImpulse = point.tangentImpulse = 0; }
        }
        if (random_.chance(0.5)) { contact.radiusA = number(0, 1); }
        if (random_.chance(0.5)) { contact.radiusB = number(0, 1); }
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
    TurningSpring turningSpring() {
        const Real mass = number(0.1, 4);
        const Real frequency = number(1, 200);
        return turningSpringOf(frequency, number(0, 1), h_, mass);
    }
    PointSpring pointSpring() {
        const TurningSpring spring = turningSpring();
        const Real other = number(0.5, 2);
        const PointMatrix own{spring.stiffness, 0, other * spring.stiffness, other * square(spring.stiffness)};
        const Vec2 axis = direction();
        return {turned(own, {axis.x, axis.y}), spring};
    }
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
        // Anchors that coincide have no direction.
        joint.centerOffset = random_.chance(0.1) ? joint.anchorA - joint.anchorB : vector(3);
        joint.axis = direction();
        joint.length = number(1, 3);
        joint.isRigid = random_.chance(0.5);
        joint.hasSpring = random_.chance(0.5);
        joint.spring = turningSpring();
        joint.hasLimits = random_.chance(0.5);
        joint.minLength = number(0, 2);
        joint.maxLength = random_.chance(0.2) ? Real(1e6) : number(2, 4);
        joint.rigidImpulse = number(-0.1, 0.1);
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
        joint.spring = turningSpring();
        joint.hasMotor = random_.chance(0.5);
        joint.motorSpeed = number(-5, 5);
        joint.maxMotorImpulse = number(0, 0.1);
        joint.heldImpulse = {number(-0.1, 0.1), 0};
    }
    void fill(WeldConstraint& joint) {
        joint.baseAngle = number(-0.01, 0.01);
        joint.hasLinearSpring = random_.chance(0.3);
        joint.isLinked = joint.hasLinearSpring && random_.chance(0.5);
        joint.linearSpring = pointSpring();
        joint.hasAngularSpring = random_.chance(0.3);
        joint.angularSpring = spring();
        joint.linearImpulse = vector(0.1);
        joint.angularImpulse = number(-0.1, 0.1);
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
        joint.ease = random_.chance(0.5) ? number(0, 0.3) : Real(0);
    }
    void fill(MouseConstraint& joint) {
        joint.slotA = kFixedSlot;
        joint.slotB = static_cast<BodySlot>(random_.integer(1, bodies_));
        joint.anchorA = {};
        joint.hasSpring = random_.chance(0.7);
        joint.spring = spring();
        joint.approachRate = number(1, 20);
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

}  // namespace swept::test

#include "spring_energy.h"

#include <algorithm>
#include <cmath>

#include "../../solver/joints/pin.h"
#include "joint_builder.h"
#include "rest_springs.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Two bodies that a joint holds, as they stand and move.
struct Ends {
    Ends(const WorldState& world, const Joint& joint, const BodyMotion& a, const BodyMotion& b)
        : motionA(a),
          motionB(b),
          armA(rotate(motionA.pose.rotation, joint.localAnchorA - world.bodies[joint.bodyA].localCenter)),
          armB(rotate(motionB.pose.rotation, joint.localAnchorB - world.bodies[joint.bodyB].localCenter)),
          gap(toReal(motionB.center - motionA.center) + (armB - armA)) {}

    Real spin() const { return motionB.angularVelocity - motionA.angularVelocity; }
    /// Of the gap.
    Vec2 speed() const { return velocityOf(motionB, armB) - velocityOf(motionA, armA); }
    /// As A sees it.
    Vec2 speedInA() const { return velocityOf(motionB, armB) - velocityOf(motionA, armA + gap); }

    const BodyMotion& motionA;
    const BodyMotion& motionB;
    Vec2 armA;
    Vec2 armB;
    Vec2 gap;

private:
    static Vec2 velocityOf(const BodyMotion& motion, Vec2 arm) {
        return motion.velocity + motion.angularVelocity * leftPerp(arm);
    }
};

/// @param stiffness  that of the spring times the square of a sub-step
double springEnergy(Real stiffness, Real stretch, Real speed, Real h) {
    const double x = static_cast<double>(stretch) / static_cast<double>(h);
    return 0.5 * static_cast<double>(stiffness) * x * (x - static_cast<double>(speed));
}

struct Reader {
    const WorldState& world;
    const Joint& joint;
    Real h;
    const BodyMotion& a;
    const BodyMotion& b;

    double operator()(const JointPart<DistanceJointDef, DistanceConstraint>& part) const {
        if (!part.def.spring) { return 0; }
        const Ends ends(world, joint, a, b);
        const UnitAndLength offset = normalized(ends.gap);
        return springEnergy(rodSpringOf(world, joint, *part.def.spring, h).stiffness, offset.length - joint.length,
                            dot(offset.unit, ends.speed()), h);
    }
    double operator()(const JointPart<WheelJointDef, WheelConstraint>& part) const {
        if (!part.def.spring) { return 0; }
        const TurningSpring spring = wheelSpringOf(world, joint, *part.def.spring, h);
        return alongAxis(spring.stiffness, part.def.springTarget);
    }
    double operator()(const JointPart<PrismaticJointDef, PrismaticConstraint>& part) const {
        if (!part.def.spring) { return 0; }
        return alongAxis(sliderSpringOf(world, joint, *part.def.spring, h).stiffness, part.def.springTarget);
    }
    double operator()(const HingePart& part) const {
        return part.def.spring ? ofAngle(*part.def.spring, part.def.springTarget, true) : 0;
    }
    double operator()(const JointPart<WeldJointDef, WeldConstraint>& part) const {
        double sum = part.def.angularSpring ? ofAngle(*part.def.angularSpring, 0, !part.def.linearSpring) : 0;
        if (part.def.linearSpring) {
            const Ends ends(world, joint, a, b);
            const PointMatrix stiffness =
                pointSpringOf(world, joint, *part.def.linearSpring, h, !part.def.angularSpring, a.pose.rotation)
                    .stiffness;
            const Vec2 stretch = (1 / h) * ends.gap;
            sum += 0.5 * static_cast<double>(dot(stretch, product(stiffness, stretch - ends.speedInA())));
        }
        return sum;
    }
    template <class Part>
    double operator()(const Part&) const {
        return 0;
    }

private:
    double alongAxis(Real stiffness, Real target) const {
        const Ends ends(world, joint, a, b);
        const Vec2 axis = rotate(ends.motionA.pose.rotation, joint.localAxis);
        return springEnergy(stiffness, dot(axis, ends.gap) - target, dot(axis, ends.speedInA()), h);
    }
    /// @param isHeld  whether the point is
    double ofAngle(const Spring& spring, Real target, bool isHeld) const {
        const Ends ends(world, joint, a, b);
        const BodyInertia ofA = inertiaOf(world, joint.bodyA);
        const BodyInertia ofB = inertiaOf(world, joint.bodyB);
        BodyState still;
        const JointPair pair{still, still, ofA, ofB};
        const Real turn = turnOf(pair);
        const Pin pin{ends.armA, ends.armB, pointMatrix(ofA, ends.armA, ofB, ends.armB)};
        const Real alone = turn > 0 ? 1 / turn : Real(0);
        const Real mass = isHeld ? spinOf(pin, pair, 0).mass : alone;
        return springEnergy(turningSpring(spring, h, mass).stiffness,
                            static_cast<Real>(b.angle - a.angle - joint.referenceAngle) - target, ends.spin(), h);
    }
};

}  // namespace

double springEnergyOf(const WorldState& world, const Joint& joint, Real h, const BodyMotion& a, const BodyMotion& b) {
    return std::visit(Reader{world, joint, h, a, b}, joint.parts);
}

}  // namespace swept::inline SWEPT_PRECISION

#include "rest_springs.h"

#include "../../solver/joints/pin.h"
#include "../../solver/softness.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The bodies of a joint as it was made, in axes of which the first is that of the joint.
struct Rest {
    Rest(const WorldState& world, const Joint& joint)
        : a(inertiaOf(world, joint.bodyA)),
          b(inertiaOf(world, joint.bodyB)),
          pin{along(joint.localAxis, joint.localAnchorA - world.bodies[joint.bodyA].localCenter),
              along(joint.localAxisB, joint.localAnchorB - world.bodies[joint.bodyB].localCenter),
              {}} {
        pin.matrix = pointMatrix(a, pin.armA, b, pin.armB);
    }

    PointMatrix atAngle() const {
        BodyState stillA;
        BodyState stillB;
        return matrixAtAngle(pin, {stillA, stillB, a, b});
    }

    BodyInertia a;
    BodyInertia b;
    Pin pin;

private:
    static Vec2 along(Vec2 axis, Vec2 arm) { return {dot(axis, arm), cross(axis, arm)}; }
};

Real inverseOf(Real response) { return response > 0 ? 1 / response : Real(0); }

/// Along the first axis, while nothing moves along the other.
Real massAlong(const PointMatrix& response) {
    return response.determinant > 0 ? response.yy / response.determinant : Real(0);
}

}  // namespace

BodyInertia inertiaOf(const WorldState& world, std::uint32_t body) {
    return {world.bodies[body].inverseMass, world.bodies[body].inverseInertia};
}

SpringGains gainsOf(const Spring& spring, Real h) {
    return springGainsOf(kTwoPi * spring.hertz, spring.dampingRatio, h);
}

TurningSpring turningSpring(const Spring& spring, Real h, Real mass) {
    return turningSpringOf(kTwoPi * spring.hertz, spring.dampingRatio, h, mass);
}

Real rodMassOf(const WorldState& world, const Joint& joint) { return inverseOf(Rest(world, joint).pin.matrix.xx); }

TurningSpring rodSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h) {
    return turningSpring(spring, h, rodMassOf(world, joint));
}

TurningSpring wheelSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h) {
    return turningSpring(spring, h, massAlong(Rest(world, joint).pin.matrix));
}

TurningSpring sliderSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h) {
    return turningSpring(spring, h, massAlong(Rest(world, joint).atAngle()));
}

PointSpring pointSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h, bool isAngleHeld,
                          Rotation turnOfA) {
    const Rest rest(world, joint);
    const PointMatrix response = isAngleHeld ? rest.atAngle() : rest.pin.matrix;
    const TurningSpring unit = turningSpring(spring, h, 1);
    if (!(response.determinant > 0)) { return {{}, unit}; }
    const Real scale = unit.stiffness / response.determinant;
    const PointMatrix own{scale * response.yy, -scale * response.xy, scale * response.xx,
                          square(unit.stiffness) / response.determinant};
    const Vec2 axis = rotate(turnOfA, joint.localAxis);
    return {turned(own, {axis.x, axis.y}), unit};
}

}  // namespace swept::inline SWEPT_PRECISION

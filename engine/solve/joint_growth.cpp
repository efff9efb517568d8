#include "joint_growth.h"

#include <variant>

namespace swept::inline SWEPT_PRECISION {
namespace {

void scaleMemory(FreedomParts& parts, Real factor) {
    parts.lowerImpulse *= factor;
    parts.upperImpulse *= factor;
    parts.motorImpulse *= factor;
    parts.springImpulse *= factor;
}

void scaleMemory(DistanceConstraint& rod, Real factor) {
    rod.rigidImpulse *= factor;
    rod.springImpulse *= factor;
    rod.lowerImpulse *= factor;
    rod.upperImpulse *= factor;
}

void scaleMemory(PrismaticConstraint& slider, Real factor) {
    scaleMemory(static_cast<FreedomParts&>(slider), factor);
    slider.heldImpulse = factor * slider.heldImpulse;
}

void scaleMemory(WheelConstraint& wheel, Real factor) {
    scaleMemory(wheel.suspension, factor);
    wheel.motorImpulse *= factor;
    wheel.heldImpulse = factor * wheel.heldImpulse;
}

void scaleMemory(WeldConstraint& weld, Real factor) {
    weld.linearImpulse = factor * weld.linearImpulse;
    weld.angularImpulse *= factor;
}

void scaleMemory(MotorConstraint& motor, Real factor) {
    motor.linearImpulse = factor * motor.linearImpulse;
    motor.angularImpulse *= factor;
    motor.hinge.guided = factor * motor.hinge.guided;
}

void scaleMemory(MouseConstraint& mouse, Real factor) {
    mouse.linearImpulse = factor * mouse.linearImpulse;
    mouse.springImpulse = factor * mouse.springImpulse;
}

void scaleMemory(GearConstraint& gear, Real factor) { gear.impulse *= factor; }

void scaleMemory(PulleyConstraint& pulley, Real factor) { pulley.tension *= factor; }

}  // namespace

void scaleStart(Joint& joint, Real factor) {
    std::visit(
        [factor](auto& part) {
            if constexpr (requires { part.memory; }) { scaleMemory(part.memory, factor); }
        },
        joint.parts);
    HingeMemory& hinge = joint.hinge;
    hinge.point = factor * hinge.point;
    hinge.lower *= factor;
    hinge.upper *= factor;
    hinge.motor *= factor;
    hinge.spring *= factor;
}

}  // namespace swept::inline SWEPT_PRECISION

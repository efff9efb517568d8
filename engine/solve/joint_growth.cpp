#include "joint_growth.h"

#include <cstddef>
#include <variant>

namespace swept::inline SWEPT_PRECISION {
namespace {

template <class Visit>
void visitNumbers(Real& impulse, const Visit& visit) {
    visit(impulse);
}

template <class Visit>
void visitNumbers(Vec2& impulse, const Visit& visit) {
    visit(impulse.x);
    visit(impulse.y);
}

template <class Visit>
void visitMemory(FreedomParts& parts, const Visit& visit) {
    visitNumbers(parts.lowerImpulse, visit);
    visitNumbers(parts.upperImpulse, visit);
    visitNumbers(parts.motorImpulse, visit);
    visitNumbers(parts.springImpulse, visit);
}

template <class Visit>
void visitMemory(DistanceConstraint& rod, const Visit& visit) {
    visitNumbers(rod.rigidImpulse, visit);
    visitNumbers(rod.springImpulse, visit);
    visitNumbers(rod.lowerImpulse, visit);
    visitNumbers(rod.upperImpulse, visit);
}

template <class Visit>
void visitMemory(PrismaticConstraint& slider, const Visit& visit) {
    visitMemory(static_cast<FreedomParts&>(slider), visit);
    visitNumbers(slider.heldImpulse, visit);
}

template <class Visit>
void visitMemory(WheelConstraint& wheel, const Visit& visit) {
    visitMemory(wheel.suspension, visit);
    visitNumbers(wheel.motorImpulse, visit);
    visitNumbers(wheel.heldImpulse, visit);
}

template <class Visit>
void visitMemory(WeldConstraint& weld, const Visit& visit) {
    visitNumbers(weld.linearImpulse, visit);
    visitNumbers(weld.angularImpulse, visit);
}

template <class Visit>
void visitMemory(MotorConstraint& motor, const Visit& visit) {
    visitNumbers(motor.linearImpulse, visit);
    visitNumbers(motor.angularImpulse, visit);
    visitNumbers(motor.hinge.guided, visit);
}

template <class Visit>
void visitMemory(MouseConstraint& mouse, const Visit& visit) {
    visitNumbers(mouse.linearImpulse, visit);
    visitNumbers(mouse.springImpulse, visit);
}

template <class Visit>
void visitMemory(GearConstraint& gear, const Visit& visit) {
    visitNumbers(gear.impulse, visit);
}

template <class Visit>
void visitMemory(PulleyConstraint& pulley, const Visit& visit) {
    visitNumbers(pulley.tension, visit);
}

/// All impulses that the joint starts from, always in the same order.
template <class Visit>
void visitStart(Joint& joint, const Visit& visit) {
    std::visit(
        [&visit](auto& part) {
            if constexpr (requires { part.memory; }) { visitMemory(part.memory, visit); }
        },
        joint.parts);
    HingeMemory& hinge = joint.hinge;
    visitNumbers(hinge.point, visit);
    visitNumbers(hinge.lower, visit);
    visitNumbers(hinge.upper, visit);
    visitNumbers(hinge.motor, visit);
    visitNumbers(hinge.spring, visit);
}

}  // namespace

void scaleStart(Joint& joint, Real factor) {
    visitStart(joint, [factor](Real& impulse) { impulse *= factor; });
}

JointStart startOf(Joint& joint, std::uint32_t index) {
    JointStart start{.joint = index};
    visitStart(joint, [&start](Real& impulse) { start.impulses[start.count++] = impulse; });
    return start;
}

void setStart(Joint& joint, const JointStart& start) {
    std::size_t next = 0;
    visitStart(joint, [&](Real& impulse) { impulse = start.impulses[next++]; });
}

}  // namespace swept::inline SWEPT_PRECISION

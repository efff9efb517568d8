#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "../solve/driven_joints.h"
#include "../state/number_range.h"
#include "../state/world_state.h"
#include "joint_checks.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// Whether a definition has a member of this kind that is set by that type.
template <class Part, class Value>
concept HasLimits = requires(Part& part, Value value) {
    part.def.limits = value;
};
template <class Part, class Value>
concept HasMotor = requires(Part& part, Value value) {
    part.def.motor = value;
};
template <class Part>
concept HasSpring = requires(Part& part, std::optional<Spring> value) {
    part.def.spring = value;
};

void wakeBodies(WorldState& world, const Joint& joint) {
    for (const std::uint32_t body : joint.allBodies()) { rouse(world, body); }
}

void setTie(WorldState& world, JointId id, const Joint& joint) {
    const JointTie tie = tieOf(joint);
    if (tie == world.jointTies[id.index]) { return; }  // as of a motor that is driven
    world.jointTies[id.index] = tie;
    world.jointChains.areCurrent = false;
}

/// Of its bodies, metres.
Real widestRadius(const WorldState& world, JointId id) {
    Real widest = 0;
    for (const std::uint32_t slot : world.joints.find(id)->allBodies()) {
        widest = std::max(widest, world.bodies[slot].radius);
    }
    return widest;
}

/// Changes a joint and wakes its bodies. @param change  takes a part, returns whether that kind of joint has what it
/// sets
template <class Change>
Status change(WorldState& world, JointId id, const Status& value, Change&& change) {
    Joint* joint = world.joints.find(id);
    if (joint == nullptr) { return {StatusCode::staleId, "joint"}; }
    if (!value.ok()) { return value; }
    if (!std::visit(change, joint->parts)) { return {StatusCode::wrongJointType, "joint"}; }
    setTie(world, id, *joint);
    wakeBodies(world, *joint);
    return Status::success();
}

std::array<Real, 2> boundsOf(const AngleLimits& limits) { return {limits.lower, limits.upper}; }
std::array<Real, 2> boundsOf(const TranslationLimits& limits) { return {limits.lower, limits.upper}; }
std::array<Real, 2> boundsOf(const LengthLimits& limits) { return {limits.min, limits.max}; }

/// How far a bound moves; infinitely where limits come or go.
template <class Limits>
Real distanceBetween(const std::optional<Limits>& before, const std::optional<Limits>& after) {
    if (before.has_value() != after.has_value()) { return std::numeric_limits<Real>::infinity(); }
    if (!before) { return 0; }
    Real farthest = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const Real from = boundsOf(*before)[i];
        const Real to = boundsOf(*after)[i];
        if (from != to) { farthest = std::max(farthest, std::fabs(to - from)); }  // both may be infinite
    }
    return farthest;
}

/// @param moved  becomes how far
template <class Limits>
auto toLimits(const std::optional<Limits>& limits, Real& moved) {
    return [limits, &moved](auto& part) {
        if constexpr (HasLimits<decltype(part), std::optional<Limits>>) {
            moved = distanceBetween(part.def.limits, limits);
            part.def.limits = limits;
            return true;
        }
        return false;
    };
}

template <class Motor>
auto toMotor(const std::optional<Motor>& motor) {
    return [motor](auto& part) {
        if constexpr (HasMotor<decltype(part), std::optional<Motor>>) {
            part.def.motor = motor;
            return true;
        }
        return false;
    };
}

}  // namespace

Status World::setAngleLimits(JointId id, std::optional<AngleLimits> limits) {
    Real turned = 0;
    const Status status = change(*state_, id, checkLimits(limits), toLimits(limits, turned));
    if (status.ok()) { noteDriven(*state_, id, turned * widestRadius(*state_, id)); }
    return status;
}
Status World::setTranslationLimits(JointId id, std::optional<TranslationLimits> limits) {
    Real moved = 0;
    const Status status = change(*state_, id, checkLimits(limits), toLimits(limits, moved));
    if (status.ok()) { noteDriven(*state_, id, moved); }
    return status;
}
Status World::setAngularMotor(JointId id, std::optional<AngularMotor> motor) {
    return change(*state_, id, checkMotor(motor), toMotor(motor));
}
Status World::setLinearMotor(JointId id, std::optional<LinearMotor> motor) {
    return change(*state_, id, checkMotor(motor), toMotor(motor));
}

Status World::setSpring(JointId id, std::optional<Spring> spring) {
    return change(*state_, id, checkSpring(spring), [&](auto& part) {
        if constexpr (HasSpring<decltype(part)>) {
            part.def.spring = spring;
            return true;
        }
        return false;
    });
}

Status World::setWeldSprings(JointId id, std::optional<Spring> linear, std::optional<Spring> angular) {
    const Status first = checkSpring(linear);
    return change(*state_, id, first.ok() ? checkSpring(angular) : first,
                  Overloaded{[&](JointPart<WeldJointDef, WeldConstraint>& part) {
                                 part.def.linearSpring = linear;
                                 part.def.angularSpring = angular;
                                 return true;
                             },
                             [](auto&) { return false; }});
}

Status World::setLengthLimits(JointId id, std::optional<LengthLimits> limits) {
    const Joint* joint = state_->joints.find(id);
    const bool isDistance = joint != nullptr && joint->type() == JointType::distance;
    const Real length = isDistance ? joint->length : Real(1);  // of others `change` tells
    Real moved = 0;
    const Status status = change(*state_, id, checkLength(length, limits), toLimits(limits, moved));
    if (status.ok()) { noteDriven(*state_, id, moved); }
    return status;
}

Status World::setLength(JointId id, Real length) {
    Joint* joint = state_->joints.find(id);
    std::optional<LengthLimits> limits;
    if (joint != nullptr) {
        if (const auto* part = std::get_if<JointPart<DistanceJointDef, DistanceConstraint>>(&joint->parts)) {
            limits = part->def.limits;
        }
    }
    const Real before = joint != nullptr ? joint->length : length;
    const Status status = change(*state_, id, checkLength(length, limits),
                                 Overloaded{[&](JointPart<DistanceJointDef, DistanceConstraint>& part) {
                                                part.def.length = joint->length = length;
                                                return true;
                                            },
                                            [](auto&) { return false; }});
    if (status.ok()) { noteDriven(*state_, id, std::fabs(length - before)); }
    return status;
}

Status World::setTarget(JointId id, DVec2 target) {
    DVec2 way;
    const Status status = change(*state_, id, checkNumber(target, "target"),
                                 Overloaded{[&](JointPart<MouseJointDef, MouseConstraint>& part) {
                                                if (!part.def.anchor) {
                                                    part.def.anchor = part.def.target;
                                                }  // as it was made
                                                way = target - part.def.target;
                                                part.memory.toGo += toReal(way);
                                                part.def.target = target;
                                                return true;
                                            },
                                            [](auto&) { return false; }});
    if (status.ok()) { noteDriven(*state_, id, static_cast<Real>(length(way))); }
    return status;
}

Status World::setDrive(JointId id, const MotorDrive& drive) {
    return change(*state_, id, checkDrive(drive),
                  Overloaded{[&](JointPart<MotorJointDef, MotorConstraint>& part) {
                                 part.def.drive = drive;
                                 return true;
                             },
                             [](auto&) { return false; }});
}

Status World::setBreakLimits(JointId id, std::optional<Real> force, std::optional<Real> torque) {
    Joint* joint = state_->joints.find(id);
    if (joint == nullptr) { return {StatusCode::staleId, "joint"}; }
    const Status status = checkBreakLimits(force, torque);
    if (!status.ok()) { return status; }
    joint->base.breakForce = force;
    joint->base.breakTorque = torque;
    setTie(*state_, id, *joint);
    return Status::success();
}

}  // namespace swept::inline SWEPT_PRECISION

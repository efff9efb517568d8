#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "../bodies/awake.h"
#include "../solve/driven_joints.h"
#include "../solve/joint_tie.h"
#include "../state/number_range.h"
#include "../state/world_state.h"
#include "../world.h"
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

using DistancePart = JointPart<DistanceJointDef, DistanceConstraint>;

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

/// How far bounds move; infinitely where limits come or go.
template <class Limits>
DrivenMove moveBetween(const std::optional<Limits>& before, const std::optional<Limits>& after) {
    if (before.has_value() != after.has_value()) { return {.farthest = std::numeric_limits<Real>::infinity()}; }
    DrivenMove move;
    if (!before) { return move; }
    for (std::size_t i = 0; i < 2; ++i) {
        const Real from = boundsOf(*before)[i];
        const Real to = boundsOf(*after)[i];
        if (from == to) { continue; }  // both may be infinite
        const Real way = to - from;
        move.farthest = std::max(move.farthest, std::fabs(way));
        if (std::isfinite(way)) { move.way[i] = way; }
    }
    return move;
}

/// @param move  becomes how they move
template <class Limits>
auto toLimits(const std::optional<Limits>& limits, DrivenMove& move) {
    return [limits, &move](auto& part) {
        if constexpr (HasLimits<decltype(part), std::optional<Limits>>) {
            move = moveBetween(part.def.limits, limits);
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
    DrivenMove move;
    const Status status = change(*state_, id, checkLimits(limits), toLimits(limits, move));
    if (!status.ok()) { return status; }
    move.lever = widestRadius(*state_, id);
    move.farthest *= move.lever;
    noteDriven(*state_, id, move);
    return status;
}
Status World::setTranslationLimits(JointId id, std::optional<TranslationLimits> limits) {
    DrivenMove move;
    const Status status = change(*state_, id, checkLimits(limits), toLimits(limits, move));
    if (status.ok()) { noteDriven(*state_, id, move); }
    return status;
}
Status World::setAngularMotor(JointId id, std::optional<AngularMotor> motor) {
    return change(*state_, id, checkMotor(motor), toMotor(motor));
}
Status World::setLinearMotor(JointId id, std::optional<LinearMotor> motor) {
    return change(*state_, id, checkMotor(motor), toMotor(motor));
}

Status World::setSpring(JointId id, std::optional<Spring> spring) {
    const Joint* joint = state_->joints.find(id);
    const DistancePart* distance = joint != nullptr ? std::get_if<DistancePart>(&joint->parts) : nullptr;
    Status value = checkSpring(spring);
    if (value.ok() && distance != nullptr) { value = checkLength(joint->length, distance->def.limits, spring); }
    return change(*state_, id, value, [&](auto& part) {
        if constexpr (HasSpring<decltype(part)>) {
            part.def.spring = spring;
            return true;
        }
        return false;
    });
}

Status World::setSpringTarget(JointId id, Real target) {
    Real farthest = 0;
    bool isAngle = false;
    const Status status =
        change(*state_, id, checkNumber(static_cast<double>(target), "springTarget"), [&](auto& part) {
            if constexpr (requires { part.def.springTarget; }) {
                isAngle = std::is_same_v<std::remove_cvref_t<decltype(part)>, HingePart>;
                if (part.def.spring) { farthest = std::fabs(target - part.def.springTarget); }
                part.def.springTarget = target;
                return true;
            }
            return false;
        });
    if (!status.ok()) { return status; }
    if (isAngle) { farthest *= widestRadius(*state_, id); }
    noteSpringDriven(*state_, id, farthest);
    return status;
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
    const DistancePart* distance = joint != nullptr ? std::get_if<DistancePart>(&joint->parts) : nullptr;
    const Status value = distance != nullptr ? checkLength(joint->length, limits, distance->def.spring)
                                             : checkLength(1, limits, {});  // what it is, `change` tells
    DrivenMove move;
    const Status status = change(*state_, id, value, toLimits(limits, move));
    if (status.ok()) { noteDriven(*state_, id, move); }
    return status;
}

Status World::setLength(JointId id, Real length) {
    Joint* joint = state_->joints.find(id);
    std::optional<LengthLimits> limits;
    std::optional<Spring> spring;
    bool isPlainRod = false;
    if (joint != nullptr) {
        if (const auto* part = std::get_if<DistancePart>(&joint->parts)) {
            limits = part->def.limits;
            spring = part->def.spring;
            isPlainRod = !limits && !spring;
        }
    }
    const Real before = joint != nullptr ? joint->length : length;
    const Status status = change(*state_, id, checkLength(length, limits, spring),
                                 Overloaded{[&](DistancePart& part) {
                                                part.def.length = joint->length = length;
                                                return true;
                                            },
                                            [](auto&) { return false; }});
    if (!status.ok()) { return status; }
    const Real way = length - before;
    // The length of a spring is none that it is held to.
    noteDriven(*state_, id, {.farthest = std::fabs(way), .way = {isPlainRod ? way : Real(0), 0}});
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
    if (status.ok()) { noteDriven(*state_, id, {.farthest = static_cast<Real>(length(way))}); }
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

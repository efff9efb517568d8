#include <utility>

#include "../bodies/awake.h"
#include "../bodies/body_joints.h"
#include "../bodies/world_boxes.h"
#include "../contacts/pairs_of_shapes.h"
#include "../solve/joint_builder.h"
#include "../state/number_range.h"
#include "../state/world_state.h"
#include "../world.h"
#include "joint_checks.h"

/// What is other in the definition of a joint is set, and nothing else is touched.

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What the ratio of a gear or a pulley multiplies: a coordinate, or the length on a side, rad or metres.
double termOf(const WorldState& world, const GearJointDef& def) {
    return coordinateOf(world, world.joints[def.jointB.index]);
}
double termOf(const WorldState& world, const Joint& joint, const PulleyJointDef& def) {
    return length(anchorBOf(world, joint) - def.groundB);
}

/// In double: times a coordinate of a thousand the rounding of a float would be seen.
double changeOf(Real before, Real now) { return static_cast<double>(now) - static_cast<double>(before); }

/// Another ratio takes hold where the bodies are: what the joint lacks of holding stays as it is.
double constantOf(const WorldState& world, const Joint& joint, const GearJointDef& before, Real ratio) {
    return joint.gearConstant + changeOf(before.ratio, ratio) * termOf(world, before);
}
double constantOf(const WorldState& world, const Joint& joint, const PulleyJointDef& before, Real ratio) {
    return static_cast<double>(joint.length) + changeOf(before.ratio, ratio) * termOf(world, joint, before);
}

/// Whether a joint may have another definition of its kind.
struct NewParts {
    const WorldState& world;
    const Joint& joint;

    Status operator()(const DistanceJointDef&, const DistanceJointDef& now) const {
        return checkParts(now, joint.length);
    }
    Status operator()(const GearJointDef& before, const GearJointDef& now) const { return checkSum(before, now); }
    Status operator()(const PulleyJointDef& before, const PulleyJointDef& now) const {
        const Status sum = checkSum(before, now);
        if (!sum.ok()) { return sum; }
        // It goes with the sum: of what is stretched far a smaller one may leave less than nothing, and pull for ever.
        const auto length = static_cast<Real>(constantOf(world, joint, before, now.ratio));
        return length > 0 ? Status::success() : Status{StatusCode::outOfRange, "ratio"};
    }
    Status operator()(const FilterJointDef&, const FilterJointDef&) const { return Status::success(); }
    template <class Def>
    Status operator()(const Def&, const Def& now) const {
        return checkParts(now);
    }

private:
    template <class Def>
    Status checkSum(const Def& before, const Def& now) const {
        const Status ratio = checkParts(now);
        if (!ratio.ok()) { return ratio; }
        const bool isGood = isInRange(constantOf(world, joint, before, now.ratio));
        return isGood ? Status::success() : Status{StatusCode::outOfRange, "ratio"};
    }
};

/// Sets what is other, by the setters where there are any: none of them refuses what `NewParts` found good.
/// @return whether it changed what no setter does, so that nobody woke the bodies
struct PartSetter {
    World& face;
    const WorldState& world;
    Joint& joint;
    JointId id;

    bool operator()(RevoluteJointDef& before, const RevoluteJointDef& now) const {
        if (now.limits != before.limits) { (void)face.setAngleLimits(id, now.limits); }
        if (now.motor != before.motor) { (void)face.setAngularMotor(id, now.motor); }
        setAimedSpring(before, now);
        return false;
    }
    bool operator()(DistanceJointDef& before, const DistanceJointDef& now) const {
        const Real length = now.length.value_or(joint.length);
        const auto setLength = [&] {
            if (length != joint.length) { (void)face.setLength(id, length); }
        };
        if (joint.length == 0) { setLength(); }  // before a spring comes: with one it must not be 0
        setSpring(before, now);
        if (now.limits != before.limits) { (void)face.setLengthLimits(id, now.limits); }
        setLength();
        return false;
    }
    bool operator()(PrismaticJointDef& before, const PrismaticJointDef& now) const {
        if (now.limits != before.limits) { (void)face.setTranslationLimits(id, now.limits); }
        if (now.motor != before.motor) { (void)face.setLinearMotor(id, now.motor); }
        setAimedSpring(before, now);
        return false;
    }
    bool operator()(WheelJointDef& before, const WheelJointDef& now) const {
        if (now.limits != before.limits) { (void)face.setTranslationLimits(id, now.limits); }
        if (now.motor != before.motor) { (void)face.setAngularMotor(id, now.motor); }
        setAimedSpring(before, now);
        return false;
    }
    bool operator()(WeldJointDef& before, const WeldJointDef& now) const {
        const bool areSame = now.linearSpring == before.linearSpring && now.angularSpring == before.angularSpring;
        if (!areSame) { (void)face.setWeldSprings(id, now.linearSpring, now.angularSpring); }
        return false;
    }
    bool operator()(MotorJointDef& before, const MotorJointDef& now) const {
        if (!(now.drive == before.drive)) { (void)face.setDrive(id, now.drive); }
        return false;
    }
    bool operator()(MouseJointDef& before, const MouseJointDef& now) const {
        if (now.target != before.target) { (void)face.setTarget(id, now.target); }
        setSpring(before, now);
        return std::exchange(before.maxForce, now.maxForce) != now.maxForce;
    }
    bool operator()(GearJointDef& before, const GearJointDef& now) const {
        joint.gearConstant = constantOf(world, joint, before, now.ratio);
        return std::exchange(before.ratio, now.ratio) != now.ratio;
    }
    bool operator()(PulleyJointDef& before, const PulleyJointDef& now) const {
        joint.length = static_cast<Real>(constantOf(world, joint, before, now.ratio));
        if (before.length) { before.length = joint.length; }
        return std::exchange(before.ratio, now.ratio) != now.ratio;
    }
    bool operator()(FilterJointDef&, const FilterJointDef&) const { return false; }

private:
    template <class Def>
    void setSpring(const Def& before, const Def& now) const {
        if (now.spring != before.spring) { (void)face.setSpring(id, now.spring); }
    }
    template <class Def>
    void setAimedSpring(const Def& before, const Def& now) const {
        setSpring(before, now);
        if (now.springTarget != before.springTarget) { (void)face.setSpringTarget(id, now.springTarget); }
    }
};

/// @return whether its bodies may meet now and might not before, or the other way round
bool setCollideConnected(WorldState& world, Joint& joint, bool collide) {
    const bool kept = joint.keepsApart();
    joint.base.collideConnected = collide || joint.type() == JointType::mouse;
    if (joint.keepsApart() == kept) { return false; }
    if (kept) {
        renewProxies(world, bodyOfFewerShapes(world, joint));
    } else {
        removePairs(world, pairsBetween(world, joint));
    }
    return true;
}

}  // namespace

Status World::redefine(JointId id, const AnyJointDef& def) {
    WorldState& world = *state_;
    Joint* const joint = world.joints.find(id);
    if (joint == nullptr) { return {StatusCode::staleId, "joint"}; }
    if (def.index() != joint->parts.index()) { return {StatusCode::wrongJointType, "joint"}; }
    // Calls `visit` with the definition that the joint has and the other one.
    const auto withBoth = [joint, &def](const auto& visit) {
        return std::visit([&](auto& part) { return visit(part.def, std::get<std::decay_t<decltype(part.def)>>(def)); },
                          joint->parts);
    };
    const JointDef& base = std::visit([](const auto& now) -> const JointDef& { return now.base; }, def);
    const Status status =
        firstFault({checkBreakLimits(base.breakForce, base.breakTorque), withBoth(NewParts{world, *joint})});
    if (!status.ok()) { return status; }
    bool isOther = withBoth(PartSetter{*this, world, *joint, id});
    (void)setBreakLimits(id, base.breakForce, base.breakTorque);  // it would be refused above
    joint->base.userData = base.userData;
    isOther = setCollideConnected(world, *joint, base.collideConnected) || isOther;
    withBoth([](auto& mine, const auto& now) {
        mine.base.userData = now.base.userData;
        mine.base.collideConnected = now.base.collideConnected;
    });
    if (isOther) {
        for (const std::uint32_t body : joint->allBodies()) { rouse(world, body); }
    }
    return Status::success();
}

}  // namespace swept::inline SWEPT_PRECISION

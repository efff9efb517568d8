#include "joint_validation.h"

#include <string_view>
#include <utility>

#include "scene_geometry.h"

namespace swept {
namespace {

class JointValidator : private FieldCheck {
public:
    JointValidator(const SceneDescription& scene, const NameIndex& bodies, double largest)
        : FieldCheck(largest), scene_(scene), bodies_(bodies) {}

    std::optional<SceneError> run() {
        const Place root;  // a place refers to the one above it
        const Place joints = root.at("joints");
        if (!checkNames(scene_.joints, "joint", joints, jointNames_)) { return takeError(); }
        for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
            if (!checkJoint(scene_.joints[i], joints.at(i))) { return takeError(); }
        }
        return std::nullopt;
    }

private:
    bool findBody(const std::string& name, const Place& place, std::size_t& index) {
        const auto found = bodies_.find(name);
        if (found == bodies_.end()) {
            std::vector<std::string_view> names;
            for (const auto& entry : bodies_) { names.push_back(entry.first); }
            const std::string_view nearest = nearestName(name, names);
            return fail(place, "there is no body " + inQuotes(name) +
                                   (nearest.empty() ? "" : "; did you mean " + inQuotes(nearest) + "?"));
        }
        index = found->second;
        return true;
    }

    // lower ≤ upper, where both exist.
    bool checkOrder(const std::optional<double>& lower, const std::optional<double>& upper, const Place& upperPlace,
                    const std::string& lowerName) {
        if (!lower || !upper || *lower <= *upper) { return true; }
        return fail(upperPlace, shortestNumber(*upper) + " is below " + lowerName + " " + shortestNumber(*lower));
    }

    template <class Members>
    bool checkSpring(const Members& joint, const Place& place) {
        if (joint.hertz) { return true; }
        if (joint.dampingRatio) {
            return fail(place.at("dampingRatio"), "there is no spring to damp: \"hertz\" is missing");
        }
        if constexpr (requires { joint.springTarget; }) {
            if (joint.springTarget) {
                return fail(place.at("springTarget"), "there is no spring to aim: \"hertz\" is missing");
            }
        }
        return true;
    }

    // A motor of a revolute, prismatic or wheel joint. @param strength  name of the member that has it
    bool checkMotor(const std::optional<double>& speed, const std::optional<double>& limit, const Place& place,
                    const std::string& strength) {
        if (!speed || limit) { return true; }
        return fail(place.at("motorSpeed"), "a motor without \"" + strength + "\" has no strength");
    }

    bool checkAxis(DVec2 axis, const Place& place) {
        return axis != DVec2{} || fail(place.at("axis"), "must have a direction, [0, 0] has none");
    }

    bool checkJoint(const PrismaticDescription& joint, const Place& place) {
        return checkAxis(joint.axis, place) && checkOrder(joint.lower, joint.upper, place.at("upper"), "lower") &&
               checkMotor(joint.motorSpeed, joint.maxMotorForce, place, "maxMotorForce") && checkSpring(joint, place);
    }

    bool checkJoint(const WheelDescription& joint, const Place& place) {
        return checkAxis(joint.axis, place) && checkOrder(joint.lower, joint.upper, place.at("upper"), "lower") &&
               checkMotor(joint.motorSpeed, joint.maxMotorTorque, place, "maxMotorTorque") && checkSpring(joint, place);
    }

    bool checkJoint(const WeldDescription& joint, const Place& place) {
        if (!joint.dampingRatio || joint.linearHertz || joint.angularHertz) { return true; }
        return fail(place.at("dampingRatio"),
                    "there is no spring to damp: \"linearHertz\" and \"angularHertz\" are missing");
    }

    // One of the two drives: what it aims at needs a strength, and is one thing.
    bool checkDrive(bool hasOffset, bool hasVelocity, bool hasStrength, const Place& place, const std::string& offset,
                    const std::string& velocity, const std::string& strength) {
        if (hasOffset && hasVelocity) {
            return fail(place.at(velocity), "there is \"" + offset + "\" already: a motor has one aim");
        }
        if ((hasOffset || hasVelocity) && !hasStrength) {
            return fail(place.at(hasOffset ? offset : velocity),
                        "a motor without \"" + strength + "\" has no strength");
        }
        return true;
    }

    bool checkJoint(const MotorDescription& joint, const Place& place) {
        if (!joint.maxForce && !joint.maxTorque) {
            return fail(place, "a motor needs \"maxForce\" or \"maxTorque\" or both");
        }
        return checkDrive(joint.linearOffset.has_value(), joint.linearVelocity.has_value(), joint.maxForce.has_value(),
                          place, "linearOffset", "linearVelocity", "maxForce") &&
               checkDrive(joint.angularOffset.has_value(), joint.angularVelocity.has_value(),
                          joint.maxTorque.has_value(), place, "angularOffset", "angularVelocity", "maxTorque");
    }

    bool checkJoint(const MouseDescription& joint, const Place& place) { return checkSpring(joint, place); }

    // One of the two joints of a gear, and the body of it that the gear names.
    bool checkGeared(const std::string& name, const Place& place, const std::string& body, const Place& bodyPlace) {
        const auto found = jointNames_.find(name);
        if (found == jointNames_.end()) {
            std::vector<std::string_view> names;
            for (const auto& entry : jointNames_) { names.push_back(entry.first); }
            const std::string_view nearest = nearestName(name, names);
            return fail(place, "there is no joint " + inQuotes(name) +
                                   (nearest.empty() ? "" : "; did you mean " + inQuotes(nearest) + "?"));
        }
        const JointDescription& geared = scene_.joints[found->second];
        const bool hasCoordinate = std::holds_alternative<RevoluteDescription>(geared.joint) ||
                                   std::holds_alternative<PrismaticDescription>(geared.joint);
        if (!hasCoordinate) {
            return fail(place, "only revolute and prismatic joints can be geared, " + inQuotes(name) + " is a " +
                                   std::string(jointTypeNames()[geared.joint.index()]) + " joint");
        }
        return body == geared.bodyB || fail(bodyPlace, "must be the body that joint " + inQuotes(name) +
                                                           " moves, its bodyB " + inQuotes(geared.bodyB));
    }

    bool checkGear(const JointDescription& joint, const GearDescription& gear, const Place& place) {
        if (gear.ratio == 0) { return fail(place.at("ratio"), "must not be 0"); }
        return checkGeared(gear.jointA, place.at("jointA"), joint.bodyA, place.at("bodyA")) &&
               checkGeared(gear.jointB, place.at("jointB"), joint.bodyB, place.at("bodyB"));
    }

    bool checkJoint(const GearDescription&, const Place&) { return true; }  // see checkGear
    bool checkJoint(const PulleyDescription&, const Place&) { return true; }
    bool checkJoint(const FilterJointDescription&, const Place&) { return true; }

    // What cannot be said of a joint without the members common to all.
    bool checkWhole(const JointDescription& joint, bool movesB, const Place& place) {
        if (const auto* gear = std::get_if<GearDescription>(&joint.joint)) { return checkGear(joint, *gear, place); }
        if (std::holds_alternative<MouseDescription>(joint.joint) && !movesB) {
            return fail(place.at("bodyB"), "must be dynamic: it is what the joint pulls");
        }
        if (std::holds_alternative<FilterJointDescription>(joint.joint)) {
            if (joint.collideConnected) {
                return fail(place.at("collideConnected"), "a filter is there to keep its bodies from colliding");
            }
            if (joint.breakForce || joint.breakTorque) {
                return fail(place.at(joint.breakForce ? "breakForce" : "breakTorque"), "a filter bears no force");
            }
        }
        return true;
    }

    bool checkJoint(const RevoluteDescription& joint, const Place& place) {
        if (!checkOrder(joint.lower, joint.upper, place.at("upper"), "lower")) { return false; }
        return checkMotor(joint.motorSpeed, joint.maxMotorTorque, place, "maxMotorTorque") && checkSpring(joint, place);
    }

    bool checkJoint(const DistanceDescription& joint, const Place& place) {
        const bool together = joint.anchorA == joint.anchorB;
        const bool isSprung = joint.hertz.has_value();  // a spring of no length has no direction
        if (together && !joint.length && (isSprung || !joint.maxLength)) {
            return fail(place.at("anchorB"), "must differ from anchorA " + textOf(joint.anchorA) + ", or \"length\" " +
                                                 (isSprung ? "be given" : "or \"maxLength\" be given"));
        }
        return checkOrder(joint.minLength, joint.maxLength, place.at("maxLength"), "minLength") &&
               checkOrder(joint.minLength, joint.length, place.at("length"), "minLength") &&
               checkOrder(joint.length, joint.maxLength, place.at("maxLength"), "length") && checkSpring(joint, place);
    }

    bool checkJoint(const JointDescription& joint, const Place& place) {
        std::size_t a = 0;
        std::size_t b = 0;
        const Place placeB = place.at("bodyB");
        if (!findBody(joint.bodyA, place.at("bodyA"), a) || !findBody(joint.bodyB, placeB, b)) { return false; }
        if (a == b) { return fail(placeB, "must differ from bodyA, both are " + inQuotes(joint.bodyB)); }
        const auto isDynamic = [&](std::size_t i) { return scene_.bodies[i].type == SceneBodyType::dynamic; };
        if (!isDynamic(a) && !isDynamic(b)) {
            return fail(placeB, "a joint needs a dynamic body, neither " + inQuotes(joint.bodyA) + " nor " +
                                    inQuotes(joint.bodyB) + " is one");
        }
        if (!checkFields(joint, place)) { return false; }
        return std::visit(
                   [&](const auto& members) { return checkFields(members, place) && checkJoint(members, place); },
                   joint.joint) &&
               checkWhole(joint, isDynamic(b), place);
    }

    const SceneDescription& scene_;
    const NameIndex& bodies_;
    NameIndex jointNames_;
};

}  // namespace

std::optional<SceneError> faultOfJoints(const SceneDescription& scene, const NameIndex& bodies, double largest) {
    return JointValidator(scene, bodies, largest).run();
}

}  // namespace swept

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "json_strict.h"
#include "scene_fields.h"
#include "scene_geometry.h"
#include "scene_names.h"
#include "scene_reader.h"

namespace swept {
namespace {

// "must be …" for a range; empty when the range allows every number.
std::string demandOf(const Range& range) {
    if (std::isfinite(range.lowest) && std::isfinite(range.highest)) {
        return "must be from " + shortestNumber(range.lowest) + " to " + shortestNumber(range.highest);
    }
    if (!std::isfinite(range.lowest)) {
        return "must be a number";
    }
    return (range.lowestExcluded ? "must be greater than " : "must be at least ") + shortestNumber(range.lowest);
}

/// Walks a scene in the order of the format and keeps the first error.
class Validator {
public:
    Validator(const SceneDescription& scene, double largest) : scene_(scene), largest_(largest) {}

    std::optional<SceneError> run() {
        if (!checkScene()) {
            return std::move(error_);
        }
        return std::nullopt;
    }

private:
    using NameIndex = std::map<std::string, std::size_t, std::less<>>;

    bool fail(const Place& place, std::string reason) {
        if (!error_) {
            error_ = SceneError{"", place.pointer(), std::move(reason)};
        }
        return false;
    }

    // --- single values, by the table
    // -----------------------------------------------------------------------------------

    bool check(double value, const Place& place, const Range& range) {
        if (!std::isfinite(value)) {
            return fail(place, "must be finite, not " + shortestNumber(value));
        }
        const bool tooLow = range.lowestExcluded ? value <= range.lowest : value < range.lowest;
        if (tooLow || value > range.highest) {
            return fail(place, demandOf(range) + ", not " + shortestNumber(value));
        }
        if (std::fabs(value) > largest_) {
            return fail(place, shortestNumber(value) + " is too large: the largest number allowed is " +
                                   shortestNumber(largest_));
        }
        if (range.lowestExcluded && value < 1 / largest_) {
            return fail(place, shortestNumber(value) + " is too small: single precision would make it 0");
        }
        return true;
    }
    bool check(int value, const Place& place, const Range& range) {
        return check(static_cast<double>(value), place, range);
    }
    bool check(DVec2 value, const Place& place, const Range& range) {
        return check(value.x, place.at(0), range) && check(value.y, place.at(1), range);
    }
    bool check(const std::array<DVec2, 2>& points, const Place& place, const Range& range) {
        return check(points[0], place.at(0), range) && check(points[1], place.at(1), range);
    }
    bool check(const std::vector<DVec2>& points, const Place& place, const Range& range) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!check(points[i], place.at(i), range)) {
                return false;
            }
        }
        return true;
    }
    template <class Value>
    bool check(const std::optional<Value>& value, const Place& place, const Range& range) {
        return !value || check(*value, place, range);
    }
    template <Described Object>
    bool check(const Object& object, const Place& place, const Range&) {
        return checkFields(object, place);
    }
    // Words, truths, filters' bit sets have no wrong values; bodies, shapes and joints have their own walk below.
    bool check(const std::string&, const Place&, const Range&) { return true; }
    bool check(bool, const Place&, const Range&) { return true; }
    bool check(std::uint32_t, const Place&, const Range&) { return true; }
    bool check(SceneBodyType, const Place&, const Range&) { return true; }
    bool check(SceneContinuous, const Place&, const Range&) { return true; }
    bool check(SceneProfile, const Place&, const Range&) { return true; }
    bool check(SceneBroadphase, const Place&, const Range&) { return true; }
    bool check(const std::vector<ShapeDescription>&, const Place&, const Range&) { return true; }
    bool check(const std::vector<BodyDescription>&, const Place&, const Range&) { return true; }
    bool check(const std::vector<JointDescription>&, const Place&, const Range&) { return true; }

    template <Described Object>
    bool checkFields(const Object& object, const Place& place) {
        bool good = true;
        forEachField<Object>([&](const auto& field) {
            if (!good) {
                return;
            }
            if constexpr (kBare<Object>) {
                good = check(object.*(field.member), place, field.range);
            } else {
                good = check(object.*(field.member), place.at(std::string_view(field.key)), field.range);
            }
        });
        return good;
    }

    // --- names
    // ---------------------------------------------------------------------------------------------------------

    // Given names must differ from each other and from the names of the unnamed (`body<index>`).
    template <class Named>
    bool checkNames(const std::vector<Named>& elements, const std::string& prefix, const Place& list,
                    NameIndex& index) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (elements[i].name.empty()) {
                index.emplace(prefix + std::to_string(i), i);
            }
        }
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const std::string& name = elements[i].name;
            if (name.empty()) {
                continue;
            }
            const auto [other, isNew] = index.emplace(name, i);
            if (isNew) {
                continue;
            }
            const std::size_t j = other->second;
            const std::string taken = elements[j].name.empty() ? " is the name of the unnamed " : " is the name of ";
            const Place element = list.at(i);
            return fail(element.at("name"), inQuotes(name) + taken + list.at(j).pointer() + " already");
        }
        return true;
    }

    // --- bodies
    // --------------------------------------------------------------------------------------------------------

    bool checkShape(const ShapeDescription& shape, SceneBodyType type, const Place& place) {
        const std::string_view kind = geometryNames()[shape.geometry.index()];
        const Place geometry = place.at(kind);
        const bool goodNumbers = std::visit([&](const auto& g) { return checkFields(g, geometry); }, shape.geometry);
        if (!goodNumbers) {
            return false;
        }
        if (const auto fault = geometryFault(shape.geometry)) {
            if (!error_) {
                error_ = SceneError{"", geometry.pointer() + fault->member, fault->reason};
            }
            return false;
        }
        if (kind == "chain" && type == SceneBodyType::dynamic) {
            return fail(geometry, "a chain needs a static or kinematic body, this one is dynamic");
        }
        if ((kind == "circle" || kind == "capsule") && shape.radius != 0) {
            return fail(place.at("radius"), "the radius of a " + std::string(kind) + " belongs inside \"" +
                                                std::string(kind) + "\", not beside it");
        }
        return checkFields(shape, place);
    }

    bool checkMotion(const BodyDescription& body, const Place& place) {
        const bool turns = body.angularVelocity != 0;
        if (body.type == SceneBodyType::fixed) {
            if (!(body.velocity == DVec2{})) {
                return fail(place.at("velocity"),
                            "a static body does not move, but has velocity " + textOf(body.velocity));
            }
            if (turns) {
                return fail(place.at("angularVelocity"), "a static body does not turn, but has angular velocity " +
                                                             shortestNumber(body.angularVelocity));
            }
        }
        if (body.fixedRotation && turns) {
            return fail(place.at("angularVelocity"),
                        "a body with fixed rotation does not turn, but has angular velocity " +
                            shortestNumber(body.angularVelocity));
        }
        if (body.type == SceneBodyType::dynamic) {
            return true;
        }
        const std::string type(namesOf<SceneBodyType>()[static_cast<std::size_t>(body.type)]);
        if (body.mass) {
            return fail(place.at("mass"), "only a dynamic body has a mass, this one is " + type);
        }
        if (body.inertia) {
            return fail(place.at("inertia"), "only a dynamic body has an inertia, this one is " + type);
        }
        return true;
    }

    bool checkMass(const BodyDescription& body, const Place& place) {
        if (body.type != SceneBodyType::dynamic) {
            return true;
        }
        const MassAndInertia shapes = massOfShapes(body);
        const double mass = body.mass.value_or(shapes.mass);
        // A given mass scales the inertia that the shapes have.
        const double perMass = body.mass && shapes.mass > 0 ? *body.mass / shapes.mass : 1;
        const double inertia = body.inertia.value_or(shapes.inertia * perMass);
        const auto missing = [&](double value) { return !(value >= 1 / largest_); };
        if (missing(mass)) {
            return fail(place, "a dynamic body needs mass (its shapes give " + shortestNumber(shapes.mass) +
                                   " kg): give a shape area and density, or the body a \"mass\"");
        }
        if (missing(inertia) && !body.fixedRotation) {
            return fail(place, "a dynamic body that may turn needs inertia (its shapes give " +
                                   shortestNumber(shapes.inertia) +
                                   " kg·m²): give a shape area and density, the body an \"inertia\", or fixedRotation");
        }
        if (mass > largest_ || inertia > largest_) {
            return fail(place, "the mass or inertia of the shapes is too large: " + shortestNumber(mass) + " kg, " +
                                   shortestNumber(inertia) + " kg·m²; the largest number allowed is " +
                                   shortestNumber(largest_));
        }
        return true;
    }

    bool checkBody(const BodyDescription& body, const Place& place) {
        if (!checkFields(body, place) || !checkMotion(body, place)) {
            return false;
        }
        const Place shapes = place.at("shapes");
        for (std::size_t i = 0; i < body.shapes.size(); ++i) {
            if (!checkShape(body.shapes[i], body.type, shapes.at(i))) {
                return false;
            }
        }
        return checkMass(body, place);
    }

    // --- joints
    // --------------------------------------------------------------------------------------------------------

    bool findBody(const std::string& name, const Place& place, std::size_t& index) {
        const auto found = bodies_.find(name);
        if (found == bodies_.end()) {
            std::vector<std::string_view> names;
            for (const auto& entry : bodies_) {
                names.push_back(entry.first);
            }
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
        if (!lower || !upper || *lower <= *upper) {
            return true;
        }
        return fail(upperPlace, shortestNumber(*upper) + " is below " + lowerName + " " + shortestNumber(*lower));
    }

    template <class Members>
    bool checkSpring(const Members& joint, const Place& place) {
        if (joint.hertz || !joint.dampingRatio) {
            return true;
        }
        return fail(place.at("dampingRatio"), "there is no spring to damp: \"hertz\" is missing");
    }

    // A motor of a revolute, prismatic or wheel joint. @param strength  name of the member that has it
    bool checkMotor(const std::optional<double>& speed, const std::optional<double>& limit, const Place& place,
                    const std::string& strength) {
        if (!speed || limit) {
            return true;
        }
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
        if (!joint.dampingRatio || joint.linearHertz || joint.angularHertz) {
            return true;
        }
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
            return fail(place.at(hasOffset ? offset : velocity), "a motor without \"" + strength + "\" has no strength");
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
            for (const auto& entry : jointNames_) {
                names.push_back(entry.first);
            }
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
        if (gear.ratio == 0) {
            return fail(place.at("ratio"), "must not be 0");
        }
        return checkGeared(gear.jointA, place.at("jointA"), joint.bodyA, place.at("bodyA")) &&
               checkGeared(gear.jointB, place.at("jointB"), joint.bodyB, place.at("bodyB"));
    }

    bool checkJoint(const GearDescription&, const Place&) { return true; }  // see checkGear
    bool checkJoint(const PulleyDescription&, const Place&) { return true; }
    bool checkJoint(const FilterJointDescription&, const Place&) { return true; }

    // What cannot be said of a joint without the members common to all.
    bool checkWhole(const JointDescription& joint, bool movesB, const Place& place) {
        if (const auto* gear = std::get_if<GearDescription>(&joint.joint)) {
            return checkGear(joint, *gear, place);
        }
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
        if (!checkOrder(joint.lower, joint.upper, place.at("upper"), "lower")) {
            return false;
        }
        return checkMotor(joint.motorSpeed, joint.maxMotorTorque, place, "maxMotorTorque") && checkSpring(joint, place);
    }

    bool checkJoint(const DistanceDescription& joint, const Place& place) {
        const bool together = joint.anchorA == joint.anchorB;
        if (together && !joint.length && !joint.maxLength) {
            return fail(place.at("anchorB"), "must differ from anchorA " + textOf(joint.anchorA) +
                                                 ", or \"length\" or \"maxLength\" be given");
        }
        return checkOrder(joint.minLength, joint.maxLength, place.at("maxLength"), "minLength") &&
               checkOrder(joint.minLength, joint.length, place.at("length"), "minLength") &&
               checkOrder(joint.length, joint.maxLength, place.at("maxLength"), "length") && checkSpring(joint, place);
    }

    bool checkJoint(const JointDescription& joint, const Place& place) {
        std::size_t a = 0;
        std::size_t b = 0;
        const Place placeB = place.at("bodyB");
        if (!findBody(joint.bodyA, place.at("bodyA"), a) || !findBody(joint.bodyB, placeB, b)) {
            return false;
        }
        if (a == b) {
            return fail(placeB, "must differ from bodyA, both are " + inQuotes(joint.bodyB));
        }
        const auto isDynamic = [&](std::size_t i) { return scene_.bodies[i].type == SceneBodyType::dynamic; };
        if (!isDynamic(a) && !isDynamic(b)) {
            return fail(placeB, "a joint needs a dynamic body, neither " + inQuotes(joint.bodyA) + " nor " +
                                    inQuotes(joint.bodyB) + " is one");
        }
        if (!checkFields(joint, place)) {
            return false;
        }
        return std::visit(
            [&](const auto& members) { return checkFields(members, place) && checkJoint(members, place); },
            joint.joint) && checkWhole(joint, isDynamic(b), place);
    }

    // -------------------------------------------------------------------------------------------------------------------

    bool checkScene() {
        const Place root;
        if (!checkFields(scene_, root)) {
            return false;
        }
        const Place bodies = root.at("bodies");
        if (!checkNames(scene_.bodies, "body", bodies, bodies_)) {
            return false;
        }
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            if (!checkBody(scene_.bodies[i], bodies.at(i))) {
                return false;
            }
        }
        const Place joints = root.at("joints");
        if (!checkNames(scene_.joints, "joint", joints, jointNames_)) {
            return false;
        }
        for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
            if (!checkJoint(scene_.joints[i], joints.at(i))) {
                return false;
            }
        }
        return true;
    }

    const SceneDescription& scene_;
    double largest_;
    NameIndex bodies_;
    NameIndex jointNames_;
    std::optional<SceneError> error_;
};

}  // namespace

std::optional<SceneError> validateScene(const SceneDescription& scene, double largest) {
    return Validator(scene, largest).run();
}

}  // namespace swept
